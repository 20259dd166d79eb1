// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Mouse, touch and keyboard of the scope.

const kDragPx = 4; // less is a click

/** Wheel: zoom at the pointer; sideways or with shift: move. */
function wheel(scope, view) {
  return (event) => {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    const sideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
    const scale = scope.scale();
    if (sideways) {
      view.pan((unit * (event.deltaX || event.deltaY)) / scale.pxPerNs);
      return;
    }
    const speed = event.ctrlKey ? 0.01 : 0.002; // ctrl: what a pinch on a touchpad sends
    view.zoom(Math.exp(speed * unit * event.deltaY), scale.time(event.offsetX));
  };
}

/** One gesture of one or two pointers on a canvas. */
class Gesture {
  constructor(scope, view, canvas, click) {
    Object.assign(this, {scope, view, canvas, click});
    this.pointers = new Map();
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#up(event));
    canvas.addEventListener('pointercancel', (event) => this.#up(event));
    canvas.addEventListener('pointerleave', () => this.#leave());
  }

  #down(event) {
    if (event.button !== 0) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, event.offsetX);
    this.start = {
      x: event.offsetX,
      from: this.view.from,
      to: this.view.to,
      moved: false,
      box: event.shiftKey,
    };
    if (this.pointers.size === 2) this.pinch = this.#pinchNow();
  }

  /** Distance of two fingers and the time between them. */
  #pinchNow() {
    const [a, b] = [...this.pointers.values()];
    return {distance: Math.max(Math.abs(a - b), 8), time: this.scope.scale().time((a + b) / 2)};
  }

  #move(event) {
    this.scope.hover = {x: event.offsetX, y: event.offsetY, canvas: this.canvas};
    this.scope.onhover?.(event);
    if (!this.pointers.has(event.pointerId)) return this.scope.invalidate();
    this.pointers.set(event.pointerId, event.offsetX);
    if (this.pointers.size === 2) return this.#pinchMove();
    const dx = event.offsetX - this.start.x;
    if (Math.abs(dx) > kDragPx) this.start.moved = true;
    if (!this.start.moved) return undefined;
    if (this.start.box) {
      this.scope.box = [this.start.x, event.offsetX];
      return this.scope.invalidate();
    }
    const perPx = (this.start.to - this.start.from) / this.scope.scale().plot;
    this.canvas.classList.add('dragging');
    return this.view.set(this.start.from - dx * perPx, this.start.to - dx * perPx);
  }

  #pinchMove() {
    const now = this.#pinchNow();
    this.start.moved = true;
    this.view.zoom(this.pinch.distance / now.distance, this.pinch.time);
    this.pinch.distance = now.distance;
  }

  #up(event) {
    if (!this.pointers.delete(event.pointerId) || !this.start) return;
    this.canvas.classList.remove('dragging');
    if (this.scope.box) {
      const scale = this.scope.scale();
      const [a, b] = this.scope.box.map((x) => scale.time(x)).sort((x, y) => x - y);
      this.scope.box = null;
      this.view.go(a, b);
    } else if (!this.start.moved && event.type === 'pointerup') {
      this.click(event, this.canvas);
    }
    if (this.pointers.size === 0) this.start = null;
  }

  #leave() {
    this.scope.hover = null;
    this.scope.onhover?.(null);
    this.scope.invalidate();
  }
}

/** What lies under a point: {time, node (or -1), segment, lane, laneIndex, bit}. */
export function hit(scope, x, y, canvas) {
  const scale = scope.scale();
  const {report} = scope;
  const time = scale.time(x);
  const node = canvas === scope.lanes ? Math.floor(y / scope.laneHeight) : -1;
  const segment = x >= scale.left ? report.segmentAt(time) : -1;
  if (segment < 0) return {time, node, segment, lane: null, bit: -1};
  const lanes = report.lanesOf(segment);
  const own = lanes.findIndex((lane) => lane.nodeIndex === node);
  const laneIndex = Math.max(own, 0);
  const lane = lanes[laneIndex] ?? null;
  return {time, node, segment, lane, laneIndex, bit: lane ? lane.bitAt(time) : -1};
}

/** Selects what was clicked: a bit where bits are wide enough, else the frame or the error. */
function clicker(scope, view) {
  return (event, canvas) => {
    const {report} = scope;
    const place = hit(scope, event.offsetX, event.offsetY, canvas);
    if (place.segment < 0) return view.select(null, 'scope');
    const scale = scope.scale();
    if (scale.pxPerBit >= 9 && place.bit >= 0) {
      return view.select(
        {kind: 'bit', segment: place.segment, lane: place.laneIndex, bit: place.bit},
        'scope',
      );
    }
    const events = report.segmentEvents.get(place.segment) ?? [];
    const on = events.find(
      (i) => place.time >= report.events.start[i] && place.time <= report.events.end[i],
    );
    if (on !== undefined) return view.select({kind: 'event', index: on}, 'scope');
    const frame = report.segmentFrame[place.segment];
    if (frame >= 0) return view.select({kind: 'frame', index: frame}, 'scope');
    if (events.length > 0) return view.select({kind: 'event', index: events[0]}, 'scope');
    return view.select({kind: 'segment', index: place.segment}, 'scope');
  };
}

/** Connects the scope with mouse, touch and pen. */
export function attachPointer(scope, view) {
  for (const canvas of [scope.top, scope.signals.canvas, scope.lanes]) {
    canvas.addEventListener('wheel', wheel(scope, view), {passive: false});
    canvas.addEventListener('dblclick', (event) => {
      const {segment} = hit(scope, event.offsetX, event.offsetY, canvas);
      if (segment >= 0)
        view.goTo(scope.report.segments.start[segment], scope.report.segments.end[segment], 0.05);
    });
    new Gesture(scope, view, canvas, clicker(scope, view));
  }
}
