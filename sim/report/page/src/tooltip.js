// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The note beside the pointer: what is under it, in words.
import {bitTitle, fieldText} from './fields.js';
import {el} from './dom.js';
import {formatTime} from './format.js';
import {hit} from './pointer.js';
import {frameTexts} from './draw_bar.js';
import {axisText, valueAt} from './draw_signal.js';

function laneLines(place, report) {
  const {lane, bit, segment} = place;
  if (!lane || bit < 0) return [];
  const field = lane.field(bit);
  const title = bitTitle(field, lane.place(bit));
  const stuff = lane.stuff(bit) ? `stuff bit before ${title}` : title;
  const level = lane.sampled(bit) ? 'recessive (1)' : 'dominant (0)';
  const lines = [
    ['b', `${stuff}: ${level}`],
    [
      'p',
      lane.stuff(bit) ? 'inserted after five equal bits, removed by receivers' : fieldText(field),
    ],
  ];
  const group = lane.groupOf(bit);
  if (group?.text) lines.push(['p', `${group.label} = ${group.text}`]);
  if (lane.sent(bit) !== lane.sampled(bit)) {
    lines.push(['p', `${lane.node.name} sends ${lane.sent(bit) ? 'recessive' : 'dominant'}`]);
  }
  if (lane.quanta[bit] !== 0) {
    const q = lane.quanta[bit];
    lines.push(['p', `resynchronised: ${Math.abs(q)} quanta ${q > 0 ? 'longer' : 'shorter'}`]);
  }
  if (report.segments.lanes[segment] > 1) lines.push(['p', `as ${lane.node.name} sees it`]);
  return lines;
}

/** Faults under the pointer; a short one also where it is drawn wider than it is. */
function faultLines(place, report, scale) {
  const reach = 3 / scale.pxPerNs;
  const seen = new Set();
  for (const {fault, from, to} of report.faults.in(place.time - reach, place.time + reach)) {
    if (from <= place.time && (to >= place.time || place.time - from <= reach)) seen.add(fault);
  }
  return [...seen].map((index) => {
    const {name, text, hits} = report.faults.list[index];
    const cause = text && text !== name ? `: ${text}` : '';
    return ['fault', `fault ${name}${cause} (took effect ${hits} times)`];
  });
}

/** The signal under the pointer and its value then. */
function signalLines(place, scope, y) {
  const found = scope.signals.at(y);
  if (!found) return [];
  const {message, signal, series} = found;
  const value = valueAt(series, place.time);
  const unit = signal.unit ? ` ${signal.unit}` : '';
  const text = Number.isNaN(value) ? 'no value yet' : `${axisText(signal, value)}${unit}`;
  return [['b', `${message.name}.${signal.name}: ${text}`]];
}

function driverLine(place, report, scale) {
  if (scale.pxPerBit < 0.5) return [];
  const names = report.driversAt(place.time).map((node) => report.nodeName(node));
  return names.length > 0 ? [['p', `driven dominant by ${names.join(', ')}`]] : [];
}

/** Keeps the note up to date. */
export function attachTooltip(scope, host) {
  const box = el('div', {class: 'tooltip', role: 'tooltip', hidden: true});
  host.append(box);
  scope.onhover = (event) => {
    const scale = scope.scale();
    if (!event || event.buttons || event.offsetX < scale.left) {
      box.hidden = true;
      return;
    }
    const {report} = scope;
    const place = hit(scope, event.offsetX, event.offsetY, event.target);
    const lines = [['time', formatTime(place.time, scope.view.span / 2000)]];
    const frame = place.segment < 0 ? -1 : report.segmentFrame[place.segment];
    if (frame >= 0) lines.push(['b', frameTexts(report.frame(frame), report)[0]]);
    for (const i of report.segmentEvents.get(place.segment) ?? []) {
      const {cause} = report.event(i);
      lines.push(['alarm', `${cause.text} (${cause.rule})`]);
    }
    lines.push(...faultLines(place, report, scale));
    if (scale.fine) lines.push(...laneLines(place, report));
    if (event.target === scope.signals.canvas)
      lines.push(...signalLines(place, scope, event.offsetY));
    lines.push(...driverLine(place, report, scale));
    box.replaceChildren(...lines.map(([style, text]) => el('div', {class: style}, text)));
    box.hidden = false;
    const wide = box.offsetWidth;
    const high = box.offsetHeight;
    const x =
      event.clientX + 16 + wide > innerWidth ? event.clientX - wide - 12 : event.clientX + 16;
    const y =
      event.clientY + 20 + high > innerHeight ? event.clientY - high - 12 : event.clientY + 20;
    box.style.left = `${Math.max(0, x)}px`;
    box.style.top = `${Math.max(0, y)}px`;
  };
}
