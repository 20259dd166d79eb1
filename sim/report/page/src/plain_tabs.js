// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Plain tables: the nodes with their settings and counts, and what was checked.
import {el, swatch} from './dom.js';
import {formatCount} from './format.js';
import {nodeColor} from './theme.js';

const kNodeColumns = [
  ['node', 'Name in the scenario', (n, i) => [swatch(nodeColor(i)), n.name]],
  ['clock, MHz', 'Frequency of its oscillator', (n) => +(n.clock_hz / 1e6).toFixed(6)],
  ['error, ppm', 'Error of the oscillator, millionths', (n) => n.error_ppm],
  [
    'bit, quanta',
    'Time quanta a bit: SYNC + PROP + PS1 + PS2',
    (n) => `${n.quanta} (1+${n.prop}+${n.ps1}+${n.ps2})`,
  ],
  ['quantum, ns', 'Time quantum, error of the clock included', (n) => +n.tq_ns.toFixed(3)],
  ['SJW, quanta', 'Largest correction of a resynchronisation, quanta', (n) => n.sjw],
  [
    'sample point, %',
    'Place in the bit where its level is read',
    (n) => (100 * n.sample_point).toFixed(1),
  ],
  ['sent', 'Frames sent', (n) => formatCount(n.sent)],
  ['received', 'Frames received', (n) => formatCount(n.received)],
  ['retries', 'Attempts that failed', (n) => n.retries],
  ['lost', 'Arbitrations lost', (n) => n.lost],
  ['errors', 'Errors that it found', (n) => n.errors],
  ['TEC', 'Transmit error counter at the end (largest)', (n) => `${n.tec} (${n.max_tec})`],
  ['REC', 'Receive error counter at the end (largest)', (n) => `${n.rec} (${n.max_rec})`],
  ['bus-off', 'How often it went bus-off', (n) => n.bus_off || ''],
  ['state', 'At the end', (n) => n.state],
];

export function nodesTab(report) {
  const head = kNodeColumns.map(([name, title], i) =>
    el('th', {title, class: i ? 'right' : ''}, name),
  );
  const rows = report.nodes.map((node, i) =>
    el(
      'tr',
      {},
      kNodeColumns.map(([, , value], column) =>
        el(
          'td',
          {class: column ? 'right' : ''},
          ...[value(node, i)].flat().map((x) => (x instanceof Node ? x : String(x))),
        ),
      ),
    ),
  );
  return el(
    'div',
    {class: 'tab-body scroll'},
    el('table', {class: 'plain'}, el('thead', {}, el('tr', {}, head)), el('tbody', {}, rows)),
  );
}

/** What was expected; failures first. */
export function checksTab(report) {
  const checks = [...report.meta.checks].sort((a, b) => a.ok - b.ok);
  const rows = checks.map(({what, wanted, seen, ok}) =>
    el(
      'tr',
      {class: ok ? '' : 'failed'},
      [ok ? '✓ ok' : '✗ failed', what, wanted, seen].map((text) => el('td', {}, text)),
    ),
  );
  const head = ['', 'what', 'wanted', 'seen'].map((name) => el('th', {}, name));
  return el(
    'div',
    {class: 'tab-body scroll'},
    checks.length === 0
      ? el('p', {class: 'dim'}, 'The scenario expects nothing in particular.')
      : el('table', {class: 'plain'}, el('thead', {}, el('tr', {}, head)), el('tbody', {}, rows)),
  );
}
