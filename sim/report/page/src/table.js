// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Table: rows of any number; only those in sight are elements.
import {el} from './dom.js';
import {milliseconds} from './format.js';

export const kRowHeight = 24;
const kSpare = 6; // rows above and below what is in sight

/** What columns of times have in common; value(row) is in ns, or not finite: there is none. */
export const timeColumn = (value, digits = 3) => ({
  numeric: true,
  mono: true,
  text: (row) => milliseconds(value(row), digits),
  key: (row) => (Number.isFinite(value(row)) ? value(row) : NaN),
});

export class Table {
  /**
   * @param columns [{name, title, text(row) or node(row), key(row) for sorting, width, numeric}]
   * @param options {label, pick(row): somebody clicked or pressed Enter}
   */
  constructor(columns, options) {
    Object.assign(this, {columns, options});
    this.rows = new Uint32Array(0);
    this.sorted = {column: null, up: true};
    this.current = -1;
    this.head = el('div', {class: 'row head', role: 'row'});
    this.space = el('div', {class: 'space'});
    this.body = el('div', {class: 'rows', role: 'rowgroup'}, this.space);
    this.root = el(
      'div',
      {class: 'table', role: 'grid', tabindex: 0, 'aria-label': options.label},
      this.head,
      this.body,
    );
    this.setColumns(columns);
    this.root.addEventListener('scroll', () => this.#paint());
    this.root.addEventListener('keydown', (event) => this.#key(event));
    this.body.addEventListener('click', (event) => {
      const row = event.target.closest('.row');
      if (row) this.#choose(Number(row.dataset.at));
    });
    new ResizeObserver(() => this.#paint()).observe(this.root);
  }

  /** Other columns for the same rows; the order of rows stays if its column does. */
  setColumns(columns) {
    this.columns = columns;
    this.head.replaceChildren(...columns.map((column, i) => this.#header(column, i)));
    const {column} = this.sorted;
    this.sorted.column = columns.find(({name}) => name === column?.name) ?? null;
    this.#showOrder();
    this.root.style.setProperty('--columns', columns.map(({width}) => width).join(' '));
    const least = columns.reduce(
      (sum, {width}) => sum + parseFloat(width.replace('minmax(', '')),
      0,
    );
    this.root.style.setProperty('--least', `${Math.max(least, 760)}px`);
  }

  #header(column, index) {
    const sortable = Boolean(column.key);
    return el(
      'button',
      {
        class: column.numeric ? 'cell right' : 'cell',
        role: 'columnheader',
        type: 'button',
        title: column.title,
        'aria-sort': 'none',
        disabled: !sortable,
        onclick: () => this.#sortBy(index),
      },
      column.name,
    );
  }

  /** Shows these rows: numbers that the columns understand. */
  show(rows) {
    this.unsorted = rows;
    this.#sort();
    this.root.setAttribute('aria-rowcount', String(rows.length));
  }

  #sortBy(index) {
    const column = this.columns[index];
    const same = this.sorted.column === column;
    this.sorted = same && !this.sorted.up ? {column: null, up: true} : {column, up: !same};
    this.#showOrder();
    this.#sort();
  }

  #showOrder() {
    [...this.head.children].forEach((cell, i) => {
      const on = this.sorted.column === this.columns[i];
      cell.setAttribute('aria-sort', !on ? 'none' : this.sorted.up ? 'ascending' : 'descending');
    });
  }

  #sort() {
    const {column, up} = this.sorted;
    if (!column) {
      this.rows = this.unsorted;
    } else {
      const keys = new Map();
      for (const row of this.unsorted) keys.set(row, column.key(row));
      const sign = up ? 1 : -1;
      const order = (x, y) => (x < y ? -1 : x > y ? 1 : 0);
      const last = (key) => (Number.isNaN(key) ? 1 : 0);
      this.rows = Uint32Array.from(this.unsorted).sort((a, b) => {
        const [x, y] = [keys.get(a), keys.get(b)];
        return last(x) - last(y) || sign * order(x, y) || a - b;
      });
    }
    this.space.style.height = `${this.rows.length * kRowHeight}px`;
    this.#paint(true);
  }

  /** Marks a row and brings it into sight. */
  mark(row) {
    if (row === this.current) return;
    this.current = row;
    const at = this.rows.indexOf(row);
    if (at >= 0) this.#reveal(at);
    this.#paint(true);
  }

  #reveal(at) {
    const top = at * kRowHeight;
    const view = this.root.clientHeight - kRowHeight;
    if (top < this.root.scrollTop) this.root.scrollTop = top;
    else if (top + kRowHeight > this.root.scrollTop + view)
      this.root.scrollTop = top + 2 * kRowHeight - view;
  }

  #choose(at) {
    if (at < 0 || at >= this.rows.length) return;
    this.current = this.rows[at];
    this.#reveal(at);
    this.#paint(true);
    this.options.pick(this.current);
  }

  #key(event) {
    const at = this.rows.indexOf(this.current);
    const page = Math.max(1, Math.floor(this.root.clientHeight / kRowHeight) - 2);
    const steps = {ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page};
    let next = null;
    if (event.key in steps) next = at + steps[event.key];
    else if (event.key === 'Home') next = 0;
    else if (event.key === 'End') next = this.rows.length - 1;
    else if (event.key === 'Enter') next = at;
    if (next === null || event.target.closest('button')) return;
    event.preventDefault();
    event.stopPropagation();
    this.#choose(Math.min(Math.max(next, 0), this.rows.length - 1));
  }

  #paint(force = false) {
    const first = Math.max(0, Math.floor(this.root.scrollTop / kRowHeight) - kSpare);
    const count = Math.ceil(this.root.clientHeight / kRowHeight) + 2 * kSpare;
    const last = Math.min(this.rows.length, first + count);
    if (!force && first === this.first && last === this.last) return;
    this.first = first;
    this.last = last;
    const rows = [];
    for (let at = first; at < last; ++at) rows.push(this.#row(at));
    this.body.replaceChildren(this.space, ...rows);
  }

  #row(at) {
    const row = this.rows[at];
    const style = ['row', this.options.style?.(row) ?? '', row === this.current ? 'current' : ''];
    const cells = this.#cells(row);
    const element = el(
      'div',
      {
        class: style.join(' ').trim(),
        role: 'row',
        'data-at': at,
        'aria-rowindex': at + 1,
        'aria-selected': String(row === this.current),
      },
      cells,
    );
    element.style.top = `${at * kRowHeight}px`;
    return element;
  }

  #cells(row) {
    const cells = [];
    for (const column of this.columns) {
      const wide = column.wide?.(row); // its text takes the rest of the row
      const look = `cell${column.numeric ? ' right' : ''}${column.mono && !wide ? ' mono' : ''}`;
      const cell = el(
        'span',
        {class: look, role: 'gridcell'},
        column.node ? column.node(row) : column.text(row),
      );
      cells.push(cell);
      if (!wide) continue;
      cell.style.gridColumn = `${cells.length} / -1`;
      break;
    }
    return cells;
  }
}
