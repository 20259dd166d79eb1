// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Load of the bus over time: part of the time in which it is busy, and what errors took of it.
import {el, swatch} from './dom.js';
import {formatTime, percent} from './format.js';
import {Plot} from './plot.js';
import {lastAtOrBelow} from './search.js';
import {colors} from './theme.js';
import uPlot from 'uplot';

const kWindows = 160;

/** Time in segments without a frame, up to each segment: what errors cost. */
function wastedSums(report) {
  const {segments} = report;
  const sums = new Float64Array(segments.count + 1);
  for (let i = 0; i < segments.count; ++i) {
    sums[i + 1] = sums[i] + (report.segmentFrame[i] < 0 ? report.busyPart(i) : 0);
  }
  return (ns) => {
    const i = lastAtOrBelow(segments.start, ns);
    if (i < 0) return 0;
    return sums[i] + (report.segmentFrame[i] < 0 ? report.busyPart(i, ns) : 0);
  };
}

/** What is missing in a report whose details a limit has cut off; null: nothing. */
function missing({detailEnd, duration}) {
  if (detailEnd >= duration) return null;
  const from = formatTime(detailEnd, duration / 1000);
  return el('span', {class: 'alarm'}, `not known from ${from} on: no bits were kept`);
}

/** Load and what of it failed, in per cent, of equal windows; null where nothing is known. */
function loadsOf(report, wasted, from, to) {
  const step = (to - from) / kWindows;
  const [x, busy, lost] = [[], [], []];
  for (let i = 0; i <= kWindows; ++i) {
    const at = from + i * step;
    const [a, b] = report.known(at, at + step);
    x.push(at);
    busy.push(b > a ? 100 * report.loadIn(at, at + step) : null);
    lost.push(b > a ? (100 * (wasted(b) - wasted(a))) / (b - a) : null);
  }
  return [x, busy, lost];
}

export class LoadTab {
  constructor(report, view) {
    const host = el('div', {class: 'plot'});
    const wasted = wastedSums(report);
    const {summary} = report.meta;
    const bound =
      summary.analytic_load > 0
        ? ` · worst case by analysis ${percent(summary.analytic_load)}`
        : '';
    this.root = el(
      'div',
      {class: 'tab-body column'},
      el(
        'div',
        {class: 'legend'},
        el('span', {}, swatch(colors().load), 'busy: frames, errors and the three bits after each'),
        el('span', {}, swatch(colors().alarm), 'of it attempts that failed'),
        el('span', {class: 'dim'}, `whole run ${percent(summary.load)}${bound}`),
        missing(report),
      ),
      host,
    );
    this.plot = new Plot(host, report, view, {
      data: (from, to) => loadsOf(report, wasted, from, to),
      options: () => ({
        label: 'bus load, %',
        scales: {y: {range: () => [0, 100]}},
        axis: {space: 24},
        series: [
          {
            stroke: colors().load,
            fill: `${colors().load}66`,
            width: 1.5,
            paths: uPlot.paths.stepped({align: 1}),
            points: {show: false},
          },
          {
            stroke: colors().alarm,
            fill: `${colors().alarm}88`,
            width: 1.5,
            paths: uPlot.paths.stepped({align: 1}),
            points: {show: false},
          },
        ],
      }),
    });
  }
}
