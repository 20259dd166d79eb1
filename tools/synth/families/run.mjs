// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run.mjs MODULES OUT SCRIPT FILE...: runs a Yosys script by the npm package @yowasp/yosys, which
// has no command line of its own, in a file system that holds the FILEs under their base names.
// What it writes below out/ is written to the folder OUT; so is its log, yosys.log.
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {pathToFileURL} from 'node:url';

const [modules, out, script, ...files] = process.argv.slice(2);
if (!script) {
  console.error('usage: run.mjs MODULES OUT SCRIPT FILE...');
  process.exit(2);
}
const package_ = join(modules, '@yowasp/yosys/gen/bundle.js');
const {runYosys} = await import(pathToFileURL(package_));
const tree = {out: {}};
for (const file of files) tree[basename(file)] = readFileSync(file);
tree['run.ys'] = script;

const log = [];
const keep = (bytes) => bytes && log.push(Buffer.from(bytes));
let result;
let status = 0;
try {
  result = await runYosys(['-s', 'run.ys'], tree, {stdout: keep, stderr: keep});
} catch (error) {
  if (error.files === undefined) throw error;
  result = error.files; // Yosys ended with an error
  status = 1;
}
mkdirSync(out, {recursive: true});
writeFileSync(join(out, 'yosys.log'), Buffer.concat(log));
for (const [name, content] of Object.entries(result.out ?? {}))
  writeFileSync(join(out, name), content);
if (status) console.error(Buffer.concat(log).toString().slice(-500));
process.exit(status);
