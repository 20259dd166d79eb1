// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The search: words that all must fit a row.

const kHex = /^(0x)?[0-9a-f]+$/i;
const kKeywords = {
  error: ({event}) => event !== undefined && event.kind !== 1,
  overload: ({event}) => event?.kind === 1,
  remote: ({frame}) => frame?.remote === true,
  data: ({frame}) => frame !== undefined && !frame.remote,
  ext: ({frame}) => frame?.extended === true,
  retry: ({frame}) => frame !== undefined && frame.retries > 0,
  lost: ({frame}) => frame !== undefined && frame.lost > 0,
};

/** Bytes anywhere in the data, at whole bytes. */
function hasBytes(data, bytes) {
  const text = bytes.match(/../g)?.join(' ');
  return bytes.length % 2 === 0 && text !== undefined && data.includes(text);
}

/** A test of one word. Names win over hexadecimal digits: a node may be called "a". */
function wordTest(word, report) {
  const lower = word.toLowerCase();
  const upper = word.toUpperCase();
  if (kKeywords[lower]) return kKeywords[lower];
  const node = report.nodes.findIndex(({name}) => name.toLowerCase() === lower);
  if (node >= 0) return (row) => row.node === node;
  if (/^0x/i.test(word) && kHex.test(word)) {
    const id = parseInt(word, 16);
    const format = {5: false, 10: true}[word.length]; // 0x123: 11 bits, 0x00000123: 29 bits
    return ({frame}) => frame?.id === id && (format ?? frame.extended) === frame.extended;
  }
  const digits = kHex.test(word);
  return (row) =>
    row.message.toLowerCase().includes(lower) ||
    row.words.toLowerCase().includes(lower) ||
    row.signals.toLowerCase().includes(lower) ||
    (row.event !== undefined && row.data.toLowerCase().includes(lower)) ||
    (digits && row.frame !== undefined && (row.id.includes(upper) || hasBytes(row.data, upper)));
}

/** Joins single bytes that follow each other: "CA FE" looks for the two in a row. */
function wordsOf(text) {
  const out = [];
  let joined = false;
  for (const word of text.trim().split(/\s+/).filter(Boolean)) {
    const byte = /^[0-9a-f]{2}$/i.test(word);
    if (byte && joined) out.push(out.pop() + word);
    else out.push(word);
    joined = byte;
  }
  return out;
}

/** A function from a row's values (frames_tab.js) to whether it fits; null for an empty search. */
export function compileQuery(text, report) {
  const tests = wordsOf(text).map((word) => wordTest(word, report));
  return tests.length === 0 ? null : (row) => tests.every((test) => test(row));
}
