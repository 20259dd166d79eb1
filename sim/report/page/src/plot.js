// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Plots over time whose time axis is the view: zooming one zooms all.
import uPlot from 'uplot';
import {formatTime} from './format.js';
import {kGutter} from './scale.js';
import {colors} from './theme.js';

const kLabelRoom = 40; // at the right, so that the last label of the time axis is whole

/** Options that all plots share. */
function base(plot, extra) {
  const theme = colors();
  const axis = {
    stroke: theme.dim,
    grid: {stroke: theme.grid, width: 1},
    ticks: {stroke: theme.grid, width: 1},
    font: `11px ${theme.sans}`,
    labelFont: `11px ${theme.sans}`,
    labelSize: 18,
  };
  return {
    width: 600,
    height: 200,
    padding: [8, kLabelRoom, 0, 0],
    legend: {show: false},
    cursor: {y: false, drag: {x: true, y: false, setScale: false}, points: {show: false}},
    select: {show: true},
    scales: {
      x: {time: false, auto: false, range: () => [plot.view.from, plot.view.to]},
      ...extra.scales,
    },
    axes: [
      {
        ...axis,
        space: 110,
        size: 30,
        values: (u, splits) =>
          splits.map((v, i) => formatTime(v, (splits[1] - splits[0]) / 2 || 1)),
      },
      {...axis, size: kGutter - (extra.label ? 18 : 0), label: extra.label, ...extra.axis},
    ],
    series: [{}, ...extra.series],
    hooks: {
      setSelect: [
        (u) => {
          if (u.select.width < 3) return;
          const a = u.posToVal(u.select.left, 'x');
          const b = u.posToVal(u.select.left + u.select.width, 'x');
          u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
          plot.view.go(a, b);
        },
      ],
      ...extra.hooks,
    },
  };
}

/** A plot in a tab; `make()` gives {data, label, series, scales, axis, hooks}. */
export class Plot {
  /** @param parts {data(from, to, columns): columns of numbers, options(): see base} */
  constructor(root, report, view, parts) {
    Object.assign(this, {root, report, view, parts});
    this.pending = 0;
    view.addEventListener('move', () => this.invalidate());
    new ResizeObserver(() => this.invalidate()).observe(root);
    window
      .matchMedia('(prefers-color-scheme: dark)')
      .addEventListener('change', () => this.rebuild());
    root.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        const u = this.plot;
        if (!u) return;
        const box = u.over.getBoundingClientRect();
        if (event.shiftKey) view.pan(((event.deltaX || event.deltaY) / box.width) * view.span);
        else view.zoom(Math.exp(0.002 * event.deltaY), u.posToVal(event.clientX - box.left, 'x'));
      },
      {passive: false},
    );
  }

  rebuild() {
    this.plot?.destroy();
    this.plot = null;
    this.invalidate();
  }

  invalidate() {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  /** Draws, if the plot is in sight. */
  draw() {
    const width = this.root.clientWidth;
    const height = this.root.clientHeight;
    if (width < 50 || height < 50) return;
    const data = this.parts.data(this.view.from, this.view.to, Math.min(800, width));
    if (!this.plot) {
      this.plot = new uPlot(
        {...base(this, this.parts.options(this)), width, height},
        data,
        this.root,
      );
      return;
    }
    if (this.plot.width !== width || this.plot.height !== height)
      this.plot.setSize({width, height});
    this.plot.setData(data, false);
    this.plot.redraw(true, true);
    this.plot.setScale('x', {min: this.view.from, max: this.view.to});
  }
}
