// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The row of buttons above the scope, the legend and the list of keys.
import {el} from './dom.js';
import {kLegend} from './fields.js';
import {formatTime} from './format.js';
import {kKeys} from './keys.js';

function button(text, title, action) {
  return el('button', {type: 'button', title, onclick: action}, text);
}

/** The list of keys, as a dialog. */
export function helpDialog() {
  const rows = kKeys.map(([key, text]) =>
    el('tr', {}, el('td', {}, el('kbd', {}, key)), el('td', {}, text)),
  );
  const dialog = el(
    'dialog',
    {class: 'help'},
    el('h2', {}, 'Keys and mouse'),
    el('table', {}, el('tbody', {}, rows)),
    el(
      'p',
      {},
      'Wheel or pinch: zoom at the pointer. Drag: move. Shift and drag: zoom to the box. ' +
        'Shift and wheel: move. Double click: zoom to the frame. Click: select.',
    ),
    button('Close', 'Esc', () => dialog.close()),
  );
  return dialog;
}

export function legend() {
  const entries = kLegend.map(([color, text]) => {
    const square = el('span', {class: 'swatch'});
    square.style.background = `var(--${color})`;
    return el('span', {}, square, text);
  });
  const stuff = el('span', {}, el('span', {class: 'swatch hatched'}), 'stuff bit');
  const sample = el('span', {}, el('span', {class: 'triangle'}, '▾'), 'sample');
  return el('div', {class: 'legend field-legend'}, entries, stuff, sample);
}

export function toolbar(report, view, steps, actions) {
  const where = el('span', {class: 'where', 'aria-live': 'off', title: 'Window of time in sight'});
  const update = () => {
    const fine = view.span / 500;
    const [from, to] = [formatTime(view.from, fine), formatTime(view.to, fine)];
    where.textContent = `${from} … ${to}   (${formatTime(view.span)})`;
  };
  view.addEventListener('move', update);
  update();
  const group = (...children) => el('span', {class: 'group'}, children);
  return el(
    'div',
    {class: 'toolbar', role: 'toolbar', 'aria-label': 'View'},
    group(
      button('−', 'Zoom out (key −)', () => view.zoom(1 / 0.6)),
      button('+', 'Zoom in (key +)', () => view.zoom(0.6)),
    ),
    group(
      button('whole run', 'Key 0', () => steps.all()),
      button('frame', 'About a frame wide (key 1)', () => steps.bits(140)),
      button('bits', 'About twenty bits wide (key 2)', () => steps.bits(20)),
      button('quanta', 'Three bits with their time quanta (key 3)', () => steps.quanta()),
    ),
    group(
      button('◂ frame', 'Previous frame (key p)', () => steps.frame(-1)),
      button('frame ▸', 'Next frame (key n)', () => steps.frame(1)),
    ),
    report.events.count > 0
      ? group(
          button('◂ error', 'Previous error or overload (Shift+E)', () => steps.event(-1)),
          button('error ▸', 'Next error or overload (key e)', () => steps.event(1)),
        )
      : null,
    where,
    group(
      button('PNG', 'Save this view as a picture', () => actions.picture('png')),
      button('SVG', 'Save this view as a drawing', () => actions.picture('svg')),
    ),
    button('?', 'Keys and mouse', () => actions.help()),
  );
}
