// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The faults of the scenario: what they are, how often and when they took effect.
import {csvButton, tableRows} from './csv.js';
import {el} from './dom.js';
import {faultPlace} from './faults.js';
import {formatCount, formatTime, milliseconds} from './format.js';
import {Table, timeColumn} from './table.js';

const kListed = 500; // moments of one fault that the details name

/** "3", "0, never", "12 000, 10 000 kept"; a moment may count several times. */
function hitsText({hits, times, more}) {
  if (hits === 0) return '0, never';
  const listed = more ? `, ${formatCount(times.length)} kept` : '';
  return `${formatCount(hits)}${listed}`;
}

function columnsOf(report) {
  const {list} = report.faults;
  const text = (value) => ({text: (row) => value(list[row]), key: (row) => value(list[row])});
  return [
    {
      name: 'fault',
      title: 'Its name, or what it is',
      width: 'minmax(110px, 1fr)',
      ...text(({name}) => name),
    },
    {name: 'kind', title: 'Kind of fault', width: '84px', ...text(({kind}) => kind)},
    {name: 'node', title: 'Whom it touches', width: 'minmax(80px, .6fr)', ...text(faultPlace)},
    {
      name: 'took effect',
      title: 'How often it took effect',
      width: '120px',
      numeric: true,
      text: (row) => hitsText(list[row]),
      key: (row) => list[row].hits,
    },
    {
      name: 'first, ms',
      title: 'When it took effect first, milliseconds from the start',
      width: '104px',
      ...timeColumn((row) => list[row].times[0]?.[0] ?? NaN, 6),
    },
    {
      name: 'last, ms',
      title: 'When the last effect that is kept began',
      width: '104px',
      ...timeColumn((row) => list[row].times.at(-1)?.[0] ?? NaN, 6),
    },
    {
      name: 'what it does',
      title: 'As the scenario says it',
      width: 'minmax(200px, 2fr)',
      ...text((fault) => fault.text),
    },
    {
      name: 'line',
      title: 'Line of the scenario',
      width: '50px',
      numeric: true,
      text: (row) => list[row].line ?? '',
      key: (row) => list[row].line ?? NaN,
    },
  ];
}

export class FaultsTab {
  constructor(report, view, steps) {
    this.table = new Table(columnsOf(report), {
      label: 'Faults',
      style: (row) => (report.faults.list[row].hits === 0 ? 'never' : ''),
      pick: (row) => steps.showFault(row),
    });
    const never = report.faults.list.filter(({hits}) => hits === 0).length;
    const note = el(
      'div',
      {class: 'search'},
      csvButton(report, 'faults', () => tableRows(this.table)),
      el('span', {class: 'dim'}, 'A click goes to the first moment, another one to the next.'),
      never
        ? el('span', {class: 'alarm'}, `${never} of ${report.faults.count} never took effect`)
        : null,
    );
    this.root = el('div', {class: 'tab-body column'}, note, this.table.root);
    view.addEventListener('select', () =>
      this.table.mark(view.selection?.kind === 'fault' ? view.selection.index : -1),
    );
    this.table.show(Uint32Array.from(report.faults.list, ({index}) => index));
  }
}

/** The details of a fault: what it is, and a button for each moment. */
export function faultDetails(report, {index, hit}, actions) {
  const fault = report.faults.list[index];
  const moments = fault.times.slice(0, kListed).map(([from, to], i) =>
    el(
      'button',
      {
        type: 'button',
        'aria-pressed': String(i === hit),
        title: `for ${formatTime(to - from, (to - from) / 1000 || 1)}`,
        onclick: () => actions.fault(index, i),
      },
      `${milliseconds(from, 6)} ms`,
    ),
  );
  const rest = fault.times.length - moments.length;
  return [
    el('h3', {}, `Fault ${fault.name}`),
    el('p', {class: 'cause'}, fault.text || fault.kind),
    el(
      'dl',
      {},
      ...[
        ['kind', fault.kind],
        ['node', faultPlace(fault)],
        ['took effect', fault.hits === 0 ? 'never' : `${formatCount(fault.hits)} times`],
        fault.line === null ? null : ['line of the scenario', String(fault.line)],
      ]
        .filter(Boolean)
        .flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]),
    ),
    moments.length ? el('h4', {}, 'moments') : null,
    el('div', {class: 'moments'}, moments),
    rest > 0 ? el('p', {class: 'dim'}, `and ${formatCount(rest)} more`) : null,
    fault.more ? el('p', {class: 'dim'}, 'and more that are not kept') : null,
  ].filter(Boolean);
}
