// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reports of real runs: what the page shows is what the log of the same run says, and the pages of
// the paper's experiments show what its figures show.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {
  closeBrowser,
  closeReport,
  inspect,
  itemsOf,
  openBrowser,
  openReport,
  outDir,
  rowsOf,
  screenshot,
  setView,
  viewOf,
} from './browser.mjs';
import {judgeFrame} from './judge.mjs';

before(openBrowser);
after(closeBrowser);

/** Runs an example: {file, lines of its candump log, result}. */
function run(example) {
  const file = join(outDir, `${example}.html`);
  const logFile = join(outDir, `${example}.log`);
  const output = execFileSync(
    process.env.VERICAN_BINARY,
    ['run', `examples/${example}.yaml`, '--report', file, '--candump', logFile, '--json'],
    {encoding: 'utf8', maxBuffer: 64 << 20},
  );
  return {file, lines: linesOf(logFile), result: JSON.parse(output).runs[0]};
}

/** The lines of a log without their line ends. */
const linesOf = (path) => readFileSync(path, 'utf8').trim().split('\n');

/** A frame of the log for the encoder. */
function frameOf(text) {
  const [head, body] = text.split('#');
  const base = {
    id: parseInt(head, 16),
    extended: head.length === 8,
    remote: body.startsWith('R'),
    data: [],
  };
  const [main, raw] = body.replace(/^R/, '').split('_');
  if (base.remote) return {...base, dlc: raw ? parseInt(raw, 16) : Number(main || 0)};
  const data = (main.match(/../g) ?? []).map((byte) => parseInt(byte, 16));
  return {...base, data, dlc: raw ? parseInt(raw, 16) : data.length};
}

/** Goes through all rows of the table as the reader does, and takes what the panel says of each. */
async function panelLines(page, count) {
  const lines = [];
  for (let i = 0; i < count; ++i) {
    await page.evaluate((index) => window.verican.steps.showFrame(index), i);
    lines.push(await page.textContent('.details .candump'));
  }
  return lines;
}

for (const [example, judged] of [
  ['arbitration', 8],
  ['faults', 7],
  ['two-nodes', 5],
]) {
  test(`examples/${example}: table, fields and counts are those of the run's log`, async () => {
    const {file, lines, result} = run(example);
    const page = await openReport(file);
    const facts = await page.textContent('.facts');
    assert.ok(
      facts.includes(`${result.frames} frames`) &&
        facts.includes(`${result.error_frames} error frames`),
      facts,
    );
    assert.equal(lines.length, result.frames);
    assert.deepEqual(await panelLines(page, result.frames), lines);
    const times = await page.evaluate(() => ({
      start: [...window.verican.report.frames.start],
      end: [...window.verican.report.frames.end],
    }));
    for (let i = 0; i < Math.min(judged, lines.length); ++i) {
      await judgeFrame(page, frameOf(lines[i].split(' ')[2]), times.start[i], times.end[i]);
    }
    const nodes = await page.evaluate(() => {
      window.verican.tabs.show('nodes');
      return [...document.querySelectorAll('#panel-nodes tbody tr')].map((row) =>
        [...row.cells].map((cell) => cell.textContent),
      );
    });
    assert.deepEqual(
      nodes.map((row) => [row[0], Number(row[7]), Number(row[10])]),
      result.nodes.map((node) => [node.name, node.sent, node.lost_arbitration]),
    );
    await closeReport(page);
  });
}

test('faults: why a frame was retried can be seen', async () => {
  const {file, result} = run('faults');
  const page = await openReport(file);
  await page.fill('#search', 'retry');
  await page.waitForFunction(() =>
    /^[1-9]\d* of/.test(document.querySelector('.found').textContent),
  );
  await page.click('#panel-frames .rows .row >> nth=0');
  await page.keyboard.press('Shift+E');
  const cause = await page.textContent('.details');
  assert.match(cause, /CRC/);
  assert.match(cause, /ED-14/);
  assert.match(cause, /middle/, 'the fault flips a bit of this node');
  const picture = await inspect(page);
  assert.equal(
    itemsOf(picture, 'lane').length,
    3,
    'the three nodes do not agree, each has its own fields',
  );
  await screenshot(page, 'faults-retry');
  await page.click('#tab-events');
  const kinds = (await rowsOf(page, 'events')).map((row) => row[1]);
  const all = await page.evaluate(() => [...window.verican.report.events.kind]);
  assert.equal(all.filter((kind) => kind === 0).length, result.error_frames);
  assert.ok(kinds.includes('error frame'));
  await closeReport(page);
});

/** Replays a log of these lines into a page: {page, code}. */
async function replayed(name, lines) {
  const log = join(outDir, `${name}.log`);
  const file = join(outDir, `${name}.html`);
  writeFileSync(log, `${lines.join('\n')}\n`);
  const {status} = spawnSync(process.env.VERICAN_BINARY, ['replay', log, '--report', file]);
  return {page: await openReport(file), status};
}

test('the page of a waveform has the times of the log that decode makes of it', async () => {
  const at = (ending) => join(outDir, `waveform.${ending}`);
  const verican = (...args) => execFileSync(process.env.VERICAN_BINARY, [...args, '--quiet']);
  verican('run', 'examples/two-nodes.yaml', '--vcd', at('vcd'), '--candump', at('run.log'));
  const bus = [at('vcd'), '--signal', 'bus.can', '--bitrate', '500k'];
  verican('decode', ...bus, '--candump', at('log'));
  verican('report', ...bus, '-o', at('html'));
  const page = await openReport(at('html'));
  const decoded = linesOf(at('log'));
  assert.deepEqual(await panelLines(page, decoded.length), decoded);
  // The waveform has whole nanoseconds.
  const ran = linesOf(at('run.log'));
  assert.ok(decoded.filter((line) => ran.includes(line)).length >= ran.length - 1);
  await closeReport(page);
});

test('a replay says which recording it was, and that every frame came', async () => {
  const {page, status} = await replayed('boat', ['(1.0) can0 123#CAFE', '(1.1) can0 124#01']);
  assert.equal(status, 0);
  assert.equal(await page.textContent('h1'), 'Replay of boat.log');
  assert.match(await page.textContent('.verdict'), /^✓ all \d+ checks$/);
  await page.click('#tab-checks');
  const checks = await page.textContent('#panel-checks');
  assert.match(checks, /replay of boat\.log2 frames, bit-exact and in order2 sent; yes/);
  await closeReport(page);
});

test('a replay of nothing says so, and why', async () => {
  const {page, status} = await replayed('fd-only', ['(1.0) can0 123##1112233']);
  assert.equal(status, 1);
  assert.match(await page.textContent('.verdict'), /^✗ \d+ of \d+ checks failed$/);
  await page.click('#tab-checks');
  assert.match(await page.textContent('#panel-checks'), /✗ failed.*replay of fd-only\.log.*NO: /);
  await closeReport(page);
});

/** The pages of the paper's experiments, by name. */
let papers = null;
function paper(name) {
  if (!papers) {
    papers = join(outDir, 'paper');
    mkdirSync(papers, {recursive: true});
    execFileSync(process.env.VERICAN_BINARY, ['paper', '--no-waves', '--report', papers]);
  }
  return openReport(join(papers, `${name}.html`));
}

/** Chooses a statement and returns the picture that shows it. */
async function choose(page, index) {
  await page.click(`.statement >> nth=${index}`);
  return inspect(page);
}

const driversOf = (page, picture, ns) => {
  const names = itemsOf(picture, 'drivers')
    .filter((d) => d.from <= ns && d.to > ns)
    .flatMap((d) => d.nodes);
  return page.evaluate((nodes) => nodes.map((node) => window.verican.report.nodeName(node)), names);
};

/** Middle of a field of the upper bar, ns. */
const middleOf = (picture, name) => {
  const item = itemsOf(picture, 'field').find(({field, own}) => field === name && !own);
  const perPx = (picture.to - picture.from) / (picture.width - picture.left);
  return picture.from + ((item.x0 + item.x1) / 2 - picture.left) * perPx;
};

/** What is in sight before anything is touched: the names of the fields in the upper bar. */
const firstSight = async (page) =>
  itemsOf(await inspect(page), 'field')
    .filter(({own}) => !own)
    .map(({field}) => field);

for (const [figure, name, sender, receiver] of [
  ['11', 'fig11-reception', 'other', 'ip'],
  ['12', 'fig12-transmission', 'ip', 'other'],
]) {
  test(`figure ${figure}: 00A with AA, ${sender} sends, ${receiver} drives the ACK`, async () => {
    const page = await paper(name);
    const fields = await firstSight(page);
    for (const field of ['SOF', 'ID', 'DATA', 'CRC', 'ACK', 'EOF'])
      assert.ok(fields.includes(field), `${field} is in sight at first`);
    const picture = await choose(page, 1);
    assert.deepEqual(await driversOf(page, picture, middleOf(picture, 'ACK')), [receiver]);
    const values = itemsOf(picture, 'field')
      .filter(({value, own}) => value && !own)
      .map(({field, value}) => [field, value]);
    assert.deepEqual(
      values.filter(([field]) => ['ID', 'DATA', 'ACK'].includes(field)),
      [
        ['ID', '00A'],
        ['DATA', 'AA'],
        ['ACK', '✓'],
      ],
    );
    await setView(page, (await middle(page)) - 20000, (await middle(page)) + 20000);
    await screenshot(page, name);
    await closeReport(page);
  });
}
const middle = async (page) => {
  const {from, to} = await viewOf(page);
  return (from + to) / 2;
};

test('figure 13: both drive until the eleventh bit, then the IP is silent and ACKs', async () => {
  const page = await paper('fig13-arbitration');
  const fields = await firstSight(page);
  for (const field of ['SOF', 'ID', 'RTR'])
    assert.ok(fields.includes(field), `${field} is in sight at first`);
  const picture = await choose(page, 0);
  const [loss] = itemsOf(picture, 'loss');
  assert.equal(
    await page.evaluate(
      ({node, winner}) =>
        [window.verican.report.nodeName(node), window.verican.report.nodeName(winner)].join(),
      loss,
    ),
    'ip,other',
  );
  assert.deepEqual(await driversOf(page, picture, middleOf(picture, 'SOF')), ['ip', 'other']);
  assert.deepEqual(await driversOf(page, picture, middleOf(picture, 'RTR')), ['other']);
  assert.deepEqual(await driversOf(page, picture, middleOf(picture, 'ACK')), ['ip']);
  const rows = (await rowsOf(page, 'frames')).map((row) => [row[1], row[4], row[9]]);
  assert.deepEqual(rows, [
    ['00A', 'other', ''],
    ['00B', 'ip', '1'],
  ]);
  await screenshot(page, 'fig13');
  await closeReport(page);
});

test('figures 14 to 16: sixteen active flags, 8 each to 128, then passive ones', async () => {
  const page = await paper('fig14-16-missing-ack');
  const tec = await page.evaluate(() => [...window.verican.report.counters.nodes[0].tec]);
  assert.deepEqual(
    tec,
    Array.from({length: 17}, (_, i) => 8 * i),
  );
  const active = await choose(page, 2);
  const flag = (picture) =>
    itemsOf(picture, 'field').find(({field, own}) => field === 'ERROR_FLAG' && !own);
  const bits = (picture) =>
    itemsOf(picture, 'bit')
      .filter(({field}) => field === 'ERROR_FLAG')
      .map(({level}) => level);
  assert.equal(flag(active).value, 'active');
  assert.deepEqual(bits(active), [0, 0, 0, 0, 0, 0]);
  await screenshot(page, 'fig15');
  const passive = await choose(page, 3);
  assert.equal(flag(passive).value, 'passive');
  assert.deepEqual(bits(passive), [1, 1, 1, 1, 1, 1]);
  assert.deepEqual(
    [...new Set(itemsOf(passive, 'state').map(({name}) => name))],
    ['error passive'],
  );
  await screenshot(page, 'fig16');
  await closeReport(page);
});

test('figures 17 and 18: bus-off at 256, silence, recovery after 128 times 11 bits', async () => {
  const page = await paper('fig17-18-bus-off');
  const picture = await choose(page, 0);
  assert.deepEqual(
    itemsOf(picture, 'state').map(({name}) => name),
    ['error passive', 'bus-off'],
  );
  const states = await page.evaluate(() => window.verican.report.counters.nodes[0].states);
  assert.deepEqual(
    states.map(({state}) => state),
    [0, 1, 2, 0],
  );
  const bit = 20000;
  const silence = (states[3].time - states[2].time) / bit;
  assert.ok(
    silence >= 1408 && silence <= 1420,
    `${silence} bits of bus-off; 128 times 11 are 1408`,
  );
  const counters = await page.evaluate(
    (time) => window.verican.report.counters.at(0, time),
    states[3].time + bit,
  );
  assert.deepEqual([counters.tec, counters.rec], [0, 0]);
  await setView(page, states[2].time + 2 * bit, states[3].time - 2 * bit);
  const quiet = await inspect(page);
  assert.equal(itemsOf(quiet, 'drivers').length, 0, 'nobody drives in bus-off');
  await screenshot(page, 'fig18');
  await closeReport(page);
});
