// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The places in the bit stream, in words and colours. Numbers are those of docs/report-format.md.

/** name: short; label: on the bar; text: for the tooltip; color: a CSS variable. */
const kFields = {
  0: ['INTEGRATING', 'joining', 'waits for eleven recessive bits before it takes part', 'quiet'],
  1: ['BUS_OFF', 'bus-off', 'bus-off: silent, counts 128 times 11 recessive bits', 'off'],
  2: ['IDLE', 'idle', 'the bus is free', 'quiet'],
  3: ['INT', 'INT', 'intermission: three recessive bits between frames', 'quiet'],
  4: ['SUSPEND', 'suspend', 'an error passive transmitter waits eight bits more', 'suspend'],
  8: ['SOF', 'SOF', 'start of frame: one dominant bit, all nodes synchronise on it', 'sof'],
  9: ['ID', 'ID', 'identifier, first 11 bits: the lowest number wins arbitration', 'id'],
  10: ['RTR', 'RTR', 'remote request (base format) or SRR (extended format)', 'control'],
  11: ['IDE', 'IDE', 'identifier extension: recessive means 29 bits', 'control'],
  12: ['EXID', 'ID ext', 'identifier, last 18 bits', 'id'],
  13: ['EXRTR', 'RTR', 'remote request of the extended format', 'control'],
  16: ['R1', 'r1', 'reserved bit', 'control'],
  17: ['R0', 'r0', 'reserved bit', 'control'],
  18: ['DLC', 'DLC', 'data length code: number of data bytes', 'dlc'],
  19: ['DATA', 'data', 'data byte, most significant bit first', 'data'],
  20: ['CRC', 'CRC', 'checksum of 15 bits over everything before', 'crc'],
  24: ['CRC_DEL', 'del', 'CRC delimiter: always recessive', 'tail'],
  25: ['ACK', 'ACK', 'acknowledge slot: every receiver with a right CRC drives it dominant', 'ack'],
  26: ['ACK_DEL', 'del', 'ACK delimiter: always recessive', 'tail'],
  27: ['EOF', 'EOF', 'end of frame: seven recessive bits', 'tail'],
  28: [
    'ERROR_FLAG',
    'error flag',
    'six equal bits that tell every node of the error: dominant if ' +
      'the node is error active, recessive if it is error passive',
    'error',
  ],
  29: ['DEL_WAIT', 'wait', 'own flag sent; waits until all others have ended theirs', 'errordel'],
  30: ['DELIMITER', 'delimiter', 'eight recessive bits after a flag', 'errordel'],
  31: ['OVERLOAD_FLAG', 'overload flag', 'six dominant bits: asks for more time', 'overload'],
};

const kUnknown = ['?', '?', 'not a field', 'quiet'];

export const F = {
  INTEG: 0,
  BUS_OFF: 1,
  IDLE: 2,
  INT: 3,
  SUSPEND: 4,
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

const row = (field) => kFields[field] ?? kUnknown;
export const fieldName = (field) => row(field)[0];
export const fieldLabel = (field) => row(field)[1];
export const fieldText = (field) => row(field)[2];
export const fieldColor = (field) => `f-${row(field)[3]}`;

/** What the legend shows, in the order of a frame. */
export const kLegend = [
  ['f-sof', 'start'],
  ['f-id', 'identifier'],
  ['f-control', 'control bits'],
  ['f-dlc', 'length'],
  ['f-data', 'data'],
  ['f-crc', 'CRC'],
  ['f-ack', 'ACK'],
  ['f-tail', 'end of frame'],
  ['f-error', 'error flag'],
  ['f-errordel', 'flag delimiter'],
  ['f-overload', 'overload flag'],
  ['f-quiet', 'intermission'],
];

/** Number that the specification gives to bit `index` (from 0, without stuff bits) of a field. */
export function bitNumber(field, index) {
  switch (field) {
    case F.ID:
      return 28 - index;
    case F.EXID:
      return 17 - index;
    case F.DLC:
      return 3 - index;
    case F.DATA:
      return 7 - (index % 8);
    case F.CRC:
      return 14 - index;
    case F.DEL:
      return index + 2;
    default:
      return index + 1;
  }
}

export const kSingle = new Set([
  F.SOF,
  F.RTR,
  F.IDE,
  F.EXRTR,
  F.R1,
  F.R0,
  F.CRC_DEL,
  F.ACK,
  F.ACK_DEL,
]);

/** The bit in words: "CRC 14", "ACK", "data byte 2 bit 7". */
export function bitTitle(field, index) {
  if (kSingle.has(field)) return fieldName(field);
  if (field === F.DATA) return `DATA byte ${index >> 3}, bit ${bitNumber(field, index)}`;
  return `${fieldName(field)} ${bitNumber(field, index)}`;
}

export const kErrorKinds = ['stuff', 'form', 'CRC', 'ACK', 'bit 0', 'bit 1'];
export const kErrorTexts = [
  'six equal bits where stuffing allows five',
  'a bit that must be recessive was dominant',
  'the checksum does not fit',
  'no node acknowledged',
  'sent dominant, read recessive',
  'sent recessive, read dominant',
];

/** "stuff + form" of the bits of e.error. */
export const errorKinds = (mask) =>
  kErrorKinds.filter((_, bit) => mask & (1 << bit)).join(' + ') || 'error';
