// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Times and numbers for people.

const kUnits = [
  [1e9, 's'],
  [1e6, 'ms'],
  [1e3, 'µs'],
  [1, 'ns'],
];

/** The unit in which `ns` reads best: [nanoseconds, name]. */
export function unitOf(ns) {
  const size = Math.abs(ns);
  return kUnits.find(([value]) => size >= value) ?? kUnits[3];
}

/** `ns` in a unit of its own size, fine enough to tell times apart that differ by `resolution`. */
export function formatTime(ns, resolution = Math.abs(ns) / 1000) {
  if (!Number.isFinite(ns)) return '–';
  const [value, name] = unitOf(Math.max(Math.abs(ns), Math.abs(resolution)));
  const digits = resolution > 0 ? Math.ceil(-Math.log10(resolution / value)) : 3;
  return `${(ns / value).toFixed(Math.min(Math.max(digits, 0), 9))} ${name}`;
}

/** Milliseconds with a fixed number of digits: columns of tables line up. */
export const milliseconds = (ns, digits = 3) =>
  Number.isFinite(ns) ? (ns / 1e6).toFixed(digits) : '–';

export function formatRate(bitrate) {
  if (bitrate >= 1e6) return `${+(bitrate / 1e6).toFixed(3)} Mbit/s`;
  if (bitrate >= 1e3) return `${+(bitrate / 1e3).toFixed(3)} kbit/s`;
  return `${bitrate} bit/s`;
}

export const formatCount = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, ' ');
export const percent = (x, digits = 1) => `${(100 * x).toFixed(digits)} %`;
export const hex = (value, digits) => value.toString(16).toUpperCase().padStart(digits, '0');

/** Round distance between marks so that about `count` of them fit into `span`. */
export function niceStep(span, count) {
  const raw = span / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}
