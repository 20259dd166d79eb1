// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The signals of the report's frames, by the databases of the page.
import {decode, decodeOne, valueText} from './signal_codec.js';

const kRemote = 0x40000000; // in f.id

export class Signals {
  constructor(report, databases) {
    Object.assign(this, {report, databases});
    this.series = new Map();
    databases.addEventListener('change', () => this.#forget());
    this.#forget();
  }

  #forget() {
    this.series.clear();
    this.framesOf = null;
  }

  /** Whether there is anything to decode with. */
  get any() {
    return this.databases.count > 0;
  }

  messageOf(frame) {
    return this.any ? this.databases.find(frame.id, frame.extended) : null;
  }

  /** Decoded signals of a frame: [{signal, raw, value}]; none of a remote frame. */
  valuesOf(frame) {
    const message = frame.remote ? null : this.messageOf(frame);
    return message ? decode(message, frame.data) : [];
  }

  /** "EngineSpeed 2400 rpm, Mode Sport". */
  textOf(frame) {
    return this.valuesOf(frame)
      .map((decoded) => `${decoded.signal.name} ${valueText(decoded)}`)
      .join(', ');
  }

  /** Frames of each message, in their order: Map of message to indices. */
  get frames() {
    if (this.framesOf) return this.framesOf;
    this.framesOf = new Map();
    const {id, count} = this.report.frames;
    for (let i = 0; i < count && this.any; ++i) {
      if (id[i] & kRemote) continue;
      const message = this.databases.find(id[i] & 0x1fffffff, id[i] >= 0x80000000);
      if (!message) continue;
      const list = this.framesOf.get(message);
      if (list) list.push(i);
      else this.framesOf.set(message, [i]);
    }
    return this.framesOf;
  }

  /** {times, values, frames, least, most} of a signal: a value at the end of each frame with it. */
  seriesOf(message, signal) {
    const known = this.series.get(signal);
    if (known) return known;
    const {frames} = this.report;
    const times = [];
    const values = [];
    const indices = [];
    let least = Infinity;
    let most = -Infinity;
    for (const i of this.frames.get(message) ?? []) {
      const value = decodeOne(signal, this.report.frame(i).data);
      if (!Number.isFinite(value)) continue;
      times.push(frames.end[i]);
      values.push(value);
      indices.push(i);
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
    const series = {times: Float64Array.from(times), values: Float64Array.from(values)};
    Object.assign(series, {frames: indices, least, most});
    this.series.set(signal, series);
    return series;
  }
}

/** Signals that are plotted; 'change' when there are others. */
export class Chosen extends EventTarget {
  constructor(signals) {
    super();
    this.signals = signals;
    this.list = []; // {message, signal}
    signals.databases.addEventListener('change', () => this.#keep());
  }

  has(signal) {
    return this.list.some((entry) => entry.signal === signal);
  }

  toggle(message, signal) {
    if (this.has(signal)) this.list = this.list.filter((entry) => entry.signal !== signal);
    else this.list = [...this.list, {message, signal}];
    this.dispatchEvent(new Event('change'));
  }

  clear() {
    this.list = [];
    this.dispatchEvent(new Event('change'));
  }

  /** After other databases: those that still exist by name. */
  #keep() {
    const {messages} = this.signals.databases;
    this.list = this.list.flatMap(({message, signal}) => {
      const next = messages.find(({key, name}) => key === message.key && name === message.name);
      const same = next?.signals.find(({name}) => name === signal.name);
      return same ? [{message: next, signal: same}] : [];
    });
    this.dispatchEvent(new Event('change'));
  }
}
