// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How the page looks: units, whole labels, lanes that scroll, colours that all people tell apart.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import * as browser from './browser.mjs';
import {F} from './can.mjs';
import {distance, lab, visions} from './colour.mjs';
import {Scene} from './scene.mjs';
import {smallScene} from './scenes.mjs';

const {closeReport, cssColor, inspect, itemsOf, openReport, screenshot, setView, writeScene} =
  browser;

const small = smallScene();
const {log, bit} = small.scene;
const file = browser.reportFor('look', small);

test('the distance of colours is CIEDE2000: pairs of Sharma, Wu and Dalal', () => {
  const pairs = [
    [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425],
    [[50, 2.5, 0], [73, 25, -18], 27.1492],
    [[60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644],
    [[6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377],
    [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082],
  ];
  for (const [a, b, wanted] of pairs) assert.ok(Math.abs(distance(a, b) - wanted) < 5e-5);
});

for (const dark of [false, true]) {
  test(`errors are apart from every node for all eyes, ${dark ? 'dark' : 'light'}`, async () => {
    const page = await openReport(file, {dark});
    const nodes = [];
    for (let i = 0; i < 16; ++i) nodes.push(await cssColor(page, `n-${i}`));
    for (const name of ['f-error', 'alarm']) {
      const error = await cssColor(page, name);
      for (const vision of visions) {
        nodes.forEach((node, i) => {
          const apart = distance(lab(error, vision), lab(node, vision));
          assert.ok(apart >= 15, `${name} and n-${i}, ${vision}: ${apart.toFixed(1)}, 15 needed`);
        });
      }
    }
    await closeReport(page);
  });
}

test('what has a unit says it: headings of tables and axes', async () => {
  const page = await openReport(file);
  const heads = async (panel, selector) => {
    await page.click(`#tab-${panel}`);
    return page.$$eval(`#panel-${panel} ${selector}`, (cells) => cells.map((c) => c.textContent));
  };
  const frames = await heads('frames', '.head .cell');
  assert.ok(frames.includes('time, ms') && frames.includes('response, ms'), frames.join('|'));
  assert.ok((await heads('events', '.head .cell')).includes('time, ms'));
  const response = await heads('response', 'th');
  for (const name of ['min, ms', 'mean, ms', 'max, ms', 'bound, ms'])
    assert.ok(response.includes(name), response.join('|'));
  const nodes = await heads('nodes', 'th');
  for (const name of ['clock, MHz', 'error, ppm', 'quantum, ns', 'sample point, %'])
    assert.ok(nodes.includes(name), nodes.join('|'));
  const labels = await page.evaluate(() =>
    ['load', 'response'].map((id) => {
      const {plot} = window.verican.tabs.entries.find((entry) => entry.id === id);
      return plot.parts.options(plot).label;
    }),
  );
  assert.deepEqual(labels, ['bus load, %', 'response time, ms']);
  await closeReport(page);
});

test('every label of the ruler is whole, wherever the view ends', async () => {
  const late = new Scene(['a', 'b']);
  late.frame(0, {id: 1, dlc: 0}, {gap: 1.9e6}); // after seconds: long labels
  const page = await openReport(writeScene('look-late', late.finish()));
  const {time} = late.log[0];
  for (let i = 0; i < 40; ++i) {
    await setView(page, time + i * 0.37 * bit, time + (i * 0.37 + 3 + 9 * i) * bit);
    const picture = await inspect(page);
    const labels = itemsOf(picture, 'label');
    assert.ok(labels.length > 2, `${labels.length} labels`);
    labels.forEach(({text, x0, x1}, n) => {
      assert.ok(x1 <= picture.width - 1, `${text} ends at ${x1} of ${picture.width}`);
      assert.ok(n === 0 || x0 > labels[n - 1].x1, `${text} stands on the label before`);
    });
  }
  await closeReport(page);
});

test('the last label of a plot over time is whole', async () => {
  const page = await openReport(file);
  await page.click('#tab-load');
  const room = await page
    .waitForFunction(() => {
      const u = window.verican.tabs.entries.find((e) => e.id === 'load').plot.plot;
      return u && u.root.clientWidth - u.over.offsetLeft - u.over.offsetWidth;
    })
    .then((handle) => handle.jsonValue());
  assert.ok(room >= 36, `${room} px beside the plot; half of "12345.678 ms" needs 36`);
  await closeReport(page);
});

/** {x, busy, lost} of the plot of the bus load. */
async function loadPlot(page) {
  await page.click('#tab-load');
  const data = await page.waitForFunction(() => {
    const {plot} = window.verican.tabs.entries.find((entry) => entry.id === 'load').plot;
    return plot && plot.data.map((column) => [...column]);
  });
  const [x, busy, lost] = await data.jsonValue();
  return {x, busy, lost};
}

test('where a limit has cut off the details the load is not told', async () => {
  const cut = new Scene(['a', 'b']);
  for (let i = 0; i < 8; ++i) cut.frame(0, {id: i, dlc: 1, data: [i]}, {gap: 60});
  const end = cut.log[4].time - 30 * bit;
  const file = writeScene('look-cut', cut.finish({detail_end_ns: end, truncated: 'Cut.'}));
  const page = await openReport(file);
  const {x, busy, lost} = await loadPlot(page);
  const step = x[1] - x[0];
  let sum = 0;
  x.forEach((from, i) => {
    const known = Math.min(from + step, end) - Math.max(from, 0); // of the window, of the run
    assert.equal(busy[i] === null, known <= 0, `${from} ns`);
    assert.equal(lost[i], busy[i] === null ? null : 0);
    sum += known > 0 ? (busy[i] / 100) * known : 0;
  });
  const four = cut.log.slice(0, 4).reduce((time, f) => time + f.end - f.time + 3 * bit, 0);
  assert.ok(Math.abs(sum - four) < 1, `${sum} ns busy, of four frames ${four}`);
  assert.match(await page.textContent('#panel-load'), /not known from [\d.]+ ms on: no bits were/);
  const [mark] = await page.evaluate(() => {
    const {overview} = window.verican;
    overview.painter.items = [];
    overview.draw();
    return overview.painter.items.filter(({kind}) => kind === 'unknown');
  });
  const places = await page.evaluate(
    ([a, b]) => [window.verican.overview.x(a), window.verican.overview.x(b)],
    [end, cut.now],
  );
  assert.ok(Math.abs(mark.x0 - places[0]) < 1 && mark.x1 > mark.x0, JSON.stringify([mark, places]));
  await screenshot(page, 'look-cut');
  await closeReport(page);
  const whole = await openReport(writeScene('look-whole', cut.finish()));
  assert.doesNotMatch(await whole.textContent('#panel-load'), /not known/);
  await closeReport(whole);
});

// A node whose cable is open sends, and nobody hears it: the head counts no load for that either.
test('what nobody hears is no load', async () => {
  const scene = new Scene(['a', 'b', 'cut off']);
  scene.frame(0, {id: 0x123, dlc: 1, data: [1]}, {gap: 60});
  const silence = (count) => Array.from({length: count}, () => ({field: F.ID, sent: 1}));
  scene.segment([{node: 2, bits: silence(100)}]);
  scene.now += 160 * scene.bit;
  const sent = Scene.sent({id: 0x321, dlc: 1, data: [2]});
  const ack = sent.findIndex(({field}) => field === F.ACK);
  const tail = silence(100);
  const [own, other] = [[...sent, ...tail], silence(sent.length + tail.length)];
  scene.segment([{node: 0, bits: own}, {node: 2, bits: other}], {1: {[ack]: 0}});
  scene.now += (own.length + 60) * scene.bit;
  const page = await openReport(writeScene('look-unheard', scene.finish()));
  const {x, busy, lost} = await loadPlot(page);
  const step = x[1] - x[0];
  const sum = (list) =>
    list.reduce((time, part, i) => {
      const known = Math.min(x[i] + step, scene.now) - Math.max(x[i], 0);
      return time + (known > 0 ? ((part ?? 0) / 100) * known : 0);
    }, 0);
  const frame = scene.log[0].end - scene.log[0].time + 3 * scene.bit;
  const second = (sent.length + 3) * scene.bit; // no acknowledged one of the table of frames
  assert.ok(Math.abs(sum(busy) - frame - second) < 1, `${sum(busy)} ns, not ${frame + second}`);
  assert.ok(Math.abs(sum(lost) - second) < 1, `${sum(lost)} ns lost, not ${second}`);
  await closeReport(page);
});

test('lanes say that there are more of them, on both sides', async () => {
  const names = Array.from({length: 24}, (_, i) => `node ${i}`);
  const scene = new Scene(names, {title: 'Many nodes'});
  scene.frame(3, {id: 0x111, dlc: 1, data: [1]});
  const page = await openReport(writeScene('look-many', scene.finish()));
  const below = '.lane-hint.below:visible';
  const above = '.lane-hint.above:visible';
  await page.waitForSelector(below);
  const shown = await page.evaluate(() => {
    const {scroll, laneHeight} = window.verican.scope;
    return scroll.clientHeight / laneHeight;
  });
  const text = await page.textContent(below);
  const hidden = Number(text.match(/^▾ (\d+) more nodes$/)?.[1]);
  assert.ok(Math.abs(hidden - (24 - shown)) < 1, `${text}, ${shown} of 24 in sight`);
  assert.equal(await page.$(above), null);
  await screenshot(page, 'look-lanes');
  await page.click(below);
  await page.waitForSelector(above);
  await page.evaluate(() => window.verican.scope.scroll.scrollTo(0, 1e6));
  await page.waitForSelector(below, {state: 'hidden'});
  await closeReport(page);
  const few = await openReport(file);
  assert.equal(await few.$(below), null, 'three nodes fit');
  await closeReport(few);
});

// Half of a laptop's screen, and less: what does not fit is wrapped or scrolled, not cut off.
test('in a small window all tabs are in sight, and all of the page can be reached', async () => {
  for (const [width, height] of [
    [900, 600],
    [640, 480],
    [1280, 420],
  ]) {
    const page = await openReport(file, {width, height, fresh: true});
    const tabs = await page.$$eval('.tabs button', (buttons) => {
      const area = document.querySelector('.tab-area').getBoundingClientRect();
      return buttons.map((button) => {
        const {left, right, bottom} = button.getBoundingClientRect();
        return {
          name: button.textContent,
          whole: left >= area.left && right <= area.right && bottom <= area.bottom,
        };
      });
    });
    assert.ok(tabs.length >= 8);
    for (const {name, whole} of tabs) assert.ok(whole, `${name} at ${width} x ${height}`);
    await page.mouse.move(width / 2, 12); // on the title
    await page.mouse.wheel(0, 5000);
    await page.waitForFunction(
      () => document.querySelector('.bottom').getBoundingClientRect().bottom <= innerHeight,
    );
    await screenshot(page, `look-${width}x${height}`);
    await closeReport(page);
  }
});
