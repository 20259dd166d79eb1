// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The identifiers: how often and how regularly each is on the bus, and which of its bytes change.
import {csvButton, tableRows} from './csv.js';
import {el, searchField, tabWithBar} from './dom.js';
import {formatCount, hex} from './format.js';
import {nodeCell} from './frames_tab.js';
import {identifiersOf} from './ids.js';
import {Table, timeColumn} from './table.js';

export const idText = ({id, extended}) => hex(id, extended ? 8 : 3);

/** Bytes of the last data frame; those that are not the same in all frames are marked. */
function dataCell(report, entry) {
  if (entry.remote) return 'remote';
  const bytes = [...report.frame(entry.last).data].map((byte, i) =>
    entry.changed & (1 << i)
      ? el('b', {class: 'changed', title: `byte ${i} changes`}, hex(byte, 2))
      : hex(byte, 2),
  );
  return el('span', {}, ...bytes.flatMap((byte) => [byte, ' ']));
}

const dataText = (report, {last}) =>
  last === null ? 'remote' : [...report.frame(last).data].map((byte) => hex(byte, 2)).join(' ');

const changedText = ({changed}) =>
  Array.from({length: 8}, (_, i) => i)
    .filter((i) => changed & (1 << i))
    .join(' ');

/** The nodes that send it; several that should not are marked. */
function sendersCell(report, {senders, shared}) {
  const attributes = shared ? {class: 'alarm', title: 'An identifier of data has one sender'} : {};
  return el('span', attributes, ...[...senders].map((n) => nodeCell(report, n)));
}

/** What is said of identifiers that several nodes send. */
function sharedText(entries) {
  const ids = entries.filter((entry) => entry.shared).map(idText);
  return ids.length > 0 ? `Sent by several nodes: ${ids.join(' ')}` : '';
}

/** Name of the messages with an identifier: of the scenario, else of a database. */
function nameOf(report, entry) {
  const frame = report.frame(entry.frames[0]);
  const own = report.meta.messages[frame.message]?.name;
  return own ?? report.signals.messageOf(frame)?.name ?? '';
}

function columnsOf(tab) {
  const {report, entries} = tab;
  const {start} = report.frames;
  const time = (name, title, value, digits = 3) => ({
    name: `${name}, ms`,
    title,
    width: '92px',
    ...timeColumn((row) => value(entries[row]), digits),
  });
  return [
    {
      name: 'id',
      title: 'Identifier, hexadecimal: 3 digits are 11 bits, 8 digits 29 bits',
      width: '84px',
      mono: true,
      text: (row) => idText(entries[row]),
      key: (row) => entries[row].id,
    },
    {
      name: 'message',
      title: 'Name in the scenario, or in a database',
      width: 'minmax(90px, 1fr)',
      text: (row) => nameOf(report, entries[row]),
      key: (row) => nameOf(report, entries[row]),
    },
    {
      name: 'from',
      title: 'Nodes that sent it',
      width: 'minmax(80px, .7fr)',
      node: (row) => sendersCell(report, entries[row]),
      csv: (row) => [...entries[row].senders].map((n) => report.nodeName(n)).join(' '),
      key: (row) => report.nodeName([...entries[row].senders][0]),
    },
    {
      name: 'count',
      title: 'Frames',
      width: '66px',
      numeric: true,
      text: (row) => formatCount(entries[row].count),
      csv: (row) => entries[row].count,
      key: (row) => entries[row].count,
    },
    time('period', 'Mean distance between the starts of its frames', (e) => e.mean),
    time('min', 'Shortest period', (e) => e.shortest),
    time('max', 'Longest period', (e) => e.longest),
    time('jitter', 'Standard deviation of the periods', (e) => e.jitter, 4),
    {
      name: 'last data',
      title: 'Of its last frame; marked: bytes that were not the same in all frames',
      width: '190px',
      mono: true,
      node: (row) => dataCell(report, entries[row]),
      csv: (row) => dataText(report, entries[row]),
      key: (row) => dataText(report, entries[row]),
    },
    {
      name: 'changed bytes',
      title: 'Numbers of the bytes that were not the same in all data frames, from 0',
      width: '118px',
      text: (row) => changedText(entries[row]),
      key: (row) => changedText(entries[row]),
    },
    time('first', 'Start of its first frame', (e) => start[e.frames[0]]),
    time('last', 'Start of its last frame', (e) => start[e.frames.at(-1)]),
  ];
}

export class IdsTab {
  /** @param show(entry) goes to the frames of an identifier */
  constructor(report, show) {
    this.report = report;
    this.entries = [];
    this.table = new Table(columnsOf(this), {
      label: 'Identifiers',
      pick: (row) => show(this.entries[row]),
    });
    this.input = searchField('Search identifiers', 'Search: 12, 0x123, name, node …', {
      oninput: () => this.search(),
    });
    this.found = el('span', {class: 'found'});
    this.shared = el('span', {class: 'shared alarm'});
    this.root = tabWithBar(
      [
        this.input,
        csvButton(report, 'identifiers', () => tableRows(this.table)),
        this.found,
        this.shared,
        el('span', {class: 'dim'}, 'A click shows the frames of an identifier.'),
      ],
      this.table.root,
    );
    report.databases.addEventListener('change', () => this.search());
  }

  /** Counts, once: only if somebody wants to see it. */
  fill() {
    if (this.entries.length > 0) return;
    this.entries.push(...identifiersOf(this.report));
    this.shared.textContent = sharedText(this.entries);
    this.search();
  }

  #fits(entry, word) {
    if (/^0x/.test(word)) return entry.id === parseInt(word, 16);
    const names = [
      nameOf(this.report, entry),
      ...[...entry.senders].map((n) => this.report.nodeName(n)),
    ];
    return (
      idText(entry).toLowerCase().includes(word) ||
      names.some((name) => name.toLowerCase().includes(word))
    );
  }

  /** Filters by what the field holds. */
  search() {
    const words = this.input.value.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = this.entries.flatMap((entry, i) =>
      words.every((word) => this.#fits(entry, word)) ? [i] : [],
    );
    this.found.textContent = words.length
      ? `${formatCount(rows.length)} of ${formatCount(this.entries.length)} found`
      : `${formatCount(this.entries.length)} identifiers`;
    this.table.show(Uint32Array.from(rows));
  }
}
