// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// An encoder of CAN 2.0 frames from the public definition alone: the judge of what the page shows.

/** Numbers of the fields in a report (docs/report-format.md). */
export const F = {
  INT: 3,
  SOF: 8,
  ID: 9,
  RTR: 10,
  IDE: 11,
  EXID: 12,
  EXRTR: 13,
  R1: 16,
  R0: 17,
  DLC: 18,
  DATA: 19,
  CRC: 20,
  CRC_DEL: 24,
  ACK: 25,
  ACK_DEL: 26,
  EOF: 27,
  ERROR_FLAG: 28,
  DEL_WAIT: 29,
  DEL: 30,
  OVERLOAD_FLAG: 31,
};

const push = (bits, field, value, count) => {
  for (let i = count - 1; i >= 0; --i) bits.push({field, level: Math.floor(value / 2 ** i) % 2});
};

/** CRC-15: remainder of the bits, times x^15, by x^15+x^14+x^10+x^8+x^7+x^4+x^3+1. */
export function crc(bits) {
  const polynomial = [1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1];
  const work = [...bits, ...new Array(15).fill(0)];
  for (let i = 0; i < bits.length; ++i) {
    if (work[i])
      polynomial.forEach((p, j) => {
        work[i + j] ^= p;
      });
  }
  return work.slice(-15).reduce((value, bit) => 2 * value + bit, 0);
}

/** SOF to CRC without stuff bits. frame: {id, extended, remote, dlc, data}. */
export function plainBits({id, extended = false, remote = false, dlc, data = []}) {
  const bits = [];
  push(bits, F.SOF, 0, 1);
  push(bits, F.ID, extended ? Math.floor(id / 0x40000) : id, 11);
  push(bits, F.RTR, extended ? 1 : Number(remote), 1);
  push(bits, F.IDE, Number(extended), 1);
  if (extended) {
    push(bits, F.EXID, id % 0x40000, 18);
    push(bits, F.EXRTR, Number(remote), 1);
    push(bits, F.R1, 0, 1);
  }
  push(bits, F.R0, 0, 1);
  push(bits, F.DLC, dlc, 4);
  if (!remote) for (let i = 0; i < Math.min(dlc, 8); ++i) push(bits, F.DATA, data[i], 8);
  push(bits, F.CRC, crc(bits.map(({level}) => level)), 15);
  return bits;
}

/** The frame as it goes out, up to EOF: a stuff bit belongs to the field of the bit then due. */
export function encode(frame) {
  const plain = plainBits(frame);
  plain.push({field: F.CRC_DEL, level: 1}); // only to take up a last stuff bit
  const bits = [];
  let run = 0;
  let last = -1;
  for (const bit of plain) {
    if (run === 5) {
      bits.push({field: bit.field, level: 1 - last, stuff: true});
      last = 1 - last;
      run = 1;
    }
    if (bit.field === F.CRC_DEL) break;
    bits.push({...bit, stuff: false});
    run = bit.level === last ? run + 1 : 1;
    last = bit.level;
  }
  bits.push(
    {field: F.CRC_DEL, level: 1, stuff: false},
    {field: F.ACK, level: 1, stuff: false},
    {field: F.ACK_DEL, level: 1, stuff: false},
  );
  for (let i = 0; i < 7; ++i) bits.push({field: F.EOF, level: 1, stuff: false});
  return bits;
}
