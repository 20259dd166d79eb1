// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Lane: the bits of one segment as one node saw them, with their times and the fields they form.
import {F, bitNumber, fieldLabel} from './fields.js';
import {hex} from './format.js';

const isStuff = (bits, i) => (bits[i] & 0x20) !== 0;

/** Runs of bits of one field; data apart by bytes. */
function groupsOf(bits) {
  const groups = [];
  let group = null;
  for (let i = 0; i < bits.length; ++i) {
    const field = bits[i] & 31;
    const full = group && field === F.DATA && group.values === 8;
    if (!group || group.field !== field || full) {
      const byte = group && field === F.DATA && group.field === F.DATA ? group.byte + 1 : 0;
      group = {field, first: i, last: i, values: 0, value: 0, byte, stuff: 0, sent: bits[i] >> 7};
      groups.push(group);
    }
    group.last = i;
    if (isStuff(bits, i)) {
      ++group.stuff;
    } else {
      ++group.values;
      group.value = group.value * 2 + ((bits[i] >> 6) & 1);
    }
  }
  return groups;
}

const kWidths = {[F.ID]: 11, [F.EXID]: 18, [F.DLC]: 4, [F.DATA]: 8, [F.CRC]: 15};

/** The value of a group as it stands on the bar, or '' if the field has none or is cut short. */
function groupValue(group) {
  const {field, value, values} = group;
  if (field in kWidths && values < kWidths[field]) return '';
  switch (field) {
    case F.ID:
      return hex(value, 3);
    case F.EXID:
      return hex(value, 5);
    case F.DLC:
      return String(value);
    case F.DATA:
      return hex(value, 2);
    case F.CRC:
      return hex(value, 4);
    case F.ACK:
      return value === 0 ? '✓' : '✗';
    case F.ERROR_FLAG:
      return group.sent === 0 ? 'active' : 'passive';
    default:
      return '';
  }
}

/** CRC-15 of CAN over bits, most significant first (x^15+x^14+x^10+x^8+x^7+x^4+x^3+1). */
function crc15(levels) {
  let crc = 0;
  for (const bit of levels) {
    const top = (crc >> 14) & 1;
    crc = (crc << 1) & 0x7fff;
    if (bit !== top) crc ^= 0x4599;
  }
  return crc;
}

export class Lane {
  /** @param node description from meta, with quanta, prop, ps1 */
  constructor(index, nodeIndex, node, start, tq, bits, quanta) {
    Object.assign(this, {index, nodeIndex, node, start, tq, bits, quanta});
    this.count = bits.length;
    this.starts = new Float64Array(this.count + 1);
    let time = start;
    for (let i = 0; i < this.count; ++i) {
      this.starts[i] = time;
      time += (node.quanta + quanta[i]) * tq;
    }
    this.starts[this.count] = time;
    this.groups = groupsOf(bits);
    for (const group of this.groups) {
      group.label = fieldLabel(group.field);
      group.text = groupValue(group);
    }
  }

  get end() {
    return this.starts[this.count];
  }
  field(i) {
    return this.bits[i] & 31;
  }
  stuff(i) {
    return isStuff(this.bits, i);
  }
  sampled(i) {
    return (this.bits[i] >> 6) & 1;
  }
  sent(i) {
    return this.bits[i] >> 7;
  }

  /** When bit i was sampled: quanta that were added lie before the sample point, in PHASE_SEG1. */
  sample(i) {
    const before = 1 + this.node.prop + this.node.ps1 + Math.max(0, this.quanta[i]);
    return this.starts[i] + before * this.tq;
  }

  /** Bit that lasts at time `ns`, or -1. */
  bitAt(ns) {
    if (ns < this.start || ns >= this.end) return -1;
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.starts[middle] <= ns) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  groupOf(i) {
    return this.groups.find((group) => i >= group.first && i <= group.last);
  }

  /** Place of bit i in its field, from 0, stuff bits not counted. */
  place(i) {
    const field = this.field(i);
    let place = 0;
    for (let j = i - 1; j >= 0 && this.field(j) === field; --j) if (!this.stuff(j)) ++place;
    return place;
  }

  number(i) {
    return bitNumber(this.field(i), this.place(i));
  }

  /** What the bits say, as far as they go: a frame that failed has only its first fields. */
  decode() {
    if (this.decoded) return this.decoded;
    const out = {
      id: null,
      extended: false,
      remote: false,
      dlc: null,
      data: [],
      crc: null,
      computed: null,
      acked: null,
      stuffBits: 0,
    };
    const covered = [];
    let base = null;
    for (let i = 0; i < this.count; ++i) {
      const field = this.field(i);
      if (field < F.SOF || field > F.CRC_DEL) continue;
      if (this.stuff(i)) ++out.stuffBits;
      else if (field < F.CRC) covered.push(this.sampled(i));
    }
    for (const {field, value, values} of this.groups) {
      const whole = values >= (kWidths[field] ?? 1);
      if (!whole) continue;
      if (field === F.ID) out.id = base = value;
      if (field === F.RTR) out.remote = value === 1;
      if (field === F.IDE && value === 1) {
        out.extended = true;
        out.id = null;
        out.remote = false;
      }
      if (field === F.EXID) out.id = base * 0x40000 + value;
      if (field === F.EXRTR) out.remote = value === 1;
      if (field === F.DLC) out.dlc = value;
      if (field === F.DATA) out.data.push(value);
      if (field === F.CRC) {
        out.crc = value;
        out.computed = crc15(covered);
      }
      if (field === F.ACK) out.acked = value === 0;
    }
    this.decoded = out;
    return out;
  }
}
