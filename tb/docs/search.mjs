// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// search.mjs ADDRESS: opens the site there in headless Chromium, searches for a word, and prints as
// JSON which links were found and which requests went to anywhere else. Environment:
// VERICAN_REPORT_MODULES npm packages.
import {createRequire} from 'node:module';
import {join} from 'node:path';

const {chromium} = createRequire(join(process.env.VERICAN_REPORT_MODULES, 'x.js'))(
  'playwright-core',
);
const address = process.argv[2];
const patience = 240000; // for slow machines
const root = process.getuid() === 0 ? ['--no-sandbox'] : [];
const browser = await chromium.launch({
  executablePath: '/usr/bin/chromium',
  timeout: patience,
  args: [...root, '--disable-dev-shm-usage', '--disable-gpu'],
});
const page = await browser.newPage();
const outside = [];
page.on('request', (request) => {
  if (!request.url().startsWith(address) && !/^(data|blob):/.test(request.url()))
    outside.push(request.url());
});
await page.goto(`${address}index.html`, {timeout: patience});
// Typed anew until there are results: a busy page may miss what is typed while it loads.
const results = '.md-search-result__list a[href]';
const end = Date.now() + patience;
for (let typed = false; !typed; ) {
  await page.fill('input[name="query"]', '');
  await page.type('input[name="query"]', 'overload');
  typed = await page
    .waitForSelector(results, {timeout: 10000, state: 'attached'})
    .then(() => true)
    .catch((reason) => {
      if (Date.now() > end) throw reason;
      return false;
    });
}
const found = await page.$$eval(results, (links) => links.map((link) => link.href));
await browser.close();
console.log(JSON.stringify({found, outside}));
