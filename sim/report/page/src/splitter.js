// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar between scope and tables: drag it, or move it with the arrow keys.
import {el} from './dom.js';

const kLeast = 120;

/** @param app gets the property --bottom, height of the part below in px */
export function attachSplitter(app) {
  const bar = el('div', {
    class: 'splitter',
    role: 'separator',
    tabindex: 0,
    'aria-orientation': 'horizontal',
    'aria-label': 'Height of the tables',
    title: 'Drag to make room for lanes or tables',
  });
  let height = 0;
  const set = (value) => {
    height = Math.min(Math.max(value, kLeast), window.innerHeight - 260);
    app.style.setProperty('--bottom', `${height}px`);
  };
  bar.addEventListener('pointerdown', (event) => bar.setPointerCapture(event.pointerId));
  bar.addEventListener('pointermove', (event) => {
    if (bar.hasPointerCapture(event.pointerId)) set(window.innerHeight - event.clientY - 6);
  });
  bar.addEventListener('keydown', (event) => {
    const step = {ArrowUp: 30, ArrowDown: -30}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    set((height || app.querySelector('.bottom').clientHeight) + step);
  });
  return bar;
}
