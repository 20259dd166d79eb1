// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What candied takes for something else and no frame can hold. The tool refuses the same
// (sim/python/dbc_checks.py). Each function says what is wrong, or null: nothing.

const kLongestMessage = 117440505; // bytes of J1939's extended transport protocol
const kMostRaw = (1n << 64n) - 1n;
const kLeastRaw = -(1n << 63n);
const kExtended = 0x80000000;
const kMostId = 0x1fffffff;
const kFloatBits = {1: 32, 2: 64}; // of SIG_VALTYPE_

export function messageProblem(name, id, length) {
  if (id > kExtended + kMostId || (id > kMostId && id < kExtended))
    return (
      `message ${name} has the identifier ${id}; allowed: 0 to 2047, and of 29 bits with bit ` +
      '31 set'
    );
  return length > kLongestMessage
    ? `message ${name} has ${length} bytes; allowed: 0 to ${kLongestMessage}`
    : null;
}

/** @param value text behind "m", or null */
export const selectionProblem = (name, value) =>
  value !== null && BigInt(value) > kMostRaw
    ? `signal ${name} has the selection m${value}; allowed: m0 to m${kMostRaw}`
    : null;

/** @param values texts of integers, those of one statement */
export function choicesProblem(name, values) {
  const wide = values.find((value) => BigInt(value) > kMostRaw || BigInt(value) < kLeastRaw);
  if (wide !== undefined)
    return (
      `value ${wide} of signal ${name} is none of 64 bits; allowed: ${kLeastRaw} to ` + kMostRaw
    );
  const known = new Set();
  for (const value of values) {
    if (known.has(BigInt(value))) return `value ${value} of signal ${name} is there twice`;
    known.add(BigInt(value));
  }
  return null;
}

export const valueTypeProblem = ({name, length}, type) =>
  length === kFloatBits[type]
    ? null
    : `signal ${name} is a floating-point number of ${length} bits; ` +
      `allowed with value type ${type}: ${kFloatBits[type]}`;

/** @param ranges [[first, last]], texts */
export function rangesProblem(name, ranges) {
  const bad = ranges.find(([a, b]) => BigInt(a) > BigInt(b) || BigInt(b) > kMostRaw);
  return bad
    ? `signal ${name} has the range ${bad.join('-')}; allowed: from the smaller to the larger ` +
        `value, up to ${kMostRaw}`
    : null;
}

/** @param names of the values, [] if the file gives them none */
export function frameFormatProblem(value, names) {
  if (/^\d+$/.test(value) && (names.length === 0 || Number(value) < names.length)) return null;
  const allowed = names.length > 0 ? `0 to ${names.length - 1}` : '0 or larger';
  return `VFrameFormat ${value} is not allowed; allowed: the numbers ${allowed}`;
}

/** Of a signal by itself. */
export function signalProblem(signal, message) {
  const {length, float, factor} = signal;
  if (length < 1 || length > 64) return `has ${length} bits; allowed: 1 to 64`;
  if (float && length !== 32 && length !== 64)
    return `is a floating-point number of ${length} bits; allowed: 32, 64`;
  if (factor === 0) return 'has the factor 0';
  for (const key of ['factor', 'offset'])
    if (!Number.isFinite(signal[key]))
      return `has the ${key} ${signal[key]}; allowed: a number that is not infinite`;
  if (signal.bytes > message.length)
    return (
      `does not fit the ${message.length} bytes of message ${message.name}: ` +
      `it needs ${signal.bytes}`
    );
  return null;
}
