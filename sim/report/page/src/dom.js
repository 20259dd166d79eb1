// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Making elements.

/** el('td', {class: 'x', onclick: f}, 'text', child...): an element. */
export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** A tab with a bar of fields and buttons above its table. */
export const tabWithBar = (bar, ...rest) =>
  el('div', {class: 'tab-body column'}, el('div', {class: 'search'}, ...bar), ...rest);

/** A field to search with. */
export const searchField = (label, placeholder, more = {}) =>
  el('input', {
    type: 'search',
    placeholder,
    'aria-label': label,
    spellcheck: 'false',
    autocomplete: 'off',
    ...more,
  });

/** A small square in the colour of a node. */
export function swatch(color) {
  const square = el('span', {class: 'swatch', 'aria-hidden': 'true'});
  square.style.background = color;
  return square;
}
