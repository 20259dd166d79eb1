// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Remote nodes on the page: commands in words, states and memory at a moment (RN-97).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import * as browser from './browser.mjs';
import {Scene} from './scene.mjs';
import {Column} from './writer.mjs';

const {closeReport, itemsOf, openReport, outDir, rowsOf, setView, writeScene} = browser;

/** A column of a known type with these values. */
function column(type, values) {
  const made = new Column(type);
  for (const value of values) made.push(value);
  return made;
}

/** Host and two nodes: a write, another one by somebody else, TRIGGER, and one frame of nobody. */
function remoteScene() {
  const scene = new Scene(['host', 'pfc', 'dab'], {title: 'Remote'});
  scene.frame(0, {id: 0x320, dlc: 1, data: [0x5a]});
  scene.frame(0, {id: 0x001, dlc: 1, data: [7]});
  scene.frame(0, {id: 0x12345678, extended: true, dlc: 0});
  scene.frame(0, {id: 0x320, dlc: 1, data: [0x5a]});
  const ends = scene.log.map(({end}) => end + 2 * scene.bit); // the nodes take it in INT2
  const units = [
    {node: 1, number: 6, window: 120},
    {node: 2, number: 7, window: 120},
  ];
  const {meta, columns} = scene.finish({remote: {units}});
  const changes = [
    [0, 2, 0x40, 0xee],
    [ends[0], 1, 0x20, 0x5a],
    [ends[1], 1, 0x10, 0x11],
    [ends[1], 2, 0x77, 0x22],
    [ends[3], 1, 0x20, 0x00],
  ];
  const states = [
    [0, 1, 2],
    [0, 2, 0],
    [ends[1] - 1000, 1, 3],
    [ends[3], 2, 2],
  ];
  const at = (list, i) => list.map((row) => row[i]);
  const words = '6: write 020 <- 5A\nTRIGGER 7, 2 nodes, skew 92 ns\n\n';
  Object.assign(columns, {
    'f.words': column('u32', [0, 1, 2, 0]),
    words: column('u8', Buffer.from(words)),
    'n.time': column('f64', at(states, 0)),
    'n.node': column('u8', at(states, 1)),
    'n.state': column('u8', at(states, 2)),
    'm.time': column('f64', at(changes, 0)),
    'm.node': column('u8', at(changes, 1)),
    'm.address': column('u8', at(changes, 2)),
    'm.byte': column('u8', at(changes, 3)),
  });
  return {scene, meta, columns, ends};
}

const scene = remoteScene();
const file = browser.reportFor('remote', scene);
const cells = (page) =>
  page.$$eval('#panel-remote tbody tr', (rows) =>
    rows.map((row) => [...row.cells].map(({innerText}) => innerText.trim())),
  );

test('each frame has its command in words, in the table, the search and the details', async () => {
  const page = await openReport(file);
  const commands = (await rowsOf(page, 'frames')).map((row) => row[7]);
  assert.deepEqual(commands, [
    '6: write 020 <- 5A',
    'TRIGGER 7, 2 nodes, skew 92 ns',
    '',
    '6: write 020 <- 5A',
  ]);
  await page.evaluate(() => window.verican.frames.show('skew'));
  assert.equal((await rowsOf(page, 'frames')).length, 1);
  await page.evaluate(() => window.verican.steps.showFrame(1));
  assert.match(await page.textContent('.details'), /commandTRIGGER 7, 2 nodes, skew 92 ns/);
  await page.evaluate(() => window.verican.steps.showFrame(2));
  assert.doesNotMatch(await page.textContent('.details'), /command/);
  await closeReport(page);
});

test('states and memory are those of the end of what is selected', async () => {
  const page = await openReport(file);
  await page.click('#tab-remote');
  await page.evaluate(() => window.verican.steps.showFrame(0));
  const line = (at, bytes) => {
    const all = Array.from({length: Math.min(16, 0x78 - at)}, (_, i) => bytes[at + i] ?? '00');
    return `${at.toString(16).toUpperCase().padStart(3, '0')} ${all.join(' ')}`;
  };
  await page.waitForFunction(() => document.querySelectorAll('#panel-remote tbody b').length === 1);
  assert.deepEqual(await cells(page), [
    ['pfc', '6', 'SAFE', 'SAFE', line(0x20, {0x20: '5A'})],
    ['dab', '7', 'INIT', 'INIT', line(0x40, {0x40: 'EE'})],
  ]);
  const bold = () => page.$$eval('#panel-remote tbody b', (all) => all.map((b) => b.innerText));
  assert.deepEqual(await bold(), ['5A']);
  await page.evaluate(() => window.verican.steps.showFrame(1));
  await page.waitForFunction(() => document.querySelectorAll('#panel-remote tbody b').length === 2);
  assert.deepEqual(await bold(), ['11', '22']);
  const operate = `SAFE, OPERATE at ${((scene.ends[1] - 1000) / 1e6).toFixed(6)} ms`;
  const both = [line(0x10, {0x10: '11'}), line(0x20, {0x20: '5A'})].join('\n');
  assert.deepEqual((await cells(page))[0], ['pfc', '6', 'OPERATE', operate, both]);
  const others = [line(0x40, {0x40: 'EE'}), line(0x70, {0x77: '22'})].join('\n');
  assert.equal((await cells(page))[1][4], others);
  await page.evaluate(() => window.verican.view.select(null));
  await setView(page, 100, scene.ends[1] + 100);
  await page.waitForFunction(() => document.querySelectorAll('#panel-remote tbody b').length === 3);
  assert.deepEqual(await bold(), ['11', '5A', '22']);
  assert.match(await page.textContent('#panel-remote'), /the end of the window\./);
  await closeReport(page);
});

test('thousands of changes: any moment has its bytes', async () => {
  const big = remoteScene();
  const count = 20000;
  const step = big.meta.duration_ns / count;
  const range = Array.from({length: count}, (_, i) => i);
  Object.assign(big.columns, {
    'm.time': column('f64', range.map((i) => i * step)),
    'm.node': column('u8', range.map((i) => 1 + (i % 2))),
    'm.address': column('u8', range.map((i) => i % 120)),
    'm.byte': column('u8', range.map((i) => (i * 7) % 256)),
  });
  const page = await openReport(writeScene('remote-many', big));
  for (const last of [0, 4095, 4096, 12345, 19999, 3]) {
    const wanted = new Uint8Array(120);
    for (let i = 0; i <= last; ++i) if (i % 2 === 1) wanted[i % 120] = (i * 7) % 256;
    const seen = await page.evaluate(
      (ns) => [...window.verican.report.remote.windowsAt(ns).get(2).bytes],
      (last + 0.5) * step,
    );
    assert.deepEqual(seen, [...wanted], `after change ${last}`);
  }
  await closeReport(page);
});

test('a report without remote nodes has neither column nor tab', async () => {
  const plain = new Scene(['left', 'right'], {title: 'Plain'});
  plain.frame(0, {id: 0x320, dlc: 1, data: [0x5a]});
  const page = await openReport(writeScene('remote-none', plain.finish()));
  assert.equal(await page.$('#tab-remote'), null);
  assert.equal(await page.$('#panel-frames .head :text("command")'), null);
  assert.deepEqual(itemsOf(await browser.inspect(page), 'remote'), []);
  await closeReport(page);
});

const kScenario = `
duration: 10 ms
bitrate: 1000000
nodes:
  - {name: host, clock: 12 MHz}
  - {name: pfc, type: remote, number: 6, serial: 6, clock: 12 MHz, memory: {0x40: 01 02}}
  - {name: dab, type: remote, number: 7, serial: 7, clock: 12 MHz, delay: 50 ns}
commands:
  - node: host
    at: 2 ms
    do: [operate, write all 0x10 11 22, write 6 0x20 5A, read 6 0x40 2, trigger 7]
user:
  - {node: dab, at: 8 ms, write: {0x30: AB}}
`;

test('a run: words, states and memory from the tool', async () => {
  const yaml = join(outDir, 'real.yaml');
  const html = join(outDir, 'real.html');
  writeFileSync(yaml, kScenario);
  const output = execFileSync(
    process.env.VERICAN_BINARY,
    ['run', yaml, '--report', html, '--json'],
    {encoding: 'utf8'},
  );
  const told = JSON.parse(output).runs[0].remote.frames.map(({words}) => words);
  const page = await openReport(html);
  const commands = (await rowsOf(page, 'frames')).map((row) => row[7]);
  assert.deepEqual(commands, told);
  assert.deepEqual(commands.slice(0, 2).map((text) => text.slice(0, 18)), [
    '6 says STATUS SAFE',
    '7 says STATUS SAFE',
  ]);
  assert.deepEqual(commands.slice(2, 7).slice(0, 4), [
    'OPERATE all',
    'all: write 010 <- 11 22',
    '6: write 020 <- 5A',
    '6: read 040, 2 bytes',
  ]);
  assert.equal(commands[6], '6 says 040 = 01 02');
  assert.match(commands[7], /^TRIGGER 7, 2 nodes, skew \d+ ns$/);
  const at = (index) =>
    page.evaluate((frame) => {
      const {report} = window.verican;
      const ns = frame < 0 ? report.duration : report.frames.end[frame] + 3 * report.bitNs;
      return report.remote.units.map(({node}, which) => {
        const {bytes} = report.remote.windowsAt(ns).get(node);
        const shown = [0x10, 0x20, 0x30, 0x40].map((address) => bytes[address]);
        return [report.remote.stateAt(which, ns), ...shown];
      });
    }, index);
  assert.deepEqual(await at(2 - 1), [
    ['SAFE', 0, 0, 0, 1],
    ['SAFE', 0, 0, 0, 0],
  ]);
  assert.deepEqual((await at(4)).map((row) => row.slice(1)), [
    [0, 0x5a, 0, 1],
    [0, 0, 0, 0],
  ]);
  assert.deepEqual(await at(-1), [
    ['OPERATE', 0x11, 0x5a, 0, 1],
    ['OPERATE', 0x11, 0, 0xab, 0],
  ]);
  assert.ok(statSync(html).size < 400_000, 'a small page');
  await closeReport(page);
});
