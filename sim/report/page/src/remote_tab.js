// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The remote nodes at a moment: the end of what is selected, else of the window. Of a frame that is
// the end of its intermission, in which the nodes take it (RN-45).
import {el, swatch} from './dom.js';
import {hex, milliseconds} from './format.js';
import {nodeColor} from './theme.js';

const kRow = 16; // bytes of a line
const kIntermission = 3; // bits
const kStates = 8; // last changes of state that a cell names

/** Lines of 16 bytes, without those that are 00 altogether; what has just changed stands out. */
function memoryLines({bytes, changed}) {
  const lines = [];
  for (let at = 0; at < bytes.length; at += kRow) {
    const line = bytes.subarray(at, at + kRow);
    const touched = [...line].some((byte, i) => byte !== 0 || changed.has(at + i));
    if (!touched) continue;
    const cells = [...line].flatMap((byte, i) => [
      ' ',
      changed.has(at + i) ? el('b', {}, hex(byte, 2)) : hex(byte, 2),
    ]);
    lines.push(el('div', {}, hex(at, 3), ...cells));
  }
  return lines.length ? lines : ['all 00'];
}

/** "SAFE, OPERATE at 1.000 ms": the last changes up to the moment. */
function stateText(remote, which, ns) {
  const past = remote.statesOf(which).filter(({from}) => from <= ns);
  const left = past.length - kStates;
  const words = past
    .slice(-kStates)
    .map(({from, state}) => (from > 0 ? `${state} at ${milliseconds(from, 6)} ms` : state));
  return (left > 0 ? '… ' : '') + words.join(', ');
}

export class RemoteTab {
  constructor(report, view) {
    Object.assign(this, {report, view});
    this.moment = el('div', {class: 'search'});
    this.body = el('tbody', {});
    const head = ['node', 'number', 'state', 'states so far', 'window'].map((name) =>
      el('th', {}, name),
    );
    const table = el('table', {class: 'plain'}, el('thead', {}, el('tr', {}, head)), this.body);
    this.root = el(
      'div',
      {class: 'tab-body column'},
      this.moment,
      el('div', {class: 'tab-body scroll'}, table),
    );
    for (const event of ['select', 'move']) view.addEventListener(event, () => this.#later());
  }

  /** The tab has come into sight. */
  show() {
    const {report, view} = this;
    const [from, to] = view.selectionSpan() ?? [view.from, Math.min(view.to, report.duration)];
    const ns = view.selection?.kind === 'frame' ? to + kIntermission * report.bitNs : to;
    const windows = report.remote.windowsAt(ns, from);
    const what = view.selection ? 'what is selected' : 'the window';
    this.moment.replaceChildren(
      `At ${milliseconds(ns, 6)} ms, the end of ${what}. Bold: changed since its beginning.`,
    );
    this.body.replaceChildren(
      ...report.remote.units.map(({node, number}, which) =>
        el(
          'tr',
          {},
          el('td', {}, swatch(nodeColor(node)), report.nodeName(node)),
          el('td', {class: 'right'}, String(number)),
          el('td', {}, report.remote.stateAt(which, ns)),
          el('td', {}, stateText(report.remote, which, ns)),
          el('td', {class: 'memory'}, memoryLines(windows.get(node))),
        ),
      ),
    );
  }

  #later() {
    if (this.root.hidden || this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      if (!this.root.hidden) this.show();
    });
  }
}
