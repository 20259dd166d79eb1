// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SvgPainter: a Painter whose picture is the text of an SVG file.
import {el} from './dom.js';
import {Painter} from './painter.js';

const kEscapes = {'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'};
// XML knows no control characters; names of files, and units, may hold some.
const kNoText = /[^\t\n\r -\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu;
const escaped = (text) =>
  String(text)
    .replace(kNoText, '\ufffd')
    .replace(/[&<>"]/g, (letter) => kEscapes[letter]);
const short = (value) => +value.toFixed(2);
const kAnchors = {left: 'start', center: 'middle', right: 'end'};
const kMiddle = 0.35; // of the size of letters: from their middle down to the line they stand on

/** The points of [x, y, x, y, ...] as a path. */
const pathOf = (points) =>
  points.reduce((path, _, i) => {
    if (i % 2) return path;
    return `${path}${i ? 'L' : 'M'}${short(points[i])} ${short(points[i + 1])}`;
  }, '');

export class SvgPainter extends Painter {
  constructor() {
    super(el('canvas')); // measures texts
    this.parts = [];
    this.clips = 0;
  }

  begin(width, height, colors) {
    Object.assign(this, {width, height, colors, whole: height, drawn: 0});
    this.rect(0, 0, width, height, 'panel');
  }

  #add(tag, attributes, text = '') {
    ++this.drawn;
    const list = Object.entries(attributes)
      .filter(([, value]) => value !== null)
      .map(
        ([name, value]) =>
          ` ${name}="${typeof value === 'number' ? short(value) : escaped(value)}"`,
      );
    this.parts.push(`<${tag}${list.join('')}>${escaped(text)}</${tag}>`);
  }

  #stroke(color, width, dash) {
    return {
      fill: 'none',
      stroke: this.color(color),
      'stroke-width': width,
      'stroke-linejoin': 'round',
      'stroke-dasharray': dash ? dash.join(' ') : null,
    };
  }

  rect(x, y, width, height, color, alpha = 1) {
    const opacity = alpha < 1 ? alpha : null;
    this.#add('rect', {x, y, width, height, fill: this.color(color), 'fill-opacity': opacity});
  }

  frame(x, y, w, h, color, width = 1) {
    const inside = {width: Math.max(w - width, 0), height: Math.max(h - width, 0)};
    const place = {x: x + width / 2, y: y + width / 2};
    this.#add('rect', {...place, ...inside, ...this.#stroke(color, width)});
  }

  hatch(x, y, w, h, color, distance = 4) {
    let path = '';
    for (let at = x - h; at < x + w; at += distance) path += pathOf([at, y + h, at + h, y]);
    this.clip(x, y, w, h, () => this.#add('path', {d: path, ...this.#stroke(color, 1)}));
  }

  line(x1, y1, x2, y2, color, width = 1, dash = null) {
    this.polyline([x1, y1, x2, y2], color, width, dash);
  }

  polyline(points, color, width = 1, dash = null) {
    if (points.length < 4) return;
    this.#add('path', {d: pathOf(points), ...this.#stroke(color, width, dash)});
  }

  polygon(points, color, alpha = 1) {
    this.#add('path', {d: `${pathOf(points)}Z`, fill: this.color(color), 'fill-opacity': alpha});
  }

  text(text, x, y, {color = 'ink', size = 12, align = 'left', bold = false, mono = false} = {}) {
    const look = {
      'font-size': size,
      'font-family': mono ? this.colors.mono : this.colors.sans,
      'font-weight': bold ? '600' : null,
      'text-anchor': kAnchors[align],
    };
    this.#add('text', {x, y: y + kMiddle * size, fill: this.color(color), ...look}, text);
  }

  #group(attributes, paint) {
    this.parts.push(`<g ${attributes}>`);
    paint();
    this.parts.push('</g>');
  }

  clip(x, y, w, h, paint) {
    const id = `c${++this.clips}`;
    const box = [x, y, Math.max(w, 0), Math.max(h, 0)].map(short);
    this.parts.push(
      `<clipPath id="${id}"><rect x="${box[0]}" y="${box[1]}" width="${box[2]}" ` +
        `height="${box[3]}"/></clipPath>`,
    );
    this.#group(`clip-path="url(#${id})"`, paint);
  }

  shifted(y, height, paint) {
    const {height: before} = this;
    this.height = height;
    this.#group(`transform="translate(0 ${short(y)})"`, paint);
    this.height = before;
  }

  /** The file. */
  get file() {
    const {width, whole} = this;
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${whole}" ` +
      `viewBox="0 0 ${width} ${whole}">\n${this.parts.join('\n')}\n</svg>\n`
    );
  }
}
