// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene: a bus at the level of bits, written down by hand. All nodes share one clock, so that every
// time and level in its report is known without a simulator.
import {F, encode} from './can.mjs';
import {Column, kColumns} from './writer.mjs';

const times = (count, bit) => Array.from({length: count}, () => ({...bit}));
const kSent = new WeakMap(); // bits of frames that go out again
export const kCauses = [
  {text: 'a receiver found a wrong checksum', rule: 'ED-14'},
  {text: 'no node acknowledged the frame', rule: 'AK-03'},
  {text: 'dominant bit in the intermission', rule: 'OV-03'},
];

export class Scene {
  /** @param names of the nodes; quanta: 10 a bit, sample point 80 % */
  constructor(names, {bitrate = 500000, title = 'Scene'} = {}) {
    this.names = names;
    this.bitrate = bitrate;
    this.title = title;
    this.txNames = names.map((_, i) => `tx${i}`);
    this.bit = 1e9 / bitrate;
    this.now = 10 * this.bit;
    this.columns = Object.fromEntries(
      Object.entries(kColumns).map(([name, type]) => [name, new Column(type)]),
    );
    this.tracks = Object.fromEntries(
      ['wire', ...names.map((_, i) => `tx${i}`)].map((name) => [
        name,
        {column: new Column('u32'), level: 1, last: 0},
      ]),
    );
    this.counters = names.map(() => ({tec: 0, rec: 0}));
    this.sums = {frames: 0, error_frames: 0, overload_frames: 0, unacknowledged: 0};
    this.log = []; // frames that were acknowledged, for the judge
    this.attempts = names.map(() => ({retries: 0, lost: 0}));
    this.busy = 0;
    names.forEach((_, node) => this.#counter(node));
  }

  #add(values) {
    for (const name in values) this.columns[name].push(values[name]);
  }

  #level(name, time, level) {
    const track = this.tracks[name];
    if (track.level === level) return;
    const tick = Math.round(time);
    track.column.push(tick - track.last);
    track.last = tick;
    track.level = level;
  }

  /** The levels of a stretch from now on; what others drive is drawn into `wire`. */
  #levels(name, levels, wire) {
    const track = this.tracks[name];
    const steps = new Uint32Array(levels.length);
    let count = 0;
    for (let i = 0; i < levels.length; ++i) {
      wire[i] &= levels[i];
      if (track.level === levels[i]) continue;
      const tick = Math.round(this.now + i * this.bit);
      steps[count++] = tick - track.last;
      track.last = tick;
      track.level = levels[i];
    }
    track.column.append(steps.subarray(0, count));
  }

  /** The same of who drives a few bits alone, {bit: level}. */
  #fewLevels(name, few, wire) {
    for (const key of Object.keys(few)) {
      const i = Number(key);
      this.#level(name, this.now + i * this.bit, few[i]);
      wire[i] &= few[i];
      if (few[i + 1] === undefined) this.#level(name, this.now + (i + 1) * this.bit, 1);
    }
  }

  #counter(node, time = this.now) {
    const {tec, rec} = this.counters[node];
    const state = tec > 255 ? 2 : tec > 127 || rec > 127 ? 1 : 0;
    this.#add({
      'c.time': node >= 0 && this.columns['c.time'].length < this.names.length ? 0 : time,
      'c.node': node,
      'c.tec': tec,
      'c.rec': rec,
      'c.state': state,
    });
  }

  #count(node, change, time) {
    const c = this.counters[node];
    const next = {
      tec: Math.max(0, c.tec + (change.tec ?? 0)),
      rec: Math.max(0, c.rec + (change.rec ?? 0)),
    };
    if (next.tec === c.tec && next.rec === c.rec) return;
    this.counters[node] = next;
    this.#counter(node, time);
  }

  /**
   * One stretch of activity. lanes: [{node, bits: [{field, stuff, sent, sampled?, q?}]}], of equal
   * length; the wire is the AND of what is sent. Lanes beyond the first only if nodes disagree.
   * drives: {node: {bit: 0}}: what nodes without a lane drive. Returns the segment's number.
   */
  segment(lanes, drives = {}) {
    const number = this.columns['s.start'].length;
    const count = lanes[0].bits.length;
    const laneOf = Object.fromEntries(lanes.map((lane) => [lane.node, lane]));
    const wire = new Uint8Array(count).fill(1);
    this.names.forEach((_, node) => {
      const lane = laneOf[node] && Uint8Array.from(laneOf[node].bits, ({sent}) => sent);
      if (lane) this.#levels(this.txNames[node], lane, wire);
      else if (drives[node]) this.#fewLevels(this.txNames[node], drives[node], wire);
    });
    for (const [i, level] of Object.entries(drives.noise ?? {})) wire[i] &= level;
    this.#levels('wire', wire, wire);
    this.#add({
      's.start': this.now,
      's.end': this.now + count * this.bit,
      's.lane': this.columns['b.node'].length,
      's.lanes': lanes.length,
    });
    for (const {node, bits} of lanes) this.#lane(node, bits, wire);
    this.busy += count * this.bit;
    const end = this.now + count * this.bit;
    this.names.forEach((_, node) => this.#level(`tx${node}`, end, 1));
    this.#level('wire', end, 1);
    return number;
  }

  #lane(node, bits, wire) {
    this.#add({
      'b.node': node,
      'b.start': this.now,
      'b.tq': this.bit / 10,
      'b.first': this.columns.bit.length,
      'b.count': bits.length,
    });
    const packed = new Uint8Array(bits.length);
    const quanta = new Int8Array(bits.length);
    bits.forEach(({field, stuff = false, sent, sampled, q = 0}, i) => {
      packed[i] = field + (stuff ? 32 : 0) + (sampled ?? wire[i]) * 64 + sent * 128;
      quanta[i] = q;
    });
    this.columns.bit.append(packed);
    this.columns['bit.q'].append(quanta);
  }

  /** Bits of a frame as its sender drives them. */
  static sent(frame) {
    const known = kSent.get(frame);
    if (known) return known;
    const bits = encode(frame).map(({field, level, stuff}) => ({field, stuff, sent: level}));
    kSent.set(frame, bits);
    return bits;
  }

  #ack(bits, nodes) {
    const slot = bits.findIndex(({field}) => field === F.ACK);
    return Object.fromEntries(nodes.map((node) => [node, {[slot]: 0}]));
  }

  /**
   * A frame that succeeds. losers: nodes that lose against it, [{node, frame}]; resync: quanta that
   * bits of the sender are longer, {bit: quanta}, their sum 0.
   */
  frame(sender, frame, {losers = [], gap = 0, response = NaN, message = -1, resync = {}} = {}) {
    this.now += gap * this.bit;
    const bits = [...Scene.sent(frame), ...times(3, {field: F.INT, sent: 1})];
    for (const [i, q] of Object.entries(resync)) bits[i] = {...bits[i], q};
    const drives = this.#ack(
      bits,
      this.names.map((_, i) => i).filter((i) => i !== sender),
    );
    const number = this.columns['s.start'].length;
    for (const loser of losers) this.#lose(loser, bits, drives, number, sender);
    this.segment([{node: sender, bits}], drives);
    const end = this.now + (bits.length - 3) * this.bit;
    this.#frameRow(sender, frame, number, end, response, message);
    this.#count(sender, {tec: -1}, end);
    this.names.forEach((_, node) => {
      if (node !== sender) this.#count(node, {rec: -1}, end - 8 * this.bit);
    });
    this.now += bits.length * this.bit;
  }

  #frameRow(sender, frame, number, end, response, message) {
    const {id, extended = false, remote = false, dlc, data = []} = frame;
    this.#add({
      'f.start': this.now,
      'f.end': end,
      'f.sender': sender,
      'f.id': id + (extended ? 0x80000000 : 0) + (remote ? 0x40000000 : 0),
      'f.dlc': dlc,
      'f.segment': number,
      'f.message': message,
      'f.response': response,
      'f.retries': this.attempts[sender].retries,
      'f.lost': this.attempts[sender].lost,
    });
    for (let i = 0; i < 8; ++i) this.columns['f.data'].push(data[i] ?? 0);
    this.log.push({
      time: this.now,
      end,
      sender,
      ...frame,
      data: remote ? [] : data.slice(0, Math.min(dlc, 8)),
      ...this.attempts[sender],
    });
    this.attempts[sender] = {retries: 0, lost: 0};
    ++this.sums.frames;
  }

  #lose({node, frame}, bits, drives, number, winner) {
    const own = Scene.sent(frame);
    const at = own.findIndex(({sent}, i) => sent !== bits[i].sent);
    drives[node] = {
      ...drives[node],
      ...Object.fromEntries(own.slice(0, at).map(({sent}, i) => [i, sent])),
    };
    const {field} = own[at];
    const index = own.slice(0, at).filter((b) => b.field === field && !b.stuff).length;
    this.#add({
      'l.time': this.now + (at + 0.8) * this.bit,
      'l.node': node,
      'l.field': field,
      'l.index': index,
      'l.segment': number,
      'l.winner': winner,
    });
    ++this.attempts[node].lost;
  }

  /**
   * `culprit` finds a wrong checksum: its flag begins at EOF1; all others see a dominant EOF1, a
   * form error, and answer with their own.
   */
  crcError(sender, frame, culprit) {
    const whole = Scene.sent(frame);
    const head = whole.slice(0, whole.length - 7);
    const tail = [
      ...times(1, {field: F.DEL_WAIT, sent: 1}),
      ...times(7, {field: F.DEL, sent: 1}),
      ...times(3, {field: F.INT, sent: 1}),
    ];
    const others = [{field: F.EOF, sent: 1}, ...times(6, {field: F.ERROR_FLAG, sent: 0}), ...tail];
    const own = [
      ...times(6, {field: F.ERROR_FLAG, sent: 0}),
      {field: F.DEL_WAIT, sent: 1},
      ...tail,
    ];
    const slot = head.findIndex(({field}) => field === F.ACK);
    const lanes = this.names.map((_, node) => {
      const mine = head.map((bit, i) => ({
        ...bit,
        sent: node === sender ? bit.sent : i === slot && node !== culprit ? 0 : 1,
      }));
      return {node, bits: [...mine, ...(node === culprit ? own : others)]};
    });
    lanes.sort((a, b) => (b.node === sender) - (a.node === sender));
    const number = this.segment(lanes);
    const at = this.now + (head.length - 1) * this.bit;
    this.#add({
      'e.kind': 0,
      'e.start': at,
      'e.end': at + 16 * this.bit,
      'e.node': culprit,
      'e.error': 4,
      'e.field': F.ACK_DEL,
      'e.index': 0,
      'e.segment': number,
      'e.cause': 0,
    });
    ++this.sums.error_frames;
    ++this.attempts[sender].retries;
    this.#count(culprit, {rec: 9}, at + this.bit);
    this.#count(sender, {tec: 8}, at + 2 * this.bit);
    this.now += lanes[0].bits.length * this.bit;
  }

  /** Nobody acknowledges: the sender flags from the ACK delimiter on. */
  noAck(sender, frame) {
    const whole = Scene.sent(frame);
    const head = whole.slice(0, whole.length - 8);
    const passive = this.counters[sender].tec > 127;
    const bits = [
      ...head,
      ...times(6, {field: F.ERROR_FLAG, sent: passive ? 1 : 0}),
      {field: F.DEL_WAIT, sent: 1},
      ...times(7, {field: F.DEL, sent: 1}),
      ...times(3, {field: F.INT, sent: 1}),
    ];
    const number = this.segment([{node: sender, bits}]);
    const at = this.now + (head.length - 1) * this.bit;
    this.#add({
      'e.kind': passive ? 2 : 0,
      'e.start': at,
      'e.end': at + 15 * this.bit,
      'e.node': sender,
      'e.error': 8,
      'e.field': F.ACK,
      'e.index': 0,
      'e.segment': number,
      'e.cause': 1,
    });
    if (!passive) ++this.sums.error_frames;
    ++this.attempts[sender].retries;
    if (!passive) this.#count(sender, {tec: 8}, at);
    this.now += (bits.length + (passive ? 8 : 0)) * this.bit;
  }

  /** A frame, then a disturbance in its intermission: all nodes send an overload flag. */
  overload(sender, frame) {
    const bits = [
      ...Scene.sent(frame),
      {field: F.INT, sent: 1},
      ...times(6, {field: F.OVERLOAD_FLAG, sent: 0}),
      {field: F.DEL_WAIT, sent: 1},
      ...times(7, {field: F.DEL, sent: 1}),
      ...times(3, {field: F.INT, sent: 1}),
    ];
    const others = this.names.map((_, i) => i).filter((i) => i !== sender);
    const drives = this.#ack(bits, others);
    const first = bits.findIndex(({field}) => field === F.INT);
    for (const node of others) for (let i = 1; i <= 6; ++i) drives[node][first + i] = 0;
    drives.noise = {[first]: 0};
    const number = this.segment([{node: sender, bits}], drives);
    const at = this.now + first * this.bit;
    this.#frameRow(sender, frame, number, at, NaN, -1);
    this.#add({
      'e.kind': 1,
      'e.start': at,
      'e.end': at + 15 * this.bit,
      'e.node': sender,
      'e.error': 0,
      'e.field': F.INT,
      'e.index': 0,
      'e.segment': number,
      'e.cause': 2,
    });
    ++this.sums.overload_frames;
    this.now += bits.length * this.bit;
  }

  /** The report: meta and columns for pack(). */
  finish(more = {}) {
    const duration = this.now + 10 * this.bit;
    const node = (name, i) => ({
      name,
      clock_hz: 8e6,
      error_ppm: 0,
      quanta: 10,
      tq_ns: this.bit / 10,
      prop: 5,
      ps1: 2,
      ps2: 2,
      sjw: 2,
      sample_point: 0.8,
      sent: this.log.filter((f) => f.sender === i).length,
      received: 0,
      retries: 0,
      lost: 0,
      errors: 0,
      ...this.counters[i],
      max_tec: 0,
      max_rec: 0,
      bus_off: 0,
      state: 'active',
    });
    const meta = {
      format: 1,
      tool: 'fixture',
      title: this.title,
      note: '',
      bitrate: this.bitrate,
      duration_ns: duration,
      tick_ps: 1000,
      initial: {wire: 1, tx: this.names.map(() => 1), rx: this.names.map(() => 1)},
      nodes: this.names.map(node),
      messages: [],
      summary: {
        ...this.sums,
        pending: 0,
        load: this.busy / duration,
        analytic_load: 0,
        wall_seconds: 0,
      },
      checks: [],
      causes: kCauses,
      statements: [],
      view: null,
      truncated: null,
      origin_ns: 0,
      detail_end_ns: duration,
      ...more,
    };
    const edges = Object.fromEntries(
      Object.entries(this.tracks).map(([name, {column}]) => [name, column]),
    );
    return {meta, columns: {...this.columns, ...edges}};
  }
}
