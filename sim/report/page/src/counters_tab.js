// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TEC and REC of all nodes over time, with their states.
import {el, swatch} from './dom.js';
import {Plot} from './plot.js';
import {lastAtOrBelow} from './search.js';
import {colors, nodeColor} from './theme.js';
import uPlot from 'uplot';

const kStates = [
  ['passive', 128, 255, 'error passive'],
  ['off', 256, 1e4, 'bus-off'],
];

/** Moments to plot: every change while there is room, else a grid that keeps the extremes. */
function timesOf(report, from, to, columns) {
  const {nodes} = report.counters;
  const ranges = nodes.map((rows) => [
    lastAtOrBelow(rows.time, from) + 1,
    lastAtOrBelow(rows.time, to),
  ]);
  const changes = ranges.reduce((sum, [a, b]) => sum + Math.max(0, b - a + 1), 0);
  if (changes > 2 * columns) {
    return {
      grid: true,
      times: Array.from({length: columns + 1}, (_, i) => from + ((to - from) * i) / columns),
    };
  }
  const times = new Set([from, to]);
  ranges.forEach(([a, b], node) => {
    for (let i = a; i <= b; ++i) times.add(nodes[node].time[i]);
  });
  return {grid: false, times: [...times].sort((a, b) => a - b)};
}

/** Values of one counter at the times; on a grid the largest since the time before. */
function valuesOf(rows, counter, {grid, times}) {
  let i = lastAtOrBelow(rows.time, times[0]);
  return times.map((time) => {
    let value = i >= 0 ? counter[i] : 0;
    while (i + 1 < rows.time.length && rows.time[i + 1] <= time) {
      ++i;
      value = grid ? Math.max(value, counter[i]) : counter[i];
    }
    return value;
  });
}

/** Strips of colour at the top: the state of each node. */
function drawStates(u, report, view) {
  const theme = colors();
  const c = u.ctx;
  const scale = window.devicePixelRatio || 1;
  const {left, top, width, height} = u.bbox;
  c.save();
  c.beginPath();
  c.rect(left, top, width, height);
  c.clip();
  for (const [name, low, high, label] of kStates) {
    const y1 = Math.max(u.valToPos(high, 'y', true), top);
    const y0 = u.valToPos(low, 'y', true);
    if (y0 <= top) continue;
    c.globalAlpha = 0.12;
    c.fillStyle = theme[name];
    c.fillRect(left, y1, width, y0 - y1);
    c.globalAlpha = 1;
    c.fillStyle = theme.dim;
    c.font = `${11 * scale}px ${theme.sans}`;
    c.fillText(label, left + width - c.measureText(label).width - 6 * scale, y0 - 4 * scale);
  }
  let drawn = 0;
  const high = 4 * scale;
  report.nodes.forEach((_, node) => {
    report.counters.states(node, view.from, view.to, (from, to, state) => {
      if (state === 0 || ++drawn > 4000) return;
      const x0 = u.valToPos(from, 'x', true);
      const x1 = u.valToPos(to, 'x', true);
      c.fillStyle = nodeColor(node);
      c.globalAlpha = state === 2 ? 1 : 0.5;
      c.fillRect(x0, top + node * (high + scale), Math.max(x1 - x0, 1), high);
    });
  });
  c.restore();
}

export class CountersTab {
  constructor(report, view) {
    const host = el('div', {class: 'plot'});
    const legend = el(
      'div',
      {class: 'legend'},
      report.nodes.map(({name}, i) => el('span', {}, swatch(nodeColor(i)), name)),
      el(
        'span',
        {
          class: 'dim',
          title:
            'Transmit error counter: 8 more for each failed transmission, 1 less for each good one',
        },
        '—— TEC',
      ),
      el('span', {class: 'dim', title: 'Receive error counter'}, '- - - REC'),
      el('span', {class: 'dim'}, 'strips at the top: pale error passive, full bus-off'),
    );
    this.root = el('div', {class: 'tab-body column'}, legend, host);
    this.plot = new Plot(host, report, view, {
      data: (from, to, columns) => {
        const at = timesOf(report, from, to, columns);
        const rows = report.counters.nodes;
        return [at.times, ...rows.flatMap((r) => [valuesOf(r, r.tec, at), valuesOf(r, r.rec, at)])];
      },
      options: () => ({
        label: 'error counter',
        scales: {y: {range: (u, min, max) => [0, Math.max(16, max * 1.3)]}},
        series: report.nodes.flatMap((_, i) => [
          {
            stroke: nodeColor(i),
            width: 1.8,
            paths: uPlot.paths.stepped({align: 1}),
            points: {show: false},
          },
          {
            stroke: nodeColor(i),
            width: 1.2,
            dash: [5, 4],
            paths: uPlot.paths.stepped({align: 1}),
            points: {show: false},
          },
        ]),
        hooks: {drawClear: [(u) => drawStates(u, report, view)]},
      }),
    });
  }
}
