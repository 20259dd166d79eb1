// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The tool with faults and a database on its command line: the page has the faults with their hits,
// and messages and signals by name.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import * as browser from './browser.mjs';

const {closeReport, inspect, itemsOf, openReport, outDir, rowsOf, setView, viewOf} = browser;

const scenario = `bitrate: 500k
duration: 42 ms
nodes:
  - {name: engine}
  - {name: display}
traffic:
  - {node: engine, name: speed, id: 0x100, data: 80 25 00 20 3C 00 00 00, period: 10 ms, count: 4}
  - {node: display, name: fuel, id: 0x200, data: 01 7D 00 00, offset: 5 ms}
  - {node: display, name: other, id: 0x321, data: CA FE, offset: 6 ms}
faults:
  - {kind: flip, name: torn, at: {node: engine, frame: 4, field: CRC, bit: 0}}
  - {kind: cut, name: unseen, node: display, from: 36 ms, for: 1 ms, hits: {min: 0}}
  - {kind: short, name: stuck, node: display, from: 40 ms, for: 20 us}
`;
const speed = 'EngineSpeed 2400 rpm, Torque 0 Nm, Mode Sport, CoolantTemperature 20 degC';
const fuel = 'Page 1, FuelLevel 62.5 %';
const file = join(outDir, 'tool.html');
let result = null;

before(async () => {
  await browser.openBrowser();
  const path = join(outDir, 'tool.yaml');
  writeFileSync(path, scenario);
  const dbc = ['--dbc', 'examples/engine.dbc'];
  const output = execFileSync(
    process.env.VERICAN_BINARY,
    ['run', path, ...dbc, '--report', file, '--json'],
    {encoding: 'utf8'},
  );
  [result] = JSON.parse(output).runs;
});
after(browser.closeBrowser);

test('rows of the faults have their hits and times', async () => {
  const page = await openReport(file);
  assert.equal(await page.textContent('#tab-faults'), 'Faults (3)');
  await page.click('#tab-faults');
  const rows = await rowsOf(page, 'faults');
  // The bus is idle: after six dominant bits the error flags of all are dominant, too.
  assert.deepEqual(
    rows.map(([name, kind, node, hits, , , , line]) => [name, kind, node, hits, line]),
    [
      ['torn', 'flip', 'engine', '1', '11'],
      ['unseen', 'cut', 'display', '0, never', '12'],
      ['stuck', 'short', 'display', '6', '13'],
    ],
  );
  assert.deepEqual(
    rows.map(([, , , , first]) => first),
    result.faults.map(({times_ps: [time]}) => (time ? (time[0] / 1e9).toFixed(6) : '–')),
  );
  const [torn, , stuck] = rows.map(([, , , , first]) => Number(first));
  assert.ok(torn > 10 && torn < 10.3, `${torn} ms, in the fourth frame`);
  assert.ok(stuck >= 40 && stuck < 40.003, `${stuck} ms`);
  await page.click('#panel-faults .row:has-text("torn")');
  const {from, to, selection} = await viewOf(page);
  assert.deepEqual(selection, {kind: 'fault', index: 0, hit: 0});
  assert.ok(from < torn * 1e6 && torn * 1e6 < to, 'in sight');
  assert.deepEqual(
    itemsOf(await inspect(page), 'faultname').map(({name}) => name),
    ['torn'],
  );
  await closeReport(page);
});

test('the error names its fault', async () => {
  const page = await openReport(file);
  assert.equal(await page.evaluate(() => window.verican.report.events.count), 2);
  await page.click('#tab-events');
  await page.click('#panel-events .rows .row >> nth=0');
  assert.match(await page.textContent('.details'), /faults before ittorn/);
  await closeReport(page);
});

test('the table has messages and signals of the database by name', async () => {
  const page = await openReport(file);
  const rows = (await rowsOf(page, 'frames')).filter((row) => row[2] === 'data');
  assert.deepEqual(
    rows.map((row) => [row[1], row[6], row[7]]),
    [
      ['100', 'speed · EngineData', speed],
      ['200', 'fuel · Dashboard', fuel],
      ['321', 'other', ''],
      ...Array(3).fill(['100', 'speed · EngineData', speed]),
    ],
  );
  await page.fill('#search', 'CoolantTemperature');
  await page.waitForFunction(() => document.querySelector('.found').textContent.startsWith('4 of'));
  await closeReport(page);
});

test('the faults are drawn where they acted', async () => {
  const page = await openReport(file);
  const {start, end} = await page.evaluate(() => {
    const {frames} = window.verican.report;
    return {start: frames.start[3], end: frames.end[3]}; // of the retransmission
  });
  await setView(page, start - 400e3, end);
  const picture = await inspect(page);
  const [drawn, ...others] = itemsOf(picture, 'fault');
  assert.deepEqual(others, []);
  const perPx = (picture.to - picture.from) / (picture.width - picture.left);
  const at = picture.from + (drawn.x0 - picture.left) * perPx;
  assert.ok(Math.abs(at - result.faults[0].times_ps[0][0] / 1000) < 2 * perPx);
  await closeReport(page);
});
