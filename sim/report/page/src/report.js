// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Report: the data of the page, with searches over it. Names and units: docs/report-format.md.
import {Counters} from './counters.js';
import {Databases} from './databases.js';
import {EdgeTrack} from './edges.js';
import {Faults} from './faults.js';
import {Lane} from './lane.js';
import {LoadError} from './load.js';
import {Remote} from './remote.js';
import {lastAtOrBelow} from './search.js';
import {Signals} from './signals.js';

const kTypes = {
  u8: Uint8Array,
  i8: Int8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  f64: Float64Array,
};
const kLanesKept = 600;
export const kNobody = 255;
const kFreeBits = 11; // recessive bits behind the last dominant one until the bus is free
const kExtended = 0x80000000;
const kRemote = 0x40000000;

function groupsOf(meta, buffer) {
  const arrays = {};
  for (const {name, type, offset, length} of meta.arrays) {
    arrays[name] = new kTypes[type](buffer, offset, length);
  }
  return arrays;
}

function need(arrays, prefix, names) {
  const group = {};
  for (const name of names) {
    const array = arrays[`${prefix}.${name}`];
    if (!array) throw new LoadError(`the report has no array ${prefix}.${name}`);
    group[name] = array;
  }
  group.count = group[names[0]].length;
  return group;
}

export class Report {
  constructor({meta, buffer}) {
    const arrays = groupsOf(meta, buffer);
    this.meta = meta;
    this.nodes = meta.nodes;
    this.duration = meta.duration_ns;
    this.detailEnd = Math.min(meta.detail_end_ns ?? Infinity, this.duration);
    this.bitNs = 1e9 / meta.bitrate;
    this.frames = need(arrays, 'f', [
      'start',
      'end',
      'sender',
      'id',
      'dlc',
      'data',
      'segment',
      'message',
      'response',
      'retries',
      'lost',
    ]);
    this.events = need(arrays, 'e', [
      'start',
      'end',
      'kind',
      'node',
      'error',
      'field',
      'index',
      'segment',
      'cause',
    ]);
    this.losses = need(arrays, 'l', ['time', 'node', 'field', 'index', 'segment', 'winner']);
    this.counters = new Counters(
      need(arrays, 'c', ['time', 'node', 'tec', 'rec', 'state']),
      this.nodes.length,
    );
    this.segments = need(arrays, 's', ['start', 'end', 'lane', 'lanes']);
    this.laneRows = need(arrays, 'b', ['start', 'node', 'tq', 'first', 'count']);
    this.laneRows.bits = arrays['b.count'];
    this.laneRows.count = this.laneRows.start.length;
    this.bits = arrays.bit ?? new Uint8Array(0);
    this.quanta = arrays['bit.q'] ?? new Int8Array(0);
    this.faults = new Faults(
      meta.faults ?? [],
      this.nodes.map(({name}) => name),
    );
    this.remote = meta.remote ? new Remote(meta.remote, arrays) : null;
    this.#tracks(arrays);
    this.#sums();
    this.lanes = new Map();
    this.databases = new Databases();
    this.signals = new Signals(this, this.databases);
  }

  #tracks(arrays) {
    const {tick_ps, initial} = this.meta;
    const track = (name, level) =>
      arrays[name] ? new EdgeTrack(arrays[name], level, tick_ps / 1000) : null;
    this.wire = track('wire', initial.wire) ?? new EdgeTrack(new Uint32Array(0), 1, 1);
    this.tx = this.nodes.map((_, i) => track(`tx${i}`, initial.tx[i] ?? 1));
    this.rx = this.nodes.map((_, i) => track(`rx${i}`, initial.rx?.[i] ?? 1));
  }

  /** Sums up to each segment and frame, so that the load of any window is two searches away. */
  #sums() {
    const {segments, events} = this;
    this.busyBefore = new Float64Array(segments.count + 1);
    this.busyFrom = Float64Array.from(segments.start);
    this.busyTo = Float64Array.from(segments.end);
    for (let i = 0; i < segments.count; ++i) {
      this.#clipToWire(i);
      this.busyBefore[i + 1] = this.busyBefore[i] + this.busyPart(i);
    }
    this.segmentEvents = new Map();
    for (let i = 0; i < events.count; ++i) {
      const list = this.segmentEvents.get(events.segment[i]);
      if (list) list.push(i);
      else this.segmentEvents.set(events.segment[i], [i]);
    }
    this.segmentFrame = new Int32Array(segments.count).fill(-1);
    for (let i = 0; i < this.frames.count; ++i) {
      if (this.frames.segment[i] < segments.count) this.segmentFrame[this.frames.segment[i]] = i;
    }
    this.nodeLosses = this.nodes.map(() => []);
    for (let i = 0; i < this.losses.count; ++i) this.nodeLosses[this.losses.node[i]]?.push(i);
  }

  /** What a node that nobody hears does in a segment does not keep the bus busy. */
  #clipToWire(i) {
    const {segments, bitNs} = this;
    const [start, end] = [segments.start[i], segments.end[i]];
    let first = Infinity;
    let last = -Infinity;
    this.wire.stretches(start - bitNs / 2, end, (from, to, level) => {
      if (level !== 0) return;
      first = Math.min(first, from);
      last = to;
    });
    if (first === Infinity) this.busyTo[i] = start;
    if (first === Infinity || segments.lanes[i] < 2) return;
    this.busyFrom[i] = Math.max(start, first);
    this.busyTo[i] = Math.max(this.busyFrom[i], Math.min(end, last + kFreeBits * bitNs));
  }

  /** Time for which a segment keeps the bus busy, up to `ns`. */
  busyPart(i, ns = Infinity) {
    return Math.max(Math.min(ns, this.busyTo[i]) - this.busyFrom[i], 0);
  }

  /** Time in which the bus is busy, from the start up to `ns`. */
  busyUntil(ns) {
    const i = lastAtOrBelow(this.segments.start, ns);
    return i < 0 ? 0 : this.busyBefore[i] + this.busyPart(i, ns);
  }

  /** The part of a window of which all is known: of the run, as far as segments were kept. */
  known(from, to) {
    return [Math.max(from, 0), Math.min(to, this.detailEnd)];
  }

  /** Part of the known time in the window in which the bus is busy, 0..1; NaN: there is none. */
  loadIn(from, to) {
    const [a, b] = this.known(from, to);
    return b > a ? (this.busyUntil(b) - this.busyUntil(a)) / (b - a) : NaN;
  }

  eventsIn(from, to) {
    return lastAtOrBelow(this.events.start, to) - lastAtOrBelow(this.events.start, from);
  }

  /** Indices of the arbitrations that a node lost in the window. */
  lossesIn(node, from, to) {
    const list = this.nodeLosses[node];
    const {time} = this.losses;
    let low = 0;
    let high = list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (time[list[middle]] < from) low = middle + 1;
      else high = middle;
    }
    const first = low;
    while (low < list.length && time[list[low]] <= to) ++low;
    return list.slice(first, low);
  }

  /** First and last segment that touch the window; [0, -1] if none does. */
  segmentsIn(from, to) {
    const {segments} = this;
    let first = Math.max(0, lastAtOrBelow(segments.start, from));
    if (segments.count > 0 && segments.end[first] <= from) ++first;
    return [first, lastAtOrBelow(segments.start, to)];
  }

  segmentAt(ns) {
    const i = lastAtOrBelow(this.segments.start, ns);
    return i >= 0 && ns < this.segments.end[i] ? i : -1;
  }

  /** Lane number `which` (0: the reference) of a segment; null if it is not in the file. */
  lane(segment, which = 0) {
    const {segments, laneRows} = this;
    if (segment < 0 || segment >= segments.count || which >= segments.lanes[segment]) return null;
    const row = segments.lane[segment] + which;
    if (row >= laneRows.count) return null;
    const known = this.lanes.get(row);
    if (known) return known;
    const first = laneRows.first[row];
    const end = first + laneRows.bits[row];
    const node = this.nodes[laneRows.node[row]] ?? this.nodes[0];
    const lane = new Lane(
      row,
      laneRows.node[row],
      node,
      laneRows.start[row],
      laneRows.tq[row],
      this.bits.subarray(first, end),
      this.quanta.subarray(first, end),
    );
    if (this.lanes.size >= kLanesKept) this.lanes.delete(this.lanes.keys().next().value);
    this.lanes.set(row, lane);
    return lane;
  }

  /** All lanes of a segment. */
  lanesOf(segment) {
    const count = this.segments.lanes[segment] ?? 0;
    return Array.from({length: count}, (_, i) => this.lane(segment, i)).filter(Boolean);
  }

  /** A frame in plain values. */
  frame(i) {
    const f = this.frames;
    const id = f.id[i];
    const remote = (id & kRemote) !== 0;
    const length = remote ? 0 : Math.min(8, f.dlc[i]);
    return {
      index: i,
      start: f.start[i],
      end: f.end[i],
      sender: f.sender[i],
      id: id & 0x1fffffff,
      extended: (id & kExtended) !== 0,
      remote,
      dlc: f.dlc[i],
      data: f.data.subarray(8 * i, 8 * i + length),
      segment: f.segment[i],
      message: f.message[i],
      response: f.response[i],
      retries: f.retries[i],
      lost: f.lost[i],
    };
  }

  event(i) {
    const e = this.events;
    return {
      index: i,
      kind: e.kind[i],
      start: e.start[i],
      end: e.end[i],
      node: e.node[i],
      error: e.error[i],
      field: e.field[i],
      place: e.index[i],
      segment: e.segment[i],
      cause: this.meta.causes[e.cause[i]] ?? {text: 'unknown', rule: ''},
    };
  }

  nodeName(node) {
    return this.nodes[node]?.name ?? 'nobody';
  }
  nodeIndex(name) {
    return this.nodes.findIndex((node) => node.name === name);
  }

  /** Nodes that drive dominant in the middle of a stretch of time. */
  driversAt(ns) {
    const list = [];
    this.tx.forEach((track, node) => {
      if (track && track.levelAt(ns) === 0) list.push(node);
    });
    return list;
  }
}
