// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A signal over time, in a lane of its own below the bus.
import {lastAtOrBelow} from './search.js';
import {numberText} from './signal_codec.js';

export const kSignalLane = 52;
const kDots = 400; // more values in the window: only the line

/** Text of a value: its choice, or the number; without the unit, which stands with the name. */
export function axisText(signal, value) {
  const raw = Math.round((value - signal.offset) / signal.factor);
  return (signal.float ? undefined : signal.choices.get(raw)) ?? numberText(signal, value);
}

/** Value of a series at a time; NaN before the first frame. */
export function valueAt({times, values}, ns) {
  const i = lastAtOrBelow(times, ns);
  return i < 0 ? NaN : values[i];
}

/** A value holds until the next frame: corners of the line [x, y, x, y, ...]. */
function corners(scale, {times, values}, first, last, y) {
  const points = [];
  for (let i = first; i <= last; ++i) {
    const x = Math.max(scale.x(times[i]), scale.left);
    if (points.length) points.push(x, points.at(-1));
    points.push(x, y(values[i]));
  }
  if (points.length) points.push(scale.width, points.at(-1));
  return points;
}

/** Too many values for a corner each: a bar for each column, from the value before on. */
function drawColumns(p, scale, signal, {times, values}, first, last, y, color) {
  let before = NaN;
  let right = scale.left;
  for (let i = first; i <= last;) {
    const x = Math.max(Math.floor(scale.x(times[i])), scale.left);
    const end = Math.max(i, lastAtOrBelow(times, scale.time(x + 1), last + 1));
    if (x > right && !Number.isNaN(before)) p.rect(right, y(before) - 0.7, x - right, 1.4, color);
    let low = Number.isNaN(before) ? values[i] : before;
    let high = low;
    for (; i <= end; ++i) {
      if (values[i] < low) low = values[i];
      else if (values[i] > high) high = values[i];
    }
    before = values[end];
    p.rect(x, y(high) - 0.7, 1, y(low) - y(high) + 1.4, color);
    p.note('bar', {signal: signal.name, x, low, high});
    right = x + 1;
  }
  if (scale.width > right) p.rect(right, y(before) - 0.7, scale.width - right, 1.4, color);
}

/** Values that are the same for long have their text in the line's place. */
function drawChoices(p, scale, signal, series, first, last, top, h) {
  let from = first;
  for (let i = first + 1; i <= last + 1; ++i) {
    if (i <= last && series.values[i] === series.values[from]) continue;
    const a = Math.max(scale.x(series.times[from]), scale.left);
    const b = i <= last ? scale.x(series.times[i]) : scale.width;
    const text = axisText(signal, series.values[from]);
    p.rect(a, top, Math.max(b - a - 1, 0.5), h, 'raised');
    p.line(a, top, a, top + h, 'dim');
    const shown = b - a > 12 ? p.fit([text], (a + b) / 2, top + h / 2, b - a, {size: 11}) : '';
    p.note('choice', {signal: signal.name, value: series.values[from], text: shown, x0: a, x1: b});
    from = i;
  }
}

function drawLine(p, scale, entry, series, first, last, y0, h, color) {
  const {signal} = entry;
  const flat = series.most === series.least;
  const bottom = y0 + h - 7;
  const y = (value) =>
    flat ? y0 + h / 2 : bottom - ((value - series.least) / (series.most - series.least)) * (h - 14);
  if (last - first > 2 * scale.plot) {
    drawColumns(p, scale, signal, series, first, last, y, color);
    return;
  }
  p.polyline(corners(scale, series, first, last, y), color, 1.4);
  for (let i = first; i <= last && last - first < kDots; ++i) {
    const x = scale.x(series.times[i]);
    if (x < scale.left) continue;
    p.rect(x - 1.5, y(series.values[i]) - 1.5, 3, 3, color);
    p.note('point', {
      signal: signal.name,
      time: series.times[i],
      value: series.values[i],
      x,
      y: y(series.values[i]),
    });
  }
}

/** Name, unit and value in the gutter; the ends of the axis at its edge. */
function drawHead(p, scale, {signal}, series, y0, h, at) {
  const name = signal.name.length > 15 ? `${signal.name.slice(0, 14)}…` : signal.name;
  p.text(name, 10, y0 + 13, {size: 12, bold: true});
  const value = valueAt(series, at);
  const unit = signal.unit ? ` ${signal.unit}` : '';
  const text = Number.isNaN(value)
    ? `no value${unit && `,${unit}`}`
    : axisText(signal, value) + unit;
  p.text(text, 10, y0 + 29, {size: 11, color: 'dim'});
  if (series.most > series.least && signal.choices.size === 0) {
    const edge = {size: 9, color: 'dim', align: 'right'};
    p.text(numberText(signal, series.most), scale.left - 4, y0 + 7, edge);
    p.text(numberText(signal, series.least), scale.left - 4, y0 + h - 6, edge);
  }
  p.note('signal', {signal: signal.name, text, y0, y1: y0 + h});
}

/** The lane of a chosen signal between y0 and y0 + h; its value in the gutter is that at `at`. */
export function drawSignal(p, scale, entry, series, y0, h, at, color) {
  const {signal} = entry;
  p.line(0, y0, p.width, y0, 'grid');
  const first = Math.max(0, lastAtOrBelow(series.times, scale.from));
  const last = lastAtOrBelow(series.times, scale.to);
  if (last >= first) {
    p.clip(scale.left, y0, scale.plot, h, () => {
      if (signal.choices.size > 0 && last - first < scale.plot)
        drawChoices(p, scale, signal, series, first, last, y0 + 8, h - 16);
      else drawLine(p, scale, entry, series, first, last, y0, h, color);
    });
  }
  drawHead(p, scale, entry, series, y0, h, at);
}
