// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The chosen signals below the bus, on its time axis.
import {drawSignal, kSignalLane} from './draw_signal.js';
import {el} from './dom.js';
import {Painter} from './painter.js';
import {kNobody} from './report.js';

const kPart = 0.4; // of the scope's height, at most

export class SignalLanes {
  /** @param chosen signals.js: what is plotted */
  constructor(report, chosen) {
    Object.assign(this, {report, chosen});
    this.canvas = el('canvas', {class: 'scope-signals'});
    this.root = el('div', {class: 'signal-lanes', hidden: true}, this.canvas);
    this.painter = new Painter(this.canvas);
  }

  /** Height of all of them, px. */
  get wanted() {
    return kSignalLane * this.chosen.list.length;
  }

  /** Height on the page, in a scope of `room` pixels. */
  shown(room) {
    return this.chosen.list.length === 0
      ? 0
      : Math.min(this.wanted, Math.max(kSignalLane, Math.floor(room * kPart)));
  }

  /** Signals have the colour of the node that sends them. */
  #color(message) {
    const [first] = this.chosen.signals.frames.get(message) ?? [];
    const sender = first === undefined ? kNobody : this.report.frames.sender[first];
    return sender === kNobody ? 'trace' : `n-${sender % 16}`;
  }

  /** Draws all of them from `y` on; the values in the gutter are those at `at`. */
  draw(p, scale, y, at) {
    this.chosen.list.forEach((entry, i) => {
      const series = this.chosen.signals.seriesOf(entry.message, entry.signal);
      const color = this.#color(entry.message);
      drawSignal(p, scale, entry, series, y + i * kSignalLane, kSignalLane, at, color);
    });
  }

  /** The signal at a height of the canvas, and its series; null if there is none. */
  at(y) {
    const entry = this.chosen.list[Math.floor(y / kSignalLane)];
    return entry
      ? {...entry, series: this.chosen.signals.seriesOf(entry.message, entry.signal)}
      : null;
  }
}
