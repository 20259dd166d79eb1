// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How often which offset: bars over ns, of the followers that are shown, while their errors count.
import uPlot from 'uplot';
import {niceStep} from '../format.js';
import {colors} from '../theme.js';
import {drawGoal} from './plots.js';

const kBars = 48;

/** Bars of equal width around 0: {step, first, counts}; bar i is [first + i step, + step). */
export function histogramOf(values) {
  let most = 0;
  for (const value of values) most = Math.max(most, Math.abs(value));
  if (values.length === 0 || most === 0) return {step: 1, first: 0, counts: [values.length]};
  const step = niceStep(2 * most, kBars);
  const half = Math.floor(most / step) + 1;
  const counts = new Array(2 * half).fill(0);
  for (const value of values) ++counts[Math.floor(value / step) + half];
  return {step, first: -half * step, counts};
}

export class Histogram {
  /** @param page {counted(): values in ns, data} */
  constructor(host, page) {
    Object.assign(this, {host, page});
    new ResizeObserver(() => this.draw()).observe(host);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
  }

  draw() {
    const width = this.host.clientWidth;
    const height = this.host.clientHeight;
    this.bars = histogramOf(this.page.counted());
    this.plot?.destroy();
    this.plot = null;
    if (width < 50 || height < 50) return;
    const {step, first, counts} = this.bars;
    const middles = counts.map((_, i) => first + (i + 0.5) * step);
    this.plot = new uPlot(this.#options(width, height), [middles, counts], this.host);
  }

  #options(width, height) {
    const theme = colors();
    const {goal, when} = this.page.data;
    const {step, first, counts} = this.bars;
    const most = Math.max(-first, first + counts.length * step, 1.1 * (goal?.max ?? 0));
    const axis = {
      stroke: theme.dim,
      grid: {stroke: theme.grid, width: 1},
      ticks: {stroke: theme.grid, width: 1},
      font: `11px ${theme.sans}`,
      labelFont: `11px ${theme.sans}`,
      labelSize: 18,
    };
    return {
      width,
      height,
      padding: [8, 16, 0, 0],
      legend: {show: false},
      cursor: {show: false},
      scales: {
        x: {time: false, range: () => [-most, most]},
        y: {range: (u, low, high) => [0, 1.05 * (high || 1)]},
      },
      axes: [
        {...axis, label: `offset ${when}, ns`, size: 30},
        {...axis, label: 'samples', size: 60},
      ],
      series: [
        {},
        {
          stroke: theme.load,
          fill: theme.load,
          points: {show: false},
          paths: uPlot.paths.bars({size: [1, Infinity], gap: 1}),
        },
      ],
      hooks: {draw: [(u) => drawGoal(u, goal, 'x')]},
    };
  }
}
