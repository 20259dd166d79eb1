// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `verican timesync --report` (TM-125): a result written down by hand, whose figures
// are known, and one of the tool.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import * as browser from './browser.mjs';

const {assertColor, closeReport, cssColor, openReport, outDir, pixel, screenshot, settle} = browser;
const template = process.env.VERICAN_TIMESYNC_PAGE;
const kNominal = 62.5 * 2 ** 32; // increment at 16 MHz

/** The result of two followers: 4 looks before they are locked, then -30, 10, -30, 10 ... */
function byHand(change = (json) => json) {
  const looks = 44;
  const at = Array.from({length: looks}, (_, i) => i * 250e9); // ps, four a second
  const errors = (low, high) =>
    at.map((_, i) => (i < 4 ? 5e6 : (i % 2 ? high : low) * 1000));
  const state = (hold) => at.map((_, i) => (i < 4 ? 1 : hold && i >= 40 ? 3 : 2));
  return change({
    format: 1,
    tool: 'verican 0.0.0',
    what: 'two followers <by hand>',
    how: 'model',
    name: 'by <hand>',
    case: {frequency_hz: 16e6, interval_s: 1},
    result: {samples: 76, locked: false, mean_ps: 0, sd_ps: 2e4, max_ps: 41000, between_ps: 71000},
    goal: {sd_ps: 16000, max_ps: 35000},
    ok: false,
    runs: [
      {
        frames: 20, repeated: 0, refused: 0, at_ps: at,
        followers: [
          {error_ps: errors(-30, 10), state: state(false)},
          {error_ps: errors(41, 1), state: state(true)},
        ],
        corrections: {
          at_ps: [0.9e12, 2.1e12, 3.1e12, 10.1e12],
          follower: [0, 0, 1, 1],
          shift_ns: [-5000, 3, 0, 0],
          increment: [kNominal * (1 + 20e-6), kNominal * (1 + 21e-6), kNominal, kNominal],
          events: [8 + 16, 1, 2, 16],
          state: [1, 2, 2, 3],
        },
      },
      {
        frames: 20, repeated: 0, refused: 0, at_ps: at,
        followers: [
          {error_ps: errors(-3, 3), state: state(false)},
          {error_ps: errors(-2, 2), state: state(false)},
        ],
        corrections: {at_ps: [], follower: [], shift_ns: [], increment: [], events: [], state: []},
      },
    ],
  });
}

function written(name, json) {
  const path = join(outDir, `${name}.html`);
  const text = JSON.stringify(json).replaceAll('<', '\\u003c');
  const data = `<script type="application/json" id="verican-meta">${text}</script>`;
  writeFileSync(path, readFileSync(template, 'utf8').replace('<!--VERICAN-META-->', () => data));
  return path;
}

const rows = (page, part) =>
  page.$$eval(`.part.${part} tbody tr`, (list) =>
    list.map((row) => [...row.children].map((cell) => cell.textContent)),
  );
const bars = (page) => page.evaluate(() => window.verican.histogram.bars);
const yRange = (page, plot) =>
  page.evaluate((name) => {
    const {min, max} = window.verican.plots[name].plot.scales.y;
    return [min, max];
  }, plot);
/** CSS place in a plot's canvas of a moment (ns) and a value. */
const placeOf = (page, plot, x, y) =>
  page.evaluate(
    ([name, a, b]) => {
      const u = window.verican.plots[name].plot;
      const scale = window.devicePixelRatio;
      return [u.valToPos(a, 'x', true) / scale, u.valToPos(b, 'y', true) / scale];
    },
    [plot, x, y],
  );
let file;
before(async () => {
  await browser.openBrowser();
  file = written('hand', byHand());
});
after(browser.closeBrowser);

test('the head has figures of all runs, goal and verdict', async () => {
  const page = await openReport(file);
  const head = await page.textContent('.head');
  for (const text of ['by <hand>', 'not locked', '41.0 ns max', '71.0 ns between'])
    assert.match(head, new RegExp(text));
  assert.match(head, /16 ns goal sd.*35 ns goal max.*76 samples/);
  assert.match(head, /two followers <by hand> · how: model/);
  assert.equal(await page.title(), 'by <hand> – VeriCAN');
  await closeReport(page);
  const good = byHand((json) => ({...json, ok: true, result: {...json.result, locked: true}}));
  const other = await openReport(written('good', good));
  assert.match(await other.textContent('.verdict'), /within its goal/);
  await closeReport(other);
  const unlocked = await openReport(written('unlocked', byHand((json) => ({...json, goal: null}))));
  assert.match(await unlocked.textContent('.head'), /not locked/);
  await closeReport(unlocked);
});

test('figures of each follower count what is locked alone', async () => {
  const page = await openReport(file);
  assert.deepEqual(await rows(page, 'followers'), [
    // -30 and 10 in turn: mean -10, sd 20; increments 20 ppm for 1 s of looks, then 21 ppm.
    ['follower 1', '40', '-10.0', '20.0', '30.0', '20.875'],
    ['follower 2', '36', '21.0', '20.0', '41.0', '0.000'],
  ]);
  const failed = await page.$$eval('.part.followers tr.failed', (list) => list.length);
  assert.equal(failed, 1, 'follower 2 is beyond 35 ns');
  await closeReport(page);
});

test('the histogram holds every locked sample of the followers that are shown', async () => {
  const page = await openReport(file);
  const all = await bars(page);
  const count = (value) => all.counts[Math.floor((value - all.first) / all.step)];
  assert.deepEqual([-30, 10, 41, 1].map(count), [20, 20, 18, 18]);
  assert.equal(all.counts.reduce((a, b) => a + b), 76);
  await page.uncheck('#follower-1');
  const one = await bars(page);
  assert.equal(one.counts.reduce((a, b) => a + b), 40);
  await closeReport(page);
});

test('offsets are drawn in the colours of their followers, and goal lines', async () => {
  const page = await openReport(file);
  await settle(page);
  const [low, high] = await yRange(page, 'offset');
  assert.ok(high >= 41 && high < 60 && low === -high, `${low}..${high}: locked samples and goal`);
  await page.evaluate(() => window.verican.view.set(4e9, 4.5e9));
  await settle(page);
  // Between the looks at 4 s (-30 ns) and 4.25 s (10 ns) the line is straight.
  const [x, y] = await placeOf(page, 'offset', 4.125e9, -10);
  const [r, g, b] = await cssColor(page, 'n-0');
  const column = [];
  for (let i = -2; i <= 2; ++i) column.push(await pixel(page, '.offset canvas', x, y + i));
  const hit = column.some((c) => [r, g, b].every((v, i) => Math.abs(c[i] - v) < 24));
  assert.ok(hit, `follower 1 at -10 ns: ${column.join(' | ')}, wanted ${[r, g, b]}`);
  const [, goal] = await placeOf(page, 'offset', 4e9, 35);
  const reds = [];
  for (let i = 0; i < 24; ++i) reds.push(await pixel(page, '.offset canvas', x + i, goal));
  const alarm = await cssColor(page, 'alarm');
  const dashes = reds.filter((c) => c.every((v, i) => Math.abs(v - alarm[i]) < 90));
  assert.ok(dashes.length > 4 && dashes.length < 24, `dashes: ${dashes.length} of 24`);
  await screenshot(page, 'timesync-hand');
  await closeReport(page);
});

test('strips tell the states, and the rate is drawn where it changes', async () => {
  const page = await openReport(file);
  await settle(page);
  const at = async (seconds, n) => {
    const [x, y] = await placeOf(page, 'state', seconds * 1e9, n + 0.5);
    return pixel(page, '.state canvas', x, y);
  };
  const [locked, acquiring, holdover] = [
    await cssColor(page, 'f-data'),
    await cssColor(page, 'passive'),
    await cssColor(page, 'alarm'),
  ];
  assertColor(await at(0.5, 0), acquiring, 'acquiring');
  assertColor(await at(5, 0), locked, 'locked');
  assertColor(await at(10.4, 0), locked, 'locked to the end');
  assertColor(await at(10.4, 1), holdover, 'holdover');
  const rate = await page.evaluate(() => [...window.verican.page.run.followers[0].rate]);
  const ppm = (index) => Math.round(1e3 * rate[index]) / 1e3;
  assert.deepEqual([ppm(3), ppm(4), ppm(8), ppm(9)], [0, 20, 20, 21]);
  const [low, high] = await yRange(page, 'rate');
  assert.ok(high >= 0.875 && high < 1.1 && low === -high, `${low}..${high} ppm around the mean`);
  await closeReport(page);
});

test('events have their words; a click goes there, and all plots follow', async () => {
  const page = await openReport(file);
  assert.deepEqual(await rows(page, 'events'), [
    ['0.900', '1', 'step, new state', '-5 000', 'acquiring'],
    ['3.100', '2', 'outlier dropped', '0', 'locked'],
    ['10.100', '2', 'new state', '0', 'holdover'],
  ]);
  await page.click('.part.events tbody tr >> nth=1');
  await settle(page);
  const windows = await page.evaluate(() =>
    Object.values(window.verican.plots).map(({plot}) => [plot.scales.x.min, plot.scales.x.max]),
  );
  for (const [from, to] of windows) {
    assert.deepEqual([from, to], windows[0]);
    assert.ok(from < 3.1e9 && 3.1e9 < to && to - from < 5e9, `${from}..${to}`);
  }
  await page.click('#whole');
  await settle(page);
  const {from, to} = await browser.viewOf(page);
  assert.ok(from <= 0 && to >= 10.75e9);
  await page.uncheck('#follower-1');
  assert.equal((await rows(page, 'events')).length, 1);
  await closeReport(page);
});

test('each seed has its own samples', async () => {
  const page = await openReport(file);
  await page.click('text=seed 2');
  const [first, second] = await rows(page, 'followers');
  assert.deepEqual(first.slice(0, 5), ['follower 1', '40', '0.0', '3.0', '3.0']);
  assert.deepEqual(second.slice(0, 5), ['follower 2', '40', '0.0', '2.0', '2.0']);
  assert.equal((await bars(page)).counts.reduce((a, b) => a + b), 80);
  await closeReport(page);
});

test('seeds have their numbers', async () => {
  const page = await openReport(
    written('seeds', byHand((json) => ({...json, case: {...json.case, first_seed: 17}}))),
  );
  assert.deepEqual(
    await page.$$eval('.seeds button', (list) => list.map((button) => button.textContent)),
    ['seed 17', 'seed 18'],
  );
  await closeReport(page);
});

// docs/timesync.md: with --master-cut errors count from the first lock on, whatever the state.
test('of a cut master all counts from the first lock on', async () => {
  const cut = byHand((json) => {
    const [run] = json.runs;
    run.followers[1].error_ps[42] = 90e3; // in holdover
    return {...json, case: {...json.case, master_cut: true}, runs: [run]};
  });
  const page = await openReport(written('cut', cut));
  // Of looks 4 to 43 half are 41 ns, one of these 90 now, and half are 1 ns.
  const mean = (19 * 41 + 20 * 1 + 90) / 40;
  const sd = Math.sqrt((19 * 41 ** 2 + 20 * 1 + 90 ** 2) / 40 - mean ** 2);
  const [, second] = await rows(page, 'followers');
  assert.deepEqual(second.slice(0, 5), [
    'follower 2',
    '40',
    mean.toFixed(1),
    sd.toFixed(1),
    '90.0',
  ]);
  assert.equal((await bars(page)).counts.reduce((a, b) => a + b), 80);
  const [, high] = await yRange(page, 'offset');
  assert.ok(high >= 90, `the offset plot ends at ${high} ns`);
  assert.match(await page.innerHTML('.head'), /Of each follower from its first lock on, all runs/);
  await closeReport(page);
  const other = await openReport(file);
  assert.match(await other.innerHTML('.head'), /Of each follower while locked, all runs/);
  await closeReport(other);
});

test('a file without data, or of another format, says so', async () => {
  const cases = [
    ['damaged', (text) => text.replace(/"format":1/, '"format":'), /data of the page is damaged/],
    ['format', (text) => text.replace(/"format":1/, '"format":2'), /has format 2/],
    ['empty', (text) => text.replace(/<script type="application.*<\/script>/, ''), /is missing/],
  ];
  for (const [name, change, words] of cases) {
    const path = join(outDir, `${name}.html`);
    writeFileSync(path, change(readFileSync(file, 'utf8')));
    const page = await openReport(path);
    assert.match(await page.textContent('[role=alert]'), words);
    await closeReport(page);
  }
});

test("the tool's page has what its JSON has", async () => {
  const path = join(outDir, 'tool.html');
  const args = ['--filter', 'automatic', '--followers', '3', '--intervals', '60', '--seeds', '2'];
  const text = execFileSync(
    process.env.VERICAN_BINARY,
    ['timesync', ...args, '--json', '--report', path],
    {encoding: 'utf8', maxBuffer: 1 << 28},
  );
  const json = JSON.parse(text);
  const page = await openReport(path, {width: 1500, height: 900});
  const shown = await rows(page, 'followers');
  assert.equal(shown.length, 3);
  json.runs[0].followers.forEach(({error_ps, state}, n) => {
    const locked = error_ps.filter((_, i) => state[i] === 2);
    const most = Math.max(...locked.map(Math.abs)) / 1e3;
    assert.equal(shown[n][1], String(locked.length));
    assert.equal(shown[n][4], most.toFixed(1));
  });
  assert.match(await page.textContent('.head'), /this case.*16 MHz .*N = automatic, 3 followers/);
  const drift = await page.evaluate(() =>
    window.verican.page.run.followers.map(({meanRate}) => meanRate),
  );
  for (const ppm of drift) assert.ok(Math.abs(ppm) > 0.01 && Math.abs(ppm) <= 201, `${ppm} ppm`);
  await settle(page);
  await screenshot(page, 'timesync-tool');
  await closeReport(page);
});
