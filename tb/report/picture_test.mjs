// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The view as a picture file: it shows what the page shows.
import assert from 'node:assert/strict';
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import * as browser from './browser.mjs';
import {smallScene} from './scenes.mjs';

const {assertColor, closeReport, inspect, itemsOf, openReport, outDir, pixel, saved} = browser;

const text = 'BO_ 291 Speeds: 2 X\n SG_ Wheel : 7|16@0+ (1,0) [0|0] "<m\x01/s>" X\n';
const title = 'Small & <round>\x1b \u{1f68c}';
const small = smallScene({databases: [{name: 'a.dbc', text}], title});
const {log, bit} = small.scene;
const file = browser.reportFor('picture', small);
const kTitle = 26; // height of the title above the view

/** Opens the report at its first frame, with a signal below the bus. */
async function openView() {
  const page = await openReport(file, {height: 1000});
  await page.evaluate(() => {
    const [message] = window.verican.report.databases.messages;
    window.verican.chosen.toggle(message, message.signals[0]);
  });
  await browser.setView(page, log[0].time - 2 * bit, log[0].end + 20 * bit);
  await inspect(page);
  return page;
}

/** Saves the view and returns it with colours of its points: at(x, y), in pixels of the page. */
async function picture(page, kind) {
  const download = await saved(page, `button:text-is("${kind.toUpperCase()}")`);
  writeFileSync(join(outDir, `view.${kind}`), download.bytes);
  const type = {png: 'image/png', svg: 'image/svg+xml'}[kind];
  const size = await page.evaluate(
    async (address) => {
      const image = new Image();
      image.src = address;
      await image.decode();
      const canvas = document.createElement('canvas');
      canvas.width = image.naturalWidth;
      canvas.height = image.naturalHeight;
      window.shown = canvas.getContext('2d', {willReadFrequently: true});
      window.shown.drawImage(image, 0, 0);
      return [image.naturalWidth, image.naturalHeight];
    },
    `data:${type};base64,${download.bytes.toString('base64')}`,
  );
  const at = (x, y) =>
    page.evaluate(
      ([a, b]) => [...window.shown.getImageData(a, b, 1, 1).data].slice(0, 3),
      [x * (kind === 'png' ? 2 : 1), y * (kind === 'png' ? 2 : 1)],
    );
  return {...download, size, at};
}

for (const kind of ['png', 'svg']) {
  test(`${kind.toUpperCase()}: bus, signal and lanes are where the page has them`, async () => {
    const page = await openView();
    const view = await inspect(page);
    const {name, size, at} = await picture(page, kind);
    assert.equal(name, `Small-round-view.${kind}`);
    const heights = await page.evaluate(() =>
      ['.scope-top', '.scope-signals', '.scope-lanes'].map(
        (canvas) => document.querySelector(canvas).clientHeight,
      ),
    );
    const [top, signals, lanes] = heights;
    const finer = kind === 'png' ? 2 : 1;
    assert.deepEqual(
      size,
      [view.width, kTitle + top + signals + lanes].map((px) => px * finer),
    );
    const data = itemsOf(view, 'field').filter(({field, own}) => field === 'DATA' && !own)[0];
    const crc = itemsOf(view, 'field').filter(({field, own}) => field === 'CRC' && !own)[0];
    const [point] = itemsOf(view, 'point');
    const look = async (canvas, x, y, below, what) =>
      assertColor(await at(x, kTitle + below + y), await pixel(page, canvas, x, y), what);
    await look('.scope-top', data.x0 + 4, data.y + 4, 0, 'a data byte');
    await look('.scope-top', crc.x0 + 4, crc.y + 4, 0, 'the checksum');
    await look('.scope-signals', point.x, point.y, top, 'a value of the signal');
    await look('.scope-lanes', view.left + 6, 8, top + signals, 'a lane');
    await look('.scope-lanes', 1, 30, top + signals, 'colour of the first node');
    await closeReport(page);
  });
}

test('texts of a drawing are texts, and stay texts', async () => {
  const page = await openView();
  const {text: svg} = await picture(page, 'svg');
  const texts = await page.evaluate((source) => {
    const tree = new DOMParser().parseFromString(source, 'image/svg+xml');
    const wrong = tree.querySelector('parsererror, script, round, m');
    return {
      wrong: wrong?.tagName ?? '',
      texts: [...tree.querySelectorAll('text')].map((node) => node.textContent),
    };
  }, svg);
  assert.equal(texts.wrong, '');
  assert.match(texts.texts[0], /^Small & <round>\ufffd \u{1f68c} {2}· {2}500 kbit\/s/u);
  for (const wanted of ['CAN_H', 'ID 123', 'left', 'Wheel', '51966 <m\ufffd/s>'])
    assert.ok(texts.texts.includes(wanted), `${wanted} in ${texts.texts}`);
  await closeReport(page);
});
