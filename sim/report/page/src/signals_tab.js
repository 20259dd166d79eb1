// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The signals of the databases: which to plot, and what they were last.
import {csvButton, tableRows} from './csv.js';
import {el, searchField, tabWithBar} from './dom.js';
import {formatCount, hex} from './format.js';
import {decode, valueText} from './signal_codec.js';
import {Table} from './table.js';

/** All signals; those whose message was on the bus first. */
function entriesOf(signals) {
  const {frames} = signals;
  const count = (message) => frames.get(message)?.length ?? 0;
  const messages = [...signals.databases.messages].sort(
    (a, b) => (count(b) > 0) - (count(a) > 0) || a.id - b.id,
  );
  return messages.flatMap((message) =>
    message.signals.map((signal) => ({message, signal, count: count(message)})),
  );
}

/** What a signal was in the last frame that has it. */
function lastText({report, frames}, {message, signal}) {
  const list = frames.get(message) ?? [];
  for (let i = list.length - 1; i >= 0 && i >= list.length - 1000; --i) {
    const found = decode(message, report.frame(list[i]).data).find((d) => d.signal === signal);
    if (found) return valueText(found);
  }
  return '';
}

const selectionText = ({selection}) =>
  selection
    ? `while ${selection.multiplexer.name} = ` +
      selection.ranges.map(([a, b]) => (a === b ? a : `${a}–${b}`)).join(', ')
    : '';

function columnsOf(tab) {
  const {signals, chosen} = tab;
  const text = (value) => ({
    text: (row) => value(tab.entries[row]),
    key: (row) => value(tab.entries[row]),
  });
  return [
    {
      name: 'plot',
      title: 'Draw it below the bus',
      width: '46px',
      text: (row) => (chosen.has(tab.entries[row].signal) ? '☑' : '☐'),
      key: (row) => (chosen.has(tab.entries[row].signal) ? 0 : 1),
    },
    {name: 'signal', title: 'Its name', width: 'minmax(120px, 1fr)', ...text((e) => e.signal.name)},
    {
      name: 'last value',
      title: 'In the last frame that has it, with its unit',
      width: 'minmax(100px, .8fr)',
      text: (row) => lastText(signals, tab.entries[row]),
    },
    {name: 'unit', title: 'As the database has it', width: '70px', ...text((e) => e.signal.unit)},
    {
      name: 'message',
      title: 'Name in the database',
      width: 'minmax(110px, 1fr)',
      ...text((e) => e.message.name),
    },
    {
      name: 'id',
      title: 'Identifier in the database, hexadecimal; PGN: whole parameter group of J1939',
      width: '118px',
      mono: true,
      text: (row) => {
        const {id, extended, j1939} = tab.entries[row].message;
        return `${hex(id, extended ? 8 : 3)}${j1939 ? ' PGN' : ''}`;
      },
      key: (row) => tab.entries[row].message.id,
    },
    {
      name: 'frames',
      title: 'Frames of its message',
      width: '70px',
      numeric: true,
      text: (row) => formatCount(tab.entries[row].count),
      key: (row) => tab.entries[row].count,
    },
    {
      name: 'when',
      title: 'When a multiplexed signal is there',
      width: 'minmax(90px, 1fr)',
      ...text((e) => selectionText(e.signal)),
    },
  ];
}

export class SignalsTab {
  constructor(signals, chosen, opener) {
    Object.assign(this, {signals, chosen, opener, entries: []});
    this.table = new Table(columnsOf(this), {
      label: 'Signals',
      pick: (row) => {
        const {message, signal} = this.entries[row];
        chosen.toggle(message, signal);
      },
    });
    this.input = searchField('Search signals', 'Search: signal, message, unit …', {
      oninput: () => this.search(),
    });
    this.list = el('span', {class: 'files'});
    this.hint = el('p', {class: 'dim hint'});
    const open = () => opener.input.click();
    this.root = tabWithBar(
      [
        this.input,
        el(
          'button',
          {type: 'button', title: 'Or drop it onto the page', onclick: open},
          'open DBC',
        ),
        el('button', {type: 'button', onclick: () => chosen.clear()}, 'plot none'),
        csvButton(signals.report, 'signals', () => tableRows(this.table)),
        this.list,
        opener.input,
      ],
      this.hint,
      this.table.root,
    );
    signals.databases.addEventListener('change', () => this.#fill());
    chosen.addEventListener('change', () => this.search());
    this.#fill();
  }

  #fill() {
    const {databases} = this.signals;
    this.entries = entriesOf(this.signals);
    const file = ({name, messages}) =>
      el(
        'span',
        {class: 'file', title: `${messages.length} messages`},
        name,
        el(
          'button',
          {
            type: 'button',
            title: 'Close this database',
            'aria-label': `Close ${name}`,
            onclick: () => databases.remove(name),
          },
          '✕',
        ),
      );
    this.list.replaceChildren(...databases.files.map(file));
    this.hint.hidden = databases.count > 0;
    this.hint.textContent =
      'No database yet: drop a DBC file onto the page. It stays in this browser; nothing is sent.';
    this.search();
  }

  search() {
    const words = this.input.value.toLowerCase().split(/\s+/).filter(Boolean);
    const fits = ({message, signal}) => {
      const text = `${message.name}.${signal.name} ${signal.unit}`.toLowerCase();
      return words.every((word) => text.includes(word));
    };
    const rows = this.entries.flatMap((entry, i) => (fits(entry) ? [i] : []));
    this.table.show(Uint32Array.from(rows));
  }
}
