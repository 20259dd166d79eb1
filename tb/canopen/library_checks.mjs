// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// library_checks.mjs PORT NODE: npm's canopen on both sides of the bus: examples/canopen/device.mjs
// is the device. No other CANopen stack is needed.
import assert from 'node:assert/strict';

import {canopen, run} from './bench.mjs';

const {DataType, NmtState, SdoCode} = canopen;
const node = Number(process.argv[3]);
const pattern = (length) => Buffer.from(Array.from({length}, (_, i) => (i * 31 + length) & 0xff));

await run({
  async 'expedited, there and back'(bench) {
    const u16 = {dataType: DataType.UNSIGNED16};
    await bench.download(0x2004, 0, 1234, u16);
    assert.equal(await bench.upload(0x2004, 0, u16), 1234);
    assert.equal(await bench.upload(0x1018, 1, {dataType: DataType.UNSIGNED32}), 0x00564341);
  },
  async 'segmented, there and back'(bench) {
    for (const size of [5, 7, 8, 14, 100]) {
      await bench.download(0x2000, 0, pattern(size));
      assert.deepEqual(await bench.upload(0x2000, 0), pattern(size), `${size} bytes`);
    }
  },
  async 'block transfer, there and back'(bench) {
    for (const size of [7, 8, 700, 889, 890]) {
      const options = {blockTransfer: true, blockInterval: 0};
      await bench.download(0x2000, 0, pattern(size), options);
      assert.deepEqual(await bench.upload(0x2000, 0, options), pattern(size), `${size} bytes`);
    }
  },
  async 'refusals'(bench) {
    const refused = (code) => (error) => error.code === code;
    await assert.rejects(bench.upload(0x5000, 0), refused(SdoCode.OBJECT_UNDEFINED));
    await assert.rejects(bench.upload(0x1018, 9), refused(SdoCode.BAD_SUB_INDEX));
    await assert.rejects(bench.upload(0x2002, 0), refused(SdoCode.WRITE_ONLY));
    await assert.rejects(bench.download(0x1000, 0, Buffer.alloc(4)), refused(SdoCode.READ_ONLY));
    await assert.rejects(bench.download(0x2004, 0, 5001, {dataType: DataType.UNSIGNED16}),
                         refused(SdoCode.VALUE_HIGH));
  },
  async 'heartbeat, NMT'(bench) {
    const beat = (state) => bench.next(({id, data}) => id === 0x700 + node && data[0] === state);
    await bench.download(0x1017, 0, 20, {dataType: DataType.UNSIGNED16});
    for (const [command, state] of [['startNode', NmtState.OPERATIONAL],
                                    ['stopNode', NmtState.STOPPED],
                                    ['enterPreOperational', NmtState.PRE_OPERATIONAL]]) {
      const seen = beat(state);
      bench.master.nmt[command](node);
      await seen;
    }
  },
  async 'SYNC, TPDO, RPDO'(bench) {
    const operating = bench.next(({id, data}) => id === 0x700 + node && data[0] === 5);
    bench.master.nmt.startNode(node);
    await operating;
    bench.bus.send({id: 0x200 + node, data: Buffer.from([0x0f, 0, 0xfa, 0, 0, 0])});
    const positions = [];
    for (let i = 0; i < 4; ++i) {
      const answer = bench.next(({id}) => id === 0x180 + node);
      bench.bus.send({id: 0x80});
      positions.push((await answer).data.readInt32LE(2));
    }
    assert.ok(positions.every((value, i) => i === 0 || value >= positions[i - 1]), positions);
    assert.equal(positions.at(-1), 250);
  },
  async 'emergency'(bench) {
    const told = new Promise((resolve) => bench.master.emcy.once('emergency', resolve));
    await bench.download(0x2008, 0, 0x4210, {dataType: DataType.UNSIGNED16});
    const {cobId, em} = await told;
    assert.deepEqual([cobId, em.code, em.register], [0x80 + node, 0x4210, 0x80]);
  },
});
