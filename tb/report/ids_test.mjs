// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The tab of identifiers: counts and periods against a scene whose times are known.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import * as browser from './browser.mjs';
import {Scene} from './scene.mjs';

const {closeReport, openReport, rowsOf, saved, screenshot, viewOf} = browser;

/** Four frames of 123 at uneven distances, two of the extended 123, two requests and an answer. */
function periodScene() {
  const scene = new Scene(['left', 'right'], {title: 'Periods, "quoted"'});
  const at = (bits) => ({gap: bits - scene.now / scene.bit});
  const data = (...bytes) => ({dlc: bytes.length, data: bytes});
  const messages = [{name: 'speed', node: 0, id: 0x123}];
  scene.frame(0, {id: 0x123, ...data(1, 2, 3)}, {...at(1000), message: 0});
  scene.frame(1, {id: 0x123, extended: true, ...data(9)}, at(1200));
  scene.frame(0, {id: 0x123, ...data(1, 7, 3)}, {...at(1500), message: 0});
  scene.frame(0, {id: 0x7f0, remote: true, dlc: 2}, at(1700));
  scene.frame(1, {id: 0x7f0, ...data(0xab, 0xcd)}, at(1900));
  scene.frame(0, {id: 0x123, ...data(1, 7, 3)}, {...at(2100), message: 0});
  scene.frame(0, {id: 0x7f0, remote: true, dlc: 2}, at(2300));
  scene.frame(0, {id: 0x123, ...data(1, 2, 3, 4)}, {...at(2500), message: 0});
  scene.frame(1, {id: 0x123, extended: true, ...data(9)}, at(2700));
  const full = messages.map((m) => ({
    ...m,
    extended: false,
    remote: false,
    period_ns: 0,
    queued: 4,
    sent: 4,
    shortest_ns: 0,
    mean_ns: 0,
    longest_ns: 0,
    bound_ns: null,
  }));
  return {scene, ...scene.finish({messages: full})};
}

// Periods of 123 in bits of 2 us: 500, 600, 400. Mean 500, variance (0 + 100^2 + 100^2) / 3.
const jitter = ((Math.sqrt(20000 / 3) * 2) / 1000).toFixed(4);
const single = ['–', '–', '–', '–'];
const wanted = [
  [
    '123',
    'speed',
    'left',
    '4',
    '1.000',
    '0.800',
    '1.200',
    jitter,
    '01 02 03 04',
    '1 3',
    '2.000',
    '5.000',
  ],
  ['7F0', '', 'right', '1', ...single, 'AB CD', '', '3.800', '3.800'],
  ['00000123', '', 'right', '2', '3.000', '3.000', '3.000', '0.0000', '09', '', '2.400', '5.400'],
  ['7F0', '', 'left', '2', '1.200', '1.200', '1.200', '0.0000', 'remote', '', '3.400', '4.600'],
];
const file = browser.reportFor('ids', periodScene());

test('count, period, jitter, data and changed bytes are those of the scene', async () => {
  const page = await openReport(file, {width: 1600});
  await page.click('#tab-ids');
  const rows = (await rowsOf(page, 'ids')).map((row) => row.map((text) => text.trim()));
  assert.deepEqual(rows, wanted);
  const marked = await page.$$eval('#panel-ids .rows .row', (list) =>
    list.map((row) => [...row.querySelectorAll('.changed')].map((b) => b.textContent)),
  );
  assert.deepEqual(
    marked,
    [['02', '04'], [], [], []],
    'bytes that were not the same in all frames',
  );
  const ground = await page.$eval('.changed', (b) => getComputedStyle(b).backgroundColor);
  assert.notEqual(ground, 'rgba(0, 0, 0, 0)', 'they stand on a colour');
  await screenshot(page, 'ids');
  await closeReport(page);
});

test('identifiers that several nodes send are marked', async () => {
  const scene = new Scene(['left', 'right'], {title: 'Shared'});
  const [data, empty, request] = [{dlc: 1, data: [7]}, {dlc: 0, data: []}, {remote: true, dlc: 1}];
  for (const node of [0, 1]) {
    scene.frame(node, {id: 0x100, ...data});
    scene.frame(node, {id: 0x402, ...empty});
    scene.frame(node, {id: 0x500, ...request});
    scene.frame(node, {id: 0x600 + node, ...data});
  }
  const shared = browser.writeScene('ids-shared', scene.finish());
  const page = await openReport(shared, {width: 1600});
  await page.click('#tab-ids');
  const marked = await page.$$eval('#panel-ids .rows .row:has(.alarm)', (rows) =>
    rows.map((row) => row.textContent.slice(0, 3)),
  );
  assert.deepEqual(marked, ['100'], 'not frames without data, and not requests');
  assert.equal(await page.textContent('#panel-ids .shared'), 'Sent by several nodes: 100');
  await closeReport(page);

  const other = await openReport(file, {width: 1600});
  await other.click('#tab-ids');
  assert.equal(await other.textContent('#panel-ids .shared'), '');
  await closeReport(other);
});

test('it sorts, filters, and leads to the frames of an identifier', async () => {
  const page = await openReport(file, {width: 1600});
  await page.click('#tab-ids');
  const ids = async () => (await rowsOf(page, 'ids')).map(([id]) => id);
  await page.click('#panel-ids .head button:has-text("period")');
  assert.deepEqual(await ids(), ['123', '7F0', '00000123', '7F0']);
  await page.click('#panel-ids .head button:has-text("period")');
  assert.deepEqual(await ids(), ['00000123', '7F0', '123', '7F0']);
  for (const [text, list] of [
    ['7f', ['7F0', '7F0']],
    ['speed', ['123']],
    ['right', ['00000123', '7F0']],
    ['0x123', ['00000123', '123']],
    ['nothing', []],
  ]) {
    await page.fill('#panel-ids input', text);
    assert.deepEqual(await ids(), list, text);
  }
  await page.fill('#panel-ids input', '');
  await page.click('#panel-ids .row:has-text("7F0")');
  assert.ok(await page.isVisible('#panel-frames'));
  assert.deepEqual(
    (await rowsOf(page, 'frames')).map((row) => [row[1], row[2]]),
    [
      ['7F0', 'remote'],
      ['7F0', 'remote'],
    ],
  );
  assert.deepEqual((await viewOf(page)).selection, {kind: 'frame', index: 3});
  await page.click('#tab-ids');
  await page.click('#panel-ids .row:has-text("00000123")');
  assert.deepEqual(
    (await rowsOf(page, 'frames')).map((row) => row[1]),
    ['00000123', '00000123'],
    'not those of the 11-bit identifier',
  );
  await closeReport(page);
});

test('CSV holds what the table shows: filter, order, bytes', async () => {
  const page = await openReport(file, {width: 1600});
  await page.click('#tab-ids');
  await page.click('#panel-ids .head button:has-text("period")');
  await page.fill('#panel-ids input', '123');
  const {name, text} = await saved(page, '#panel-ids button.csv');
  assert.equal(name, 'Periods-quoted-identifiers.csv');
  const heads =
    'id,message,from,count,"period, ms","min, ms","max, ms","jitter, ms",last data,changed bytes,' +
    '"first, ms","last, ms"';
  assert.deepEqual(text.split('\r\n'), [heads, wanted[0].join(','), wanted[2].join(','), '']);
  await page.click('#tab-frames');
  await page.fill('#search', 'remote');
  await page.waitForFunction(() => document.querySelector('.found').textContent.startsWith('2 of'));
  const frames = await saved(page, '#panel-frames button.csv');
  assert.equal(
    frames.text,
    '"time, ms",id,type,dlc,node,data,message,"response, ms",retries,lost\r\n' +
      '3.400000,7F0,remote,2,left,,,–,,\r\n4.600000,7F0,remote,2,left,,,–,,\r\n',
  );
  await closeReport(page);
});
