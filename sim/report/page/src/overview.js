// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Overview: the whole run in a strip. Height: load of the bus; marks: errors; window: the view.
import {el} from './dom.js';
import {Painter} from './painter.js';
import {kGutter} from './scale.js';
import {colors} from './theme.js';

const kHeight = 40;
const kColumn = 2;

export class Overview {
  constructor(root, report, view) {
    Object.assign(this, {root, report, view});
    this.canvas = el('canvas', {
      class: 'overview',
      role: 'img',
      'aria-label': 'The whole run; click or drag to move the view',
    });
    root.append(this.canvas);
    this.painter = new Painter(this.canvas);
    this.columns = null;
    this.pending = 0;
    const later = () => this.invalidate();
    view.addEventListener('move', later);
    new ResizeObserver(later).observe(root);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', later);
    this.#attach();
  }

  invalidate() {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  get plot() {
    return Math.max(this.width - kGutter, 1);
  }
  x(ns) {
    return kGutter + ((ns - this.view.least) / (this.view.most - this.view.least)) * this.plot;
  }
  time(x) {
    return this.view.least + ((x - kGutter) / this.plot) * (this.view.most - this.view.least);
  }

  /** Load and errors of each column; the same until the width changes. */
  #columnsOf(width) {
    if (this.columns?.width === width) return this.columns;
    const list = [];
    for (let x = kGutter; x < width; x += kColumn) {
      const from = this.time(x);
      const to = this.time(x + kColumn);
      list.push({
        x,
        load: this.report.loadIn(from, to),
        errors: this.report.eventsIn(from, to),
        fault: this.report.faults.any(from, to),
      });
    }
    this.columns = {width, list};
    return this.columns;
  }

  draw() {
    this.width = this.root.clientWidth;
    const p = this.painter;
    p.begin(this.width, kHeight, colors());
    for (const {x, load, errors, fault} of this.#columnsOf(this.width).list) {
      if (load > 0)
        p.rect(x, kHeight - load * (kHeight - 10), kColumn, load * (kHeight - 10), 'load');
      if (errors > 0) p.rect(x, 0, kColumn, 7, 'f-error');
      if (fault) {
        p.rect(x, kHeight - 6, kColumn, 6, 'fault');
        p.note('fault', {x});
      }
    }
    this.#drawEnd(p);
    p.text('whole run', 10, kHeight / 2, {size: 11, color: 'dim'});
    const a = this.x(this.view.from);
    const b = this.x(this.view.to);
    p.rect(kGutter, 0, Math.max(a - kGutter, 0), kHeight, 'panel', 0.55);
    p.rect(b, 0, Math.max(this.width - b, 0), kHeight, 'panel', 0.55);
    p.frame(a - 1, 0.5, Math.max(b - a + 2, 4), kHeight - 1, 'select', 2);
    p.note('window', {x0: a, x1: b});
  }

  /** Where the load is not known, as a limit has cut off the details. */
  #drawEnd(p) {
    const {detailEnd, duration} = this.report;
    if (detailEnd >= duration) return;
    const [a, b] = [this.x(detailEnd), this.x(duration)];
    p.hatch(a, 8, b - a, kHeight - 15, 'dim');
    p.note('unknown', {x0: a, x1: b});
  }

  #attach() {
    const {canvas, view} = this;
    let grip = null;
    const edge = (x) => {
      const a = this.x(view.from);
      const b = this.x(view.to);
      if (b - a > 24 && Math.abs(x - a) < 6) return 'from';
      if (b - a > 24 && Math.abs(x - b) < 6) return 'to';
      return x > a - 4 && x < b + 4 ? 'inside' : 'outside';
    };
    const move = (time) => {
      if (grip.edge === 'from') view.set(Math.min(time, view.to - view.minSpan), view.to);
      else if (grip.edge === 'to') view.set(view.from, Math.max(time, view.from + view.minSpan));
      else view.set(time - grip.offset, time - grip.offset + grip.span);
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      const time = this.time(event.offsetX);
      const where = edge(event.offsetX);
      const offset = where === 'outside' ? view.span / 2 : time - view.from;
      grip = {edge: where, offset, span: view.span};
      if (where === 'outside') move(time);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (grip) return move(this.time(event.offsetX));
      const where = edge(event.offsetX);
      canvas.style.cursor = where === 'from' || where === 'to' ? 'ew-resize' : 'pointer';
      return undefined;
    });
    for (const name of ['pointerup', 'pointercancel'])
      canvas.addEventListener(name, () => {
        grip = null;
      });
  }
}
