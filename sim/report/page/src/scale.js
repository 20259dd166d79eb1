// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scale: from times to pixels of the scope, and how much detail the scale has room for.

export const kGutter = 118; // room for names at the left
const kFieldPx = 0.55; // a bit at least this wide: fields apart
const kBitPx = 9; // a bit at least this wide: bits apart
const kQuantumPx = 5; // a quantum at least this wide: quanta apart
const kBlockPx = 5; // a segment at least this wide on average: segments apart

export class Scale {
  constructor(report, view, width) {
    this.report = report;
    this.from = view.from;
    this.to = view.to;
    this.left = kGutter;
    this.width = width;
    this.plot = Math.max(width - kGutter, 1);
    this.pxPerNs = this.plot / view.span;
    this.pxPerBit = this.pxPerNs * report.bitNs;
    this.segments = report.segmentsIn(this.from, this.to);
    this.mode = this.#mode();
  }

  #mode() {
    const [first, last] = this.segments;
    const quantum = this.pxPerNs * (this.report.nodes[0]?.tq_ns ?? this.report.bitNs / 10);
    if (quantum >= kQuantumPx && this.pxPerBit >= kBitPx) return 'quanta';
    if (this.pxPerBit >= kBitPx) return 'bits';
    if (this.pxPerBit >= kFieldPx) return 'fields';
    return last - first + 1 <= this.plot / kBlockPx ? 'blocks' : 'columns';
  }

  /** The mode shows fields, or more. */
  get fine() {
    return this.mode === 'fields' || this.mode === 'bits' || this.mode === 'quanta';
  }

  x(ns) {
    return this.left + (ns - this.from) * this.pxPerNs;
  }
  time(x) {
    return this.from + (x - this.left) / this.pxPerNs;
  }

  /** Range of x that lies on the plot, or null. */
  range(fromNs, toNs) {
    const a = Math.max(this.x(fromNs), this.left);
    const b = Math.min(this.x(toNs), this.width);
    return b > a ? [a, b] : null;
  }
}
