// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Response times: one point for each frame, the bound of each message as a line, and a table.
import {el, swatch} from './dom.js';
import {formatCount, hex, milliseconds} from './format.js';
import {Plot} from './plot.js';
import {lastAtOrBelow} from './search.js';
import {colors, nodeColor} from './theme.js';

const kPoints = 4000; // more frames in the window: only the extremes of each column

/** Sums that the report does not hold: retries and lost arbitrations of each message. */
function sumsOf(report) {
  const sums = report.meta.messages.map(() => ({retries: 0, lost: 0}));
  const {frames} = report;
  for (let i = 0; i < frames.count; ++i) {
    const sum = sums[frames.message[i]];
    if (!sum) continue;
    sum.retries += frames.retries[i];
    sum.lost += frames.lost[i];
  }
  return sums;
}

/** Frames of the window to draw: all, or of each column and message the fastest and slowest. */
function pointsOf(report, from, to, columns, only) {
  const {frames} = report;
  const first = Math.max(0, lastAtOrBelow(frames.start, from));
  const last = lastAtOrBelow(frames.start, to);
  const wanted = (i) =>
    frames.message[i] >= 0 &&
    !Number.isNaN(frames.response[i]) &&
    (only < 0 || frames.message[i] === only);
  const points = [];
  if (last - first < kPoints) {
    for (let i = first; i <= last; ++i) if (wanted(i)) points.push(i);
    return points;
  }
  const extremes = new Map();
  for (let i = first; i <= last; ++i) {
    if (!wanted(i)) continue;
    const column = Math.floor(((frames.start[i] - from) / (to - from)) * columns);
    const key = column * 4096 + frames.message[i];
    const pair = extremes.get(key);
    if (!pair) extremes.set(key, [i, i]);
    else if (frames.response[i] < frames.response[pair[0]]) pair[0] = i;
    else if (frames.response[i] > frames.response[pair[1]]) pair[1] = i;
  }
  for (const [a, b] of extremes.values()) points.push(a, ...(a === b ? [] : [b]));
  return points;
}

const messageColor = (report, index) => nodeColor(index);

export class ResponseTab {
  constructor(report, view, steps) {
    Object.assign(this, {report, view, steps, only: -1});
    this.sums = sumsOf(report);
    const host = el('div', {class: 'plot'});
    this.table = this.#table();
    const side = el('div', {class: 'side'}, this.#noBound(), this.table);
    this.root = el('div', {class: 'tab-body split'}, host, side);
    this.plot = new Plot(host, report, view, {
      data: (from, to, columns) => {
        this.points = pointsOf(report, from, to, Math.min(columns / 3, 200), this.only);
        let top = 0;
        for (const i of this.points) top = Math.max(top, report.frames.response[i]);
        const bound = this.only >= 0 ? report.meta.messages[this.only].bound_ns : null;
        this.top = Math.max(top, bound ?? 0, 1000) / 1e6;
        return [
          [from, to],
          [0, this.top],
        ];
      },
      options: () => ({
        label: 'response time, ms',
        scales: {y: {range: () => [0, this.top * 1.08]}},
        axis: {space: 28},
        series: [{stroke: 'transparent', points: {show: false}, paths: () => null}],
        hooks: {draw: [(u) => this.#scatter(u)]},
      }),
    });
    host.addEventListener('click', (event) => this.#pick(event));
  }

  #scatter(u) {
    const {frames, meta} = this.report;
    const c = u.ctx;
    const scale = window.devicePixelRatio || 1;
    const {left, top, width, height} = u.bbox;
    c.save();
    c.beginPath();
    c.rect(left, top, width, height);
    c.clip();
    meta.messages.forEach(({bound_ns}, m) => {
      if (bound_ns === null || (this.only >= 0 && m !== this.only)) return;
      const y = u.valToPos(bound_ns / 1e6, 'y', true);
      c.strokeStyle = messageColor(this.report, m);
      c.lineWidth = 1.5 * scale;
      c.setLineDash([6 * scale, 4 * scale]);
      c.beginPath();
      c.moveTo(left, y);
      c.lineTo(left + width, y);
      c.stroke();
    });
    c.setLineDash([]);
    const r = 2.6 * scale;
    for (const i of this.points) {
      c.fillStyle = messageColor(this.report, frames.message[i]);
      const x = u.valToPos(frames.end[i], 'x', true);
      const y = u.valToPos(frames.response[i] / 1e6, 'y', true);
      c.beginPath();
      c.arc(x, y, r, 0, 2 * Math.PI);
      c.fill();
    }
    c.restore();
  }

  #pick(event) {
    const u = this.plot.plot;
    const box = u?.over.getBoundingClientRect();
    if (!box) return;
    const {frames} = this.report;
    let best = -1;
    let least = 12 ** 2;
    for (const i of this.points) {
      const dx = u.valToPos(frames.end[i], 'x') - (event.clientX - box.left);
      const dy = u.valToPos(frames.response[i] / 1e6, 'y') - (event.clientY - box.top);
      if (dx * dx + dy * dy < least) {
        least = dx * dx + dy * dy;
        best = i;
      }
    }
    if (best >= 0) this.steps.showFrame(best);
  }

  /** Why a scenario that asks for bounds has none; null if there is nothing to say. */
  #noBound() {
    const why = this.report.meta.no_bound;
    return why ? el('p', {class: 'dim'}, `No bound: ${why}`) : null;
  }

  #table() {
    const {messages} = this.report.meta;
    const times = ['min, ms', 'mean, ms', 'max, ms', 'bound, ms'];
    const head = ['message', 'id', 'count', ...times, 'retries', 'lost'];
    const titles = [
      'Name in the scenario',
      'Identifier, hexadecimal',
      'Frames that were sent',
      'Shortest response time, ms: from the event that queues the frame to its end',
      'Mean response time, ms',
      'Longest response time, ms',
      'Worst case by analysis, ms (needs analysis: true in the scenario)',
      'Attempts that failed',
      'Arbitrations lost',
    ];
    const rows = messages.map((m, i) => {
      const late = m.bound_ns !== null && m.longest_ns > m.bound_ns;
      const cells = [
        el('td', {}, swatch(messageColor(this.report, i)), m.name),
        ...[
          hex(m.id, m.extended ? 8 : 3),
          formatCount(m.sent),
          ...[m.shortest_ns, m.mean_ns, m.longest_ns].map((ns) =>
            m.sent ? milliseconds(ns) : '–',
          ),
          m.bound_ns === null ? '–' : milliseconds(m.bound_ns),
          this.sums[i].retries || '',
          this.sums[i].lost || '',
        ].map((text, column) =>
          el('td', {class: column === 4 && late ? 'right alarm' : 'right'}, String(text)),
        ),
      ];
      return el(
        'tr',
        {
          tabindex: 0,
          title: 'Show only this message',
          onclick: () => this.#only(i),
          onkeydown: (event) => {
            if (event.key === 'Enter') this.#only(i);
          },
        },
        cells,
      );
    });
    return el(
      'table',
      {class: 'plain'},
      el(
        'thead',
        {},
        el(
          'tr',
          {},
          head.map((name, i) => el('th', {class: i ? 'right' : '', title: titles[i]}, name)),
        ),
      ),
      el('tbody', {}, rows),
    );
  }

  #only(index) {
    this.only = this.only === index ? -1 : index;
    [...this.table.tBodies[0].rows].forEach((row, i) =>
      row.classList.toggle('current', i === this.only),
    );
    this.plot.invalidate();
  }
}
