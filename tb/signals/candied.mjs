// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candied.mjs DBC < FRAMES: what the npm package candied makes of frames, one line "message id,
// data in hexadecimal" each: {"<line number>": {"<signal>": "<raw value>"}} on stdout. Of
// little-endian integers of up to 53 bits alone: it knows no floating-point numbers, and takes the
// start bit of a big-endian signal for its last. It decodes all multiplexed signals.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const [modules, path] = process.argv.slice(2);
const {Can, Dbc} = createRequire(resolve(modules, 'x.js'))('candied');
const can = new Can();
can.database = new Dbc().load(readFileSync(path, 'utf8'));
const result = {};
readFileSync(0, 'utf8').trim().split('\n').forEach((line, index) => {
  const [id, hex] = line.split(' ');
  const message = can.getMessageById(Number(id));
  if (!message) return;
  const payload = [...Buffer.from(hex, 'hex')];
  const values = {};
  for (const [name, signal] of message.signals)
    if (signal.endian === 'Intel' && !signal.isFloat && signal.length <= 53)
      values[name] = String(can.decodeSignal(payload, signal).rawValue);
  result[index] = values;
});
console.log(JSON.stringify(result));
