// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Remote: the nodes without a processor; their frames in words, states and windows over time.
import {lastAtOrBelow} from './search.js';

export const kRemoteStates = ['INIT', 'LISTEN', 'SAFE', 'OPERATE'];
const kStep = 4096; // changes of bytes between two kept pictures of all windows

/** The rows of one node as lists. */
function rowsOf(nodes, node) {
  const rows = [];
  for (let i = 0; i < nodes.length; ++i) if (nodes[i] === node) rows.push(i);
  return rows;
}

export class Remote {
  constructor({units}, arrays) {
    this.units = units;
    this.words = arrays['f.words'];
    this.lines = new TextDecoder().decode(arrays.words).split('\n');
    this.states = units.map(({node}) => {
      const rows = rowsOf(arrays['n.node'], node);
      return {
        time: Float64Array.from(rows, (i) => arrays['n.time'][i]),
        state: rows.map((i) => arrays['n.state'][i]),
      };
    });
    const [time, node, address, byte] = ['time', 'node', 'address', 'byte'].map(
      (name) => arrays[`m.${name}`],
    );
    this.changes = {time, node, address, byte};
    this.pictures = []; // of all windows before each kStep-th change
  }

  /** What frame `index` means, '' for nothing. */
  wordsOf(index) {
    return this.lines[this.words[index]] ?? '';
  }

  /** The state of unit `which` at `ns`, as a word. */
  stateAt(which, ns) {
    const {time, state} = this.states[which];
    return kRemoteStates[state[lastAtOrBelow(time, ns)]] ?? '';
  }

  /** Stretches of one state of unit `which`: [{from, state}]. */
  statesOf(which) {
    const {time, state} = this.states[which];
    return state.map((one, i) => ({from: time[i], state: kRemoteStates[one]}));
  }

  #empty() {
    return new Map(this.units.map(({node, window}) => [node, new Uint8Array(window)]));
  }

  #play(windows, from, to) {
    const {node, address, byte} = this.changes;
    for (let i = from; i < to; ++i) windows.get(node[i])[address[i]] = byte[i];
  }

  /** The picture before change kStep * `index`; made when it is first asked for. */
  #picture(index) {
    const {pictures} = this;
    if (pictures.length === 0) pictures.push(this.#empty());
    while (pictures.length <= index) {
      const next = new Map([...pictures.at(-1)].map(([node, bytes]) => [node, bytes.slice()]));
      this.#play(next, (pictures.length - 1) * kStep, pictures.length * kStep);
      pictures.push(next);
    }
    return pictures[index];
  }

  /** Windows at `ns`: Map of node to {bytes, changed: addresses of changes after `since`}. */
  windowsAt(ns, since = ns) {
    const {time, node, address} = this.changes;
    const end = lastAtOrBelow(time, ns) + 1;
    const start = Math.floor(end / kStep);
    const windows = new Map(
      [...this.#picture(start)].map(([key, bytes]) => [key, bytes.slice()]),
    );
    this.#play(windows, start * kStep, end);
    const changed = new Map(this.units.map((unit) => [unit.node, new Set()]));
    for (let i = end - 1; i >= 0 && time[i] > since; --i)
      changed.get(node[i]).add(address[i]);
    return new Map(
      [...windows].map(([key, bytes]) => [key, {bytes, changed: changed.get(key)}]),
    );
  }
}
