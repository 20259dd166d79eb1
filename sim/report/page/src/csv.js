// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Tables as CSV (RFC 4180), and files for the person who looks at the page.
import {el} from './dom.js';

const cell = (value) => {
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/** Rows of values as the text of a CSV file. */
export const csvText = (rows) => rows.map((row) => `${row.map(cell).join(',')}\r\n`).join('');

/** What a table shows, in its order: heading and rows. More columns: [{name, text(row)}]. */
export function tableRows(table, more = []) {
  const columns = [...table.columns.filter(({text, csv}) => text || csv), ...more];
  const value = ({csv, text}, row) => (csv ?? text)(row);
  return [
    columns.map(({name}) => name),
    ...Array.from(table.rows, (row) => columns.map((column) => value(column, row))),
  ];
}

/** Offers a file for saving. */
export function save(name, blob) {
  const address = URL.createObjectURL(blob);
  const link = el('a', {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

/** A name for a file of this report: "Retry-frames.csv". */
export function fileName(report, what) {
  const title = report.meta.title.replace(/[^\p{L}\p{N}._-]+/gu, '-').replace(/^[-.]+|-+$/g, '');
  return `${title.slice(0, 80) || 'report'}-${what}`;
}

/** A button that saves what a table shows. */
export function csvButton(report, what, rows) {
  const write = () =>
    save(fileName(report, `${what}.csv`), new Blob([csvText(rows())], {type: 'text/csv'}));
  return el(
    'button',
    {type: 'button', class: 'csv', title: 'Save what the table shows, as CSV', onclick: write},
    'CSV',
  );
}
