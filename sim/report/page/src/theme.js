// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The colours of the moment, light or dark, from the style sheet.

const kNames = [
  'panel',
  'raised',
  'grid',
  'ink',
  'dim',
  'trace',
  'rx',
  'load',
  'select',
  'alarm',
  'passive',
  'off',
  'fault',
  'onfault',
  'onfield',
  'stuff',
  'onstrong',
  't-sync',
  't-prop',
  't-ps1',
  't-ps2',
  'f-sof',
  'f-id',
  'f-control',
  'f-dlc',
  'f-data',
  'f-crc',
  'f-ack',
  'f-tail',
  'f-error',
  'f-errordel',
  'f-overload',
  'f-suspend',
  'f-quiet',
  'f-off',
  ...Array.from({length: 16}, (_, i) => `n-${i}`),
];

let known = null;
window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  known = null;
});

/** {name: colour} for all names, and the fonts. */
export function colors() {
  if (known) return known;
  const style = getComputedStyle(document.documentElement);
  known = {
    sans: 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif',
    mono: 'ui-monospace, monospace',
  };
  for (const name of kNames) known[name] = style.getPropertyValue(`--${name}`).trim() || '#888';
  return known;
}

export const nodeColor = (node) => colors()[`n-${node % 16}`] ?? colors().dim;
