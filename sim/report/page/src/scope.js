// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scope: two pictures over one time scale. Above, ruler, decoded bar and bus, always in sight;
// below, one lane for each node, which scroll if there are many.
import {drawBar, drawRuler, kBarEnd, kRows} from './draw_bar.js';
import {drawFaultRow, drawFaultShade, kFaultRow} from './draw_faults.js';
import {drawBus, drawNode} from './draw_traces.js';
import {el} from './dom.js';
import {LaneHint} from './lane_hint.js';
import {Painter} from './painter.js';
import {Scale, kGutter} from './scale.js';
import {SignalLanes} from './signal_lanes.js';
import {colors} from './theme.js';

const kBus = {least: 76, most: 150};
const kLane = {least: 20, usual: 46, most: 84};

export class Scope {
  /** @param chosen signals.js: what is plotted below the bus */
  constructor(root, report, view, chosen) {
    Object.assign(this, {root, report, view});
    this.signals = new SignalLanes(report, chosen);
    this.top = el('canvas', {
      class: 'scope-top',
      tabindex: 0,
      role: 'img',
      'aria-label': 'Bus over time; arrow keys move, plus and minus zoom',
    });
    this.lanes = el('canvas', {class: 'scope-lanes'});
    this.scroll = el('div', {class: 'lanes'}, this.lanes);
    this.hint = new LaneHint(this.scroll);
    const host = el('div', {class: 'lanes-host'}, this.scroll, this.hint.above, this.hint.below);
    root.append(this.top, this.signals.root, host);
    this.topPainter = new Painter(this.top);
    this.lanesPainter = new Painter(this.lanes);
    this.hover = null;
    this.box = null;
    this.pending = 0;
    this.stats = {redraws: 0, lastMs: 0, drawn: 0, times: []};
    const later = () => this.invalidate();
    view.addEventListener('move', later);
    view.addEventListener('select', later);
    chosen.addEventListener('change', later);
    new ResizeObserver(later).observe(root);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', later);
  }

  invalidate() {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  /** Room that the lanes leave goes to the bus. */
  get busHeight() {
    const lanes = kLane.usual * this.report.nodes.length;
    const room = this.root.clientHeight - kBarEnd - this.faultRow - this.signalHeight - lanes - 2;
    return Math.min(Math.max(room, kBus.least), kBus.most);
  }

  /** Height of the upper picture: the bar, the bus, and the faults if there are any. */
  get topHeight() {
    return kBarEnd + this.busHeight + this.faultRow;
  }
  get signalHeight() {
    return this.signals.shown(this.root.clientHeight);
  }
  get faultRow() {
    return this.report.faults.count > 0 ? kFaultRow : 0;
  }

  get laneHeight() {
    const room = this.root.clientHeight - this.topHeight - this.signalHeight - 2;
    const each = Math.floor(room / Math.max(this.report.nodes.length, 1));
    return Math.min(Math.max(each, kLane.least), kLane.most);
  }

  scale() {
    return new Scale(this.report, this.view, this.scroll.clientWidth || 800);
  }

  draw() {
    const begin = performance.now();
    const theme = colors();
    const scale = this.scale();
    this.topPainter.begin(scale.width, this.topHeight, theme);
    this.#drawTop(this.topPainter, scale);
    this.#drawSignals(scale, theme);
    this.lanesPainter.begin(scale.width, Math.max(this.lanesHeight, 1), theme);
    this.#drawLanes(this.lanesPainter, scale);
    this.#overlay(this.topPainter, scale);
    this.#overlay(this.lanesPainter, scale);
    this.hint.update(this.laneHeight);
    this.#measure(performance.now() - begin, scale);
  }

  #drawSignals(scale, theme) {
    const {signals, signalHeight} = this;
    signals.root.hidden = signalHeight === 0;
    signals.root.style.height = `${signalHeight}px`;
    if (signalHeight === 0) return;
    signals.painter.begin(scale.width, signals.wanted, theme);
    signals.draw(signals.painter, scale, 0, this.moment(scale));
    this.#overlay(signals.painter, scale);
  }

  /** The time of the values in the gutter: under the pointer, else at the right end. */
  moment(scale) {
    return this.hover ? scale.time(this.hover.x) : this.view.to;
  }

  #drawLanes(p, scale) {
    const height = this.laneHeight;
    for (let node = 0; node < this.report.nodes.length; ++node)
      this.#drawLane(p, scale, node, node * height, height);
  }

  get lanesHeight() {
    return this.laneHeight * this.report.nodes.length;
  }

  /** Height of all of it, with what is scrolled away. */
  get wholeHeight() {
    return this.topHeight + this.signals.wanted + this.lanesHeight;
  }

  /** Paints all of it, one below the other, for a picture file. */
  paint(p, scale) {
    const {topHeight, signals} = this;
    const parts = [
      [topHeight, () => this.#drawTop(p, scale)],
      [signals.wanted, () => signals.draw(p, scale, 0, this.moment(scale))],
      [this.lanesHeight, () => this.#drawLanes(p, scale)],
    ];
    let y = 0;
    for (const [height, draw] of parts) {
      p.shifted(y, height, () => {
        draw();
        this.#overlay(p, scale);
      });
      y += height;
    }
  }

  #measure(ms, scale) {
    const {stats} = this;
    ++stats.redraws;
    stats.lastMs = ms;
    const signals = this.signals.root.hidden ? 0 : this.signals.painter.drawn;
    stats.drawn = this.topPainter.drawn + signals + this.lanesPainter.drawn;
    stats.mode = scale.mode;
    stats.times.push(ms);
    if (stats.times.length > 1000) stats.times.shift();
  }

  #drawTop(p, scale) {
    const bus = this.busHeight;
    drawRuler(p, scale);
    p.clip(scale.left, 0, scale.plot, p.height, () => {
      drawBar(p, scale);
      drawBus(p, scale, kBarEnd, bus);
      drawFaultShade(p, scale, -1, kBarEnd, bus);
      if (this.faultRow) drawFaultRow(p, scale, kBarEnd + bus);
    });
    const note = {size: 11, color: 'dim'};
    p.text(scale.mode === 'columns' ? 'bus load' : 'frames', 10, kRows.frame[0] + 10, note);
    if (scale.fine) p.text('fields', 10, kRows.fields[0] + 13, note);
    if (scale.mode === 'bits' || scale.mode === 'quanta')
      p.text('bits', 10, kRows.bits[0] + 9, note);
    if (scale.mode === 'quanta') p.text('time quanta', 10, kRows.quanta[0] + 7, note);
    p.text('bus', 10, kBarEnd + bus / 2, {size: 13, bold: true});
    if (this.faultRow) p.text('faults', 10, kBarEnd + bus + kFaultRow / 2, note);
    p.text('CAN_H', scale.left - 8, kBarEnd + 14, {size: 10, color: 'dim', align: 'right'});
    p.text('CAN_L', scale.left - 8, kBarEnd + bus - 14, {size: 10, color: 'dim', align: 'right'});
    this.#drawEnd(p, scale);
  }

  /** Where bits and levels end, if a limit cut them off. */
  #drawEnd(p, scale) {
    const {detailEnd, duration} = scale.report;
    const range = detailEnd < duration ? scale.range(detailEnd, scale.to) : null;
    if (!range) return;
    p.rect(range[0], kRows.fields[0], range[1] - range[0], p.height, 'raised', 0.6);
    p.fit(
      ['no details were kept from here on'],
      (range[0] + range[1]) / 2,
      kBarEnd + kBus.least / 2,
      range[1] - range[0],
      {color: 'dim'},
    );
  }

  #drawLane(p, scale, node, y, h) {
    p.line(0, y, p.width, y, 'grid');
    p.clip(scale.left, y, scale.plot, h, () => {
      drawNode(p, scale, node, y, h);
      drawFaultShade(p, scale, node, y, h);
    });
    p.rect(0, y + 4, 4, h - 8, `n-${node % 16}`);
    const name = this.report.nodes[node].name;
    const at = this.moment(scale);
    const {tec, rec, state} = this.report.counters.at(node, at);
    const small = h < 34;
    const label = name.length > 15 ? `${name.slice(0, 14)}…` : name;
    p.text(label, 10, y + (small ? h / 2 : 14), {size: 13, bold: true});
    const text = state === 2 ? 'bus-off' : `TEC ${tec} REC ${rec}`;
    const color = state === 0 ? 'dim' : 'alarm';
    if (small) {
      if (tec || rec)
        p.text(`${tec}/${rec}`, scale.left - 6, y + h / 2, {size: 10, color, align: 'right'});
    } else {
      p.text(text, 10, y + 30, {size: 11, color});
    }
  }

  /** Selection, pointer and box over a picture. */
  #overlay(p, scale) {
    const span = this.view.selectionSpan?.();
    if (span) {
      const range = scale.range(span[0], span[1]);
      if (range) {
        const whole = range[1] - range[0] > 0.98 * scale.plot;
        p.rect(
          range[0],
          0,
          Math.max(range[1] - range[0], 1.5),
          p.height,
          'select',
          whole ? 0.03 : 0.1,
        );
        p.line(range[0], 0, range[0], p.height, 'select', 1.2);
        p.line(range[1], 0, range[1], p.height, 'select', 1.2);
        p.note('selection', {x0: range[0], x1: range[1]});
      }
    }
    if (this.box) {
      const [a, b] = this.box;
      p.rect(Math.min(a, b), 0, Math.abs(b - a), p.height, 'select', 0.25);
    } else if (this.hover && this.hover.x > scale.left) {
      p.line(this.hover.x, 0, this.hover.x, p.height, 'dim', 1, [2, 3]);
    }
  }

  /** What the picture shows: for the tests. Draws once more, keeping a list. */
  inspect() {
    const painters = [this.topPainter, this.signals.painter, this.lanesPainter];
    for (const painter of painters) painter.items = [];
    this.draw();
    const items = painters.flatMap((painter) => painter.items);
    for (const painter of painters) painter.items = null;
    const {from, to} = this.view;
    return {
      from,
      to,
      left: kGutter,
      width: this.scroll.clientWidth,
      mode: this.stats.mode,
      drawn: this.stats.drawn,
      items,
    };
  }
}
