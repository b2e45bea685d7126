// SPDX-License-Identifier: LGPL-3.0-or-later
// The documentation site in Chromium: it searches pages, begins with tutorials, fits a telephone, and replays a run. scripts/docs.sh runs this.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch } from '../viewer/browser.mjs';

const site = resolve(process.env.CELLWALK_SITE ?? 'build/docs/html'), live = 'live/aorta.html';
const telephone = { width: 390, height: 844 }, desk = { width: 1280, height: 800 }, patience = 120000;  // pixels, ms
let browser;

before(async () => { browser = await launch(); });
after(async () => { await browser?.close(); });

/** Opens a page of the site; what it complains of or asks the network for is collected. */
async function open(name, viewport) {
  const page = await browser.newPage({ viewport });
  page.setDefaultTimeout(patience);
  page.complaints = [];
  page.on('console', message => { if (message.type() === 'error') page.complaints.push(message.text()); });
  page.on('pageerror', error => page.complaints.push(error.message));
  page.on('request', request => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`asks for ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(site, name)).href);
  return page;
}

/** What a search finds, as texts and addresses. */
async function found(page, words) {
  await page.fill('#MSearchField', '');
  await page.type('#MSearchField', words);
  const results = page.frameLocator('#MSearchResults');
  await results.locator('.SRResult:visible').first().waitFor({ timeout: patience });
  return results.locator('.SRResult:visible').evaluateAll(rows => rows.map(row =>
    ({ text: row.textContent, links: [...row.querySelectorAll('a')].map(link => link.getAttribute('href')) })));
}

test('search finds words of pages, headings and names', async () => {
  const page = await open('index.html', desk);
  for (const [words, address] of [['gymnasium', 'md_docs_catheter.html'], ['wheel', 'md_docs_embedding.html'], ['slit', 'md_docs_generators.html'],
    ['radius: the theory', 'md_docs_radius.html'], ['thick walls', 'md_docs_surfaces.html#docs-surfaces-md-thick-walls'], ['sweep_edge', 'cellwalk']]) {
    const rows = await found(page, words);
    assert.ok(rows.some(row => row.links.some(link => link.includes(address))), `${words}: ${JSON.stringify(rows).slice(0, 400)}`);
  }
  await page.close();
});

test('a word leads to its section', async () => {
  const page = await open('md_docs_start.html', desk);
  await found(page, 'gymnasium');
  const results = page.frameLocator('#MSearchResults'), row = results.locator('.SRResult:visible', { hasText: 'in pages' }).first();
  await row.locator('a').first().click();
  await row.locator('.SRChildren a', { hasText: 'A catheter to learn with' }).first().click();
  await page.waitForURL(/md_docs_catheter\.html/);
  await page.close();
});

test('the tree begins with tutorials', async () => {
  const page = await open('index.html', desk);
  await page.waitForSelector('#nav-tree-contents .label');
  const first = await page.locator('#nav-tree-contents .label').allTextContents();
  assert.deepEqual(first.slice(0, 4), ['Cellwalk', 'Start', 'From an OFF file to contacts', 'A solver of your own, in C++']);
  await page.close();
});

test('pages fit a telephone', async () => {
  const names = ['index', 'md_docs_start', 'md_docs_gallery', 'md_docs_commands', 'md_docs_radius', 'md_docs_python_reference', 'md_docs_tutorials_solver',
    'md_experiments_01_figure_8_README', 'md_experiments_06_real_scenes_README', 'classcellwalk_1_1Body', 'files'].map(name => `${name}.html`);
  const page = await browser.newPage({ viewport: telephone }), wide = [];
  page.setDefaultTimeout(patience);
  for (const name of names) {
    await page.goto(pathToFileURL(join(site, name)).href, { waitUntil: 'domcontentloaded' });
    const width = await page.evaluate(() => Math.max(document.documentElement.scrollWidth, document.getElementById('doc-content').scrollWidth));
    if (width > telephone.width) wide.push(`${name}: ${width} pixels`);
  }
  assert.deepEqual(wide, []);
  await page.close();
});

test('the run is replayed, on a telephone and without a network', { skip: !existsSync(join(site, live)) }, async () => {
  const page = await open(live, telephone);
  await page.waitForSelector('body[data-state]');
  assert.equal(await page.getAttribute('body', 'data-state'), 'ready');
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= telephone.width, `${width} pixels`);
  assert.ok((await page.locator('#slider').boundingBox()).width > 0.4 * telephone.width, 'the slider can be drawn with a thumb');
  const shoot = () => page.locator('#stage').screenshot();
  const start = await shoot();
  await page.keyboard.press('End');
  assert.ok(!start.equals(await shoot()), 'the end looks otherwise than the start');
  await page.keyboard.press('Home');
  await page.locator('#play').click();
  // Not waitForFunction(), which the page's policy against evaluated text refuses.
  for (const end = Date.now() + patience; Number(await page.inputValue('#slider')) <= 2; await page.waitForTimeout(50))
    assert.ok(Date.now() < end, 'the run plays on');
  assert.deepEqual(page.complaints, []);
  await page.close();
});
