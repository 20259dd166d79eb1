// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page against scenes of which everything is known: decoding, pictures, tables, search.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {
  assertColor,
  blend,
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
import {F} from './can.mjs';
import {judgeFrame} from './judge.mjs';
import {Scene} from './scene.mjs';
import {lonelyScene, smallScene} from './scenes.mjs';

const small = smallScene();
const {log, bit} = small.scene;
const file = reportFor('small', small);

const hex = (value, digits) => value.toString(16).toUpperCase().padStart(digits, '0');
const idText = ({id, extended}) => hex(id, extended ? 8 : 3);
const dataText = ({data}) => data.map((byte) => hex(byte, 2)).join(' ');

test('the page shows title and counts, without errors and without a network', async () => {
  const page = await openReport(file);
  assert.equal(await page.textContent('h1'), 'A bit of everything');
  const facts = await page.textContent('.facts');
  for (const text of ['500 kbit/s', '3 nodes', '7 frames', '2 error frames', '1 overload frames']) {
    assert.ok(facts.includes(text), `${text} in ${facts}`);
  }
  await screenshot(page, 'small-whole');
  await closeReport(page);
});

test('every frame is decoded as the encoder made it, to the last bit', async () => {
  const page = await openReport(file);
  for (const frame of log) await judgeFrame(page, frame, frame.time, frame.end);
  await closeReport(page);
});

test('the table has every frame and error in order of time', async () => {
  const page = await openReport(file);
  const rows = await rowsOf(page, 'frames');
  const frames = rows.filter((row) => row[1] !== '');
  assert.deepEqual(
    frames.map(([time, id, type, dlc, node, data]) => [time, id, type, dlc, node, data]),
    log.map((f) => [
      (f.time / 1e6).toFixed(6),
      idText(f),
      `${f.extended ? 'ext ' : ''}${f.remote ? 'remote' : 'data'}`,
      String(f.dlc),
      small.scene.names[f.sender],
      dataText(f),
    ]),
  );
  assert.deepEqual(
    frames.map((row) => [Number(row[8]), Number(row[9])]),
    log.map((f) => [f.retries, f.lost]),
  );
  const errors = rows.filter((row) => row[1] === '');
  assert.deepEqual(
    errors.map((row) => [row[2], row[5]]),
    [
      ['error frame', 'a receiver found a wrong checksum'],
      ['overload frame', 'dominant bit in the intermission'],
      ['error frame', 'no node acknowledged the frame'],
    ],
  );
  const times = rows.map((row) => Number(row[0]));
  assert.deepEqual(
    times,
    [...times].sort((a, b) => a - b),
  );
  await closeReport(page);
});

// Bits of a frame's data have the same numbers in each byte.
test('an error in the data is told with its byte', async () => {
  const scene = new Scene(['a', 'b']);
  const frame = {id: 0x123, dlc: 3, data: [0x55, 0x55, 0x55]};
  scene.frame(0, frame);
  const places = Scene.sent(frame).flatMap(({field, stuff}, i) =>
    field === F.DATA && !stuff ? [i] : [],
  );
  for (const at of [places[18], Scene.sent(frame).findIndex(({field}) => field === F.ACK)]) {
    const start = scene.log[0].time + at * scene.bit;
    const row = {kind: 0, start, end: start + 20 * scene.bit, node: 0, error: 16, field: F.DATA};
    for (const [name, value] of Object.entries({...row, index: 18, segment: 0, cause: 0}))
      scene.columns[`e.${name}`].push(value);
  }
  const page = await openReport(writeScene('page-place', scene.finish()));
  const where = (await rowsOf(page, 'events')).map((row) => row[6]);
  assert.deepEqual(where, ['DATA byte 2, bit 5', 'ACK']); // the 19th bit is the third of byte 2
  await closeReport(page);
});

test('sorting by a column keeps all rows', async () => {
  const page = await openReport(file);
  await page.click('#panel-frames .head button:has-text("id")');
  const ids = (await rowsOf(page, 'frames')).map((row) => row[1]);
  const numbers = log.map(({id}) => id).sort((a, b) => a - b);
  assert.deepEqual(
    ids.filter(Boolean).map((text) => parseInt(text, 16)),
    numbers,
  );
  assert.deepEqual(ids.slice(log.length), ['', '', ''], 'errors have no identifier and come last');
  await page.click('#panel-frames .head button:has-text("id")');
  const down = (await rowsOf(page, 'frames')).map((row) => row[1]).filter(Boolean);
  assert.deepEqual(
    down.map((text) => parseInt(text, 16)),
    numbers.reverse(),
  );
  await closeReport(page);
});

test('search finds identifiers, bytes, names and errors', async () => {
  const page = await openReport(file);
  const wanted = {
    '2AA': (f) => f.id === 0x2aa,
    '0x333': (f) => f.id === 0x333,
    'ca fe': (f) => dataText(f).includes('CA FE'),
    'fe ca': () => false,
    left: (f) => f.sender === 0,
    remote: (f) => f.remote,
    ext: (f) => f.extended,
    speed: (f) => f.message === undefined && [0x123, 0x2aa].includes(f.id),
    lost: (f) => f.lost > 0,
    'right data': (f) => f.sender === 2 && !f.remote,
    nonsense: () => false,
  };
  for (const [text, fits] of Object.entries(wanted)) {
    await page.fill('#search', text);
    const ids = log.filter(fits).map(idText);
    const found = `${ids.length} of 10`;
    await page
      .waitForFunction(
        ([words, list]) => {
          const rows = [...document.querySelectorAll('#panel-frames .rows .row')].map(
            (row) => row.children[1].textContent,
          );
          return (
            document.querySelector('.found').textContent.startsWith(words) &&
            rows.filter(Boolean).join() === list.join()
          );
        },
        [found, ids],
      )
      .catch(async (late) => {
        const shown = (await rowsOf(page, 'frames')).map((row) => row[1]);
        const said = await page.textContent('.found');
        throw new Error(`${text}: "${said}", not "${found}"; ${shown}, not ${ids}`, {cause: late});
      });
  }
  await page.fill('#search', 'error');
  await page.waitForFunction(() =>
    document.querySelector('.found').textContent.startsWith('2 of 10'),
  );
  await page.keyboard.press('Escape');
  await page.waitForFunction(() =>
    document.querySelector('.found').textContent.startsWith('7 frames'),
  );
  await closeReport(page);
});

test('an error shows its cause, its rule, who found it and what each node sees', async () => {
  const page = await openReport(file);
  await page.click('#tab-events');
  await page.click('#panel-events .row:has-text("wrong checksum")');
  const details = await page.textContent('.details');
  for (const text of [
    'a receiver found a wrong checksum',
    'ED-14',
    'CRC error',
    'right',
    'as left sees it',
    'as right sees it',
  ]) {
    assert.ok(details.includes(text), `${text} in ${details}`);
  }
  const picture = await inspect(page);
  const flags = itemsOf(picture, 'field').filter(({field, own}) => own && field === 'ERROR_FLAG');
  const starts = (node) => Math.max(...flags.filter((f) => f.node === node).map(({x0}) => x0));
  const pxPerBit = ((picture.width - picture.left) / (picture.to - picture.from)) * bit;
  assert.ok(
    Math.abs(starts(0) - starts(2) - pxPerBit) < 0.01,
    'the finder flags one bit before the others',
  );
  assert.equal(itemsOf(picture, 'lane').length, 3, 'a lane of fields for each node');
  await screenshot(page, 'small-error');
  await closeReport(page);
});

test('who drives what: colours of all nodes that drive at once, listed and drawn', async () => {
  const page = await openReport(file);
  const frame = log.at(-1);
  await setView(page, frame.time - 2 * bit, frame.time + 18 * bit);
  const picture = await inspect(page);
  const at = (ns) =>
    picture.left +
    ((ns - picture.from) * (picture.width - picture.left)) / (picture.to - picture.from);
  const nodesAt = (ns) =>
    itemsOf(picture, 'drivers').find((d) => d.from <= ns && d.to > ns)?.nodes ?? [];
  assert.deepEqual(nodesAt(frame.time + bit / 2), [0, 1, 2], 'SOF: all three');
  assert.deepEqual(
    nodesAt(frame.time + 1.5 * bit),
    [0, 1, 2],
    'all identifiers begin with a dominant bit',
  );
  assert.deepEqual(nodesAt(frame.time + 4.5 * bit), [0, 2], '0x3FF has lost at its fourth bit');
  assert.deepEqual(nodesAt(frame.time + 12.5 * bit), [2], 'RTR: one is left');
  const bus = await page.$eval('.scope-top', (canvas) => canvas.clientHeight);
  const ground = await cssColor(page, 'panel');
  for (const [node, part] of [
    [0, 1 / 6],
    [1, 3 / 6],
    [2, 5 / 6],
  ]) {
    const y = 109 + 9 + part * (bus - 109 - 18);
    assertColor(
      await pixel(page, '.scope-top', at(frame.time + 0.3 * bit), y + (node === 1 ? 5 : 0)),
      blend(await cssColor(page, `n-${node}`), ground, 0.6),
      `band of node ${node}`,
    );
  }
  const lost = itemsOf(picture, 'loss');
  assert.deepEqual(lost.map(({node, winner}) => [node, winner]).sort(), [
    [0, 2],
    [1, 2],
  ]);
  await screenshot(page, 'small-arbitration');
  await closeReport(page);
});

test('pixels: fields have their colours, recessive bus is a line', async () => {
  const page = await openReport(file);
  const frame = log[0];
  await setView(page, frame.time, frame.end);
  const picture = await inspect(page);
  const y = itemsOf(picture, 'field').find((f) => !f.own).y + 3;
  for (const [field, color] of [
    ['ID', 'f-id'],
    ['DATA', 'f-data'],
    ['CRC', 'f-crc'],
    ['EOF', 'f-tail'],
  ]) {
    const item = itemsOf(picture, 'field').find((f) => f.field === field && !f.own);
    assertColor(
      await pixel(page, '.scope-top', item.x0 + 3, y),
      await cssColor(page, color),
      field,
    );
  }
  const eof = itemsOf(picture, 'field').find((f) => f.field === 'EOF' && !f.own);
  const high = await page.$eval('.scope-top', (canvas) => canvas.clientHeight);
  assertColor(
    await pixel(page, '.scope-top', (eof.x0 + eof.x1) / 2, 109 + 14),
    await cssColor(page, 'panel'),
    'nothing above a recessive bus',
  );
  const rows = [];
  for (let y2 = -5; y2 < 0; ++y2)
    rows.push(
      (
        await pixel(
          page,
          '.scope-top',
          (eof.x0 + eof.x1) / 2,
          Math.round(109 + (high - 109) / 2) + y2,
        )
      )[0],
    );
  assert.ok(Math.min(...rows) < 100 && Math.max(...rows) > 230, `CAN_H is a thin line: ${rows}`);
  await closeReport(page);
});

test('time quanta and resynchronisation are drawn to scale', async () => {
  const page = await openReport(file);
  const start = log[0].time;
  await setView(page, start + 11.5 * bit, start + 15.5 * bit);
  const picture = await inspect(page);
  assert.equal(picture.mode, 'quanta');
  const parts = (i) =>
    itemsOf(picture, 'part')
      .filter((part) => part.bit === i)
      .map(({name, quanta}) => [name, quanta]);
  assert.deepEqual(parts(13), [
    ['SYNC', 1],
    ['PROP', 5],
    ['PS1', 2],
    ['PS2', 2],
  ]);
  assert.deepEqual(parts(12), [
    ['SYNC', 1],
    ['PROP', 5],
    ['PS1 +1', 3],
    ['PS2', 2],
  ]);
  assert.deepEqual(parts(14), [
    ['SYNC', 1],
    ['PROP', 5],
    ['PS1', 2],
    ['PS2 −1', 1],
  ]);
  const pxPerTq = (picture.width - picture.left) / 4 / 10;
  const prop = itemsOf(picture, 'part').find((part) => part.bit === 13 && part.name === 'PROP');
  assert.ok(Math.abs(prop.x1 - prop.x0 - 5 * pxPerTq) < 0.01, 'five quanta wide');
  const item = itemsOf(picture, 'bit').find(({bit: i}) => i === 13);
  assert.ok(Math.abs(item.sample - item.x0 - 8 * pxPerTq) < 0.01, 'sample point at 80 %');
  await screenshot(page, 'small-quanta');
  await page.click('.scope-top', {position: {x: item.x0 + 5, y: 80}});
  assert.deepEqual((await viewOf(page)).selection, {kind: 'bit', segment: 0, lane: 0, bit: 13});
  assert.match(await page.textContent('.details'), /10 quanta of 200 ns/);
  await closeReport(page);
});

test('error counters and states over time', async () => {
  const page = await openReport(writeScene('lonely', lonelyScene()));
  await page.click('#tab-counters');
  const data = await page
    .waitForFunction(
      () => window.verican.tabs.entries.find((e) => e.id === 'counters').plot.plot?.data,
    )
    .then((handle) => handle.jsonValue());
  const tec = data[1].filter((value, i) => i === 0 || value !== data[1][i - 1]);
  assert.deepEqual(
    tec,
    Array.from({length: 17}, (_, i) => 8 * i),
    'sixteen steps of 8, then it stays',
  );
  assert.ok(data[2].every((rec) => rec === 0));
  await page.keyboard.press('0');
  const picture = await inspect(page);
  assert.deepEqual(
    itemsOf(picture, 'state').map(({node, name}) => [node, name]),
    [[0, 'error passive']],
  );
  const flags = [];
  for (const i of [0, 19]) {
    await page.evaluate((index) => window.verican.steps.showEvent(index), i);
    flags.push(
      itemsOf(await inspect(page), 'field').find(({field}) => field === 'ERROR_FLAG').value,
    );
  }
  assert.deepEqual(flags, ['active', 'passive']);
  await screenshot(page, 'lonely-counters');
  await closeReport(page);
});

test('statements of the paper move the view; what fails is said first', async () => {
  const page = await openReport(writeScene('lonely', lonelyScene()));
  assert.match(await page.textContent('.verdict'), /2 of 4 checks failed/);
  const buttons = await page.$$('.statement');
  assert.equal(buttons.length, 3);
  const before = await viewOf(page);
  await buttons[1].click();
  const {from, to} = await viewOf(page);
  const time = lonelyScene().meta.statements[1].time_ns;
  assert.ok(
    from < time && time < to && to - from < (before.to - before.from) / 5,
    'the moment is in a narrow view',
  );
  assert.match(await page.textContent('.seen'), /six recessive bits/);
  await buttons[2].click();
  assert.deepEqual(
    await viewOf(page),
    {from, to, selection: null},
    'a statement without a moment moves nothing',
  );
  await page.click('.verdict');
  assert.match(await page.textContent('#panel-checks'), /✗ failedframes10/);
  await closeReport(page);
});

test('response times: a point for each frame, the bound, and who broke it', async () => {
  const page = await openReport(file);
  await page.click('#tab-response');
  await page.waitForFunction(
    () => window.verican.tabs.entries.find((e) => e.id === 'response').plot.plot,
  );
  const rows = await page.$$eval('#panel-response tbody tr', (list) =>
    list.map((row) => [...row.cells].map((c) => c.textContent)),
  );
  assert.deepEqual(rows, [
    ['speed', '123', '2', '0.110', '0.295', '0.480', '0.400', '1', ''],
    ['door <b>', '00A', '1', '0.250', '0.250', '0.250', '–', '', ''],
  ]);
  assert.equal(
    await page.$$eval('#panel-response td.alarm', (cells) => cells.length),
    1,
    'later than its bound',
  );
  assert.equal(await page.$('#panel-response .side p'), null);
  await closeReport(page);
});

test('response times: why there is no bound', async () => {
  const why = "node 'a' has <b>";
  const page = await openReport(writeScene('no-bound', smallScene({no_bound: why})));
  await page.click('#tab-response');
  assert.equal(await page.textContent('#panel-response .side p'), `No bound: ${why}`);
  await closeReport(page);
});
