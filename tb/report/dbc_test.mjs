// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DBC files on the page: signals decoded to values that were worked out by hand, in the table,
// the details and below the bus; files that are opened, dropped, and of no use.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {bad} from './bad_databases.mjs';
import * as browser from './browser.mjs';
import {Scene} from './scene.mjs';

const {closeReport, inspect, itemsOf, openReport, outDir, pixel, rowsOf, saved} = browser;
const {cssColor, assertColor, screenshot, setView, viewOf, writeScene} = browser;

const dbc = readFileSync(new URL('signals.dbc', import.meta.url), 'utf8');
const bytes = (text) => text.split(' ').map((byte) => parseInt(byte, 16));

/** [identifier, data, message, signals as the table shows them], worked out by hand. */
const frames = [
  // 0x2580 / 4; 0xABC - 0x1000 is -1348; 0x50 - 40; 0x341 from the top of byte 6 and byte 7
  [
    0x123,
    '25 80 0A BC 50 01 12 34',
    'EngineData',
    'Speed 2400 rpm, Torque -134.8 Nm; 100"%", Temperature 40 °C, Gear First; slow, Counter 833',
  ],
  [
    0x123,
    '25 84 00 03 D8 07 00 00',
    'EngineData',
    'Speed 2401 rpm, Torque 0.3 Nm; 100"%", Temperature -80 °C, Gear Fault, Counter 0',
  ],
  [
    0x123,
    '00 01 7F FF 00 02',
    'EngineData',
    'Speed 0.25 rpm, Torque -0.1 Nm; 100"%", Temperature -40 °C, Gear 2',
  ],
  [0x123, '00 01', 'EngineData', 'Speed 0.25 rpm'],
  [0x200, '01 E8 03 00 00 00 00 00', 'Pages', 'Page 1, Pressure 100 kPa'],
  [0x200, '02 03 05 00 00 00 00 00', 'Pages', 'Page 2, Level 1.5 %'],
  [0x200, '08 C8 05 00 00 00 00 00', 'Pages', 'Page 8, Level 100 %'],
  [0x200, '03 05 2A 00 00 00 00 00', 'Pages', 'Page 3, SubPage 5, Deep 42'],
  [0x200, '03 06 2A 00 00 00 00 00', 'Pages', 'Page 3, SubPage 6'],
  [0x200, '05 05 2A 00 00 00 00 00', 'Pages', 'Page 5'],
  [0x201, 'CD CC CC 3D C0 20 00 00', 'Numbers', 'Half 0.1, Other -4 m'],
  [0x202, 'FF FF FF FF FF FF FF FE', 'Wide', 'All 18446744073709551614'],
  [0x203, '3F F8 00 00 00 00 00 00', 'Double', 'Ratio 1.5'],
  [0x98feca00, '00 00 00 00 00 00 00 00', '', ''],
  // EEC1 is group F004: other priority and source; a request (PDU1) to another destination
  [0x8cf00421, '00 00 00 20 4E 00 00 00', 'EEC1', 'EngSpeed 2500 rpm'],
  [0x98eaff05, 'CA FE 00', 'Request', 'Wanted 65226'],
  [0x124, 'CA FE', '', ''],
];

function sceneOf(list, more) {
  const scene = new Scene(['Engine', 'Brakes'], {title: 'Signals'});
  list.forEach(([id, text], i) => {
    const extended = id >= 0x80000000;
    const data = bytes(text);
    scene.frame(0, {id: id % 0x80000000, extended, dlc: data.length, data}, {gap: 10 + i});
  });
  return {scene, ...scene.finish(more)};
}

const plain = sceneOf(frames);
const embedded = sceneOf(frames, {databases: [{name: 'signals.dbc', text: dbc}]});
const file = browser.reportFor('dbc', embedded);
const {log, bit} = embedded.scene;

/** Messages and signals of the rows of the frame table. */
const shown = async (page) => (await rowsOf(page, 'frames')).map((row) => [row[6], row[7]]);

test('every kind of signal has the value that its bits say', async () => {
  const page = await openReport(file, {height: 1400});
  assert.equal(await page.isVisible('[role=alert]'), false);
  assert.deepEqual(
    await shown(page),
    frames.map(([, , message, signals]) => [message, signals]),
  );
  await screenshot(page, 'dbc-table');
  await closeReport(page);
});

const compared = `
BO_ 1 Signed: 8 X
 SG_ Mode M : 0|8@1- (1,0) [0|0] "" X
 SG_ Low m255 : 8|8@1+ (1,0) [0|0] "" X
BO_ 2 Wide: 8 X
 SG_ All M : 0|64@1+ (1,0) [0|0] "" X
 SG_ Last m18446744073709551615 : 0|8@1+ (1,0) [0|0] "" X
BO_ 3 Twice: 2 X
 SG_ Page M : 0|8@1+ (1,0) [0|0] "" X
 SG_ Both m1 : 8|8@1+ (1,0) [0|0] "" X
SG_MUL_VAL_ 3 Both Page 1-1;
SG_MUL_VAL_ 3 Both Page 3-4;
VAL_ 2 All 9007199254740993"odd" ;
`;

// docs/signals.md: m255 is the value -1 of a signed multiplexer of 8 bits. 9007199254740993 is the
// first integer that a Number does not hold.
test('what selects a signal, or is a choice, is compared by all its bits', async () => {
  const list = [
    [1, 'FF 07 00 00 00 00 00 00', 'Signed', 'Mode -1, Low 7'],
    [1, '7F 07 00 00 00 00 00 00', 'Signed', 'Mode 127'],
    [2, 'FF FF FF FF FF FF FF FF', 'Wide', 'All 18446744073709551615, Last 255'],
    [2, 'FE FF FF FF FF FF FF FF', 'Wide', 'All 18446744073709551614'],
    [2, '00 00 00 00 00 00 20 00', 'Wide', 'All 9007199254740992'],
    [2, '01 00 00 00 00 00 20 00', 'Wide', 'All odd'],
    [3, '01 05', 'Twice', 'Page 1, Both 5'],
    [3, '02 05', 'Twice', 'Page 2'],
    [3, '03 05', 'Twice', 'Page 3, Both 5'],
  ];
  const databases = [{name: 'compared.dbc', text: compared}];
  const page = await openReport(writeScene('dbc-compared', sceneOf(list, {databases})));
  assert.equal(await page.textContent('[role=alert] span'), '');
  assert.deepEqual(
    await shown(page),
    list.map(([, , message, signals]) => [message, signals]),
  );
  await closeReport(page);
});

test('blanks do not matter, nor how the lines of the file end', async () => {
  const dense = dbc
    .replace(/^ SG_ (.*)$/gm, (line, rest) => `\tSG_  ${rest.replace(/ ([:([])/g, '$1')}`)
    .replace(/,([0-9.]+)\) ?\[/g, ', +$1 )  [')
    .replaceAll('\n', '\r\n');
  assert.ok(dense.includes('Torque: 19|12@0-(1E-1, +0.0 )  [-3.0E2|300]'), 'the text is another');
  const databases = [{name: 'dense.dbc', text: dense}];
  const page = await openReport(writeScene('dbc-dense', sceneOf(frames, {databases})), {
    height: 1400,
  });
  assert.equal(await page.textContent('[role=alert] span'), '');
  assert.deepEqual(
    await shown(page),
    frames.map(([, , message, signals]) => [message, signals]),
  );
  await closeReport(page);
});

test('the details of a frame list its signals with units and raw values', async () => {
  const page = await openReport(file);
  await page.click('#panel-frames .row:has-text("25 80 0A BC")');
  const rows = await page.$$eval('.details .signals tr', (list) =>
    list.map((row) => [...row.cells].map((cell) => cell.textContent)),
  );
  assert.deepEqual(rows, [
    ['Speed', '2400 rpm', '9600'],
    ['Torque', '-134.8 Nm; 100"%"', '-1348'],
    ['Temperature', '40 °C', '80'],
    ['Gear', 'First; slow (1)', '1'],
    ['Counter', '833', '833'],
  ]);
  assert.match(await page.textContent('.details .signals h4'), /EngineData \(signals\.dbc\)/);
  await closeReport(page);
});

test('search finds messages and signals of a database', async () => {
  const page = await openReport(file);
  for (const [text, count] of [
    ['pressure', 1],
    ['2500', 1],
    ['pages level', 2],
    ['first;', 1],
    ['nonsense', 0],
  ]) {
    await page.fill('#search', text);
    await page.waitForFunction(
      (words) => document.querySelector('.found').textContent.startsWith(words),
      `${count} of ${frames.length}`,
    );
  }
  await closeReport(page);
});

/** Opens the tab of signals and ticks one of them. */
async function plot(page, name) {
  await page.click('#tab-signals');
  await page.fill('#panel-signals input[type=search]', name);
  await page.click('#panel-signals .rows .row >> nth=0');
}

test('CSV has a column for each signal that the table shows', async () => {
  const page = await openReport(file);
  await page.fill('#search', 'pages');
  await page.waitForFunction(() => document.querySelector('.found').textContent.startsWith('6 of'));
  const {text} = await saved(page, '#panel-frames button.csv');
  const [head, first, second] = text.split('\r\n');
  assert.equal(
    head.split('lost,')[1],
    'Pages.Page,"Pages.Pressure, kPa","Pages.Level, %",Pages.SubPage,Pages.Deep',
  );
  assert.match(first, /,"Page 1, Pressure 100 kPa",.*,1,100,,,$/);
  assert.match(second, /,2,,1\.5,,$/);
  await page.fill('#search', 'enginedata');
  await page.waitForFunction(() => document.querySelector('.found').textContent.startsWith('4 of'));
  const quoted = await saved(page, '#panel-frames button.csv');
  assert.ok(quoted.text.includes(',"EngineData.Torque, Nm; 100""%""",'), quoted.text);
  await closeReport(page);
});

test('chosen signals are plotted below the bus on its time axis', async () => {
  const page = await openReport(file, {height: 1000});
  await plot(page, 'EngineData.Speed');
  await page.keyboard.press('Escape');
  const [from, to] = [log[0].time, log[3].end + 20 * bit];
  await setView(page, from, to);
  const picture = await inspect(page);
  const points = itemsOf(picture, 'point');
  const scale = (picture.width - picture.left) / (picture.to - picture.from);
  assert.deepEqual(
    points.map(({value}) => value),
    [2400, 2401, 0.25, 0.25],
  );
  points.forEach(({x, time}, i) => {
    assert.equal(time, log[i].end, 'a value is there from the end of its frame on');
    assert.ok(Math.abs(x - (picture.left + (time - picture.from) * scale)) < 1e-6);
  });
  const [lane] = itemsOf(picture, 'signal');
  const height = (value) => lane.y1 - 7 - ((value - 0.25) / 2400.75) * (lane.y1 - lane.y0 - 14);
  points.forEach(({y, value}) =>
    assert.ok(Math.abs(y - height(value)) < 0.01, `height of ${value}`),
  );
  assert.equal(lane.text, '0.25 rpm', 'the value at the right end of the view');
  assertColor(
    await pixel(page, '.scope-signals', points[0].x + 0.5, points[0].y),
    await cssColor(page, 'n-0'),
    'the colour of the sender',
  );
  await setView(page, from + 0.1 * (to - from), to + 0.1 * (to - from));
  const moved = itemsOf(await inspect(page), 'point');
  assert.ok(moved[1].x < points[1].x - 50, 'it moves with the view');
  const box = await (await page.$('.scope-signals')).boundingBox();
  await page.mouse.move(box.x + moved[1].x + 5, box.y + 20);
  assert.match(await page.textContent('.tooltip'), /EngineData\.Speed: 2401 rpm/);
  await closeReport(page);
});

test('choices are plotted as words; what is not ticked any more goes', async () => {
  const page = await openReport(file, {height: 1000});
  await plot(page, 'Gear');
  await setView(page, log[0].time, log[3].end + 20 * bit);
  const choices = itemsOf(await inspect(page), 'choice').map(({value, text}) => [value, text]);
  assert.deepEqual(choices, [
    [1, 'First; slow'],
    [7, 'Fault'],
    [2, '2'],
  ]);
  await plot(page, 'Counter');
  assert.equal(itemsOf(await inspect(page), 'signal').length, 2);
  await screenshot(page, 'dbc-plots');
  await page.click('#panel-signals .rows .row >> nth=0');
  assert.deepEqual(
    itemsOf(await inspect(page), 'signal').map(({signal}) => signal),
    ['Gear'],
  );
  await page.click('button:has-text("plot none")');
  await page.waitForSelector('.signal-lanes', {state: 'hidden'});
  await closeReport(page);
});

test('a file is opened by the button, closed again, and replaced by one of its name', async () => {
  const page = await openReport(writeScene('dbc-open', plain));
  assert.equal((await rowsOf(page, 'frames'))[0].length, 10, 'no column of signals without one');
  const path = join(outDir, 'opened.dbc');
  writeFileSync(path, dbc);
  await page.click('#tab-signals');
  const chooser = page.waitForEvent('filechooser');
  await page.click('button:has-text("open DBC")');
  await (await chooser).setFiles(path);
  await page.waitForSelector('.file:has-text("opened.dbc")');
  const first = await rowsOf(page, 'signals');
  assert.equal(first.length > 0, true);
  await plot(page, 'EngineData.Speed');
  writeFileSync(path, dbc.replace('(0.25,0) [0|16383.75] "rpm"', '(0.5,0) [0|16383.75] "1/min"'));
  await page.setInputFiles('input[type=file]', path);
  await page.waitForFunction(() =>
    document.querySelector('#panel-signals .rows').textContent.includes('1/min'),
  );
  assert.equal(await page.$$eval('.file', (files) => files.length), 1);
  await page.keyboard.press('Escape');
  assert.deepEqual(
    itemsOf(await inspect(page), 'signal').map(({text}) => text),
    ['0.5 1/min'],
    'the plot follows the new file',
  );
  await page.click('[aria-label="Close opened.dbc"]');
  await page.waitForSelector('.signal-lanes', {state: 'hidden'});
  await page.click('#tab-frames');
  assert.equal((await rowsOf(page, 'frames'))[0].length, 10);
  await closeReport(page);
});

/** Drops a file onto the page as a hand does. */
const drop = (page, name, text) =>
  page.evaluate(
    ([fileName, content]) => {
      const data = new DataTransfer();
      data.items.add(new File([content], fileName));
      const fire = (type) =>
        document.body.dispatchEvent(
          new DragEvent(type, {dataTransfer: data, bubbles: true, cancelable: true}),
        );
      fire('dragover');
      return fire('drop');
    },
    [name, text],
  );

test('a file is dropped; with one that has the same messages it is refused', async () => {
  const page = await openReport(writeScene('dbc-open', plain));
  assert.equal(await drop(page, 'dropped.dbc', dbc), false, 'the browser does not open it itself');
  await page.waitForFunction(() => window.verican.report.databases.count === 1);
  assert.deepEqual((await shown(page))[0], [frames[0][2], frames[0][3]]);
  await drop(page, 'again.dbc', dbc);
  await page.waitForSelector('[role=alert]:visible');
  assert.match(
    await page.textContent('[role=alert]'),
    new RegExp('again\\.dbc cannot be used: line 11: message EngineData has the identifier 123 ' +
      'of EngineData in dropped\\.dbc; allowed: one message for an identifier'),
  );
  assert.equal(await page.evaluate(() => window.verican.report.databases.count), 1);
  await closeReport(page);
});

test('a file of no use is refused with its line and the reason; the page goes on', async () => {
  const page = await openReport(file);
  for (const [name, [text, message]] of Object.entries(bad)) {
    await page.evaluate(() => window.verican.opener.quiet());
    await drop(page, 'x.dbc', text);
    await page.waitForSelector('[role=alert]:visible');
    assert.match(await page.textContent('[role=alert]'), message, name);
    assert.equal(await page.evaluate(() => window.verican.report.databases.count), 1, name);
  }
  assert.deepEqual((await shown(page))[0], [frames[0][2], frames[0][3]]);
  await page.click('[role=alert] button');
  assert.equal(await page.isVisible('[role=alert]'), false);
  await page.click('#panel-frames .row >> nth=2');
  assert.equal((await viewOf(page)).selection.kind, 'frame');
  await closeReport(page);
});

test('a database of the report that is of no use is said; the rest is shown', async () => {
  const databases = [
    {name: 'bad.dbc', text: 'BO_ x'},
    {name: 'signals.dbc', text: dbc},
  ];
  const page = await openReport(writeScene('dbc-bad', sceneOf(frames, {databases})));
  assert.match(await page.textContent('[role=alert]'), /bad\.dbc cannot be used: line 1/);
  assert.deepEqual((await shown(page))[0], [frames[0][2], frames[0][3]]);
  await closeReport(page);
});

test('names and units of a database stay text', async () => {
  const text = 'BO_ 291 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] "<img src=x onerror=alert(1)>" X\n';
  const databases = [{name: '<b>.dbc', text}];
  const page = await openReport(writeScene('dbc-hostile', sceneOf(frames, {databases})));
  assert.equal((await shown(page))[0][1], 'S 37 <img src=x onerror=alert(1)>');
  await page.click('#tab-signals');
  assert.equal(await page.$$eval('#app img, .file b', (found) => found.length), 0);
  await closeReport(page);
});
