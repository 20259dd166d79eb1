// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The view as a picture file: PNG or SVG, with a title and all lanes.
import {fileName, save} from './csv.js';
import {el} from './dom.js';
import {formatRate, formatTime} from './format.js';
import {Painter} from './painter.js';
import {SvgPainter} from './svg_painter.js';
import {colors} from './theme.js';

const kTitle = 26;
const kFiner = 2; // pixels of a PNG for one of the page

function paint(p, scope, pixels) {
  const {report, view} = scope;
  const scale = scope.scale();
  p.begin(scale.width, kTitle + scope.wholeHeight, colors(), pixels);
  const fine = view.span / 500;
  const window = `${formatTime(view.from, fine)} … ${formatTime(view.to, fine)}`;
  const title = `${report.meta.title}  ·  ${formatRate(report.meta.bitrate)}  ·  ${window}`;
  p.text(title, 10, kTitle / 2, {size: 13, bold: true});
  p.shifted(kTitle, scope.wholeHeight, () => scope.paint(p, scale));
  return p;
}

/** Saves the view as `kind`, "png" or "svg". */
export function savePicture(scope, kind) {
  const name = fileName(scope.report, `view.${kind}`);
  if (kind === 'svg') {
    const {file} = paint(new SvgPainter(), scope);
    save(name, new Blob([file], {type: 'image/svg+xml'}));
    return;
  }
  const {canvas} = paint(new Painter(el('canvas')), scope, kFiner);
  canvas.toBlob((blob) => save(name, blob), 'image/png');
}
