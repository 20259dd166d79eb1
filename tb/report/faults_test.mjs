// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults on the page: where they are drawn, what is said of them, how one gets to their moments.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import * as browser from './browser.mjs';
import {smallScene} from './scenes.mjs';

const {assertColor, closeReport, cssColor, inspect, itemsOf, openReport} = browser;
const {pixel, rowsOf, screenshot, setView, viewOf, writeScene} = browser;

const plain = smallScene();
const {log, bit} = plain.scene;
const errorAt = log.find(({id}) => id === 0x2aa).time - 60 * bit; // in the attempt that fails

/** Three faults of which one never took effect; times in ns. */
const faults = [
  {
    name: 'bad receiver',
    kind: 'flip',
    node: 'right',
    text: 'flips what right reads',
    hits: 4,
    times_ns: [
      [log[1].time, log[1].time + 2 * bit],
      [log[2].time + 2 * bit, log[2].time + 3 * bit],
      [errorAt, errorAt + bit],
      [log[4].time + 5 * bit, log[4].time + 6 * bit],
    ],
    line: 21,
  },
  {
    name: '',
    kind: 'cut',
    node: 'all',
    text: 'the cable is open',
    hits: 12000,
    times_ns: [
      [0, 40000],
      [log[2].time, log[2].end],
    ],
    more: true,
    line: 30,
  },
  {
    name: 'too late',
    kind: 'dominant',
    node: 'left',
    text: 'DLC bit 9',
    hits: 0,
    times_ns: [],
    line: 33,
  },
];
const scene = smallScene({faults});
const file = browser.reportFor('faults', scene);

const xOf = (picture, ns) =>
  picture.left +
  ((ns - picture.from) * (picture.width - picture.left)) / (picture.to - picture.from);

test('a fault is drawn where it acts, with its name, over the node that it touches', async () => {
  const page = await openReport(file);
  await setView(page, log[1].time - 10 * bit, log[1].time + 30 * bit);
  const picture = await inspect(page);
  const [drawn, ...others] = itemsOf(picture, 'fault');
  assert.deepEqual(others, []);
  assert.equal(drawn.fault, 0);
  assert.ok(Math.abs(drawn.x0 - xOf(picture, log[1].time)) < 0.01, 'begins with the fault');
  assert.ok(Math.abs(drawn.x1 - xOf(picture, log[1].time + 2 * bit)) < 0.01, 'ends with it');
  assert.deepEqual(
    itemsOf(picture, 'faultname').map(({name}) => name),
    ['bad receiver'],
  );
  assert.deepEqual(
    itemsOf(picture, 'faultshade').map(({node}) => node),
    [-1, 2],
    'the bus and the node that it touches, no other',
  );
  const high = await page.$eval('.scope-top', (canvas) => canvas.clientHeight);
  const shades = [];
  for (let x = drawn.x0 + 1; x < drawn.x0 + 8; ++x)
    shades.push(await pixel(page, '.scope-top', x, high - 5));
  const fault = await cssColor(page, 'fault');
  assertColor(
    shades.reduce((a, b) => (a[0] > b[0] ? a : b)),
    fault,
    'row of faults',
  );
  await screenshot(page, 'faults-drawn');
  await closeReport(page);
});

test('a fault of no particular node shades all lanes; a short one is seen from afar', async () => {
  const page = await openReport(file);
  await setView(page, -5 * bit, 15 * bit);
  const lanes = itemsOf(await inspect(page), 'faultshade').map(({node}) => node);
  assert.deepEqual(lanes, [-1, 0, 1, 2]);
  await page.keyboard.press('0');
  const picture = await inspect(page);
  const widths = itemsOf(picture, 'fault').map(({x0, x1}) => x1 - x0);
  assert.equal(widths.length, 6);
  assert.ok(Math.min(...widths) >= 3, `${widths} px wide`);
  const marks = await page.evaluate(() => {
    const {overview} = window.verican;
    overview.painter.items = [];
    overview.draw();
    return overview.painter.items.filter(({kind}) => kind === 'fault').length;
  });
  assert.ok(marks >= 4, `${marks} marks in the overview`);
  await closeReport(page);
});

test('a fault that is over is not drawn, one that began before it still is', async () => {
  const page = await openReport(file);
  await setView(page, log[2].time + 10 * bit, log[2].time + 20 * bit);
  const drawn = itemsOf(await inspect(page), 'fault').map(({fault, hit}) => [fault, hit]);
  assert.deepEqual(drawn, [[1, 1]]);
  await closeReport(page);
});

test('the list says how often each took effect; a click goes to the moments in turn', async () => {
  const page = await openReport(file);
  assert.equal(await page.textContent('#tab-faults'), 'Faults (3)');
  await page.click('#tab-faults');
  const ms = (ns) => (ns / 1e6).toFixed(6);
  const times = faults[0].times_ns;
  assert.deepEqual(await rowsOf(page, 'faults'), [
    [
      'bad receiver',
      'flip',
      'right',
      '4',
      ms(times[0][0]),
      ms(times[3][0]),
      'flips what right reads',
      '21',
    ],
    ['cut', 'cut', 'all', '12 000, 2 kept', ms(0), ms(log[2].time), 'the cable is open', '30'],
    ['too late', 'dominant', 'left', '0, never', '–', '–', 'DLC bit 9', '33'],
  ]);
  assert.match(await page.textContent('#panel-faults .search'), /1 of 3 never took effect/);
  for (const hit of [0, 1, 2, 3, 0]) {
    await page.click('#panel-faults .row:has-text("bad receiver")');
    const {from, to, selection} = await viewOf(page);
    assert.deepEqual(selection, {kind: 'fault', index: 0, hit});
    assert.ok(from < times[hit][0] && to > times[hit][1], `moment ${hit} is in sight`);
  }
  await page.click(`.moments button:has-text("${ms(times[1][0])}")`);
  assert.equal((await viewOf(page)).selection.hit, 1);
  await page.waitForFunction(() => location.hash.endsWith('sel=fault.0.1'));
  await page.click('#panel-faults .row:has-text("too late")');
  assert.match(await page.textContent('.details'), /Fault too late.*took effectnever/);
  await closeReport(page);
});

test('an error names the fault that acted before it; the note of the pointer too', async () => {
  const page = await openReport(file, {hash: `#from=0&to=${log[0].end}&sel=fault.0.3`});
  assert.deepEqual((await viewOf(page)).selection, {kind: 'fault', index: 0, hit: 3});
  await page.click('#tab-events');
  await page.click('#panel-events .row:has-text("wrong checksum")');
  assert.match(await page.textContent('.details'), /faults before itbad receiver/);
  await page.click('.details button.link');
  assert.deepEqual((await viewOf(page)).selection, {kind: 'fault', index: 0, hit: 2});
  const picture = await inspect(page);
  const box = await (await page.$('.scope-top')).boundingBox();
  await page.mouse.move(box.x + xOf(picture, errorAt + bit / 2), box.y + box.height - 8);
  assert.match(
    await page.textContent('.tooltip'),
    /fault bad receiver: flips what right reads \(took effect 4 times\)/,
  );
  await closeReport(page);
});

test('thousands of moments are drawn as columns', async () => {
  const many = Array.from({length: 5000}, (_, i) => [i * 2000, i * 2000 + 500]);
  const one = {
    name: 'noise',
    kind: 'noise',
    node: 'all',
    text: 'glitches',
    hits: 9e4,
    times_ns: many,
    more: true,
    line: 3,
  };
  const page = await openReport(writeScene('faults-many', smallScene({faults: [one]})));
  const picture = await inspect(page);
  assert.equal(itemsOf(picture, 'faultcolumns').length, 1);
  assert.ok(picture.drawn < 6 * 4 * (picture.width - picture.left));
  await closeReport(page);
});

test('a report without faults has neither row nor tab', async () => {
  const page = await openReport(writeScene('faults-none', plain));
  assert.equal(await page.$('#tab-faults'), null);
  assert.deepEqual(itemsOf(await inspect(page), 'fault'), []);
  const hash = '#from=0&to=9000&sel=fault.0.0';
  await closeReport(page);
  const wrong = await openReport(writeScene('faults-none', plain), {hash});
  assert.equal((await viewOf(wrong)).selection, null);
  await closeReport(wrong);
});
