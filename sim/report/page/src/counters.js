// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Counters: the error counters and states of each node over time, apart by nodes.
import {lastAtOrBelow} from './search.js';

/** Rows of one node: times rising, and the stretches of one state. */
function nodeRows(counters, node, rows) {
  const out = {
    time: new Float64Array(rows.length),
    tec: new Uint16Array(rows.length),
    rec: new Uint16Array(rows.length),
    states: [],
    stateTimes: [],
  };
  rows.forEach((row, i) => {
    out.time[i] = counters.time[row];
    out.tec[i] = counters.tec[row];
    out.rec[i] = counters.rec[row];
    const state = counters.state[row];
    if (out.states.length === 0 || out.states.at(-1).state !== state) {
      out.states.push({time: counters.time[row], state});
      out.stateTimes.push(counters.time[row]);
    }
  });
  return out;
}

export class Counters {
  constructor(counters, nodes) {
    const rows = Array.from({length: nodes}, () => []);
    for (let i = 0; i < counters.count; ++i) rows[counters.node[i]]?.push(i);
    this.nodes = rows.map((list, node) => nodeRows(counters, node, list));
  }

  /** {tec, rec, state} of a node at time `ns`. */
  at(node, ns) {
    const rows = this.nodes[node];
    const i = lastAtOrBelow(rows.time, ns);
    const state = lastAtOrBelow(rows.stateTimes, ns);
    return {
      tec: i < 0 ? 0 : rows.tec[i],
      rec: i < 0 ? 0 : rows.rec[i],
      state: state < 0 ? 0 : rows.states[state].state,
    };
  }

  /** Stretches of one state in a window: visit(from, to, state). */
  states(node, from, to, visit) {
    const {states, stateTimes} = this.nodes[node];
    for (let i = Math.max(0, lastAtOrBelow(stateTimes, from)); i < states.length; ++i) {
      if (states[i].time > to) return;
      visit(
        Math.max(from, states[i].time),
        Math.min(to, states[i + 1]?.time ?? to),
        states[i].state,
      );
    }
  }
}
