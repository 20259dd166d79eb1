// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// sdo_checks.mjs PORT NODE transfers|refusals|states: the SDO server of the drive (sw/canopennode)
// against CiA 301, 7.2.4: transfers of every kind and size by npm's canopen, and by raw frames what
// a right client never sends. Objects are those of drive.eds.
import assert from 'node:assert/strict';

import {abort, canopen, run, SERVER} from './bench.mjs';

const {DataType, SdoCode} = canopen;
const AREA = 0x2000;
const AREA_BYTES = 4096;
const TRACE = 0x2001;
const TRACE_BYTES = 10_000;
const SEGMENTED_SIZES = [1, 4, 5, 7, 8, 14, 15, 100];
const BLOCK_SIZES = [5, 6, 7, 8, 14, 15, 888, 889, 890, 1000, AREA_BYTES];

const pattern = (length) => Buffer.from(Array.from({length}, (_, i) => (i * 31 + length) & 0xff));
const trace = Buffer.from(
    Array.from({length: TRACE_BYTES}, (_, i) => (i * 7 + Math.floor(i / 256)) & 0xff));

function aborts(code) {
  return (error) => {
    assert.equal(error.code, code, error.message);
    return true;
  };
}

// Outside of a transfer there is no object that an abort could name.
function assertBadCommand(answer) {
  assert.equal(answer.slice(0, 2), '80', answer);
  assert.equal(answer.slice(12), '01 00 04 05', answer);  // 0504 0001h
}

// ---- Transfers

const transfers = {
  async 'expedited: values of 1, 2 and 4 bytes'(bench) {
    assert.equal(await bench.upload(0x1000, 0, {dataType: DataType.UNSIGNED32}), 0x00020192);
    await bench.download(0x2004, 0, 1234, {dataType: DataType.UNSIGNED16});
    assert.equal(await bench.upload(0x2004, 0, {dataType: DataType.UNSIGNED16}), 1234);
    await bench.download(0x2006, 3, 0xcafe1234, {dataType: DataType.UNSIGNED32});
    assert.equal(await bench.upload(0x2006, 3, {dataType: DataType.UNSIGNED32}), 0xcafe1234);
    await bench.download(0x6060, 0, -1, {dataType: DataType.INTEGER8});
    assert.equal(await bench.upload(0x6060, 0, {dataType: DataType.INTEGER8}), -1);
    await bench.download(0x6060, 0, 8, {dataType: DataType.INTEGER8});
  },
  async 'identity, sub-index by sub-index'(bench) {
    const want = [4, 0x00564341, 0x402, 0x00010000];
    for (const [sub, value] of want.entries()) {
      const dataType = sub === 0 ? DataType.UNSIGNED8 : DataType.UNSIGNED32;
      assert.equal(await bench.upload(0x1018, sub, {dataType}), value);
    }
  },
  async 'segmented: a constant string'(bench) {
    const name = await bench.upload(0x1008, 0);
    assert.equal(name.toString(), 'VeriCAN servo drive');
  },
  async 'segmented: eight bytes, a string shorter than its object'(bench) {
    assert.equal((await bench.upload(0x2007, 0)).length, 8);
    await bench.download(0x2005, 0, Buffer.from('left elbow'));
    const label = await bench.upload(0x2005, 0);
    assert.equal(label.toString().replace(/\0+$/, ''), 'left elbow');
  },
  async 'segmented: every size there and back'(bench) {
    for (const size of SEGMENTED_SIZES) {
      const data = pattern(size);
      await bench.download(AREA, 0, data);
      assert.deepEqual(await bench.upload(AREA, 0), data, `${size} bytes`);
    }
  },
  async 'block upload: 10,000 bytes with CRC'(bench) {
    assert.deepEqual(await bench.upload(TRACE, 0, {blockTransfer: true}), trace);
  },
  async 'block upload: small blocks'(bench) {
    const data = pattern(50);
    await bench.download(AREA, 0, data, {blockTransfer: true, blockInterval: 0});
    for (const size of [1, 2, 7]) {
      bench.master.sdo.setBlockSize(size);
      assert.deepEqual(await bench.upload(AREA, 0, {blockTransfer: true}), data, `block ${size}`);
    }
    bench.master.sdo.setBlockSize(127);
  },
  async 'block download: every size, back by block upload'(bench) {
    for (const size of BLOCK_SIZES) {
      const data = pattern(size).reverse();
      await bench.download(AREA, 0, data, {blockTransfer: true, blockInterval: 0});
      assert.deepEqual(await bench.upload(AREA, 0, {blockTransfer: true}), data, `${size} bytes`);
    }
  },
};

// ---- Refusals: the abort code that CiA 301 has for it

const refusals = {
  async 'abort: object and sub-index that do not exist'(bench) {
    await assert.rejects(bench.upload(0x5000, 0), aborts(SdoCode.OBJECT_UNDEFINED));
    await assert.rejects(bench.upload(0x1018, 5), aborts(SdoCode.BAD_SUB_INDEX));
    await assert.rejects(bench.download(0x5000, 0, Buffer.alloc(2)),
                         aborts(SdoCode.OBJECT_UNDEFINED));
    await assert.rejects(bench.upload(0x5000, 0, {blockTransfer: true}),
                         aborts(SdoCode.OBJECT_UNDEFINED));
  },
  async 'abort: read-only, write-only'(bench) {
    await assert.rejects(bench.download(0x1000, 0, Buffer.alloc(4)), aborts(SdoCode.READ_ONLY));
    await assert.rejects(bench.download(0x6041, 0, Buffer.alloc(2)), aborts(SdoCode.READ_ONLY));
    await assert.rejects(bench.upload(0x2002, 0), aborts(SdoCode.WRITE_ONLY));
  },
  async 'abort: too long, too short'(bench) {
    await assert.rejects(bench.download(0x2004, 0, Buffer.alloc(4)), aborts(SdoCode.DATA_LONG));
    await assert.rejects(bench.download(0x2006, 1, Buffer.alloc(2)), aborts(SdoCode.DATA_SHORT));
    await assert.rejects(bench.download(0x2006, 1, Buffer.alloc(9)), aborts(SdoCode.DATA_LONG));
  },
  async 'abort: value above and below its range, and at the edges'(bench) {
    const write = (value) => bench.download(0x2004, 0, value, {dataType: DataType.UNSIGNED16});
    await assert.rejects(write(5001), aborts(SdoCode.VALUE_HIGH));
    await assert.rejects(write(99), aborts(SdoCode.VALUE_LOW));
    await write(5000);
    await write(100);
  },
  async 'abort: a domain too small for the data'(bench) {
    await assert.rejects(bench.download(AREA, 0, pattern(AREA_BYTES + 1),
                                        {blockTransfer: true, blockInterval: 0}),
                         aborts(SdoCode.OUT_OF_MEMORY));
  },
  async 'abort: PDO mapping while the PDO is valid, unmappable object, too long a PDO'(bench) {
    const u32 = {dataType: DataType.UNSIGNED32};
    const u8 = {dataType: DataType.UNSIGNED8};
    await assert.rejects(bench.download(0x1a00, 1, 0x60410010, u32),
                         aborts(SdoCode.UNSUPPORTED_ACCESS));
    const cobId = await bench.upload(0x1800, 1, u32);
    await bench.download(0x1800, 1, (cobId | 0x80000000) >>> 0, u32);
    await bench.download(0x1a00, 0, 0, u8);
    await assert.rejects(bench.download(0x1a00, 1, 0x20040010, u32),
                         aborts(SdoCode.OBJECT_NOT_MAPPABLE));
    await bench.download(0x1a00, 1, 0x60410010, u32);
    await bench.download(0x1a00, 2, 0x20070040, u32);
    await assert.rejects(bench.download(0x1a00, 0, 2, u8), aborts(SdoCode.MAP_LENGTH));
    await bench.download(0x1a00, 2, 0x60640020, u32);
    await bench.download(0x1a00, 0, 2, u8);
    await bench.download(0x1800, 1, cobId, u32);
  },
  async 'storage: "save" alone stores'(bench) {
    await bench.download(0x1010, 3, Buffer.from('save'));
    await assert.rejects(bench.download(0x1010, 3, Buffer.from('evas')),
                         aborts(SdoCode.DATA_TRANSFER));
    await assert.rejects(bench.download(0x1010, 4, Buffer.from('save')),
                         aborts(SdoCode.BAD_SUB_INDEX));
  },
};

// ---- Raw frames: what a right client does not do

const states = {
  async 'toggle: repeated in an upload'(bench) {
    assert.equal(await bench.ask('40 08 10 00 00 00 00 00'), '41 08 10 00 13 00 00 00');
    assert.equal((await bench.ask('60 00 00 00 00 00 00 00')).slice(0, 2), '00');
    assert.equal(await bench.ask('60 00 00 00 00 00 00 00'), abort(0x1008, 0, SdoCode.TOGGLE_BIT));
  },
  async 'toggle: begins wrong in a download'(bench) {
    assert.equal(await bench.ask('21 00 20 00 0a 00 00 00'), '60 00 20 00 00 00 00 00');
    assert.equal(await bench.ask('10 01 02 03 04 05 06 07'), abort(AREA, 0, SdoCode.TOGGLE_BIT));
  },
  async 'a segment without a transfer'(bench) {
    assertBadCommand(await bench.ask('60 00 00 00 00 00 00 00'));
  },
  async 'an unknown command'(bench) {
    assertBadCommand(await bench.ask('e0 08 10 00 00 00 00 00'));
  },
  async 'a download shorter than it said'(bench) {
    await bench.ask('21 00 20 00 0a 00 00 00');
    await bench.ask('00 01 02 03 04 05 06 07');
    assert.equal(await bench.ask('1d 08 00 00 00 00 00 00'), abort(AREA, 0, SdoCode.DATA_SHORT));
  },
  async 'a download longer than it said'(bench) {
    await bench.ask('21 00 20 00 08 00 00 00');
    await bench.ask('00 01 02 03 04 05 06 07');
    assert.equal(await bench.ask('11 08 09 0a 0b 0c 0d 0e'), abort(AREA, 0, SdoCode.DATA_LONG));
  },
  async 'an abort of the client ends the transfer'(bench) {
    await bench.ask('40 08 10 00 00 00 00 00');
    bench.tell('80 08 10 00 00 00 00 08');
    assertBadCommand(await bench.ask('60 00 00 00 00 00 00 00'));
  },
  async 'a new request instead of the next segment'(bench) {
    await bench.ask('40 08 10 00 00 00 00 00');
    const answer = await bench.ask('40 00 10 00 00 00 00 00');
    assert.ok(answer === '43 00 10 00 92 01 02 00' || answer.startsWith('80'), answer);
    if (answer.startsWith('80')) {
      assert.equal(await bench.ask('40 00 10 00 00 00 00 00'), '43 00 10 00 92 01 02 00');
    }
  },
  async 'block size 0 and 128'(bench) {
    for (const size of ['00', '80']) {
      assert.equal(await bench.ask(`a4 01 20 00 ${size} 00 00 00`),
                   abort(TRACE, 0, SdoCode.BAD_BLOCK_SIZE));
    }
  },
  async 'block download with a wrong CRC'(bench) {
    const answer = await bench.ask('c6 00 20 00 07 00 00 00');
    assert.equal(answer.slice(0, 11), 'a4 00 20 00');
    assert.equal((await bench.ask('81 01 02 03 04 05 06 07')).slice(0, 5), 'a2 01');
    assert.equal(await bench.ask('c1 34 12 00 00 00 00 00'), abort(AREA, 0, SdoCode.BAD_BLOCK_CRC));
  },
  async 'block download: a lost segment is asked for again'(bench) {
    const answer = await bench.ask('c6 00 20 00 15 00 00 00');
    assert.equal(answer.slice(0, 11), 'a4 00 20 00');
    bench.tell('01 01 02 03 04 05 06 07');
    const confirmed = await bench.ask('83 0f 10 11 12 13 14 15');  // the second is missing
    assert.equal(confirmed.slice(0, 5), 'a2 01');
    bench.tell('01 08 09 0a 0b 0c 0d 0e');
    assert.equal((await bench.ask('82 0f 10 11 12 13 14 15')).slice(0, 5), 'a2 02');
    const data = Buffer.from(Array.from({length: 21}, (_, i) => i + 1));
    const crc = canopen.calculateCrc(data);
    const low = (crc & 0xff).toString(16).padStart(2, '0');
    const high = (crc >> 8).toString(16).padStart(2, '0');
    assert.equal((await bench.ask(`c1 ${low} ${high} 00 00 00 00 00`)).slice(0, 2), 'a1');
    assert.deepEqual(await bench.upload(AREA, 0), data);
  },
  async 'block upload: a lost segment is sent again'(bench) {
    const answer = await bench.ask('a4 01 20 00 02 00 00 00');
    assert.equal(answer, 'c6 01 20 00 10 27 00 00');  // 10,000 bytes, with CRC
    const first = bench.next(({id, data}) => id === SERVER && data[0] === 2);
    bench.tell('a3 00 00 00 00 00 00 00');
    await first;
    const again = bench.next(({id, data}) => id === SERVER && data[0] === 1);
    const last = bench.next(({id, data}) => id === SERVER && data[0] === 2);
    bench.tell('a2 01 02 00 00 00 00 00');  // the second segment did not come
    assert.deepEqual((await again).data.subarray(1), trace.subarray(7, 14));
    await last;  // or the library takes it for an answer to its upload
    bench.tell('80 01 20 00 00 00 00 08');
    assert.equal(await bench.upload(0x1000, 0, {dataType: DataType.UNSIGNED32}), 0x00020192);
  },
  async 'time-out: the server gives up after a second of the bus'(bench) {
    const answered = bench.next(({id, data}) => id === SERVER && data[0] === 0x41);
    const refused = bench.next(({id, data}) => id === SERVER && data[0] === 0x80);
    bench.tell('40 08 10 00 00 00 00 00');
    const begin = await answered;
    const given = await refused;
    assert.equal(given.data.readUInt32LE(4), SdoCode.TIMEOUT);
    assert.ok(given.time - begin.time >= 0.9, `${given.time - begin.time} s`);
  },
};

await run({transfers, refusals, states}[process.argv[4]]);
