// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the checks in JavaScript share: a master of npm's canopen on a bus, raw frames beside it.
// Environment: VERICAN_CANOPEN, the folder with node_modules; arguments: port of socketcand,
// node-ID.
import {createRequire} from 'node:module';
import {join} from 'node:path';

import {Socketcand} from '../../examples/canopen/socketcand.mjs';

export const canopen = createRequire(join(process.env.VERICAN_CANOPEN, 'x.js'))('canopen');
export const PATIENCE = 120_000;  // ms of real time; simulated time may be much slower

export const [port, node] = process.argv.slice(2).map(Number);
export const CLIENT = 0x600 + node;
export const SERVER = 0x580 + node;

const MASTER_ID = 0x7f;
const UNCONFIGURED = 255;  // a drive that waits for LSS

export class Bench {
  static async open() {
    const bench = new Bench();
    bench.bus = await Socketcand.open(port);
    bench.master = new canopen.Device({id: MASTER_ID, eds: new canopen.Eds()});
    if (node !== UNCONFIGURED) {
      bench.master.eds.addSdoClientParameter(node, CLIENT, SERVER);
      bench.master.eds.addEmcyConsumer(0x80 + node);
    }
    bench.bus.attach(bench.master);
    bench.master.start();
    return bench;
  }

  close() {
    this.master.stop();
    this.bus.close();
  }

  upload(index, subIndex, options = {}) {
    return this.master.sdo.upload({deviceId: node, index, subIndex, timeout: PATIENCE, ...options});
  }

  download(index, subIndex, data, options = {}) {
    return this.master.sdo.download(
        {deviceId: node, index, subIndex, data, timeout: PATIENCE, ...options});
  }

  /// The next message that `wanted` says yes to.
  next(wanted) {
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.bus.off('message', look);
        reject(new Error('no such message came'));
      }, PATIENCE);
      const look = (message) => {
        if (!wanted(message)) return;
        clearTimeout(timer);
        this.bus.off('message', look);
        resolve(message);
      };
      this.bus.on('message', look);
    });
  }

  /// A request of the SDO client in hexadecimal bytes, and the server's answer likewise.
  async ask(hex) {
    const answer = this.next(({id}) => id === SERVER);
    this.bus.send({id: CLIENT, data: Buffer.from(hex.replaceAll(' ', ''), 'hex')});
    return hexadecimal((await answer).data);
  }

  /// A request that is not answered at once.
  tell(hex) {
    this.bus.send({id: CLIENT, data: Buffer.from(hex.replaceAll(' ', ''), 'hex')});
  }
}

export function hexadecimal(data) {
  return [...data].map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
}

/// An abort of CiA 301 as the eight bytes on the bus.
export function abort(index, subIndex, code) {
  const data = Buffer.alloc(8);
  data[0] = 0x80;
  data.writeUInt16LE(index, 1);
  data[3] = subIndex;
  data.writeUInt32LE(code, 4);
  return hexadecimal(data);
}

/// Runs the checks one after the other; the process ends with 1 if one fails.
export async function run(checks) {
  const bench = await Bench.open();
  let failed = 0;
  let count = 0;
  for (const [name, check] of Object.entries(checks)) {
    ++count;
    try {
      await check(bench);
      console.log(`ok   ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAIL ${name}: ${error.message.replaceAll(/\s+/g, ' ')}`);
    }
  }
  console.log(`${count} checks, ${failed} failed`);
  bench.close();
  if (failed !== 0) process.exitCode = 1;
}
