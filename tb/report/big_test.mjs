// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A hundred thousand frames: the page opens them, and what it draws at once stays bounded.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {
  closeBrowser,
  closeReport,
  inspect,
  itemsOf,
  openBrowser,
  openReport,
  screenshot,
  settle,
  writeScene,
} from './browser.mjs';
import {bigScene} from './scenes.mjs';

const kFrames = 100000;
let scene;
let file;
before(async () => {
  await openBrowser();
  scene = bigScene(kFrames);
  file = writeScene('big', scene);
});
after(closeBrowser);

/** Milliseconds of the redraws since the last call: {count, mean, worst}. */
const redraws = (page) =>
  page.evaluate(() => {
    const times = window.verican.stats.times.splice(0);
    return {
      count: times.length,
      mean: times.reduce((a, b) => a + b, 0) / times.length,
      worst: Math.max(...times),
    };
  });

const say = (text, {count, mean, worst}) =>
  console.log(
    `# ${text}: ${count} redraws, mean ${mean.toFixed(1)} ms, worst ${worst.toFixed(1)} ms`,
  );

test('a hundred thousand frames open, pan, zoom and are searched', async () => {
  const page = await openReport(file, {width: 1600, height: 900});
  console.log(`# opened in ${Math.round(await page.evaluate(() => window.verican.loadMs))} ms`);
  assert.match(await page.textContent('.found'), /^100 000 frames/);
  const frames = await page.evaluate(() => window.verican.report.frames.count);
  assert.equal(frames, kFrames);
  const {width, left} = await inspect(page);
  const bound = 4 * 6 * (width - left); // per column and lane a few things, five lanes
  const modes = new Set();
  await redraws(page);
  let most = 0;
  for (let i = 0; i < 11; ++i) {
    // from the run to a few quanta, with steps to the right
    for (const key of ['ArrowRight', 'ArrowLeft', '+', '+', '+', '+']) {
      await page.keyboard.press(key);
      await settle(page);
      const {drawn, mode} = await page.evaluate(() => ({...window.verican.stats, times: null}));
      modes.add(mode);
      most = Math.max(most, drawn);
      assert.ok(drawn <= bound, `${drawn} things drawn in mode ${mode}, allowed ${bound}`);
    }
    if (i === 0) say('whole run', await redraws(page));
  }
  say('all scales', await redraws(page));
  console.log(`# at most ${most} things in a picture`);
  assert.deepEqual([...modes], ['columns', 'blocks', 'fields', 'bits', 'quanta']);
  const rows = await page.$$eval('#panel-frames .rows .row', (list) => list.length);
  assert.ok(rows > 0 && rows < 60, `${rows} rows are elements`);
  await page.click('#tab-counters');
  await page.keyboard.press('0');
  await settle(page);
  const points = await page
    .waitForFunction(() => {
      const u = window.verican.tabs.entries.find((e) => e.id === 'counters').plot.plot;
      return u?.data[0].length;
    })
    .then((handle) => handle.jsonValue());
  assert.ok(points <= 1700, `${points} points in a plot`);
  await screenshot(page, 'big-counters');
  await closeReport(page);
});

/** A database for the identifiers of the scene: two signals in each of 16 messages. */
const database = Array.from(
  {length: 16},
  (_, i) =>
    `BO_ ${0x100 + 16 * i} M${i}: 8 X\n` +
    ' SG_ A : 0|16@1+ (0.1,0) [0|0] "V" X\n SG_ B : 23|12@0- (1,0) [0|0] "" X\n',
).join('');

/** Bars of the first signal, message 0: extremes of its column, and the value before. */
function judgeBars(picture) {
  const scale = (picture.width - picture.left) / (picture.to - picture.from);
  const wanted = new Map();
  let before = NaN;
  for (const {id, end, data} of scene.scene.log) {
    if (id !== 0x100) continue;
    const value = Math.round(data[0] + 256 * data[1]) / 10;
    const x = Math.floor(picture.left + (end - picture.from) * scale);
    const old = wanted.get(x) ?? {low: before, high: before};
    wanted.set(x, {
      low: Math.min(Number.isNaN(old.low) ? value : old.low, value),
      high: Math.max(Number.isNaN(old.high) ? value : old.high, value),
    });
    before = value;
  }
  const lanes = itemsOf(picture, 'bar');
  const own = lanes.slice(0, wanted.size);
  assert.ok(wanted.size > 500);
  assert.deepEqual(
    own.map(({x, low, high}) => [x, low, high]),
    [...wanted].map(([x, {low, high}]) => [x, low, high]),
  );
}

test('signals of a hundred thousand frames are plotted, searched, and bounded', async () => {
  const page = await openReport(file, {width: 1600, height: 900});
  const ms = await page.evaluate((text) => {
    const begin = performance.now();
    const {report, chosen} = window.verican;
    report.databases.add('big.dbc', text);
    for (const message of report.databases.messages.slice(0, 6))
      chosen.toggle(message, message.signals[0]);
    window.verican.scope.draw();
    return performance.now() - begin;
  }, database);
  console.log(`# six signals decoded and drawn in ${Math.round(ms)} ms`);
  const {width, left} = await inspect(page);
  const bound = 4 * 6 * (width - left) + 6 * 11 * (width - left); // and six lines
  judgeBars(await inspect(page));
  await redraws(page);
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press(i % 4 ? '+' : 'ArrowRight');
    await settle(page);
    const drawn = await page.evaluate(() => window.verican.stats.drawn);
    assert.ok(drawn <= bound, `${drawn} things drawn, allowed ${bound}`);
    if (i === 0) say('whole run with six signals', await redraws(page));
  }
  say('all scales with six signals', await redraws(page));
  const found = await page.evaluate(() => {
    const begin = performance.now();
    window.verican.frames.show('m3');
    return [performance.now() - begin, document.querySelector('.found').textContent];
  });
  console.log(`# searched signals in ${Math.round(found[0])} ms`);
  const count = scene.scene.log.filter(({id}) => id === 0x130).length;
  assert.ok(found[1].replace(/ (?=\d{3}\b)/g, '').startsWith(`${count} of`), found[1]);
  await closeReport(page);
});

test('search and table of a hundred thousand frames', async () => {
  const {log} = scene.scene;
  const page = await openReport(file);
  const id = log[0].id.toString(16);
  const wanted = log.filter((frame) => frame.id === log[0].id).length;
  const ms = await page.evaluate((text) => {
    const begin = performance.now();
    window.verican.frames.input.value = text;
    window.verican.frames.search();
    return performance.now() - begin;
  }, `0x${id}`);
  console.log(`# searched in ${Math.round(ms)} ms`);
  assert.ok(
    (await page.textContent('.found')).replace(/ (?=\d{3}\b)/g, '').startsWith(`${wanted} of`),
  );
  await page.click('#panel-frames .row >> nth=3');
  const view = await page.evaluate(() => window.verican.view.selection);
  const frame = log[view.index];
  assert.equal(frame.id, log[0].id);
  await page.focus('#panel-frames .table');
  await page.keyboard.press('End');
  const last = await page.evaluate(() => window.verican.view.selection.index);
  assert.equal(
    last,
    log.findLastIndex((f) => f.id === log[0].id),
  );
  await closeReport(page);
});
