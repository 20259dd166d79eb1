// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// master.mjs PORT NODE [BUS]: npm's canopen as a master: who is there, starts the drive, moves it
// by PDO and SYNC, and reads where it is by SDO.
import {canopen, openBus} from './program.mjs';

const {DataType, Device, Eds} = canopen;
const SYNCS = 10;
const TARGET = 300;

const {bus, node} = await openBus();
const master = new Device({id: 0x7f, eds: new Eds()});
master.eds.addSdoClientParameter(node, 0x600 + node, 0x580 + node);
bus.attach(master);
master.start();
const of = (index, dataType) => ({deviceId: node, index, dataType, timeout: 60_000});

const name = await master.sdo.upload(of(0x1008, DataType.VISIBLE_STRING));
console.log(`node ${node}: ${name}`);
master.nmt.startNode(node);
for (const control of [0x06, 0x07, 0x0f]) await cycle(control);
for (let i = 0; i < SYNCS; ++i) await cycle(0x0f);
const position = await master.sdo.upload(of(0x6064, DataType.INTEGER32));
console.log(`position ${position}`);
master.stop();
bus.close();
process.exitCode = position === TARGET ? 0 : 1;

// Set point, SYNC, and the drive's answer.
async function cycle(control) {
  const data = Buffer.alloc(6);
  data.writeUInt16LE(control);
  data.writeInt32LE(TARGET, 2);
  const answer = new Promise((resolve) => bus.on('message', function take({id}) {
    if (id !== 0x180 + node) return;
    bus.off('message', take);
    resolve();
  }));
  bus.send({id: 0x200 + node, data});
  bus.send({id: 0x80});
  await answer;
}
