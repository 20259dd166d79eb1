// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// build.mjs MODULES PAGE OUT: makes one HTML file of a page. MODULES is the node_modules folder
// with esbuild, uPlot and candied, PAGE the name of the page (below), OUT the file to write. Script
// and style are inlined and named by their hashes in a content security policy that allows nothing
// else: the page cannot reach a network.
import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

// Each page: the folder below src/ of its main.js and style.css, what it is, whose code is in it.
const kPages = {
  report: {
    folder: '.',
    what: 'A report of a simulated CAN bus: docs/report.md',
    libraries: {uplot: 'uPlot', candied: 'parts of candied'},
  },
  timesync: {
    folder: 'timesync',
    what: 'How well clocks were synchronised over a simulated CAN bus: docs/timesync.md',
    libraries: {uplot: 'uPlot'},
  },
};
const [modulesPath, name, outPath] = process.argv.slice(2);
const wanted = kPages[name];
if (!wanted || !outPath) {
  console.error(`usage: node build.mjs NODE_MODULES ${Object.keys(kPages).join('|')} OUT.html`);
  process.exit(2);
}
const [modules, out] = [modulesPath, outPath].map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(modules, 'x.js'))('esbuild');

function bundle(entry) {
  const result = esbuild.buildSync({
    entryPoints: [join(here, 'src', wanted.folder, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'none',
    nodePaths: [modules],
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

// What stands in the way of a replacement string is its "$"; a function has no such letters.
const fill = (text, mark, value) => {
  const at = text.indexOf(mark);
  if (at < 0 || text.indexOf(mark, at + 1) >= 0) throw new Error(`one ${mark} is needed`);
  return text.replace(mark, () => value);
};

const script = bundle('main.js');
const style = bundle('style.css');
if (/<\/(script|style)/i.test(script + style)) throw new Error('an end tag in script or style');
const policy =
  `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; ` +
  `img-src data:; base-uri 'none'; form-action 'none'`;
const licence = Object.keys(wanted.libraries)
  .map((part) => `${part}: ${readFileSync(join(modules, part, 'LICENSE'), 'utf8').trim()}`)
  .join('\n\n');

let page = readFileSync(join(here, 'src', 'page.html'), 'utf8');
page = fill(page, '{{policy}}', policy);
page = fill(page, '{{what}}', wanted.what);
page = fill(page, '{{parts}}', Object.values(wanted.libraries).join(' and '));
page = fill(page, '{{licence}}', licence.replaceAll('--', '- -'));
page = fill(page, '/*{{style}}*/', style);
page = fill(page, '/*{{script}}*/', script);
for (const mark of ['META', 'DATA']) {
  if (!page.split('\n').includes(`<!--VERICAN-${mark}-->`)) {
    throw new Error(`VERICAN-${mark} must stand on a line of its own`);
  }
}
writeFileSync(out, page);
