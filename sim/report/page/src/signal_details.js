// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The signals of the selected frame.
import {el} from './dom.js';
import {choiceOf, rawText} from './signal_codec.js';

/** The signals of a frame with values, units and raw values; null without a database for it. */
export function signalTable(report, frame) {
  const message = report.signals.messageOf(frame);
  if (!message) return null;
  const rows = report.signals.valuesOf(frame).map((decoded) => {
    const {name, unit} = decoded.signal;
    const choice = choiceOf(decoded);
    const number = `${rawText(decoded)}${unit && ` ${unit}`}`;
    return el(
      'tr',
      {},
      el('td', {}, name),
      el('td', {class: 'right'}, choice === undefined ? number : `${choice} (${rawText(decoded)})`),
      el('td', {class: 'right dim', title: 'raw value'}, String(decoded.raw)),
    );
  });
  const none = frame.remote
    ? 'A remote request has no data.'
    : 'No signal of it is in these bytes.';
  return el(
    'div',
    {class: 'signals'},
    el('h4', {}, `signals of ${message.name} (${message.file})`),
    rows.length
      ? el('table', {class: 'plain'}, el('tbody', {}, rows))
      : el('p', {class: 'dim'}, none),
  );
}
