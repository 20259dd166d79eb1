// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes reports as docs/report-format.md has them, without the program that usually does.
import {deflateSync} from 'node:zlib';
import {readFileSync, writeFileSync} from 'node:fs';

const kTypes = {
  u8: Uint8Array,
  i8: Int8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  f64: Float64Array,
};

/** A list of numbers that grows into a typed array. */
export class Column {
  constructor(type) {
    this.type = type;
    this.values = new kTypes[type](1024);
    this.length = 0;
  }

  push(value) {
    this.#fit(this.length + 1);
    this.values[this.length++] = value;
  }

  /** All numbers of a list, a typed array at best: much faster than one by one. */
  append(values) {
    this.#fit(this.length + values.length);
    this.values.set(values, this.length);
    this.length += values.length;
  }

  #fit(length) {
    if (length <= this.values.length) return;
    const more = new kTypes[this.type](2 * length);
    more.set(this.values);
    this.values = more;
  }
}

/** Names and types of all arrays but the edges. */
export const kColumns = {
  'f.start': 'f64',
  'f.end': 'f64',
  'f.sender': 'u8',
  'f.id': 'u32',
  'f.dlc': 'u8',
  'f.data': 'u8',
  'f.segment': 'u32',
  'f.message': 'i16',
  'f.response': 'f64',
  'f.retries': 'u16',
  'f.lost': 'u16',
  'e.kind': 'u8',
  'e.start': 'f64',
  'e.end': 'f64',
  'e.node': 'u8',
  'e.error': 'u8',
  'e.field': 'u8',
  'e.index': 'u8',
  'e.segment': 'u32',
  'e.cause': 'u16',
  'l.time': 'f64',
  'l.node': 'u8',
  'l.field': 'u8',
  'l.index': 'u8',
  'l.segment': 'u32',
  'l.winner': 'u8',
  'c.time': 'f64',
  'c.node': 'u8',
  'c.tec': 'u16',
  'c.rec': 'u16',
  'c.state': 'u8',
  's.start': 'f64',
  's.end': 'f64',
  's.lane': 'u32',
  's.lanes': 'u8',
  'b.node': 'u8',
  'b.start': 'f64',
  'b.tq': 'f64',
  'b.first': 'u32',
  'b.count': 'u32',
  bit: 'u8',
  'bit.q': 'i8',
};

/** {meta, text}: the description with its list of arrays, and the data as base64. */
export function pack(meta, columns) {
  const parts = [];
  const arrays = [];
  let offset = 0;
  for (const [name, column] of Object.entries(columns)) {
    const {type, values, length} = column;
    const bytes = Buffer.from(values.buffer, 0, length * values.BYTES_PER_ELEMENT);
    arrays.push({name, type, offset, length});
    parts.push(bytes, Buffer.alloc((8 - (bytes.length % 8)) % 8));
    offset += bytes.length + parts.at(-1).length;
  }
  const text = deflateSync(Buffer.concat(parts), {level: 1}).toString('base64');
  return {meta: {...meta, arrays}, text};
}

/** Puts a report into the page. */
export function writeReport(template, out, {meta, text}) {
  const json = JSON.stringify(meta).replaceAll('<', '\\u003c');
  const page = readFileSync(template, 'utf8')
    .replace(
      '<!--VERICAN-META-->',
      () => `<script type="application/json" id="verican-meta">${json}</script>`,
    )
    .replace(
      '<!--VERICAN-DATA-->',
      () => `<script type="text/plain" id="verican-data">${text}</script>`,
    );
  writeFileSync(out, page);
}
