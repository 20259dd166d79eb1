// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The head of the page: what the run was, what failed, and the statements of the paper.
import {el} from './dom.js';
import {formatCount, formatRate, formatTime, percent} from './format.js';

function fact(value, name, title, style = '') {
  return el('span', {class: `fact ${style}`.trim(), title}, el('b', {}, value), ` ${name}`);
}

function facts(report) {
  const {meta} = report;
  const {summary} = meta;
  const list = [
    fact(formatRate(meta.bitrate), '', 'Bit rate'),
    fact(formatTime(meta.duration_ns, meta.duration_ns / 1000), '', 'Simulated time'),
    fact(
      formatCount(report.nodes.length),
      report.nodes.length === 1 ? 'node' : 'nodes',
      'Controllers on the bus',
    ),
    fact(formatCount(summary.frames), 'frames', 'Acknowledged frames'),
    fact(
      formatCount(summary.error_frames),
      'error frames',
      'A node found an error and told all others',
      summary.error_frames ? 'alarm' : '',
    ),
    fact(formatCount(summary.overload_frames), 'overload frames', 'A node asked for more time'),
    fact(percent(summary.load), 'load', 'Part of the time in which the bus is busy'),
  ];
  if (summary.unacknowledged > 0)
    list.push(
      fact(
        formatCount(summary.unacknowledged),
        'unacknowledged',
        'Complete frames that nobody acknowledged',
        'alarm',
      ),
    );
  if (summary.pending > 0)
    list.push(
      fact(
        formatCount(summary.pending),
        'still waiting',
        'Frames that were queued and have not left',
        'alarm',
      ),
    );
  return list;
}

function verdict(report, actions) {
  const failed =
    report.meta.checks.filter(({ok}) => !ok).length +
    report.meta.statements.filter(({ok}) => !ok).length;
  const all = report.meta.checks.length + report.meta.statements.length;
  if (failed > 0) {
    return el(
      'button',
      {type: 'button', class: 'verdict bad', onclick: () => actions.tab('checks')},
      `✗ ${failed} of ${all} checks failed`,
    );
  }
  return all > 0
    ? el(
        'button',
        {type: 'button', class: 'verdict good', onclick: () => actions.tab('checks')},
        `✓ all ${all} checks`,
      )
    : null;
}

/** One button for each statement of the paper. */
function statementsBar(report, view) {
  const {statements} = report.meta;
  if (statements.length === 0) return null;
  const out = el('p', {class: 'seen', 'aria-live': 'polite', hidden: true});
  const buttons = statements.map((statement) => {
    const {figure, reported, seen, ok, time_ns} = statement;
    return el(
      'button',
      {
        type: 'button',
        class: ok ? 'statement' : 'statement bad',
        'aria-pressed': 'false',
        title: `The paper reports: ${reported}\nHere: ${seen}`,
        onclick: (event) => {
          for (const b of buttons)
            b.setAttribute('aria-pressed', String(b === event.currentTarget));
          out.hidden = false;
          out.replaceChildren(
            el('b', {}, `fig. ${figure}  `),
            `reported: ${reported}. `,
            el('b', {}, ok ? ' seen: ' : ' seen (differs): '),
            seen,
          );
          goToStatement(report, view, time_ns);
        },
      },
      el('b', {}, `${ok ? '✓' : '✗'} fig. ${figure}`),
      el('span', {}, reported),
    );
  });
  return el(
    'section',
    {class: 'statements', 'aria-label': 'Statements of the paper'},
    el('div', {class: 'buttons'}, buttons),
    out,
  );
}

/** The whole attempt around a moment, or some bits of silence. */
export function goToStatement(report, view, time) {
  if (time === null) return;
  const segment = report.segmentAt(time);
  if (segment >= 0) {
    const {start, end} = report.segments;
    const span = Math.min(end[segment] - start[segment], 160 * report.bitNs);
    const from = Math.max(start[segment], Math.min(time - span / 2, end[segment] - span));
    view.goTo(from, from + span, 0.08);
  } else {
    view.goTo(time - 40 * report.bitNs, time + 40 * report.bitNs, 0);
  }
}

export function header(report, view, actions) {
  const {meta} = report;
  return [
    el(
      'header',
      {class: 'head'},
      el('h1', {}, meta.title),
      verdict(report, actions),
      el('div', {class: 'facts'}, facts(report)),
      el(
        'div',
        {class: 'about'},
        el('span', {class: 'note', title: meta.note}, meta.note),
        el('span', {class: 'tool'}, meta.tool),
      ),
    ),
    meta.truncated
      ? el('p', {class: 'note warn'}, `Not everything is in this file: ${meta.truncated}`)
      : null,
    statementsBar(report, view),
  ].filter(Boolean);
}
