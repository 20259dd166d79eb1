// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The place in the report as the part of the address after '#', so that it can be passed on.

function selectionText(selection) {
  if (!selection) return '';
  const {kind, index, hit, segment, lane, bit} = selection;
  if (kind === 'fault') return `fault.${index}.${hit}`;
  return kind === 'bit' ? `bit.${segment}.${lane}.${bit}` : `${kind}.${index}`;
}

function selectionOf(text) {
  const [kind, ...numbers] = text.split('.');
  const [a, b, c] = numbers.map(Number);
  if (numbers.length === 0 || [a, b, c].some((n) => n !== undefined && !(n >= 0))) return null;
  if (kind === 'bit') return {kind, segment: a, lane: b, bit: c};
  if (kind === 'fault') return {kind, index: a, hit: b ?? 0};
  return ['frame', 'event', 'loss', 'segment'].includes(kind) ? {kind, index: a} : null;
}

/** {from, to, selection} of an address, or null. Times in ns. */
export function readHash(hash) {
  const values = new URLSearchParams(hash.replace(/^#/, ''));
  const from = parseFloat(values.get('from'));
  const to = parseFloat(values.get('to'));
  if (!(to > from)) return null;
  return {from, to, selection: selectionOf(values.get('sel') ?? '')};
}

/** Keeps the address up to date; not more often than a browser allows. */
export function keepHash(view) {
  let timer = 0;
  const write = () => {
    timer = 0;
    const selection = selectionText(view.selection);
    const hash =
      `#from=${+view.from.toFixed(3)}&to=${+view.to.toFixed(3)}` +
      (selection ? `&sel=${selection}` : '');
    if (hash !== location.hash) history.replaceState(null, '', hash);
  };
  const later = () => {
    timer ||= setTimeout(write, 250);
  };
  view.addEventListener('move', later);
  view.addEventListener('select', later);
}
