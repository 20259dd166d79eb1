// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The panel of what is selected: a frame, an error, a lost arbitration or a single bit.
import {el, swatch} from './dom.js';
import {F, bitTitle, errorKinds, fieldColor, fieldName, fieldText, kErrorTexts} from './fields.js';
import {formatTime, hex, milliseconds} from './format.js';
import {placeOf} from './events_tab.js';
import {faultDetails} from './faults_tab.js';
import {kEventKinds, messageName, nodeCell} from './frames_tab.js';
import {kNobody} from './report.js';
import {signalTable} from './signal_details.js';

/** Logs of simulations start at 1 s (docs/scenario.md, Outputs). */
const kLogOriginUs = 1e6;

/** A time of the page as the stamp of a log: cut to microseconds, as the tool writes it. */
function stampOf(report, ns) {
  const ps = Math.round((ns + report.meta.origin_ns) * 1000); // no sum lacks a trifle of its us
  const micros = Math.floor(ps / 1e6) + kLogOriginUs;
  const seconds = `${Math.floor(micros / 1e6)}`.padStart(10, '0');
  return `(${seconds}.${String(micros % 1e6).padStart(6, '0')})`;
}

/** A frame as its line in the tool's candump log of the run. */
export function candumpLine(report, frame) {
  const id = hex(frame.id, frame.extended ? 8 : 3);
  const raw = frame.dlc > 8 ? `_${hex(frame.dlc, 1)}` : '';
  const length = Math.min(frame.dlc, 8);
  const body = frame.remote
    ? `R${length > 0 || raw ? length : ''}${raw}`
    : [...frame.data].map((byte) => hex(byte, 2)).join('') + raw;
  return `${stampOf(report, frame.start)} can0 ${id}#${body}`;
}

const lines = (pairs) =>
  el(
    'dl',
    {},
    pairs
      .filter(Boolean)
      .flatMap(([name, value, title]) => [el('dt', {title}, name), el('dd', {}, value)]),
  );

/** Nodes that drive the ACK slot dominant. */
function acknowledgers(report, lane) {
  const slot = lane?.groups.find((group) => group.field === F.ACK);
  if (!slot) return null;
  const middle = (lane.starts[slot.first] + lane.starts[slot.first + 1]) / 2;
  return report.driversAt(middle);
}

function nodeList(report, nodes) {
  return nodes.length === 0
    ? 'nobody'
    : el(
        'span',
        {class: 'list'},
        nodes.map((node) => nodeCell(report, node)),
      );
}

/** The fields as coloured pieces. */
function fieldStrip(lane) {
  return el(
    'div',
    {class: 'strip'},
    lane.groups.map((group) => {
      const bits = [];
      for (let i = group.first; i <= group.last; ++i) {
        bits.push(
          el(
            'i',
            {
              class: lane.stuff(i) ? 'stuff' : '',
              title: lane.stuff(i) ? 'stuff bit' : bitTitle(group.field, lane.place(i)),
            },
            String(lane.sampled(i)),
          ),
        );
      }
      const piece = el(
        'span',
        {title: fieldText(group.field)},
        el('b', {}, group.text ? `${group.label} ${group.text}` : group.label),
        el('code', {}, bits),
      );
      piece.style.setProperty('--field', `var(--${fieldColor(group.field)})`);
      return piece;
    }),
  );
}

function crcText(decoded) {
  if (decoded.crc === null) return null;
  const fits = decoded.crc === decoded.computed;
  const verdict = fits ? 'right' : `wrong: the bits before give 0x${hex(decoded.computed, 4)}`;
  return `0x${hex(decoded.crc, 4)}, ${verdict}`;
}

/** What a frame means to remote nodes; null: nothing. */
function commandOf(report, index) {
  const words = report.remote?.wordsOf(index);
  return words ? ['command', words, 'What it means to remote nodes (docs/remote.md)'] : null;
}

function frameDetails(report, index, actions) {
  const frame = report.frame(index);
  const lane = report.lane(frame.segment);
  const decoded = lane?.decode();
  const acks = acknowledgers(report, lane);
  const bits = Math.round((frame.end - frame.start) / report.bitNs);
  return [
    el(
      'h3',
      {},
      `Frame ${hex(frame.id, frame.extended ? 8 : 3)}`,
      el(
        'button',
        {type: 'button', onclick: () => actions.copy(), title: 'Copy as a line of candump (key c)'},
        'copy',
      ),
    ),
    el('code', {class: 'candump'}, candumpLine(report, frame)),
    lines([
      ['start', formatTime(frame.start, 1)],
      ['end', formatTime(frame.end, 1)],
      ['length', `${bits} bits, ${formatTime(frame.end - frame.start, 100)}`],
      [
        'identifier',
        `0x${hex(frame.id, frame.extended ? 8 : 3)} (${frame.extended ? 29 : 11} bits)`,
      ],
      ['type', frame.remote ? 'remote request' : 'data'],
      ['DLC', String(frame.dlc)],
      frame.remote
        ? null
        : ['data', [...frame.data].map((byte) => hex(byte, 2)).join(' ') || 'none'],
      ['sender', frame.sender === kNobody ? 'not known' : nodeCell(report, frame.sender)],
      commandOf(report, index),
      messageName(report, frame) ? ['message', messageName(report, frame)] : null,
      [
        'response',
        Number.isNaN(frame.response) ? 'not known' : `${milliseconds(frame.response, 6)} ms`,
        'From the event that queued it to the end of the frame',
      ],
      ['retries', String(frame.retries)],
      ['arbitrations lost', String(frame.lost)],
      decoded && crcText(decoded) ? ['CRC', crcText(decoded)] : null,
      decoded ? ['stuff bits', String(decoded.stuffBits)] : null,
      acks
        ? [
            'acknowledged by',
            nodeList(
              report,
              acks.filter((node) => node !== frame.sender),
            ),
          ]
        : null,
    ]),
    signalTable(report, frame),
    lane ? fieldStrip(lane) : el('p', {class: 'dim'}, 'No bits were kept of this frame.'),
  ];
}

/** Faults that acted during the attempt, up to the error: each a button that goes there. */
function faultsAt(report, event, actions) {
  const from = report.segments.start[event.segment] ?? event.start - 30 * report.bitNs;
  const first = new Map();
  for (const {fault, hit} of report.faults.in(from, event.start + 2 * report.bitNs))
    first.set(fault, hit);
  if (first.size === 0) return null;
  const buttons = [...first].map(([fault, hit]) =>
    el(
      'button',
      {type: 'button', class: 'link', onclick: () => actions.fault(fault, hit)},
      report.faults.list[fault].name,
    ),
  );
  return ['faults before it', el('span', {class: 'list'}, buttons)];
}

function eventDetails(report, index, actions) {
  const event = report.event(index);
  const texts = kErrorTexts.filter((_, bit) => event.error & (1 << bit));
  const lanes = report.lanesOf(event.segment);
  return [
    el(
      'h3',
      {},
      event.kind === 1
        ? 'Overload frame'
        : event.kind === 2
          ? 'Error with a passive flag'
          : 'Error frame',
    ),
    el(
      'p',
      {class: event.kind === 1 ? 'cause overload' : 'cause error'},
      event.cause.text,
      event.cause.rule
        ? el(
            'span',
            {class: 'rule', title: 'Rule of the protocol: docs/rules.md'},
            event.cause.rule,
          )
        : null,
    ),
    lines([
      ['kind', event.kind === 1 ? kEventKinds[1] : `${errorKinds(event.error)} error`],
      texts.length > 0 ? ['meaning', texts.join('; ')] : null,
      ['found first by', event.node === kNobody ? 'not known' : nodeCell(report, event.node)],
      ['where', placeOf(report, event)],
      ['at', formatTime(event.start, 1)],
      ['over at', formatTime(event.end, 1)],
      faultsAt(report, event, actions),
    ]),
    ...lanes.flatMap((lane) => [
      el('h4', {}, lanes.length > 1 ? `as ${lane.node.name} sees it` : 'bits'),
      fieldStrip(lane),
    ]),
  ];
}

function lossDetails(report, index) {
  const {losses} = report;
  const winner = losses.winner[index];
  return [
    el('h3', {}, 'Arbitration lost'),
    el(
      'p',
      {class: 'cause'},
      'It sent recessive and read dominant: an identifier of higher priority is on the bus. ' +
        'It goes on as a receiver and tries again.',
      el('span', {class: 'rule'}, 'AR-02'),
    ),
    lines([
      ['loser', nodeCell(report, losses.node[index])],
      ['winner', winner === kNobody ? 'not known' : nodeCell(report, winner)],
      ['field', `${fieldName(losses.field[index])}`],
      ['sampled at', formatTime(losses.time[index], 1)],
    ]),
  ];
}

function bitDetails(report, {segment, lane: which, bit}) {
  const lane = report.lane(segment, which);
  if (!lane || bit >= lane.count) return [];
  const field = lane.field(bit);
  const q = lane.quanta[bit];
  const level = (value) => (value ? 'recessive (1)' : 'dominant (0)');
  return [
    el(
      'h3',
      {},
      lane.stuff(bit) ? `Stuff bit (${fieldName(field)})` : bitTitle(field, lane.place(bit)),
    ),
    el(
      'p',
      {},
      lane.stuff(bit)
        ? 'After five equal bits the sender inserts one of the other level; receivers remove it ' +
            '(ST-01).'
        : fieldText(field),
    ),
    lines([
      ['as seen by', nodeCell(report, lane.nodeIndex)],
      ['bit of the frame', `${bit + 1} of ${lane.count}, stuff bits counted`],
      ['sampled', level(lane.sampled(bit))],
      ['sent', level(lane.sent(bit))],
      ['start', formatTime(lane.starts[bit], 1)],
      ['sample point', formatTime(lane.sample(bit), 1)],
      ['length', `${lane.node.quanta + q} quanta of ${+lane.tq.toFixed(3)} ns`],
      q !== 0
        ? ['resynchronised', `${Math.abs(q)} quanta ${q > 0 ? 'longer (PS1)' : 'shorter (PS2)'}`]
        : null,
      [
        'driven dominant by',
        nodeList(report, report.driversAt((lane.starts[bit] + lane.starts[bit + 1]) / 2)),
      ],
    ]),
  ];
}

/** The panel; it follows the selection. */
export function detailPanel(report, view, actions) {
  const root = el('aside', {class: 'details', 'aria-live': 'polite', 'aria-label': 'Details'});
  const show = () => {
    const {selection} = view;
    const kinds = {
      frame: () => frameDetails(report, selection.index, actions),
      event: () => eventDetails(report, selection.index, actions),
      loss: () => lossDetails(report, selection.index),
      fault: () => faultDetails(report, selection, actions),
      bit: () => bitDetails(report, selection),
      segment: () => [el('h3', {}, 'Activity without a frame')],
    };
    root.replaceChildren(
      ...(selection
        ? (kinds[selection.kind]?.() ?? []).filter(Boolean)
        : [
            el(
              'p',
              {class: 'dim'},
              'Click a frame, an error or, zoomed in, a single bit: here is what it is.',
            ),
          ]),
    );
  };
  view.addEventListener('select', show);
  report.databases.addEventListener('change', show);
  show();
  return root;
}
