// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens reports in headless Chromium and watches over what they do. Environment:
// VERICAN_REPORT_PAGE template of the page, VERICAN_REPORT_MODULES npm packages,
// VERICAN_CHROMIUM the browser, VERICAN_OUT folder for pages and screenshots.
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {after, before} from 'node:test';
import {pathToFileURL} from 'node:url';
import {pack, writeReport} from './writer.mjs';

const given = process.env.VERICAN_CHROMIUM ?? '';
const chromiumPath = existsSync(given) ? given : '/usr/bin/chromium';
export const outDir = process.env.VERICAN_OUT;
export const template = process.env.VERICAN_REPORT_PAGE;
const patience = 120000; // for slow machines

/** Ends the program: as skipped, but as failed where CI promises every package. */
export function without(what, debianPackage) {
  console.log(`skipped: ${what} is not there (Debian package ${debianPackage})`);
  process.exit(process.env.CI === 'true' ? 1 : 77);
}

if (!existsSync(chromiumPath)) without(chromiumPath, 'chromium');
mkdirSync(outDir, {recursive: true});
const {chromium} = createRequire(join(process.env.VERICAN_REPORT_MODULES, 'x.js'))(
  'playwright-core',
);

let browser = null;

/** One browser for all tests of a file. */
export async function openBrowser() {
  const root = process.getuid() === 0 ? ['--no-sandbox'] : [];
  browser = await chromium.launch({
    executablePath: chromiumPath,
    timeout: patience,
    args: [...root, '--disable-dev-shm-usage', '--disable-gpu'],
  });
}

export const closeBrowser = () => browser.close();

/** Writes a scene's report and returns its path. */
export function writeScene(name, {meta, columns}, change = (packed) => packed) {
  const path = join(outDir, `${name}.html`);
  writeReport(template, path, change(pack(meta, columns)));
  return path;
}

/** A browser for all tests of a file, and the report of a scene for them: its path. */
export function reportFor(name, scene) {
  before(async () => {
    await openBrowser();
    writeScene(name, scene);
  });
  after(closeBrowser);
  return join(outDir, `${name}.html`);
}

const pages = new Map(); // by their size and colours; a new one costs more than a test

/** A page that notes its problems and requests. */
async function newPage({width, height}) {
  const context = await browser.newContext({viewport: {width, height}, reducedMotion: 'reduce'});
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  page.on('console', (message) => {
    const ours = message.text().includes('getImageData'); // pixel() below, not the page
    if (['error', 'warning'].includes(message.type()) && !ours) page.problems.push(message.text());
  });
  page.on('pageerror', (error) => page.problems.push(error.stack));
  page.on('request', (request) => page.requests.push(request.url()));
  return page;
}

/**
 * Opens a file. The page that comes back has what it said and asked for: problems (console errors
 * and exceptions), requests (addresses).
 */
export async function openReport(path, options = {}) {
  const {hash = '', width = 1280, height = 720, dark = false, fresh = false} = options;
  const key = `${width} ${height}`;
  const page = (!fresh && pages.get(key)) || (await newPage({width, height}));
  pages.delete(key);
  page.poolKey = fresh ? null : key;
  page.problems = [];
  page.requests = [];
  await page.emulateMedia({colorScheme: dark ? 'dark' : 'light', reducedMotion: 'reduce'});
  await page.goto('about:blank'); // else another part of the same file would not load it anew
  page.requests = [];
  await page.goto(pathToFileURL(path).href + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await settle(page); // sizes of the first layout are drawn a frame after it
  return page;
}

/** Waits until all that was asked for is drawn. */
export const settle = (page) =>
  page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );

/** Ends a page; nothing went wrong in it and it asked for nothing but itself. */
export async function closeReport(page) {
  assert.deepEqual(page.problems, []);
  const others = page.requests.filter(
    (url) => !url.startsWith('file:') && !url.startsWith('data:'),
  );
  assert.deepEqual(others, [], 'no request leaves the file');
  assert.equal(page.requests.filter((url) => url.startsWith('file:')).length, 1);
  if (page.poolKey && !pages.has(page.poolKey)) pages.set(page.poolKey, page);
  else await page.context().close();
}

/** What the scope shows: {from, to, mode, items...}. */
export const inspect = (page) => page.evaluate(() => window.verican.inspect());
export const itemsOf = (picture, kind) => picture.items.filter((item) => item.kind === kind);
export const setView = (page, from, to) =>
  page.evaluate(([a, b]) => window.verican.view.set(a, b), [from, to]);
export const viewOf = (page) =>
  page.evaluate(() => ({
    from: window.verican.view.from,
    to: window.verican.view.to,
    selection: window.verican.view.selection,
  }));

/** Texts of the rows in sight, by columns. */
export const rowsOf = (page, panel) =>
  page.$$eval(`#panel-${panel} .rows .row`, (rows) =>
    rows.map((row) => [...row.children].map((cell) => cell.textContent)),
  );

/** Colour of a point of a canvas: [r, g, b], x and y in CSS pixels. */
export const pixel = (page, canvas, x, y) =>
  page.$eval(
    canvas,
    (element, [px, py]) => {
      const scale = window.devicePixelRatio;
      return [...element.getContext('2d').getImageData(px * scale, py * scale, 1, 1).data].slice(
        0,
        3,
      );
    },
    [x, y],
  );

/** A colour of the style sheet: [r, g, b]. */
export async function cssColor(page, name) {
  const text = await page.evaluate(
    (n) => getComputedStyle(document.documentElement).getPropertyValue(`--${n}`).trim(),
    name,
  );
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));
}

export const blend = (color, ground, alpha) =>
  color.map((c, i) => c * alpha + ground[i] * (1 - alpha));

export function assertColor(seen, wanted, text) {
  const near = seen.every((c, i) => Math.abs(c - wanted[i]) <= 8);
  assert.ok(near, `${text}: seen ${seen}, wanted ${wanted.map(Math.round)}`);
}

export const screenshot = (page, name) => page.screenshot({path: join(outDir, `${name}.png`)});

/** Presses a button that saves a file; its name, bytes and text. */
export async function saved(page, selector) {
  const waiting = page.waitForEvent('download');
  await page.click(selector);
  const download = await waiting;
  const bytes = readFileSync(await download.path());
  return {name: download.suggestedFilename(), bytes, text: bytes.toString()};
}
