// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// View: the window of time that the page shows and what is selected. All parts listen to it.

const kAnimationMs = 180;
const kMinQuanta = 0.4; // narrowest window, in time quanta

export class View extends EventTarget {
  /** @param report sets the limits; times in ns */
  constructor(report) {
    super();
    this.report = report;
    const margin = Math.max(report.duration * 0.02, 20 * report.bitNs);
    this.least = -margin;
    this.most = report.duration + margin;
    const quantum = Math.min(...report.nodes.map((node) => node.tq_ns), report.bitNs);
    this.minSpan = kMinQuanta * quantum;
    this.from = 0;
    this.to = report.duration;
    this.selection = null;
    this.animation = 0;
    this.still = window.matchMedia('(prefers-reduced-motion: reduce)');
  }

  get span() {
    return this.to - this.from;
  }

  /** Shows the window at once, moved and widened as far as the limits ask. */
  set(from, to) {
    cancelAnimationFrame(this.animation);
    this.#apply(from, to);
  }

  #apply(from, to) {
    if (!Number.isFinite(from) || !Number.isFinite(to)) return;
    const whole = this.most - this.least;
    const span = Math.min(Math.max(to - from, this.minSpan), whole);
    const middle = (from + to) / 2;
    from = Math.min(Math.max(middle - span / 2, this.least), this.most - span);
    this.from = from;
    this.to = from + span;
    this.dispatchEvent(new Event('move'));
  }

  /** Goes to the window in a short movement that keeps the sense of place. */
  go(from, to) {
    cancelAnimationFrame(this.animation);
    if (this.still.matches) {
      this.#apply(from, to);
      return;
    }
    const start = {from: this.from, to: this.to};
    const begin = performance.now();
    const step = (now) => {
      const part = Math.min(1, Math.max(0, (now - begin) / kAnimationMs));
      const eased = 1 - (1 - part) ** 3;
      if (part >= 1) return this.#apply(from, to);
      this.#apply(start.from + (from - start.from) * eased, start.to + (to - start.to) * eased);
      this.animation = requestAnimationFrame(step);
    };
    this.animation = requestAnimationFrame(step);
  }

  /** Shows the window with some room on both sides. */
  goTo(from, to, room = 0.15) {
    const span = Math.max(to - from, this.minSpan);
    this.go(from - room * span, to + room * span);
  }

  zoom(factor, at = (this.from + this.to) / 2) {
    const span = Math.min(Math.max(this.span * factor, this.minSpan), this.most - this.least);
    const part = (at - this.from) / this.span;
    this.set(at - part * span, at - part * span + span);
  }

  pan(ns) {
    this.set(this.from + ns, this.to + ns);
  }

  /** Brings a moment into view without a change of scale, if it is not there. */
  reveal(from, to) {
    if (from >= this.from && to <= this.to) return;
    const span = this.span;
    const wide = to - from > span;
    if (wide) return this.goTo(from, to);
    const middle = (from + to) / 2;
    return this.go(middle - span / 2, middle + span / 2);
  }

  /** [from, to] of what is selected, ns, or null. */
  selectionSpan() {
    const {selection, report} = this;
    if (!selection) return null;
    const {kind, index} = selection;
    if (kind === 'frame') return [report.frames.start[index], report.frames.end[index]];
    if (kind === 'event') return [report.events.start[index], report.events.end[index]];
    if (kind === 'segment') return [report.segments.start[index], report.segments.end[index]];
    if (kind === 'fault') return report.faults.span(index, selection.hit);
    if (kind === 'loss') {
      const time = report.losses.time[index];
      return [time - report.bitNs / 2, time + report.bitNs / 2];
    }
    const lane = report.lane(selection.segment, selection.lane);
    if (!lane || selection.bit >= lane.count) return null;
    return [lane.starts[selection.bit], lane.starts[selection.bit + 1]];
  }

  /** @param selection {kind: 'frame'|'event'|'loss'|'fault'|'bit', ...} or null */
  select(selection, origin = '') {
    this.selection = selection;
    const event = new Event('select');
    event.origin = origin;
    this.dispatchEvent(event);
  }
}
