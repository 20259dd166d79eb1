// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EdgeTrack: a level over time, stored as distances between its changes. Searching starts at a
// checkpoint every 64 changes, so millions of changes need little more memory than the file had.

const kGap = 4294967295; // so many ticks pass without a change
const kStep = 64;

export class EdgeTrack {
  /**
   * @param ticks distances as in the file
   * @param initial level before the first change
   * @param tickNs length of a tick
   */
  constructor(ticks, initial, tickNs) {
    this.ticks = ticks;
    this.initial = initial;
    this.tickNs = tickNs;
    const checkpoints = Math.ceil(ticks.length / kStep) + 1;
    this.time = new Float64Array(checkpoints); // ticks, after the entries before this block
    this.edges = new Uint32Array(checkpoints); // changes in the entries before this block
    let time = 0;
    let edges = 0;
    for (let i = 0; i < ticks.length; ++i) {
      if (i % kStep === 0) this.#mark(i / kStep, time, edges);
      time += ticks[i];
      if (ticks[i] !== kGap) ++edges;
    }
    this.#mark(checkpoints - 1, time, edges);
    this.count = edges;
  }

  #mark(index, time, edges) {
    this.time[index] = time;
    this.edges[index] = edges;
  }

  /** Last block that begins at or before `tick`. */
  #block(tick) {
    let low = 0;
    let high = this.time.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.time[middle] <= tick) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Number of changes up to and at time `ns`. */
  countAt(ns) {
    const limit = ns / this.tickNs;
    const block = this.#block(limit);
    let time = this.time[block];
    let edges = this.edges[block];
    for (let i = block * kStep; i < this.ticks.length; ++i) {
      time += this.ticks[i];
      if (time > limit) break;
      if (this.ticks[i] !== kGap) ++edges;
    }
    return edges;
  }

  levelAt(ns) {
    return this.initial ^ (this.countAt(ns) & 1);
  }

  /** Calls visit(time in ns, level from then on) for each change after `from`, up to `to`. */
  walk(from, to, visit) {
    const first = from / this.tickNs;
    const last = to / this.tickNs;
    const block = this.#block(first);
    let time = this.time[block];
    let level = this.initial ^ (this.edges[block] & 1);
    for (let i = block * kStep; i < this.ticks.length; ++i) {
      time += this.ticks[i];
      if (time > last) return;
      if (this.ticks[i] === kGap) continue;
      level ^= 1;
      if (time > first) visit(time * this.tickNs, level);
    }
  }

  /** Stretches of one level that lie in the range: visit(from, to, level). */
  stretches(from, to, visit) {
    let start = from;
    let level = this.levelAt(from);
    this.walk(from, to, (time, next) => {
      visit(start, time, level);
      start = time;
      level = next;
    });
    visit(start, to, level);
  }
}
