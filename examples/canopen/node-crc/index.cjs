// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// In place of npm's node-crc, a native module: the call that canopen makes of it, with the CRC of
// SDO block transfers (CiA 301, 7.2.4.3.16: x^16 + x^12 + x^5 + 1, begins with 0).
'use strict';

const POLYNOMIAL = 0x1021;

exports.crc = (width, reflect, polynomial, init, ...rest) => {
  const data = rest.at(-1);
  const others = [reflect, init, ...rest.slice(0, -1)];
  if (width !== 16 || polynomial !== POLYNOMIAL || others.some((value) => value)) {
    throw new RangeError('node-crc of VeriCAN knows the CRC of CANopen only');
  }
  let crc = 0;
  for (const byte of data) {
    crc ^= byte << 8;
    for (let bit = 0; bit < 8; ++bit) {
      crc = crc & 0x8000 ? ((crc << 1) ^ POLYNOMIAL) & 0xffff : crc << 1;
    }
  }
  return Buffer.from([crc >> 8, crc & 0xff]);
};
