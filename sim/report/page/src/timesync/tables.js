// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Tables of the run that is shown: figures of each follower, and what happened.
import {el, swatch} from '../dom.js';
import {formatCount} from '../format.js';
import {nodeColor} from '../theme.js';
import {eventWords, figuresOf, kStates} from './sync_data.js';

const kMostEvents = 2000; // rows; more of them would only make the page slow

const ns = (value) => (Number.isFinite(value) ? value.toFixed(1) : '–');
const ppm = (value) => (Number.isFinite(value) ? value.toFixed(3) : '–');

/** @param head of each column its name, what it is, and whether it holds numbers */
function table(head, rows) {
  const cells = head.map(([text, title, number]) =>
    el('th', {title, class: number ? 'right' : ''}, text),
  );
  return el(
    'table',
    {class: 'plain'},
    el('thead', {}, el('tr', {}, cells)),
    el('tbody', {}, rows),
  );
}

/** A row for each follower; `toggle(n)` shows or hides it. */
export function followersTable(page, toggle) {
  const {when} = page.data;
  const goal = page.data.goal?.max ?? Infinity;
  const rows = page.run.followers.map(({meanRate}, n) => {
    const {count, mean, sd, max} = figuresOf(page.run.counted(n));
    const box = el('input', {type: 'checkbox', checked: page.shown(n), id: `follower-${n}`});
    box.addEventListener('change', () => toggle(n));
    const name = el('label', {for: `follower-${n}`}, swatch(nodeColor(n)), `follower ${n + 1}`);
    const figures = [formatCount(count), ns(mean), ns(sd), ns(max), ppm(meanRate)];
    return el(
      'tr',
      {class: max <= goal ? '' : 'failed'},
      el('td', {}, box, name),
      figures.map((text) => el('td', {class: 'right'}, text)),
    );
  });
  return table(
    [
      ['', 'Untick it to hide it'],
      ['samples', `Looks at it ${when}`, true],
      ['mean, ns', `Of the offset ${when}`, true],
      ['sd, ns', 'Standard deviation of the offset', true],
      ['max, ns', 'Largest offset, either way', true],
      ['rate, ppm', 'Mean of its increment against the nominal one', true],
    ],
    rows,
  );
}

/** A row for each correction that is more than a pair taken; a click goes there. */
export function eventsTable(page) {
  const events = page.run.events().filter(({follower}) => page.shown(follower));
  const rows = events.slice(0, kMostEvents).map(({at, follower, shift, events: bits, state}) => {
    const row = el('tr', {}, el('td', {}, (at / 1e9).toFixed(3)));
    const name = el('td', {}, swatch(nodeColor(follower)), String(follower + 1));
    row.append(
      name,
      el('td', {}, eventWords(bits)),
      el('td', {class: 'right'}, formatCount(shift)),
      el('td', {}, kStates[state]),
    );
    row.addEventListener('click', () => page.goTo(at));
    return row;
  });
  const more = events.length - rows.length;
  return [
    table(
      [
        ['time, s', 'Of the simulation'],
        ['follower', 'Its number'],
        ['what', 'The servo did with a pair'],
        ['shift, ns', 'Of the clock', true],
        ['then', 'State from then on'],
      ],
      rows,
    ),
    more > 0 ? el('p', {class: 'dim'}, `and ${formatCount(more)} more`) : null,
  ];
}
