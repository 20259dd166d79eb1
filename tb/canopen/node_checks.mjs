// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// node_checks.mjs PORT NODE network|pdo|emergency|lss: the drive of sw/canopennode as a CANopen
// device (CiA 301, 305, 402), by npm's canopen and raw frames. lss: a drive without a node-ID.
import assert from 'node:assert/strict';

import {canopen, PATIENCE, run} from './bench.mjs';

const {DataType, LssMode, NmtState} = canopen;
const node = Number(process.argv[3]);
const HEARTBEAT = 0x700 + node;
const TPDO1 = 0x180 + node;
const RPDO1 = 0x200 + node;
const EMCY = 0x80 + node;
const U8 = {dataType: DataType.UNSIGNED8};
const U16 = {dataType: DataType.UNSIGNED16};
const U32 = {dataType: DataType.UNSIGNED32};

const heartbeat = (state) => ({id, data}) => id === HEARTBEAT && data[0] === state;

// What is sent before the answer is waited for could be missed otherwise.
async function after(bench, wanted, act) {
  const message = bench.next(wanted);
  act();
  return message;
}

const sync = (bench) => after(bench, ({id}) => id === TPDO1, () => bench.bus.send({id: 0x80}));

function setPoint(bench, control, target) {
  const data = Buffer.alloc(6);
  data.writeUInt16LE(control);
  data.writeInt32LE(target, 2);
  bench.bus.send({id: RPDO1, data});
}

const status = ({data}) => data.readUInt16LE(0);
const position = ({data}) => data.readInt32LE(2);

async function operate(bench) {
  await bench.download(0x1017, 0, 20, U16);
  await after(bench, heartbeat(NmtState.OPERATIONAL), () => bench.master.nmt.startNode(node));
}

const network = {
  async 'boot-up after reset communication and reset node'(bench) {
    for (const reset of ['resetCommunication', 'resetNode']) {
      await after(bench, heartbeat(0), () => bench.master.nmt[reset](node));
    }
  },
  async 'heartbeat in its period tells the state'(bench) {
    await bench.download(0x1017, 0, 20, U16);
    const times = [];
    for (let i = 0; i < 5; ++i) times.push((await bench.next(({id}) => id === HEARTBEAT)).time);
    for (let i = 1; i < 5; ++i) assert.ok(Math.abs(times[i] - times[i - 1] - 0.02) < 0.0025, times);
    const {nmt} = bench.master;
    await after(bench, heartbeat(NmtState.OPERATIONAL), () => nmt.startNode(node));
    await after(bench, heartbeat(NmtState.STOPPED), () => nmt.stopNode(node));
    await after(bench, heartbeat(NmtState.PRE_OPERATIONAL), () => nmt.enterPreOperational(node));
    await after(bench, heartbeat(NmtState.OPERATIONAL), () => nmt.startNode(0));
  },
  async 'stopped: no SDO, no PDO; commands for others are not ours'(bench) {
    const {nmt} = bench.master;
    await after(bench, heartbeat(NmtState.STOPPED), () => nmt.stopNode(node));
    let strange = 0;
    bench.bus.on('message', ({id}) => strange += id !== HEARTBEAT);
    bench.tell('40 00 10 00 00 00 00 00');
    bench.bus.send({id: 0x80});
    nmt.startNode(node + 1);
    for (let i = 0; i < 3; ++i) await bench.next(heartbeat(NmtState.STOPPED));
    assert.equal(strange, 0);
    bench.bus.removeAllListeners('message');
    bench.bus.attach(bench.master);
    await after(bench, heartbeat(NmtState.PRE_OPERATIONAL), () => nmt.enterPreOperational(node));
  },
  async 'parameters that were stored are there after reset node, and defaults after "load"'(bench) {
    await bench.download(0x2006, 2, 4711, U32);
    await bench.download(0x1010, 1, Buffer.from('save'));
    await bench.download(0x2006, 2, 815, U32);
    await after(bench, heartbeat(0), () => bench.master.nmt.resetNode(node));
    assert.equal(await bench.upload(0x2006, 2, U32), 4711);
    assert.equal(await bench.upload(0x1017, 0, U16), 20);
    await bench.download(0x1011, 1, Buffer.from('load'));
    await after(bench, heartbeat(0), () => bench.master.nmt.resetNode(node));
    assert.equal(await bench.upload(0x2006, 2, U32), 200);
    assert.equal(await bench.upload(0x1017, 0, U16), 0);
  },
};

const pdo = {
  async 'no PDO before OPERATIONAL'(bench) {
    let early = 0;
    const count = ({id}) => early += id === TPDO1;
    bench.bus.on('message', count);
    bench.bus.send({id: 0x80});
    await bench.upload(0x1000, 0);
    await bench.upload(0x1000, 0);
    assert.equal(early, 0);
    bench.bus.off('message', count);
  },
  async 'each SYNC has its TPDO'(bench) {
    await operate(bench);
    for (let i = 0; i < 20; ++i) await sync(bench);
  },
  async 'a set point counts from the SYNC after it; the drive follows'(bench) {
    const states = [];
    for (const control of [0x06, 0x07, 0x0f]) {
      setPoint(bench, control, 500);
      states.push(status(await sync(bench)) & 0x6f);
    }
    assert.deepEqual(states, [0x21, 0x23, 0x27]);
    let last = 0;
    for (let i = 0; i < 200 && last < 500; ++i) {
      const now = position(await sync(bench));
      assert.ok(now >= last && now <= 500, `${last}, then ${now}`);
      last = now;
    }
    assert.equal(last, 500);
    assert.ok((status(await sync(bench)) & 0x0400) !== 0, 'target reached');
    assert.equal(await bench.upload(0x6064, 0, {dataType: DataType.INTEGER32}), 500);
  },
  async 'every third SYNC, after the PDO was configured so'(bench) {
    const cobId = await bench.upload(0x1800, 1, U32);
    assert.equal(cobId & 0x7ff, TPDO1);
    await bench.download(0x1800, 1, (cobId | 0x80000000) >>> 0, U32);
    await bench.download(0x1800, 2, 3, U8);
    await bench.download(0x1800, 1, cobId, U32);
    let sent = 0;
    const count = ({id}) => sent += id === TPDO1;
    bench.bus.on('message', count);
    for (let i = 0; i < 9; ++i) {
      bench.bus.send({id: 0x80});
      await bench.upload(0x1000, 0);
    }
    assert.equal(sent, 3);
    bench.bus.off('message', count);
  },
  async 'another COB-ID for a receive PDO: the filters follow'(bench) {
    const u32 = (sub, value) => bench.download(0x1400, sub, value >>> 0, U32);
    await u32(1, 0x80000000 | RPDO1);
    await u32(1, 0x333);
    const data = Buffer.from([0x06, 0, 1, 0, 0, 0]);
    await bench.upload(0x1000, 0);
    bench.bus.send({id: 0x333, data});
    bench.bus.send({id: 0x80});
    await bench.upload(0x1000, 0);
    assert.equal(await bench.upload(0x6040, 0, U16), 6);
    setPoint(bench, 0x0f, 0);
    bench.bus.send({id: 0x80});
    await bench.upload(0x1000, 0);
    assert.equal(await bench.upload(0x6040, 0, U16), 6);
  },
  async 'a TPDO by its event timer'(bench) {
    const times = [];
    for (let i = 0; i < 3; ++i) {
      times.push((await bench.next(({id}) => id === 0x280 + node)).time);
    }
    for (let i = 1; i < 3; ++i) assert.ok(Math.abs(times[i] - times[i - 1] - 0.1) < 0.005, times);
  },
};

const emergency = {
  async 'an error is told, kept in 1003, and taken back'(bench) {
    const told = () => new Promise((resolve) => bench.master.emcy.once('emergency', resolve));
    let message = told();
    await bench.download(0x2008, 0, 0x4210, U16);
    let {cobId, em} = await message;
    assert.deepEqual([cobId, em.code, em.register], [EMCY, 0x4210, 0x80]);
    assert.equal(await bench.upload(0x1001, 0, U8), 0x80);
    assert.equal(await bench.upload(0x1003, 0, U8), 1);
    assert.equal((await bench.upload(0x1003, 1, U32)) & 0xffff, 0x4210);
    message = told();
    await bench.download(0x2008, 0, 0, U16);
    ({em} = await message);
    assert.deepEqual([em.code, em.register], [0, 0]);
    await bench.download(0x1003, 0, 0, U8);
    assert.equal(await bench.upload(0x1003, 0, U8), 0);
  },
  async 'a failed drive says so in its statusword, until it is reset'(bench) {
    await operate(bench);
    await bench.download(0x2008, 0, 0x4210, U16);
    assert.equal(status(await sync(bench)) & 0x4f, 0x08);
    setPoint(bench, 0x80, 0);
    assert.equal(status(await sync(bench)) & 0x4f, 0x40);
  },
  async 'a heartbeat that stays away is an error'(bench) {
    await bench.download(0x1016, 1, (0x33 << 16) | 50, U32);
    bench.bus.send({id: 0x733, data: Buffer.from([5])});
    const {data} = await bench.next(({id}) => id === EMCY);
    assert.equal(data.readUInt16LE(0), 0x8130);  // heartbeat error
  },
};

const lss = {
  async 'found by fastscan, which knows all but the serial number'(bench) {
    const found = await bench.master.lss.fastscan({
      vendorId: 0x00564341, productCode: 0x402, revisionNumber: 0x00010000, timeout: 8000,
    });
    assert.equal(found.serialNumber, 0x2000);
  },
  async 'identity, and a node-ID that is not one'(bench) {
    const {lss: master} = bench.master;
    assert.equal(await master.inquireVendorId(PATIENCE), 0x00564341);
    assert.equal(await master.inquireProductCode(PATIENCE), 0x402);
    assert.equal(await master.inquireSerialNumber(PATIENCE), 0x2000);
    await assert.rejects(master.configureNodeId(128, PATIENCE), /out of range/);
  },
  async 'bit rates it has and has not'(bench) {
    const {lss: master} = bench.master;
    await master.configureBitTiming(0, 0, PATIENCE);  // 1 Mbit/s
    await assert.rejects(master.configureBitTiming(0, 5, PATIENCE), /not supported/);
    await assert.rejects(master.configureBitTiming(0, 9, PATIENCE), /specific/);  // automatic
  },
  async 'a node-ID makes it a device'(bench) {
    const {lss: master} = bench.master;
    await master.configureNodeId(9, PATIENCE);
    await master.storeConfiguration(PATIENCE);
    await after(bench, ({id, data}) => id === 0x709 && data[0] === 0,
                () => master.switchModeGlobal(LssMode.OPERATION));
  },
};

await run({network, pdo, emergency, lss}[process.argv[4]]);
