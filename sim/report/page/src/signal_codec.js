// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// From the bytes of a frame to the values of its signals, and to their texts.

const kExact = 9e15; // integers up to here are exact
const kMostDecimals = 12;
const view = new DataView(new ArrayBuffer(8));

function number(places, data) {
  let raw = 0;
  for (const place of places) raw = raw * 2 + ((data[place >> 3] >> (place & 7)) & 1);
  return raw;
}

/** An integer, Number, BigInt or text, as a Number where that is exact. */
export function exact(value) {
  const rounded = Number(value);
  return Number.isSafeInteger(rounded) ? rounded : BigInt(value);
}

/** The bits as an integer without a sign: a Number, or a BigInt beyond 53 bits. */
function bitsOf({places, length}, data) {
  if (length <= 53) return number(places, data);
  return (
    (BigInt(number(places.slice(0, -32), data)) << 32n) | BigInt(number(places.slice(-32), data))
  );
}

/** The same with its sign. */
function rawOf(signal, data) {
  const {length, signed, float} = signal;
  const bits = bitsOf(signal, data);
  if (!signed || float) return bits;
  if (length > 53) return BigInt.asIntN(length, bits);
  return bits >= 2 ** (length - 1) ? bits - 2 ** length : bits;
}

function floatOf(length, raw) {
  if (length === 32) {
    view.setUint32(0, raw);
    return view.getFloat32(0);
  }
  view.setBigUint64(0, raw);
  return view.getFloat64(0);
}

/** What a decimal factor means: 3 * 0.1 is 0.3. */
function rounded(value, decimals) {
  const scale = 10 ** decimals;
  if (decimals > kMostDecimals || Math.abs(value * scale) >= kExact) return value;
  return (Math.sign(value) * Math.round(Math.abs(value) * scale)) / scale;
}

/** {signal, raw, value}: value in the signal's unit. */
export function valueOf(signal, data) {
  const raw = rawOf(signal, data);
  const {factor, offset, float, length, decimals} = signal;
  const plain = (float ? floatOf(length, raw) : Number(raw)) * factor + offset;
  return {signal, raw, value: float ? plain : rounded(plain, decimals)};
}

/** Whether a signal is there: its multiplexer is, and selects it by its bits, sign or not. */
export function isSelected(signal, data) {
  const {selection} = signal;
  if (!selection) return true;
  const {multiplexer, ranges} = selection;
  if (multiplexer.bytes > data.length || !isSelected(multiplexer, data)) return false;
  const bits = bitsOf(multiplexer, data);
  return ranges.some(([first, last]) => bits >= first && bits <= last);
}

const isThere = (signal, data) => signal.bytes <= data.length && isSelected(signal, data);

/** The signals that these bytes hold. */
export const decode = (message, data) =>
  message.signals.filter((signal) => isThere(signal, data)).map((s) => valueOf(s, data));

/** The value of one signal, NaN if it is not there. */
export const decodeOne = (signal, data) =>
  isThere(signal, data) ? valueOf(signal, data).value : NaN;

/** Shortest digits that are this 32-bit number. */
function singleText(value) {
  for (let digits = 1; digits < 9; ++digits) {
    const short = Number(value.toPrecision(digits));
    if (Math.fround(short) === value) return String(short);
  }
  return String(Number(value.toPrecision(9)));
}

/** A physical value with as many decimals as it has and no more. */
export function numberText(signal, value) {
  const {float, length, factor, offset, decimals} = signal;
  if (!Number.isFinite(value)) return String(value);
  if (float && length === 32 && factor === 1 && offset === 0) return singleText(value);
  if (float || Math.abs(value) >= 1e15 || decimals > kMostDecimals) return String(value);
  const text = value.toFixed(decimals);
  const short = text.includes('.') ? text.replace(/\.?0+$/, '') : text;
  return short === '-0' ? '0' : short;
}

export const choiceOf = ({signal, raw}) =>
  signal.float ? undefined : signal.choices.get(exact(raw));

/** The number of a decoded value, all digits of 64 bits. */
export function rawText({signal, raw, value}) {
  const plain = !signal.float && signal.factor === 1 && signal.offset === 0;
  return plain ? String(raw) : numberText(signal, value);
}

/** "2400 rpm", or the choice "Sport". */
export function valueText(decoded) {
  const {unit} = decoded.signal;
  return choiceOf(decoded) ?? `${rawText(decoded)}${unit && ` ${unit}`}`;
}
