// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the report says about each identifier: how often, how regularly, and what changes in it.
import {kNobody} from './report.js';

const kExtended = 0x80000000; // in f.id
const kRemote = 0x40000000;

class Identifier {
  constructor(id, extended, remote) {
    Object.assign(this, {id, extended, remote, count: 0});
    this.frames = []; // their indices
    this.senders = new Set();
    this.last = null; // index of the last data frame
    this.bytes = 0; // of the longest data frame
    this.changed = 0; // bit n: byte n was not the same in all data frames
    this.shortest = Infinity;
    this.longest = -Infinity;
    this.spread = 0; // sum of squared distances of the periods from their mean (Welford)
    this.mean = NaN;
  }

  add(i, frames, dataOf) {
    if (this.count > 0) this.#period(frames.start[i] - frames.start[this.frames.at(-1)]);
    ++this.count;
    this.frames.push(i);
    this.senders.add(frames.sender[i]);
    if (this.remote) return;
    const data = dataOf(i);
    this.bytes = Math.max(this.bytes, data.length);
    const before = this.last === null ? data : dataOf(this.last);
    for (let at = 0; at < Math.max(data.length, before.length); ++at) {
      if (data[at] !== before[at]) this.changed |= 1 << at;
    }
    this.last = i;
  }

  #period(ns) {
    const off = ns - (this.count > 1 ? this.mean : 0);
    this.mean = this.count > 1 ? this.mean + off / this.count : ns;
    if (this.count > 1) this.spread += off * (ns - this.mean);
    this.shortest = Math.min(this.shortest, ns);
    this.longest = Math.max(this.longest, ns);
  }

  /**
   * Two nodes send data under it, which destroy each other where they start at once. Requests may
   * be of many, and frames without a byte are the same of all.
   */
  get shared() {
    const known = [...this.senders].filter((node) => node !== kNobody);
    return this.bytes > 0 && known.length > 1;
  }

  /** Standard deviation of the periods, ns. */
  get jitter() {
    return this.count > 1 ? Math.sqrt(this.spread / (this.count - 1)) : NaN;
  }
}

/** One entry for each identifier, remote requests apart; periods are between starts, ns. */
export function identifiersOf(report) {
  const {frames} = report;
  const dataOf = (i) => frames.data.subarray(8 * i, 8 * i + Math.min(8, frames.dlc[i]));
  const found = new Map();
  for (let i = 0; i < frames.count; ++i) {
    const key = frames.id[i];
    let entry = found.get(key);
    if (!entry) {
      entry = new Identifier(key & 0x1fffffff, key >= kExtended, (key & kRemote) !== 0);
      found.set(key, entry);
    }
    entry.add(i, frames, dataOf);
  }
  return [...found.values()].sort(
    (a, b) => a.remote - b.remote || a.extended - b.extended || a.id - b.id,
  );
}
