// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The decoded bar: ruler, frames, fields, bits, quanta.
import {F, bitTitle, fieldColor, fieldName, errorKinds, kSingle} from './fields.js';
import {formatTime, hex, niceStep} from './format.js';
import {kNobody} from './report.js';

export const kRuler = 22;
export const kRows = {frame: [24, 20], fields: [45, 26], bits: [72, 19], quanta: [92, 15]};
export const kBarEnd = 109;

/** [top, height] of the row of fields: it has the room of bits and quanta if these are hidden. */
function fieldRow(scale) {
  const [top, height] = kRows.fields;
  return scale.mode === 'fields' ? [top, kBarEnd - 4 - top] : [top, height];
}

export function drawRuler(p, scale) {
  const step = niceStep(scale.to - scale.from, scale.plot / 110);
  const first = Math.ceil(scale.from / step);
  const last = Math.floor(scale.to / step);
  let free = 0;
  p.rect(0, 0, p.width, kRuler, 'raised');
  for (let n = first; n <= last; ++n) {
    const x = scale.x(n * step);
    p.line(x, kRuler - 5, x, p.height, 'grid');
    const text = n === 0 ? '0' : formatTime(n * step, step / 2);
    const wide = p.measure(text, 11);
    const at = Math.min(x + 3, p.width - wide - 2); // the last one whole, beside its line
    if (at < free) continue;
    p.text(text, at, kRuler / 2, {size: 11, color: 'dim'});
    p.note('label', {text, x0: at, x1: at + wide});
    free = at + wide + 6;
  }
  p.note('ruler', {step, first, last});
}

/** "0x123 [2] CA FE": the frame as the bar names it, in three lengths. */
export function frameTexts(frame, report) {
  const id = frame.extended ? hex(frame.id, 8) : hex(frame.id, 3);
  const data = frame.remote
    ? 'remote request'
    : [...frame.data].map((byte) => hex(byte, 2)).join(' ');
  const from = frame.sender === kNobody ? '' : `  ·  from ${report.nodeName(frame.sender)}`;
  const name = report.meta.messages[frame.message]?.name;
  const head = `0x${id}  [${frame.dlc}]  ${data}`;
  return [`${head}${from}${name ? `  ·  ${name}` : ''}`, `${head}${from}`, head, `0x${id}`, id];
}

/** What the bar says over a segment that has no frame: the attempt and its error. */
function attemptTexts(segment, report) {
  const events = (report.segmentEvents.get(segment) ?? []).map((i) => report.event(i));
  const lane = report.lane(segment);
  const id = lane?.decode().id;
  const what = events.map((e) => (e.kind === 1 ? 'overload' : `${errorKinds(e.error)} error`));
  const cause = events[0]?.cause.text ?? '';
  const head =
    id === null || id === undefined ? '' : `0x${hex(id, lane.decode().extended ? 8 : 3)}  `;
  return [
    `${head}✗ ${what[0] ?? 'no frame'}: ${cause}`,
    `${head}✗ ${what[0] ?? 'no frame'}`,
    `✗ ${what[0] ?? ''}`,
    '✗',
  ];
}

function segmentTexts(segment, report) {
  const frame = report.segmentFrame[segment];
  const events = report.segmentEvents.get(segment);
  if (frame < 0)
    return {texts: attemptTexts(segment, report), bad: Boolean(events), sender: kNobody};
  const plain = report.frame(frame);
  const texts = frameTexts(plain, report);
  return {texts, bad: false, sender: plain.sender, overload: Boolean(events)};
}

/** One segment as a whole: a strip with the sender's colour and what it carries. */
function drawSegmentHead(p, scale, segment, y, h) {
  const {report} = scale;
  const {segments} = report;
  const range = scale.range(segments.start[segment], segments.end[segment]);
  if (!range) return;
  const [a, b] = range;
  const {texts, bad, sender} = segmentTexts(segment, report);
  const color = bad ? 'f-error' : sender === kNobody ? 'dim' : `n-${sender % 16}`;
  p.rect(a, y, Math.max(b - a - 1, 1), h, color, 0.16);
  p.rect(a, y, Math.min(3, Math.max(b - a - 1, 1)), h, color);
  const text = p.fit(texts, (a + b) / 2, y + h / 2, b - a - 4, {size: 12, bold: true});
  p.note('segment', {segment, x0: a, x1: b, text, bad, sender});
}

function drawColumns(p, scale) {
  const {report} = scale;
  const top = kRows.frame[0];
  const bottom = kBarEnd - 2;
  let before = report.busyUntil(scale.from);
  const step = 2;
  for (let x = scale.left; x < scale.width; x += step) {
    const from = scale.time(x);
    const to = scale.time(x + step);
    const busy = report.busyUntil(to);
    const load = (busy - before) / (to - from);
    before = busy;
    if (load > 0) p.rect(x, bottom - load * (bottom - top), step, load * (bottom - top), 'load');
    if (report.eventsIn(from, to) > 0) p.rect(x, top, step, 8, 'f-error');
  }
  p.note('columns', {step});
}

function drawBlocks(p, scale) {
  const [first, last] = scale.segments;
  const [y] = kRows.frame;
  for (let i = first; i <= last; ++i) {
    drawSegmentHead(p, scale, i, y, kBarEnd - y - 4);
    for (const event of scale.report.segmentEvents.get(i) ?? []) {
      const x = scale.x(scale.report.events.start[event]);
      const overload = scale.report.events.kind[event] === 1;
      p.rect(
        Math.max(x - 1, scale.left),
        y,
        3,
        kBarEnd - y - 4,
        overload ? 'f-overload' : 'f-error',
      );
    }
  }
}

const inkOf = (field) =>
  field === F.ERROR_FLAG || field === F.OVERLOAD_FLAG ? 'onstrong' : 'onfield';

/** Name and value of a group, in two lines where there is height for them. */
function groupText(p, group, a, b, y, h, size) {
  const options = {size, color: inkOf(group.field), bold: Boolean(group.text)};
  const middle = (a + b) / 2;
  if (h > 40 && group.text && p.measure(group.text, size + 1, true) <= b - a - 4) {
    p.fit([group.label], middle, y + h / 2 - 10, b - a, {...options, size: size - 1, bold: false});
    return p.fit([group.text], middle, y + h / 2 + 8, b - a, {...options, size: size + 1});
  }
  const both = group.text ? `${group.label} ${group.text}` : group.label;
  const brief = group.field === F.ERROR_FLAG ? [`${group.text} flag`, 'flag'] : [group.text];
  return p.fit([both, ...brief, group.label], middle, y + h / 2, b - a, options);
}

/** The fields of a lane between y and y + h: coloured, stuff bits marked, named where it fits. */
export function drawFields(p, scale, lane, y, h, size = 12) {
  const shown = [];
  for (const group of lane.groups) {
    const range = scale.range(lane.starts[group.first], lane.starts[group.last + 1]);
    if (!range) continue;
    const [a, b] = range;
    p.rect(a, y, Math.max(b - a - (b - a > 4 ? 1 : 0), 0.5), h, fieldColor(group.field));
    shown.push([group, a, b]);
  }
  if (scale.pxPerBit >= 2) drawStuff(p, scale, lane, y, h);
  for (const [group, a, b] of shown) {
    const text = b - a > 7 ? groupText(p, group, a, b, y, h, size) : '';
    p.note('field', {
      field: fieldName(group.field),
      value: group.text,
      text,
      x0: a,
      x1: b,
      y,
      node: lane.nodeIndex,
      own: size < 12,
    });
  }
}

/** Marks the stuff bits of a lane with slanting lines. */
function drawStuff(p, scale, lane, y, h) {
  for (let i = 0; i < lane.count; ++i) {
    if (!lane.stuff(i)) continue;
    const range = scale.range(lane.starts[i], lane.starts[i + 1]);
    if (!range || range[1] - range[0] < 1.2) continue;
    p.hatch(range[0], y, range[1] - range[0], h, 'stuff', scale.pxPerBit > 8 ? 5 : 3);
    p.note('stuff', {bit: i, x0: range[0], x1: range[1], node: lane.nodeIndex});
  }
}

function drawBits(p, scale, lane) {
  const [y, h] = kRows.bits;
  for (let i = 0; i < lane.count; ++i) {
    const range = scale.range(lane.starts[i], lane.starts[i + 1]);
    if (!range) continue;
    const [a, b] = range;
    const width = b - a;
    p.rect(a, y, Math.max(width - 1, 1), h, fieldColor(lane.field(i)), 0.45);
    if (lane.stuff(i)) p.hatch(a, y, width - 1, h, 'ink', 5);
    const level = String(lane.sampled(i));
    const title = lane.stuff(i) ? 'stuff bit' : bitTitle(lane.field(i), lane.place(i));
    const text = p.fit([`${title} = ${level}`, level], (a + b) / 2, y + h / 2, width, {size: 11});
    if (text === level && width > 30 && !lane.stuff(i) && !kSingle.has(lane.field(i))) {
      p.text(String(lane.number(i)), a + 3, y + h / 2, {size: 9, color: 'dim'});
    }
    p.note('bit', {
      bit: i,
      field: fieldName(lane.field(i)),
      level: lane.sampled(i),
      stuff: lane.stuff(i),
      q: lane.quanta[i],
      x0: a,
      x1: b,
      text,
      sample: scale.x(lane.sample(i)),
    });
  }
}

/** [name, quanta, colour] of the parts of bit i, resynchronisation included. */
function partsOf(lane, i) {
  const {prop, ps1, ps2} = lane.node;
  const q = lane.quanta[i];
  return [
    ['SYNC', 1, 't-sync'],
    ['PROP', prop, 't-prop'],
    [q > 0 ? `PS1 +${q}` : 'PS1', ps1 + Math.max(q, 0), 't-ps1'],
    [q < 0 ? `PS2 −${-q}` : 'PS2', ps2 + Math.min(q, 0), 't-ps2'],
  ];
}

function drawBitQuanta(p, scale, lane, i, y, h) {
  let time = lane.starts[i];
  for (const [name, quanta, color] of partsOf(lane, i)) {
    const end = time + quanta * lane.tq;
    const range = scale.range(time, end);
    if (range) {
      p.rect(range[0], y, range[1] - range[0], h, color);
      const text = p.fit(
        [name, name.replace(/ .*/, '')],
        (range[0] + range[1]) / 2,
        y + h / 2,
        range[1] - range[0],
        {size: 10, color: 'onfield'},
      );
      p.note('part', {bit: i, name, quanta, x0: range[0], x1: range[1], text});
    }
    for (let n = 0; n < quanta; ++n) {
      const x = scale.x(time + n * lane.tq);
      if (x >= scale.left && x <= scale.width) p.line(x, y + (n ? h - 5 : 0), x, y + h, 'panel', 1);
    }
    time = end;
  }
}

function drawQuanta(p, scale, lane) {
  const [y, h] = kRows.quanta;
  for (let i = 0; i < lane.count; ++i) {
    if (lane.starts[i + 1] < scale.from || lane.starts[i] > scale.to) continue;
    drawBitQuanta(p, scale, lane, i, y, h);
  }
}

/** Everything between the ruler and the bus trace. */
export function drawBar(p, scale) {
  if (scale.mode === 'columns') return drawColumns(p, scale);
  if (scale.mode === 'blocks') return drawBlocks(p, scale);
  const [first, last] = scale.segments;
  for (let i = first; i <= last; ++i) {
    drawSegmentHead(p, scale, i, ...kRows.frame);
    const lane = scale.report.lane(i);
    if (!lane) continue;
    drawFields(p, scale, lane, ...fieldRow(scale));
    if (scale.mode !== 'fields') drawBits(p, scale, lane);
    if (scale.mode === 'quanta') drawQuanta(p, scale, lane);
  }
}
