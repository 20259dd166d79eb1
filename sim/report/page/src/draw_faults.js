// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults in the scope: a row with their names, and shading over what they touch.

export const kFaultRow = 20;
const kMost = 400; // more in the window: columns
const kLeast = 3; // px, so that a short fault is seen
const kColumn = 2;

function drawColumns(p, scale, y, h) {
  const {faults} = scale.report;
  for (let x = scale.left; x < scale.width; x += kColumn) {
    if (faults.any(scale.time(x), scale.time(x + kColumn))) p.rect(x, y, kColumn, h, 'fault');
  }
  p.note('faultcolumns', {step: kColumn});
}

/** [left, right] on the plot of a hit, at least a few pixels wide; null if it is not in sight. */
function place(scale, {from, to}) {
  const a = Math.max(scale.x(from), scale.left);
  const b = Math.min(Math.max(scale.x(to), scale.x(from) + kLeast), scale.width);
  return b > a ? [a, b] : null;
}

/** Row of faults between y and y + kFaultRow: yellow with slanting lines, and named. */
export function drawFaultRow(p, scale, y) {
  const {faults} = scale.report;
  const hits = faults.in(scale.from, scale.to);
  const h = kFaultRow - 5;
  if (hits.length > kMost) return drawColumns(p, scale, y + 2, h);
  for (const hit of hits.reverse()) {
    const range = place(scale, hit);
    if (!range) continue;
    const [a, b] = range;
    p.rect(a, y + 2, b - a, h, 'fault');
    p.hatch(a, y + 2, b - a, h, 'onfault', 7);
    p.note('fault', {fault: hit.fault, hit: hit.hit, x0: a, x1: b});
  }
  return drawNames(p, scale, hits, y + 2, h);
}

/** Names inside of wide faults, beside narrow ones as far as there is room. */
function drawNames(p, scale, hits, y, h) {
  let free = scale.left;
  hits.forEach((hit, i) => {
    const range = place(scale, hit);
    if (!range) return;
    const {name} = scale.report.faults.list[hit.fault];
    const wide = p.measure(name, 11, true) + 8;
    const inside = range[1] - range[0] > wide;
    const x = inside ? range[0] + 3 : range[1] + 2;
    const next = hits.slice(i + 1).find((other) => other.from > hit.from);
    const limit = Math.min(next ? scale.x(next.from) : scale.width, scale.width);
    if (x < free || x + wide > (inside ? scale.width : limit)) return;
    p.rect(x, y + 1, wide - 2, h - 2, 'panel', 0.9);
    p.text(name, x + 3, y + h / 2, {size: 11, bold: true});
    p.note('faultname', {fault: hit.fault, hit: hit.hit, name, x});
    free = x + wide;
  });
}

/** Shading over a trace between y and y + h while faults touch it; node -1: the bus. */
export function drawFaultShade(p, scale, node, y, h) {
  const {faults} = scale.report;
  if (faults.count === 0) return;
  const hits = faults.in(scale.from, scale.to);
  if (hits.length > kMost) return;
  for (const hit of hits) {
    const {nodes} = faults.list[hit.fault];
    const range = node < 0 || nodes.length === 0 || nodes.includes(node) ? place(scale, hit) : null;
    if (!range) continue;
    p.rect(range[0], y, range[1] - range[0], h, 'fault', 0.22);
    p.note('faultshade', {fault: hit.fault, hit: hit.hit, node, x0: range[0], x1: range[1]});
  }
}
