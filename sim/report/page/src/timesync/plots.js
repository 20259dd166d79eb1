// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Plots over time: offset, state and rate of each follower. They share the window of time.
import {Plot} from '../plot.js';
import {colors, nodeColor} from '../theme.js';
import {kStates} from './sync_data.js';
import uPlot from 'uplot';

/** Clips drawing to the plot and restores it afterwards. */
function inside(u, draw) {
  const {left, top, width, height} = u.bbox;
  const c = u.ctx;
  c.save();
  c.beginPath();
  c.rect(left, top, width, height);
  c.clip();
  draw(c, window.devicePixelRatio || 1);
  c.restore();
}

/** Dashed lines at +- the goal. */
export function drawGoal(u, goal, axis) {
  if (!goal) return;
  inside(u, (c, scale) => {
    c.strokeStyle = colors().alarm;
    c.setLineDash([6 * scale, 4 * scale]);
    c.lineWidth = scale;
    for (const value of [-goal.max, goal.max]) {
      const at = u.valToPos(value, axis, true);
      c.beginPath();
      c.moveTo(axis === 'y' ? u.bbox.left : at, axis === 'y' ? at : u.bbox.top);
      c.lineTo(
        axis === 'y' ? u.bbox.left + u.bbox.width : at,
        axis === 'y' ? at : u.bbox.top + u.bbox.height,
      );
      c.stroke();
    }
  });
}

const line = (shown, i, more) => ({
  stroke: nodeColor(i),
  width: 1.2,
  show: shown(i),
  points: {show: false},
  ...more,
});

/** What both plots of lines have: a line for each follower. */
const lines = (page, more = {}) => ({
  series: page.run.followers.map((_, i) => line((n) => page.shown(n), i, more)),
});

/** Offset of each follower against the master. */
export function offsetPlot(host, page) {
  const plot = new Plot(host, null, page.view, {
    data: () => [page.run.at, ...page.run.followers.map(({error}) => error)],
    options: () => ({
      label: 'offset, ns',
      scales: {y: {range: () => page.offsetRange()}},
      axis: {space: 28},
      ...lines(page),
      hooks: {draw: [(u) => drawGoal(u, page.data.goal, 'y')]},
    }),
  });
  return plot;
}

/** What the increment of each follower is above its mean while it is locked. */
export function ratePlot(host, page) {
  return new Plot(host, null, page.view, {
    data: () => [
      page.run.at,
      ...page.run.followers.map(({rate, meanRate}) => rate.map((value) => value - meanRate)),
    ],
    options: () => ({
      label: 'rate, ppm',
      scales: {y: {range: () => page.rateRange()}},
      axis: {space: 20},
      ...lines(page, {paths: uPlot.paths.stepped({align: 1})}),
    }),
  });
}

/** The colour of a state, for strips and their legend. */
export function stateColor(state) {
  const theme = colors();
  return [theme.off, theme.passive, theme['f-data'], theme.alarm][state];
}

/** A strip for each follower: its state. */
export function statePlot(host, page) {
  return new Plot(host, null, page.view, {
    data: () => [page.run.at, page.run.at.map(() => 0)],
    options: () => ({
      label: 'state',
      scales: {y: {range: () => [0, page.run.followers.length], dir: -1}},
      axis: {
        splits: () => page.run.followers.map((_, i) => i + 0.5),
        space: 1,
        values: (u, at) => at.map((value) => String(Math.floor(value) + 1)),
        grid: {show: false},
      },
      series: [{stroke: 'transparent', points: {show: false}, paths: () => null}],
      hooks: {draw: [(u) => drawStates(u, page)]},
    }),
  });
}

function drawStates(u, page) {
  inside(u, (c, scale) => {
    page.run.followers.forEach((_, n) => {
      if (!page.shown(n)) return;
      const top = u.valToPos(n, 'y', true) + scale;
      const bottom = u.valToPos(n + 1, 'y', true) - scale;
      for (const [from, to, state] of page.run.stretches(n)) {
        const left = u.valToPos(from, 'x', true);
        c.fillStyle = stateColor(state);
        const right = u.valToPos(to, 'x', true);
        c.fillRect(left, top, Math.max(right - left, scale), bottom - top);
      }
    });
  });
}

export const stateNames = kStates;
