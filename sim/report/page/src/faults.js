// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults: the deliberate disturbances of a scenario and the moments at which they took effect.
import {lastAtOrBelow} from './search.js';

/** One fault as the page names it; `nodes` are the indices of whom it touches, [] for all. */
function faultOf(raw, index, names) {
  const {name, kind = '', node = null, text = '', times_ns = [], hits = times_ns.length} = raw;
  const at = typeof node === 'number' ? node : names.indexOf(node);
  return {
    index,
    name: name || kind || `fault ${index + 1}`,
    kind,
    text,
    hits,
    times: times_ns,
    more: raw.more === true,
    line: raw.line ?? null,
    nodes: at >= 0 && at < names.length ? [at] : [],
    where: names[at] ?? (node === null ? '' : String(node)),
  };
}

/** Texts of where a fault acts: the node, or all of them. */
export const faultPlace = (fault) => fault.where || 'all';

export class Faults {
  /** @param list meta.faults; @param names of the nodes */
  constructor(list, names) {
    this.list = list.map((raw, i) => faultOf(raw, i, names));
    const hits = this.list.flatMap(({index, times}) =>
      times.map(([from, to], hit) => ({from, to: Math.max(from, to), fault: index, hit})),
    );
    this.hits = hits.sort((a, b) => a.from - b.from);
    this.starts = Float64Array.from(this.hits, ({from}) => from);
    // Latest end of all hits up to each: where a search backwards may stop.
    this.ends = new Float64Array(this.hits.length);
    let end = -Infinity;
    this.hits.forEach(({to}, i) => {
      end = Math.max(end, to);
      this.ends[i] = end;
    });
  }

  get count() {
    return this.list.length;
  }

  /** Hits that touch the window, the latest first. */
  in(from, to) {
    const found = [];
    for (let i = lastAtOrBelow(this.starts, to); i >= 0 && this.ends[i] >= from; --i) {
      if (this.hits[i].to >= from) found.push(this.hits[i]);
    }
    return found;
  }

  /** Whether any hit touches the window. */
  any(from, to) {
    const last = lastAtOrBelow(this.starts, to);
    return last >= 0 && this.ends[last] >= from;
  }

  /** [from, to] of one hit, ns; null if the report does not have it. */
  span(fault, hit) {
    return this.list[fault]?.times[hit] ?? null;
  }
}
