// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page against a second library, Debian's canmatrix: every message of the tests' databases,
// its layout, and what is in frames of random bytes.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {bad} from './bad_databases.mjs';
import * as browser from './browser.mjs';
import {randomFrom, smallScene} from './scenes.mjs';

const {closeReport, openReport} = browser;
const kFrames = 200; // of each message
const report = browser.reportFor('judge', smallScene());
const databases = ['tb/report/signals.dbc', 'tb/signals/features.dbc'];

/** What a Python script says: its JSON. */
function python(script, args, input) {
  const {status, stdout, stderr} = spawnSync('/usr/bin/python3', [script, ...args], {
    input,
    encoding: 'utf8',
    maxBuffer: 1 << 28,
  });
  assert.equal(status, 0, stderr);
  return JSON.parse(stdout);
}

if (spawnSync('/usr/bin/python3', ['-c', 'import canmatrix.formats.dbc']).status !== 0) {
  browser.without('canmatrix', 'python3-canmatrix');
}

/** The layout of all messages of the page, in the form of sim/python/dbc_to_json.py. */
const layout = (page, text) =>
  page.evaluate((content) => {
    const {databases: files} = window.verican.report;
    files.files = [];
    files.add('judged.dbc', content);
    const limit = (value) => (Number.isFinite(value) ? value : null);
    const selection = (s) => s && {signal: s.multiplexer.name, ranges: s.ranges};
    return files.messages.map(({name, id, extended, length, j1939, signals}) => ({
      ...{name, id, extended, length, j1939},
      signals: signals.map((s) => ({
        ...{name: s.name, start: s.start, length: s.length, little_endian: s.littleEndian},
        ...{signed: s.signed, float: s.float, factor: s.factor, offset: s.offset, unit: s.unit},
        ...{minimum: limit(s.minimum), maximum: limit(s.maximum)},
        choices: [...s.choices].sort((a, b) => a[0] - b[0]),
        multiplexer: s.multiplexer,
        multiplexed: selection(s.selection),
      })),
    }));
  }, text);

/** The same of canmatrix: numbers as numbers, no start values, no limits as null. */
function judged(path) {
  const {messages} = python('sim/python/dbc_to_json.py', [], readFileSync(path));
  return messages.map((message) => ({
    ...message,
    signals: message.signals.map(({start_value: _, ...signal}) => {
      const [minimum, maximum] = [Number(signal.minimum), Number(signal.maximum)];
      const limited = minimum < maximum && Number.isFinite(minimum);
      return {
        ...signal,
        unit: signal.unit.replaceAll('\\"', '"'), // canmatrix leaves it as in the file
        factor: Number(signal.factor),
        offset: Number(signal.offset),
        minimum: limited ? minimum : null,
        maximum: limited ? maximum : null,
      };
    }),
  }));
}

const byId = (messages) =>
  Object.fromEntries(
    messages.map((m) => [
      `${m.id}${m.extended ? 'x' : ''}`,
      {...m, signals: Object.fromEntries(m.signals.map((s) => [s.name, s]))},
    ]),
  );

/** Raw values of the signals of frames by the page: texts by name, bits of floats as an integer. */
const decoded = (page, frames) =>
  page.evaluate(
    (list) =>
      list.map(({id, extended, data}) => {
        const bytes = Uint8Array.from(data.match(/../g), (byte) => parseInt(byte, 16));
        const frame = {id, extended, remote: false, data: bytes};
        const values = window.verican.report.signals.valuesOf(frame);
        return Object.fromEntries(values.map(({signal, raw}) => [signal.name, String(raw)]));
      }),
    frames,
  );

const isNan = (signal, raw) => {
  const bits = BigInt(raw);
  return signal.length === 32
    ? (bits & 0x7fffffffn) > 0x7f800000n
    : (bits & 0x7fffffffffffffffn) > 0x7ff0000000000000n;
};

for (const path of databases) {
  test(`${path}: layout of every message, and its frames`, async () => {
    const page = await openReport(report);
    const messages = judged(path);
    const text = readFileSync(path, 'utf8');
    assert.deepEqual(byId(await layout(page, text)), byId(messages));
    const random = randomFrom(16);
    const byte = () => random(256).toString(16).padStart(2, '0');
    const few = () => random(10).toString(16).padStart(2, '0'); // selects what is multiplexed
    const frames = messages.flatMap(({id, extended, length}) =>
      Array.from({length: kFrames}, (_, i) => ({
        ...{id, extended},
        data: Array.from({length}, i % 2 ? byte : few).join(''),
      })),
    );
    const wanted = python('tb/report/canmatrix_judge.py', [path], JSON.stringify(frames));
    const seen = await decoded(page, frames);
    const known = byId(messages);
    frames.forEach((frame, i) => {
      const {signals} = known[`${frame.id}${frame.extended ? 'x' : ''}`];
      for (const [name, raw] of Object.entries(seen[i])) {
        if (signals[name].float && isNan(signals[name], raw)) seen[i][name] = wanted[i][name];
      }
      assert.deepEqual(seen[i], wanted[i], JSON.stringify(frame));
    });
    console.log(`# ${frames.length} frames of ${messages.length} messages`);
    await closeReport(page);
  });
}

// A database of the page and one of the tool are the same file.
test('the tool refuses what the page refuses, in the same line', () => {
  for (const [name, [text, message]] of Object.entries(bad)) {
    const line = Number(/line (\d+)/.exec(message.source)?.[1] ?? 0);
    const {error} = python('sim/python/dbc_to_json.py', [], text);
    assert.equal(error?.line, line, name);
  }
});
