// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page under hands: wheel, drag, keys, touch of the address, dark screens, and broken files.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {
  assertColor,
  closeReport,
  cssColor,
  inspect,
  itemsOf,
  openReport,
  pixel,
  reportFor,
  rowsOf,
  screenshot,
  setView,
  viewOf,
  writeScene,
} from './browser.mjs';
import {smallScene} from './scenes.mjs';

const small = smallScene();
const {log, bit} = small.scene;
const file = reportFor('input', small);

const near = (a, b, tolerance, text) =>
  assert.ok(Math.abs(a - b) <= tolerance, `${text}: ${a}, wanted ${b}`);

/** Box of the upper canvas on the screen, and the time under a point of it. */
async function scopeBox(page) {
  const {left, width} = await inspect(page);
  const {from, to} = await viewOf(page);
  return {
    left,
    plot: width - left,
    time: (x) => from + ((x - left) * (to - from)) / (width - left),
    x: (ns) => left + ((ns - from) * (width - left)) / (to - from),
  };
}

test('the wheel zooms at the pointer, from the whole run to a single quantum', async () => {
  const page = await openReport(file);
  const target = log[2].time + 30.4 * bit;
  const modes = new Set();
  for (let i = 0; i < 60; ++i) {
    const box = await scopeBox(page);
    const outer = await (await page.$('.scope-top')).boundingBox();
    const x = Math.round(box.x(target));
    await page.mouse.move(outer.x + x, outer.y + 60);
    const under = box.time(x);
    const {from: a, to: b} = await viewOf(page);
    await page.mouse.wheel(0, -200);
    await page.waitForFunction((span) => window.verican.view.span < span, b - a);
    const after = await scopeBox(page);
    near(
      after.time(x),
      under,
      0.01 * bit + 0.002 * (after.time(after.left + after.plot) - after.time(after.left)),
      'time under the pointer',
    );
    const picture = await inspect(page);
    modes.add(picture.mode);
    if (picture.to - picture.from < 0.2 * bit) break;
  }
  assert.deepEqual([...modes], ['fields', 'bits', 'quanta']);
  const {from, to} = await viewOf(page);
  assert.ok(
    to - from < 0.2 * bit && from < target && target < to,
    'less than two quanta, and the place is in sight',
  );
  await screenshot(page, 'input-quantum');
  await closeReport(page);
});

test('dragging moves the view by as much as the pointer went; a box zooms to it', async () => {
  const page = await openReport(file);
  await setView(page, log[1].time, log[1].end);
  const before = await viewOf(page);
  const box = await scopeBox(page);
  const outer = await (await page.$('.scope-top')).boundingBox();
  const drag = async (a, b) => {
    await page.mouse.move(outer.x + a, outer.y + 90);
    await page.mouse.down();
    await page.mouse.move(outer.x + (a + b) / 2, outer.y + 90, {steps: 4});
    await page.mouse.move(outer.x + b, outer.y + 90);
    await page.mouse.up();
  };
  await drag(700, 500);
  const after = await viewOf(page);
  near(
    after.from,
    before.from + (200 * (before.to - before.from)) / box.plot,
    0.01 * bit,
    'view after a drag',
  );
  near(after.to - after.from, before.to - before.from, 1, 'same scale');
  const again = await scopeBox(page);
  const [a, b] = [again.time(400), again.time(600)];
  await page.keyboard.down('Shift');
  await drag(400, 600);
  await page.keyboard.up('Shift');
  const boxed = await viewOf(page);
  near(boxed.from, a, 0.05 * bit, 'left end of the box');
  near(boxed.to, b, 0.05 * bit, 'right end of the box');
  await closeReport(page);
});

test('a row of the table moves the view; a click in the picture marks its row', async () => {
  const page = await openReport(file);
  await page.click('#panel-frames .row:has-text("DE AD BE EF")');
  const frame = log.find(({id}) => id === 0x2aa);
  let view = await viewOf(page);
  assert.ok(
    view.from < frame.time &&
      view.to > frame.end &&
      view.to - view.from < 1.5 * (frame.end - frame.time),
  );
  assert.deepEqual(view.selection, {kind: 'frame', index: log.indexOf(frame)});
  await page.keyboard.press('0');
  const box = await scopeBox(page);
  const other = log[1];
  await page.click('.scope-top', {position: {x: box.x((other.time + other.end) / 2), y: 60}});
  view = await viewOf(page);
  assert.deepEqual(view.selection, {kind: 'frame', index: 1});
  assert.deepEqual(
    await page.$$eval('#panel-frames .row.current', (rows) =>
      rows.map((row) => row.children[1].textContent),
    ),
    ['00A'],
  );
  assert.match(await page.textContent('.details'), /Frame 00A/);
  assert.equal(itemsOf(await inspect(page), 'selection').length, 2, 'marked in both pictures');
  await closeReport(page);
});

test('the keyboard does it all', async () => {
  const page = await openReport(file);
  await page.keyboard.press('n');
  assert.deepEqual((await viewOf(page)).selection?.kind, 'frame');
  const first = (await viewOf(page)).selection.index;
  await page.keyboard.press('n');
  assert.equal((await viewOf(page)).selection.index, Math.min(first + 1, log.length - 1));
  await page.keyboard.press('Escape');
  assert.equal((await viewOf(page)).selection, null);
  await page.keyboard.press('0');
  await page.keyboard.press('Home');
  await page.keyboard.press('e');
  assert.equal((await viewOf(page)).selection.kind, 'event');
  const {from, to} = await viewOf(page);
  await page.keyboard.press('ArrowRight');
  near((await viewOf(page)).from, from + 0.1 * (to - from), 1, 'a tenth to the right');
  await page.keyboard.press('+');
  near((await viewOf(page)).to - (await viewOf(page)).from, 0.6 * (to - from), 1, 'zoomed in');
  await page.keyboard.press('3');
  assert.equal((await inspect(page)).mode, 'quanta');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('dialog.help'));
  await page.keyboard.press('Escape');
  await page.waitForSelector('dialog.help', {state: 'hidden'});
  await page.keyboard.press('/');
  await page.waitForSelector('#search:focus');
  await page.keyboard.type('333');
  await page.waitForFunction(() =>
    document.querySelector('.found').textContent.startsWith('1 of 10'),
  );
  await page.focus('#panel-frames .table');
  await page.keyboard.press('End');
  assert.deepEqual((await viewOf(page)).selection, {kind: 'frame', index: log.length - 1});
  await page.focus('#tab-frames');
  await page.keyboard.press('ArrowRight');
  assert.ok(await page.isVisible('#panel-events'));
  await closeReport(page);
});

test('a key right after the help is closed counts', async () => {
  const page = await openReport(file);
  await page.keyboard.press('?');
  await page.evaluate(() => {
    // Until the browser has drawn the page anew, the focus may stay in the closed dialog.
    const dialog = document.querySelector('dialog.help');
    dialog.close();
    dialog.dispatchEvent(new KeyboardEvent('keydown', {key: '/', bubbles: true}));
  });
  assert.ok(await page.isVisible('#search:focus'));
  await closeReport(page);
});

test('the address keeps view and selection', async () => {
  const page = await openReport(file);
  await page.click('#panel-frames .row:has-text("DE AD BE EF")');
  await page.waitForFunction(() => location.hash.includes('sel=frame.'));
  const hash = await page.evaluate(() => location.hash);
  const view = await viewOf(page);
  await closeReport(page);
  const again = await openReport(file, {hash});
  const other = await viewOf(again);
  near(other.from, view.from, 0.01, 'from');
  near(other.to, view.to, 0.01, 'to');
  assert.deepEqual(other.selection, view.selection);
  await closeReport(again);
  const wrong = await openReport(file, {hash: '#from=1&to=5000&sel=frame.999999'});
  assert.equal((await viewOf(wrong)).selection, null);
  await closeReport(wrong);
});

test('the overview moves the view', async () => {
  const page = await openReport(file);
  await setView(page, 0, 100 * bit);
  const outer = await (await page.$('.overview')).boundingBox();
  // A click on the element waits until it stays where it is.
  await page.click('.overview', {position: {x: 118 + 0.75 * (outer.width - 118), y: 20}});
  await page.waitForFunction(() => window.verican.view.from !== 0);
  const view = await viewOf(page);
  const limits = await page.evaluate(() => [window.verican.view.least, window.verican.view.most]);
  near(
    (view.from + view.to) / 2,
    limits[0] + 0.75 * (limits[1] - limits[0]),
    2 * bit,
    'middle of the view',
  );
  await closeReport(page);
});

test('a frame is copied as a line of candump', async () => {
  const page = await openReport(file);
  await page.click('#panel-frames .row:has-text("CA FE")');
  await page.keyboard.press('c');
  await page.waitForSelector('.toast:visible');
  assert.equal(await page.textContent('.toast'), 'Copied: (0000000001.000020) can0 123#CAFE');
  const lines = await page.evaluate(() => window.verican.report.frames.count);
  assert.equal(lines, log.length);
  await closeReport(page);
});

test('its time is that of the log of the run, cut to microseconds', async () => {
  for (const [origin, text] of [
    [88875.25, '0000000001.000108'],
    [88999.999, '0000000001.000108'],
    [89000, '0000000001.000109'],
    [3600e9, '0000003601.000020'],
  ]) {
    const scene = smallScene();
    scene.meta.origin_ns = origin;
    const page = await openReport(writeScene('origin', scene));
    await page.click('#panel-frames .row:has-text("CA FE")');
    assert.equal(await page.textContent('.details .candump'), `(${text}) can0 123#CAFE`);
    await closeReport(page);
  }
});

test('dark screens get dark pictures', async () => {
  const page = await openReport(file, {dark: true});
  const dark = await cssColor(page, 'panel');
  assert.ok(dark.every((c) => c < 60));
  assertColor(await pixel(page, '.scope-top', 4, 120), dark, 'ground of the scope');
  await screenshot(page, 'input-dark');
  await page.emulateMedia({colorScheme: 'light'});
  await page.waitForFunction(() => {
    const canvas = document.querySelector('.scope-top');
    return canvas.getContext('2d').getImageData(4, 120, 1, 1).data[0] > 200;
  });
  await closeReport(page);
});

test('text of a scenario stays text', async () => {
  const page = await openReport(
    writeScene(
      'hostile',
      smallScene({title: '</script><img src=x onerror=alert(1)>', note: '<i>note</i>'}),
    ),
  );
  assert.equal(await page.textContent('h1'), '</script><img src=x onerror=alert(1)>');
  assert.equal(await page.$$eval('#app img, #app .note i', (found) => found.length), 0);
  await page.fill('#search', 'door <b>');
  await page.waitForFunction(() => document.querySelector('.found').textContent.startsWith('1 of'));
  assert.equal((await rowsOf(page, 'frames'))[0][6], 'door <b>');
  await closeReport(page);
});

const spoiled = {
  'not base64': [
    (p) => ({...p, text: `${p.text.slice(0, 100)}!${p.text.slice(101)}`}),
    /not base64/,
  ],
  'cut short': [
    (p) => ({...p, text: p.text.slice(0, Math.floor(p.text.length / 8) * 4)}),
    /damaged|ends early/,
  ],
  'one bit wrong': [
    (p) => ({
      ...p,
      text: p.text.replace(/^(.{200})(.)/, (_, head, c) => head + (c === 'A' ? 'B' : 'A')),
    }),
    /damaged/,
  ],
  'another format': [
    (p) => ({...p, meta: {...p.meta, format: 7}}),
    /format 7; this page reads format 1/,
  ],
  'an array missing': [
    (p) => ({...p, meta: {...p.meta, arrays: p.meta.arrays.filter(({name}) => name !== 'f.dlc')}}),
    /no array f\.dlc/,
  ],
  'longer than it is': [
    (p) => ({
      ...p,
      meta: {...p.meta, arrays: p.meta.arrays.map((a) => ({...a, length: a.length + 1e5}))},
    }),
    /ends early/,
  ],
};
for (const [name, [change, message]] of Object.entries(spoiled)) {
  test(`a damaged file says so: ${name}`, async () => {
    const page = await openReport(
      writeScene(`spoiled-${name.replaceAll(' ', '-')}`, small, change),
    );
    assert.match(await page.textContent('[role=alert]'), message);
    await closeReport(page);
  });
}

test('a page without a report says so', async () => {
  const page = await openReport(process.env.VERICAN_REPORT_PAGE);
  assert.match(await page.textContent('[role=alert]'), /no report in it/);
  await closeReport(page);
});

test('a browser that cannot decompress says so', async () => {
  const page = await openReport(file, {fresh: true});
  const context = page.context();
  await context.addInitScript(() => {
    delete globalThis.DecompressionStream;
  });
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  assert.match(await page.textContent('[role=alert]'), /cannot decompress/);
  assert.deepEqual(page.problems, []);
  await context.close();
});
