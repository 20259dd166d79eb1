// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Error and overload frames with their causes in words, and lost arbitrations.
import {csvButton, tableRows} from './csv.js';
import {el, tabWithBar} from './dom.js';
import {bitTitle, errorKinds, fieldName, kErrorKinds, kErrorTexts} from './fields.js';
import {formatCount, hex, milliseconds} from './format.js';
import {kEventKinds, nodeCell, nodeText} from './frames_tab.js';
import {Table} from './table.js';

const kLoss = 0x80000000;

/** Where an event was found: "DATA byte 2, bit 5" of the lane of the node that found it. */
export function placeOf(report, event) {
  const lane =
    report.lanesOf(event.segment).find((l) => l.nodeIndex === event.node) ??
    report.lane(event.segment);
  const bit = lane ? lane.bitAt(event.start + lane.tq / 2) : -1;
  if (bit >= 0) {
    const stuff = lane.stuff(bit) ? ' (stuff bit)' : '';
    return `${bitTitle(lane.field(bit), lane.place(bit))}${stuff}`;
  }
  return fieldName(event.field);
}

/** The identifier that was on the bus, as far as it got. */
function idOf(report, segment) {
  const lane = report.lane(segment);
  const {id, extended} = lane ? lane.decode() : {id: null};
  return id === null ? '' : hex(id, extended ? 8 : 3);
}

function columnsOf(report) {
  const {events, losses} = report;
  const loss = (row) => row >= kLoss;
  const index = (row) => row & 0x7fffffff;
  const time = (row) => (loss(row) ? losses.time[index(row)] : events.start[index(row)]);
  const node = (row) => (loss(row) ? losses.node[index(row)] : events.node[index(row)]);
  const kind = (row) => (loss(row) ? 'lost arbitration' : kEventKinds[events.kind[index(row)]]);
  const winner = (row) => report.nodeName(losses.winner[index(row)]);
  const cause = (row) =>
    loss(row)
      ? `another node's identifier has priority: ${winner(row)} goes on`
      : report.event(index(row)).cause.text;
  const place = (row) =>
    loss(row) ? fieldName(losses.field[index(row)]) : placeOf(report, report.event(index(row)));
  const segment = (row) => (loss(row) ? losses.segment[index(row)] : events.segment[index(row)]);
  return [
    {
      name: 'time, ms',
      title: 'Start of the bit that showed it',
      width: '104px',
      numeric: true,
      mono: true,
      text: (row) => milliseconds(time(row), 6),
      key: time,
    },
    {
      name: 'what',
      title: 'Error frame, overload frame or lost arbitration',
      width: '120px',
      text: kind,
      key: kind,
    },
    {
      name: 'error',
      title: kErrorKinds.map((name, i) => `${name}: ${kErrorTexts[i]}`).join('; '),
      width: '96px',
      text: (row) =>
        loss(row) ? '' : events.kind[index(row)] === 1 ? '' : errorKinds(events.error[index(row)]),
      key: (row) => (loss(row) ? '' : errorKinds(events.error[index(row)])),
    },
    {
      name: 'cause',
      title: 'What happened, in words',
      width: 'minmax(260px, 3fr)',
      text: cause,
      key: cause,
    },
    {
      name: 'rule',
      title: 'Rule of the protocol: docs/rules.md',
      width: '64px',
      text: (row) => (loss(row) ? 'AR-02' : report.event(index(row)).cause.rule),
      key: (row) => (loss(row) ? 'AR-02' : report.event(index(row)).cause.rule),
    },
    {
      name: 'found by',
      title: 'The node that found it first',
      width: 'minmax(90px, 1fr)',
      node: (row) => nodeCell(report, node(row)),
      csv: (row) => nodeText(report, node(row)),
      key: (row) => report.nodeName(node(row)),
    },
    {name: 'where', title: 'Field and bit', width: 'minmax(110px, 1fr)', text: place},
    {
      name: 'id',
      title: 'Identifier on the bus, as far as it got',
      width: '84px',
      mono: true,
      text: (row) => idOf(report, segment(row)),
    },
  ];
}

export class EventsTab {
  constructor(report, view, steps) {
    Object.assign(this, {report, view});
    this.table = new Table(columnsOf(report), {
      label: 'Errors, overloads and lost arbitrations',
      style: (row) => (row >= kLoss ? '' : report.events.kind[row] === 1 ? 'overload' : 'error'),
      pick: (row) => (row >= kLoss ? steps.showLoss(row - kLoss) : steps.showEvent(row)),
    });
    this.withLosses = el('input', {type: 'checkbox', checked: true, onchange: () => this.show()});
    const counts =
      `errors and overloads ${formatCount(report.events.count)}, ` +
      `lost arbitrations ${formatCount(report.losses.count)}`;
    this.root = tabWithBar(
      [
        el('label', {}, this.withLosses, ' lost arbitrations too'),
        csvButton(report, 'errors', () => tableRows(this.table)),
        el('span', {class: 'found'}, counts),
      ],
      this.table.root,
    );
    view.addEventListener('select', () => this.#mark());
    this.show();
  }

  show() {
    const {events, losses} = this.report;
    const count = this.withLosses.checked ? losses.count : 0;
    const rows = new Uint32Array(events.count + count);
    for (let i = 0; i < events.count; ++i) rows[i] = i;
    for (let i = 0; i < count; ++i) rows[events.count + i] = kLoss + i;
    const time = (row) => (row >= kLoss ? losses.time[row - kLoss] : events.start[row]);
    this.table.show(rows.sort((a, b) => time(a) - time(b)));
  }

  #mark() {
    const {selection} = this.view;
    if (selection?.kind === 'event') this.table.mark(selection.index);
    else if (selection?.kind === 'loss') this.table.mark(kLoss + selection.index);
    else if (!selection) this.table.mark(-1);
  }
}
