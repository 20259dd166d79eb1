// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the programs share: npm's canopen, PORT NODE [BUS] of the command line, and a line that says
// what went wrong.
import {createRequire} from 'node:module';
import {basename, dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {Socketcand} from './socketcand.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const program = basename(process.argv[1]);
const usage = `usage: ${program} PORT NODE [BUS]`;

process.on('uncaughtException', ({message}) => fail(message));

function fail(message) {
  console.error(`${program}: ${message.split('\n', 1)[0]}`);
  process.exit(1);
}

function load() {
  const folder = process.env.VERICAN_CANOPEN ?? here;
  try {
    return createRequire(join(folder, 'x.js'))('canopen');
  } catch ({code, message}) {
    if (code !== 'MODULE_NOT_FOUND') throw new Error(message);
    return fail(`${folder} has no package canopen; run 'npm ci --ignore-scripts' there`);
  }
}

function whole(text, name, last) {
  const number = Number(text);
  if (/^\d+$/.test(text ?? '') && number >= 1 && number <= last) return number;
  const found = text === undefined ? 'missing' : `'${text}'`;
  return fail(`${name} is ${found}; allowed: 1 to ${last}; ${usage}`);
}

export const canopen = load();

/// The node-ID of the command line, and its bus, opened.
export async function openBus() {
  const [portText, nodeText, name = 'can0', ...others] = process.argv.slice(2);
  const port = whole(portText, 'PORT', 65535);
  const node = whole(nodeText, 'NODE', 127);
  if (others.length > 0) fail(usage);
  try {
    return {node, bus: await Socketcand.open(port, name)};
  } catch (error) {
    // Of several addresses that were tried each has an error of its own.
    const [{code, message}] = error.errors ?? [error];
    const hint = code === 'ECONNREFUSED' ? "; does 'verican bridge' run?" : '';
    return fail(`bus ${name} at port ${port}: ${message}${hint}`);
  }
}
