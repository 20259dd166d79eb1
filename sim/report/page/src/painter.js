// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Painter: draws on a canvas and counts what it draws; on request it also keeps a list, which the
// tests read. Coordinates are CSS pixels.

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.items = null;
    this.drawn = 0;
  }

  /** Starts a new picture of the given size; colors is the theme of the moment. */
  begin(width, height, colors, scale = window.devicePixelRatio || 1) {
    const wide = Math.round(width * scale);
    const high = Math.round(height * scale);
    if (this.canvas.width !== wide || this.canvas.height !== high) {
      this.canvas.width = wide;
      this.canvas.height = high;
      this.canvas.style.width = `${width}px`;
      this.canvas.style.height = `${height}px`;
    }
    this.width = width;
    this.height = height;
    this.colors = colors;
    this.drawn = 0;
    this.context.setTransform(scale, 0, 0, scale, 0, 0);
    this.context.fillStyle = colors.panel;
    this.context.fillRect(0, 0, width, height);
  }

  /** Notes a thing of the picture for the tests. */
  note(kind, data) {
    if (this.items) this.items.push({kind, ...data});
  }

  color(name) {
    return this.colors[name] ?? name;
  }

  rect(x, y, w, h, color, alpha = 1) {
    ++this.drawn;
    const c = this.context;
    c.globalAlpha = alpha;
    c.fillStyle = this.color(color);
    c.fillRect(x, y, w, h);
    c.globalAlpha = 1;
  }

  frame(x, y, w, h, color, width = 1) {
    ++this.drawn;
    const c = this.context;
    c.strokeStyle = this.color(color);
    c.lineWidth = width;
    c.strokeRect(x + width / 2, y + width / 2, Math.max(w - width, 0), Math.max(h - width, 0));
  }

  /** Slanting lines over an area: the mark of stuff bits. */
  hatch(x, y, w, h, color, distance = 4) {
    ++this.drawn;
    const c = this.context;
    c.save();
    c.beginPath();
    c.rect(x, y, w, h);
    c.clip();
    c.beginPath();
    for (let at = x - h; at < x + w; at += distance) {
      c.moveTo(at, y + h);
      c.lineTo(at + h, y);
    }
    c.strokeStyle = this.color(color);
    c.lineWidth = 1;
    c.stroke();
    c.restore();
  }

  line(x1, y1, x2, y2, color, width = 1, dash = null) {
    ++this.drawn;
    const c = this.context;
    c.beginPath();
    c.moveTo(x1, y1);
    c.lineTo(x2, y2);
    this.#stroke(color, width, dash);
  }

  /** A line through points [x, y, x, y, ...]. */
  polyline(points, color, width = 1, dash = null) {
    if (points.length < 4) return;
    this.drawn += points.length / 2;
    const c = this.context;
    c.beginPath();
    c.moveTo(points[0], points[1]);
    for (let i = 2; i < points.length; i += 2) c.lineTo(points[i], points[i + 1]);
    this.#stroke(color, width, dash);
  }

  #stroke(color, width, dash) {
    const c = this.context;
    c.strokeStyle = this.color(color);
    c.lineWidth = width;
    c.setLineDash(dash ?? []);
    c.lineJoin = 'round';
    c.stroke();
    if (dash) c.setLineDash([]);
  }

  polygon(points, color, alpha = 1) {
    ++this.drawn;
    const c = this.context;
    c.globalAlpha = alpha;
    c.beginPath();
    c.moveTo(points[0], points[1]);
    for (let i = 2; i < points.length; i += 2) c.lineTo(points[i], points[i + 1]);
    c.closePath();
    c.fillStyle = this.color(color);
    c.fill();
    c.globalAlpha = 1;
  }

  text(text, x, y, {color = 'ink', size = 12, align = 'left', bold = false, mono = false} = {}) {
    ++this.drawn;
    const c = this.context;
    c.font = `${bold ? '600 ' : ''}${size}px ${mono ? this.colors.mono : this.colors.sans}`;
    c.textAlign = align;
    c.textBaseline = 'middle';
    c.fillStyle = this.color(color);
    c.fillText(text, x, y);
  }

  measure(text, size = 12, bold = false, mono = false) {
    const c = this.context;
    c.font = `${bold ? '600 ' : ''}${size}px ${mono ? this.colors.mono : this.colors.sans}`;
    return c.measureText(text).width;
  }

  /** The first of the texts that fits into `width`, centred at x; nothing if none does. */
  fit(texts, x, y, width, options = {}) {
    for (const text of texts) {
      if (text && this.measure(text, options.size, options.bold, options.mono) <= width - 4) {
        this.text(text, x, y, {...options, align: 'center'});
        return text;
      }
    }
    return '';
  }

  /** Paints a picture of the given height that begins `y` further down. */
  shifted(y, height, paint) {
    const {height: before} = this;
    this.height = height;
    this.context.save();
    this.context.translate(0, y);
    paint();
    this.context.restore();
    this.height = before;
  }

  clip(x, y, w, h, paint) {
    const c = this.context;
    c.save();
    c.beginPath();
    c.rect(x, y, w, h);
    c.clip();
    paint();
    c.restore();
  }
}
