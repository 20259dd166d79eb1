// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `verican timesync --report`: takes the data out of the file and draws it.
import {el, swatch} from '../dom.js';
import {formatCount} from '../format.js';
import {LoadError} from '../load.js';
import {View} from '../view.js';
import {Histogram} from './histogram.js';
import {offsetPlot, ratePlot, stateColor, stateNames, statePlot} from './plots.js';
import {figuresOf, kLocked, load} from './sync_data.js';
import {eventsTable, followersTable} from './tables.js';

const fact = (value, name, title) =>
  el('span', {class: 'fact', title}, el('b', {}, value), ` ${name}`);
const ns = (ps) => `${(ps / 1e3).toFixed(1)} ns`;

/** Verdict and figures of all seeds. */
function header({json, goal, when}) {
  const {result} = json;
  const verdict = goal || !json.ok
    ? el(
        'span',
        {class: `verdict ${json.ok ? 'good' : 'bad'}`},
        json.ok ? '✓ within its goal' : result.locked ? '✗ goal missed' : '✗ not locked',
      )
    : null;
  const limits = goal
    ? [
        fact(goal.sd === null ? '–' : `${goal.sd} ns`, 'goal sd', 'Standard deviation allowed'),
        fact(`${goal.max} ns`, 'goal max', 'Largest error allowed'),
      ]
    : [];
  return el(
    'header',
    {class: 'head'},
    el('h1', {}, json.name),
    verdict,
    el(
      'div',
      {class: 'facts'},
      fact(ns(result.mean_ps), 'mean', 'Of the error against the master, all runs'),
      fact(ns(result.sd_ps), 'sd', 'Its standard deviation'),
      fact(ns(result.max_ps), 'max', 'Largest error, either way'),
      fact(ns(result.between_ps), 'between followers', 'Largest distance of two followers'),
      ...limits,
      fact(formatCount(result.samples), 'samples', `Of each follower ${when}, all runs`),
    ),
    el(
      'div',
      {class: 'about'},
      el('span', {class: 'note', title: json.what}, `${json.what} · how: ${json.how}`),
      el('span', {class: 'tool'}, json.tool),
    ),
  );
}

/** One run in sight; its parts ask it what to draw. */
class Page {
  constructor(data) {
    this.data = data;
    this.hidden = new Set();
    this.show(0);
  }

  show(index) {
    this.index = index;
    this.run = this.data.runs[index];
    const span = Math.max(this.run.end - this.run.begin, 1);
    const look = span / Math.max(this.run.at.length, 1);
    if (!this.view) this.view = new View({duration: this.run.end, bitNs: look, nodes: []});
    this.view.set(this.run.begin, this.run.end);
  }

  shown(n) {
    return !this.hidden.has(n);
  }

  /** Errors that count of all followers that are shown, ns. */
  counted() {
    return this.run.followers.flatMap((_, n) => (this.shown(n) ? [...this.run.counted(n)] : []));
  }

  offsetRange() {
    const most = 1.1 * Math.max(figuresOf(this.counted()).max || 0, this.data.goal?.max ?? 0, 1);
    return [-most, most];
  }

  rateRange() {
    let most = 1e-4;
    this.run.followers.forEach(({rate, meanRate, state}, n) => {
      if (!this.shown(n)) return;
      for (let i = 0; i < rate.length; ++i)
        if (state[i] === kLocked) most = Math.max(most, Math.abs(rate[i] - meanRate));
    });
    return [-1.1 * most, 1.1 * most];
  }

  /** Some looks around a moment. */
  goTo(at) {
    const interval = this.data.json.case.interval_s * 1e9;
    const span = Math.min((this.run.end - this.run.begin) / 8, 20 * interval);
    this.view.go(at - span / 2, at + span / 2);
  }
}

function toolbar(page, redraw) {
  const seeds = page.data.runs.map((_, i) =>
    el(
      'button',
      {
        type: 'button',
        'aria-pressed': String(i === page.index),
        onclick: (event) => {
          page.show(i);
          for (const b of seeds) b.setAttribute('aria-pressed', String(b === event.currentTarget));
          redraw();
        },
      },
      `seed ${page.data.firstSeed + i}`,
    ),
  );
  const whole = el(
    'button',
    {type: 'button', id: 'whole', onclick: () => page.view.go(page.run.begin, page.run.end)},
    'whole run',
  );
  const legend = stateNames.map((name, i) => el('span', {}, swatch(stateColor(i)), name));
  return el(
    'div',
    {class: 'toolbar'},
    el('div', {class: 'group seeds'}, seeds),
    whole,
    el('div', {class: 'legend'}, legend, el('span', {class: 'dim'}, 'dashed: goal')),
    el('span', {class: 'where'}, 'Simulated: transceivers and cables come on top.'),
  );
}

function build(data, app) {
  const page = new Page(data);
  const hosts = Object.fromEntries(
    ['offset', 'state', 'rate', 'histogram', 'followers', 'events'].map((name) => [
      name,
      el('section', {class: `part ${name}`, 'aria-label': name}),
    ]),
  );
  const plots = {
    offset: offsetPlot(hosts.offset, page),
    state: statePlot(hosts.state, page),
    rate: ratePlot(hosts.rate, page),
  };
  const histogram = new Histogram(hosts.histogram, page);
  const redraw = () => {
    hosts.followers.replaceChildren(followersTable(page, toggle));
    hosts.events.replaceChildren(...eventsTable(page).filter(Boolean));
    for (const plot of Object.values(plots)) plot.rebuild();
    histogram.draw();
  };
  const toggle = (n) => {
    if (!page.hidden.delete(n)) page.hidden.add(n);
    redraw();
  };
  app.replaceChildren(
    header(data),
    toolbar(page, redraw),
    hosts.offset,
    hosts.state,
    hosts.rate,
    el('div', {class: 'lower'}, hosts.histogram, hosts.followers, hosts.events),
  );
  redraw();
  return {data, page, view: page.view, plots, histogram};
}

function start() {
  const app = document.getElementById('app');
  try {
    const data = load(document);
    if (data.runs.length === 0) throw new LoadError('there is no run in it');
    document.title = `${data.json.name} – VeriCAN`;
    window.verican = build(data, app);
  } catch (error) {
    const known = error instanceof LoadError;
    const text = known ? error.message : `a mistake in the page: ${error.message}`;
    app.replaceChildren(
      el('p', {class: 'loading error', role: 'alert'}, `The result cannot be shown: ${text}.`),
    );
    window.verican = {error};
    if (!known) throw error;
  }
  document.documentElement.dataset.ready = 'yes';
}

start();
