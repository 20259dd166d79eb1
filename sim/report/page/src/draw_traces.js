// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The traces: the bus as an oscilloscope shows it, and what each node drives and sees.
import {drawFields} from './draw_bar.js';

const kMaxEdges = 2500; // more in the window: columns instead of single edges
const kColumn = 1; // width of a column, px
export const kStrip = 13; // height of a node's own fields

const edgesIn = (track, scale) => track.countAt(scale.to) - track.countAt(scale.from);

/**
 * Columns of a track that has too many edges to show each: visit(x0, x1, density 0..1), density in
 * `levels` steps, neighbours of one density together.
 */
function columns(track, scale, levels, visit) {
  const perColumn = kColumn / scale.pxPerNs / scale.report.bitNs;
  const full = Math.max(1, 0.5 * perColumn);
  let before = track.countAt(scale.from);
  let start = scale.left;
  let shade = -1;
  const flush = (x, next) => {
    if (shade > 0 && x > start) visit(start, x, shade / levels);
    start = x;
    shade = next;
  };
  for (let x = scale.left; x < scale.width; x += kColumn) {
    const count = track.countAt(scale.time(x + kColumn));
    const edges = count - before;
    before = count;
    const level = track.initial ^ (count & 1);
    const density = edges === 0 ? 1 - level : Math.min(1, edges / full);
    const next = Math.ceil(levels * density);
    if (next !== shade) flush(x, next);
  }
  flush(scale.width, 0);
}

/** Points of a trace between two heights; with slopes where there is room for them. */
function tracePoints(track, scale, yHigh, yLow) {
  const slope = scale.pxPerBit > 10 ? Math.min(5, 0.05 * scale.pxPerBit) : 0;
  const y = (level) => (level ? yHigh : yLow);
  let level = track.levelAt(scale.from);
  const points = [scale.left, y(level)];
  track.walk(scale.from, scale.to, (time, next) => {
    const x = scale.x(time);
    points.push(x, y(level), Math.min(x + slope, scale.width), y(next));
    level = next;
  });
  points.push(scale.width, y(level));
  return points;
}

/** Stretches of time with the nodes that drive dominant in them. */
function driverStretches(scale, visit) {
  const edges = [];
  const driving = new Set();
  scale.report.tx.forEach((track, node) => {
    if (!track) return;
    if (track.levelAt(scale.from) === 0) driving.add(node);
    track.walk(scale.from, scale.to, (time, level) => edges.push({time, node, level}));
  });
  edges.sort((a, b) => a.time - b.time);
  let start = scale.from;
  const flush = (time) => {
    if (driving.size > 0 && time > start)
      visit(
        start,
        time,
        [...driving].sort((a, b) => a - b),
      );
    start = time;
  };
  for (const {time, node, level} of edges) {
    if (time > start) flush(time);
    if (level === 0) driving.add(node);
    else driving.delete(node);
  }
  flush(scale.to);
}

function drawDrivers(p, scale, top, bottom) {
  driverStretches(scale, (from, to, nodes) => {
    const range = scale.range(from, to);
    if (!range) return;
    const band = (bottom - top) / nodes.length;
    nodes.forEach((node, i) => {
      p.rect(
        range[0],
        top + i * band,
        Math.max(range[1] - range[0], 0.6),
        band,
        `n-${node % 16}`,
        0.6,
      );
    });
    p.note('drivers', {nodes, x0: range[0], x1: range[1], from, to});
  });
}

/** Sample points of the reference lane: where the level was read. */
function drawSamples(p, scale, yMiddle, half) {
  const [first, last] = scale.segments;
  for (let s = first; s <= last; ++s) {
    const lane = scale.report.lane(s);
    if (!lane) continue;
    for (let i = 0; i < lane.count; ++i) {
      const x = scale.x(lane.sample(i));
      if (x < scale.left || x > scale.width) continue;
      const y = lane.sampled(i) ? yMiddle : yMiddle - half;
      p.polygon([x - 4, y - 9, x + 4, y - 9, x, y - 2], 'ink', 0.85);
      if (scale.mode === 'quanta') p.line(x, yMiddle - half, x, yMiddle + half, 'ink', 1, [2, 3]);
    }
  }
}

/** The bus between y and y + h: CAN_H above, CAN_L below, filled in the colours of who drives. */
export function drawBus(p, scale, y, h) {
  const {report} = scale;
  const middle = y + h / 2;
  const half = h / 2 - 9;
  const edges = edgesIn(report.wire, scale);
  const drivers = report.tx.reduce((sum, track) => sum + (track ? edgesIn(track, scale) : 0), 0);
  p.note('bus', {edges, exact: edges <= kMaxEdges});
  if (edges > kMaxEdges || drivers > 2 * kMaxEdges) {
    p.line(scale.left, middle, scale.width, middle, 'trace', 1);
    columns(report.wire, scale, 4, (x0, x1, density) => {
      p.rect(x0, middle - half, x1 - x0, 2 * half, 'trace', 0.2 + 0.7 * density);
    });
    return;
  }
  drawDrivers(p, scale, middle - half, middle + half);
  const width = scale.pxPerBit > 3 ? 1.7 : scale.pxPerBit > 1 ? 1 : 0.5;
  p.polyline(tracePoints(report.wire, scale, middle - 2, middle - half), 'trace', width);
  p.polyline(tracePoints(report.wire, scale, middle + 2, middle + half), 'trace', width);
  if (scale.pxPerBit >= 14) drawSamples(p, scale, middle, half);
}

function drawStates(p, scale, node, y, h) {
  let drawn = 0;
  scale.report.counters.states(node, scale.from, scale.to, (from, to, state) => {
    const range = state === 0 ? null : scale.range(from, to);
    if (!range || range[1] - range[0] < 0.5 || ++drawn > 500) return;
    p.rect(range[0], y, range[1] - range[0], h, state === 1 ? 'passive' : 'off', 0.2);
    const name = state === 1 ? 'error passive' : 'bus-off';
    const wide = p.measure(name, 10) + 8;
    if (h >= 30 && range[1] - range[0] > wide) {
      p.rect(range[1] - wide - 2, y + h - 15, wide, 13, 'panel', 0.9);
      p.text(name, range[1] - wide + 2, y + h - 8, {size: 10});
    }
    p.note('state', {node, state, x0: range[0], x1: range[1], name});
  });
}

/** The fields as this node sees them, where nodes do not agree. */
function drawOwnFields(p, scale, node, y, h) {
  const [first, last] = scale.segments;
  const {report} = scale;
  for (let s = first; s <= last; ++s) {
    if (report.segments.lanes[s] < 2) continue;
    const lane = report.lanesOf(s).find((l) => l.nodeIndex === node);
    if (!lane) continue;
    drawFields(p, scale, lane, y, h, 10);
    p.note('lane', {node, segment: s});
  }
}

function drawLosses(p, scale, node, y, h) {
  const {losses} = scale.report;
  for (const i of scale.report.lossesIn(node, scale.from, scale.to)) {
    const x = scale.x(losses.time[i]);
    p.line(x, y + 2, x, y + h - 2, 'ink', 1.5);
    p.polygon([x, y + 2, x + 7, y + 6, x, y + 10], 'ink');
    if (scale.pxPerBit > 3) {
      p.text(`lost to ${scale.report.nodeName(losses.winner[i])}`, x + 10, y + 7, {size: 10});
    }
    p.note('loss', {node, index: i, x, winner: losses.winner[i]});
  }
}

function drawReceived(p, scale, track, y, h) {
  if (edgesIn(track, scale) > kMaxEdges) return;
  p.polyline(tracePoints(track, scale, y + h * 0.3, y + h), 'rx', 1.2, [3, 2]);
}

/** The lane of one node between y and y + h. */
export function drawNode(p, scale, node, y, h) {
  const {report} = scale;
  const track = report.tx[node];
  const color = `n-${node % 16}`;
  const strip = scale.fine && h >= 34 ? kStrip : 0;
  const top = y + 5;
  const bottom = y + h - 4 - strip;
  if (!track) return drawStates(p, scale, node, y + 1, h - 2);
  if (edgesIn(track, scale) > kMaxEdges / 2) {
    p.line(scale.left, top, scale.width, top, color, 1);
    const far = scale.mode === 'columns'; // too far away for single frames: height says how much
    columns(track, scale, far ? 24 : 4, (x0, x1, density) => {
      const high = far ? density * (bottom - top) : bottom - top;
      p.rect(x0, bottom - high, x1 - x0, high, color, far ? 0.8 : 0.25 + 0.75 * density);
    });
  } else {
    track.stretches(scale.from, scale.to, (from, to, level) => {
      const range = level === 0 ? scale.range(from, to) : null;
      if (range)
        p.rect(range[0], top, Math.max(range[1] - range[0], 0.6), bottom - top, color, 0.5);
    });
    p.polyline(tracePoints(track, scale, top, bottom), color, scale.pxPerBit > 1 ? 1.5 : 0.6);
  }
  drawStates(p, scale, node, y + 1, h - 2);
  if (report.rx[node] && scale.pxPerBit >= 3)
    drawReceived(p, scale, report.rx[node], top, bottom - top);
  if (strip) drawOwnFields(p, scale, node, bottom + 3, strip - 2);
  if (scale.fine) drawLosses(p, scale, node, y, h - strip);
  return p.note('node', {node, x0: scale.left, x1: scale.width, y0: y, y1: y + h});
}
