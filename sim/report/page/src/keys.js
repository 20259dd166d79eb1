// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys and steps: from frame to frame, from error to error, to a scale.
import {lastAtOrBelow} from './search.js';

/** Moves through the report; the keys and the buttons share it. */
export class Steps {
  constructor(report, view) {
    Object.assign(this, {report, view});
  }

  get middle() {
    const span = this.view.selectionSpan();
    return span && span[0] < this.view.to && span[1] > this.view.from
      ? (span[0] + span[1]) / 2
      : (this.view.from + this.view.to) / 2;
  }

  all() {
    this.view.go(-0.01 * this.report.duration, 1.01 * this.report.duration);
  }

  /** A window of so many bits around the middle. */
  bits(count) {
    const half = (count * this.report.bitNs) / 2;
    this.view.go(this.middle - half, this.middle + half);
  }

  quanta() {
    const bits = 3;
    this.bits(bits);
  }

  /** The next (1) or previous (-1) of rising times. */
  #next(times, length, direction) {
    const middle = this.middle;
    const at = lastAtOrBelow(times, middle, length);
    if (direction > 0) return Math.min(at + 1, length - 1);
    const inside = at >= 0 && times[at] <= middle ? at : at - 1;
    return Math.max(inside, 0);
  }

  frame(direction) {
    const {frames} = this.report;
    if (frames.count === 0) return;
    const selected = this.view.selection?.kind === 'frame' ? this.view.selection.index : null;
    const index =
      selected !== null
        ? Math.min(Math.max(selected + direction, 0), frames.count - 1)
        : this.#next(frames.start, frames.count, direction);
    this.view.select({kind: 'frame', index});
    this.view.goTo(frames.start[index], frames.end[index], 0.08);
  }

  event(direction) {
    const {events} = this.report;
    if (events.count === 0) return;
    const selected = this.view.selection?.kind === 'event' ? this.view.selection.index : null;
    const index =
      selected !== null
        ? Math.min(Math.max(selected + direction, 0), events.count - 1)
        : this.#next(events.start, events.count, direction);
    this.showEvent(index);
  }

  /** The whole attempt in which an error or overload happened. */
  showEvent(index) {
    const {events, segments} = this.report;
    const segment = events.segment[index];
    this.view.select({kind: 'event', index});
    const from = segments.start[segment] ?? events.start[index] - 30 * this.report.bitNs;
    const to = segments.end[segment] ?? events.end[index];
    this.view.goTo(from, to, 0.05);
  }

  showFrame(index) {
    const {frames} = this.report;
    this.view.select({kind: 'frame', index});
    this.view.goTo(frames.start[index], frames.end[index], 0.08);
  }

  /** A moment of a fault; without a number the next one, or the first if it is not selected. */
  showFault(index, hit = null) {
    const {faults} = this.report;
    const {selection} = this.view;
    const same = selection?.kind === 'fault' && selection.index === index;
    const count = faults.list[index].times.length;
    const next = hit ?? (same && count > 0 ? (selection.hit + 1) % count : 0);
    this.view.select({kind: 'fault', index, hit: next});
    const span = faults.span(index, next);
    const room = 40 * this.report.bitNs;
    if (span) this.view.goTo(span[0] - room, span[1] + room, 0.1);
  }

  showLoss(index) {
    const {losses, segments} = this.report;
    this.view.select({kind: 'loss', index});
    const segment = losses.segment[index];
    const time = losses.time[index];
    this.view.goTo(
      segments.start[segment] ?? time - 20 * this.report.bitNs,
      time + 8 * this.report.bitNs,
      0.1,
    );
  }
}

export const kKeys = [
  ['← →', 'move by a tenth, with Shift by a whole window'],
  ['+ −', 'zoom in, out'],
  ['↑ ↓', 'scroll the lanes of the nodes'],
  ['Home End', 'start, end of the run'],
  ['0', 'the whole run'],
  ['1 2 3', 'scale: a frame, a few bits, time quanta'],
  ['n p', 'next, previous frame'],
  ['e Shift+E', 'next, previous error or overload'],
  ['Enter', 'zoom to what is selected'],
  ['c', 'copy the selected frame as a line of candump'],
  ['/', 'search frames'],
  ['Esc', 'nothing selected'],
  ['?', 'this list'],
];

/** Keys of the whole page; not while somebody types into a field. */
export function attachKeys(view, steps, scope, actions) {
  const keys = {
    ArrowLeft: (e) => view.pan((e.shiftKey ? -1 : -0.1) * view.span),
    ArrowRight: (e) => view.pan((e.shiftKey ? 1 : 0.1) * view.span),
    ArrowUp: () => scope.scroll.scrollBy(0, -40),
    ArrowDown: () => scope.scroll.scrollBy(0, 40),
    '+': () => view.zoom(0.6),
    '=': () => view.zoom(0.6),
    '-': () => view.zoom(1 / 0.6),
    Home: () => view.go(0, view.span),
    End: () => view.go(view.report.duration - view.span, view.report.duration),
    0: () => steps.all(),
    1: () => steps.bits(140),
    2: () => steps.bits(20),
    3: () => steps.quanta(),
    n: () => steps.frame(1),
    p: () => steps.frame(-1),
    e: () => steps.event(1),
    E: () => steps.event(-1),
    Enter: () => {
      const span = view.selectionSpan();
      if (span) view.goTo(span[0], span[1], 0.2);
    },
    Escape: () => view.select(null),
    '/': () => actions.search(),
    '?': () => actions.help(),
    c: () => actions.copy(),
  };
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // A dialog that has just been closed may still have the focus.
    if (event.target.closest?.('input, textarea, select, dialog[open]')) return;
    const moving =
      event.key.startsWith('Arrow') ||
      event.key === 'Enter' ||
      event.key === 'Home' ||
      event.key === 'End';
    if (moving && event.target.closest?.('[role=grid], [role=tab], button, a')) return;
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
