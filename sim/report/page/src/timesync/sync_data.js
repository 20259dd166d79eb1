// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What came out of a case, as `verican timesync --json` prints it, in columns of ns and ppm.
import {LoadError} from '../load.js';
import {lastAtOrBelow} from '../search.js';

/** By number: verican_sync_state_t, and the bits of VERICAN_SERVO_*. */
export const kStates = ['unsynchronised', 'acquiring', 'locked', 'holdover'];
export const kLocked = 2;
const kEvents = ['pair taken', 'outlier dropped', 'leap not followed', 'step', 'new state'];
const kTaken = 1;

/** Events of a correction, in words. */
export const eventWords = (bits) => kEvents.filter((_, i) => bits & (1 << i)).join(', ');

/** mean, standard deviation and largest absolute value of a list. */
export function figuresOf(values) {
  if (values.length === 0) return {count: 0, mean: NaN, sd: NaN, max: NaN};
  let sum = 0;
  let squares = 0;
  let max = 0;
  for (const value of values) {
    sum += value;
    squares += value * value;
    max = Math.max(max, Math.abs(value));
  }
  const mean = sum / values.length;
  const sd = Math.sqrt(Math.max(0, squares / values.length - mean * mean));
  return {count: values.length, mean, sd, max};
}

/** One run: the looks at all followers, and what their servos did. */
class SyncRun {
  /** @param throughout errors count from the first time on that a follower is locked */
  constructor(json, nominal, throughout) {
    this.throughout = throughout;
    this.at = Float64Array.from(json.at_ps, (ps) => ps / 1e3);
    this.begin = this.at[0] ?? 0;
    this.end = this.at.at(-1) ?? 0;
    this.followers = json.followers.map(({error_ps, state}) => ({
      error: Float64Array.from(error_ps, (ps) => ps / 1e3),
      state: Uint8Array.from(state),
    }));
    const c = json.corrections;
    this.corrections = c.at_ps.map((ps, i) => ({
      at: ps / 1e3,
      follower: c.follower[i],
      shift: c.shift_ns[i],
      rate: 1e6 * (c.increment[i] / nominal - 1),
      events: c.events[i],
      state: c.state[i],
    }));
    this.followers.forEach((follower, n) => this.#rates(follower, n));
  }

  /** The rate that holds at each look, ppm from the nominal one. */
  #rates(follower, n) {
    const own = this.corrections.filter((correction) => correction.follower === n);
    const times = own.map(({at}) => at);
    follower.rate = Float64Array.from(this.at, (at) => own[lastAtOrBelow(times, at)]?.rate ?? 0);
    const locked = follower.rate.filter((_, i) => follower.state[i] === kLocked);
    follower.meanRate = figuresOf(locked).mean;
  }

  /** Errors of a follower that count, ns: as the tool's figures, SyncFigures. */
  counted(n) {
    const {error, state} = this.followers[n];
    if (!this.throughout) return error.filter((_, i) => state[i] === kLocked);
    const first = state.indexOf(kLocked);
    return first < 0 ? error.subarray(0, 0) : error.subarray(first);
  }

  /** Stretches of a follower in one state: [from, to, state]. */
  stretches(n) {
    const {state} = this.followers[n];
    const list = [];
    for (let i = 0; i < state.length; ++i) {
      const last = list.at(-1);
      if (last && last[2] === state[i]) last[1] = this.at[i + 1] ?? this.end;
      else list.push([this.at[i], this.at[i + 1] ?? this.end, state[i]]);
    }
    return list;
  }

  /** Corrections that are more than a pair taken. */
  events() {
    return this.corrections.filter(({events}) => events !== kTaken);
  }
}

/** The case and all its runs. */
export class SyncData {
  constructor(json) {
    this.json = json;
    this.nominal = (1e9 / json.case.frequency_hz) * 2 ** 32;
    const {master_cut: cut = false, first_seed: seed = 1} = json.case;
    this.when = cut ? 'from its first lock on' : 'while locked'; // errors count
    this.firstSeed = seed;
    this.runs = json.runs.map((run) => new SyncRun(run, this.nominal, cut));
    this.goal = json.goal && {
      sd: json.goal.sd_ps === null ? null : json.goal.sd_ps / 1e3,
      max: json.goal.max_ps / 1e3,
    };
  }
}

/** The data of this document. LoadError in words for people. */
export function load(documentNode) {
  const element = documentNode.getElementById('verican-meta');
  if (!element) throw new LoadError('this file has no result in it: verican-meta is missing');
  let json;
  try {
    json = JSON.parse(element.textContent);
  } catch (error) {
    throw new LoadError(`the data of the page is damaged: ${error.message}`);
  }
  if (json.format !== 1)
    throw new LoadError(`this result has format ${json.format}; this page reads format 1`);
  return new SyncData(json);
}
