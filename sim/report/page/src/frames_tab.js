// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and errors in one list, by time, with the search over it.
import {csvButton, tableRows} from './csv.js';
import {el, searchField, swatch, tabWithBar} from './dom.js';
import {errorKinds} from './fields.js';
import {formatCount, hex, milliseconds} from './format.js';
import {compileQuery} from './query.js';
import {kNobody} from './report.js';
import {choiceOf, rawText} from './signal_codec.js';
import {Table} from './table.js';
import {nodeColor} from './theme.js';

const kEvent = 0x80000000; // row numbers with this bit are events, others frames
const isEvent = (row) => row >= kEvent;
const index = (row) => row & 0x7fffffff;
export const kEventKinds = ['error frame', 'overload frame', 'error, passive flag'];

/** Rows of frames and events by their start. */
function allRows(report) {
  const {frames, events} = report;
  const rows = new Uint32Array(frames.count + events.count);
  let f = 0;
  let e = 0;
  for (let i = 0; i < rows.length; ++i) {
    const frame = e >= events.count || (f < frames.count && frames.start[f] <= events.start[e]);
    rows[i] = frame ? f++ : kEvent + e++;
  }
  return rows;
}

/** Name of a frame's message: that of the scenario, of the database, or both if they differ. */
export function messageName(report, frame) {
  const own = report.meta.messages[frame.message]?.name ?? '';
  const given = report.signals.messageOf(frame)?.name ?? '';
  return own && given && own !== given ? `${own} · ${given}` : own || given;
}

/** Texts of a row; the search looks at the same. */
export function rowValues(report, row) {
  if (isEvent(row)) {
    const event = report.event(index(row));
    return {
      event,
      time: event.start,
      id: '',
      dlc: '',
      data: event.cause.text,
      type: kEventKinds[event.kind],
      node: event.node,
      message: '',
      signals: '',
      words: `${errorKinds(event.error)} ${event.cause.rule}`,
    };
  }
  const frame = report.frame(index(row));
  const type = `${frame.extended ? 'ext ' : ''}${frame.remote ? 'remote' : 'data'}`;
  return {
    frame,
    time: frame.start,
    id: hex(frame.id, frame.extended ? 8 : 3),
    dlc: frame.dlc,
    type,
    data: [...frame.data].map((byte) => hex(byte, 2)).join(' '),
    node: frame.sender,
    message: messageName(report, frame),
    signals: report.signals.textOf(frame),
    words: report.remote?.wordsOf(frame.index) ?? '',
  };
}

/** The column of decoded signals, if there is a database. */
const signalColumn = (values) => ({
  name: 'signals',
  title: 'Signals by the databases: name and value',
  width: 'minmax(260px, 4fr)',
  text: (row) => values(row).signals,
  key: (row) => values(row).signals,
});

/** What the frame means to remote nodes, if there are any. */
const commandColumn = (values) => ({
  name: 'command',
  title: 'What the frame means to remote nodes (docs/remote.md)',
  width: 'minmax(190px, 2fr)',
  text: (row) => (isEvent(row) ? '' : values(row).words),
  key: (row) => (isEvent(row) ? '' : values(row).words),
});

function columnsOf(report) {
  const values = (row) => rowValues(report, row);
  const {frames, events} = report;
  const number = (array) => (row) => (isEvent(row) ? NaN : array[index(row)]);
  return [
    {
      name: 'time, ms',
      title: 'Start of the frame, milliseconds from the start',
      width: '104px',
      numeric: true,
      mono: true,
      text: (row) =>
        milliseconds(isEvent(row) ? events.start[index(row)] : frames.start[index(row)], 6),
      key: (row) => (isEvent(row) ? events.start[index(row)] : frames.start[index(row)]),
    },
    {
      name: 'id',
      title: 'Identifier, hexadecimal: 3 digits are 11 bits, 8 digits 29 bits',
      width: '84px',
      mono: true,
      text: (row) => values(row).id,
      key: (row) => (isEvent(row) ? NaN : frames.id[index(row)] & 0x1fffffff),
    },
    {
      name: 'type',
      title: 'data or remote request; ext: 29-bit identifier',
      width: '118px',
      text: (row) => values(row).type,
      key: (row) => values(row).type,
    },
    {
      name: 'dlc',
      title: 'Data length code; more than 8 means 8 bytes',
      width: '42px',
      numeric: true,
      text: (row) => values(row).dlc,
      key: number(frames.dlc),
    },
    {
      name: 'node',
      title: 'Who sent the frame or found the error',
      width: 'minmax(84px, .7fr)',
      node: (row) => nodeCell(report, values(row).node),
      csv: (row) => nodeText(report, values(row).node),
      key: (row) => report.nodeName(values(row).node),
    },
    {
      name: 'data',
      title: 'Data bytes, hexadecimal; for errors their cause',
      width: 'minmax(190px, 2fr)',
      mono: true,
      wide: isEvent,
      text: (row) => values(row).data,
      key: (row) => values(row).data,
    },
    {
      name: 'message',
      title: 'Name in the scenario, or in a database',
      width: 'minmax(90px, 1fr)',
      text: (row) => values(row).message,
      key: (row) => values(row).message,
    },
    ...(report.remote ? [commandColumn(values)] : []),
    ...(report.signals.any ? [signalColumn(values)] : []),
    {
      name: 'response, ms',
      title: 'Milliseconds from the event that queued the frame to its end',
      width: '104px',
      numeric: true,
      mono: true,
      text: (row) => (isEvent(row) ? '' : milliseconds(frames.response[index(row)])),
      key: number(frames.response),
    },
    {
      name: 'retries',
      title: 'Attempts of the sender that failed since its frame before',
      width: '58px',
      numeric: true,
      text: (row) =>
        isEvent(row) || !frames.retries[index(row)] ? '' : frames.retries[index(row)],
      key: number(frames.retries),
    },
    {
      name: 'lost',
      title: 'Arbitrations that the sender lost since its frame before',
      width: '46px',
      numeric: true,
      text: (row) => (isEvent(row) || !frames.lost[index(row)] ? '' : frames.lost[index(row)]),
      key: number(frames.lost),
    },
  ];
}

export const nodeText = (report, node) => (node === kNobody ? '' : report.nodeName(node));

export function nodeCell(report, node) {
  if (node === kNobody) return '';
  return el('span', {}, swatch(nodeColor(node)), report.nodeName(node));
}

/** The tab: a search field and the table. */
export class FramesTab {
  constructor(report, view, steps) {
    Object.assign(this, {report, view});
    this.rows = allRows(report);
    this.table = new Table(columnsOf(report), {
      label: 'Frames and errors',
      style: (row) =>
        isEvent(row) ? (report.events.kind[index(row)] === 1 ? 'overload' : 'error') : '',
      pick: (row) => (isEvent(row) ? steps.showEvent(index(row)) : steps.showFrame(index(row))),
    });
    const example = 'Search: 123, CA FE, node, message, error, remote …';
    this.input = searchField('Search frames', example, {
      id: 'search',
      title:
        'Words that all must fit: identifier or data bytes in hex, name of a ' +
        'node or message, error, overload, remote, data, ext, retry, lost',
    });
    this.found = el('span', {class: 'found', 'aria-live': 'polite'});
    this.root = tabWithBar(
      [this.input, csvButton(report, 'frames', () => this.#csv()), this.found],
      this.table.root,
    );
    this.input.addEventListener('input', () => this.#later());
    this.input.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') {
        this.input.value = '';
        this.search();
        this.input.blur();
      }
    });
    view.addEventListener('select', () => this.#mark());
    report.databases.addEventListener('change', () => {
      this.table.setColumns(columnsOf(report));
      this.search();
    });
    this.search();
  }

  #later() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.search(), 120);
  }

  /** Filters by a text, as if somebody had typed it. */
  show(text) {
    this.input.value = text;
    this.search();
  }

  /** Filters by what the field holds. */
  search() {
    const fits = compileQuery(this.input.value, this.report);
    const rows = fits ? this.rows.filter((row) => fits(rowValues(this.report, row))) : this.rows;
    this.found.textContent = fits
      ? `${formatCount(rows.length)} of ${formatCount(this.rows.length)} found`
      : `${formatCount(this.report.frames.count)} frames, ` +
        `errors and overloads ${formatCount(this.report.events.count)}`;
    this.table.show(rows);
  }

  /** The table as rows of a CSV file, and a column for each signal that is in it. */
  #csv() {
    const {report, table} = this;
    const columns = new Map(); // by signal
    const values = new Map(); // by row: Map of signal to text
    for (const row of table.rows) {
      if (isEvent(row) || !report.signals.any) continue;
      const frame = report.frame(index(row));
      const message = report.signals.messageOf(frame);
      const texts = new Map();
      for (const decoded of report.signals.valuesOf(frame)) {
        const {signal} = decoded;
        texts.set(signal, choiceOf(decoded) ?? rawText(decoded));
        const unit = signal.unit && `, ${signal.unit}`;
        columns.set(signal, `${message.name}.${signal.name}${unit}`);
      }
      values.set(row, texts);
    }
    const more = [...columns].map(([signal, name]) => ({
      name,
      text: (row) => values.get(row)?.get(signal) ?? '',
    }));
    return tableRows(table, more);
  }

  #mark() {
    const {selection} = this.view;
    if (!selection) return this.table.mark(-1);
    if (selection.kind === 'frame') return this.table.mark(selection.index);
    if (selection.kind === 'event') return this.table.mark(kEvent + selection.index);
    if (selection.kind === 'bit') {
      const frame = this.report.segmentFrame[selection.segment];
      const event = this.report.segmentEvents.get(selection.segment)?.[0];
      if (frame >= 0) return this.table.mark(frame);
      if (event !== undefined) return this.table.mark(kEvent + event);
    }
    return undefined;
  }
}
