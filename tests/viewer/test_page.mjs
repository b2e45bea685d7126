// SPDX-License-Identifier: LGPL-3.0-or-later
// The page in Chromium: it loads from a file, draws, follows slider, keys and mouse, and says what run.json says.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';
import { Folder } from './runs.mjs';

const folder = new Folder();
const canvasSize = { width: 480, height: 300 }, panelWidth = 304, barHeight = 56;
const patience = 20000;  // ms
let browser;

before(async () => {
  for (const name of ['space', 'plane', 'doors', 'cut']) folder.run(name);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  folder.remove();
});

/** Opens a page; whatever it complains of or asks the network for is collected. */
async function open(name) {
  const page = await browser.newPage({ viewport: { width: canvasSize.width + panelWidth, height: canvasSize.height + barHeight } });
  page.complaints = [];
  page.on('console', message => { if (message.type() === 'error') page.complaints.push(message.text()); });
  page.on('pageerror', error => page.complaints.push(error.message));
  page.on('request', request => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`asks for ${request.url()}`);
  });
  await page.goto(pathToFileURL(folder.file(name)).href);
  await page.waitForSelector('body[data-state]', { timeout: patience });
  assert.equal(await page.getAttribute('body', 'data-state'), 'ready');
  return page;
}

/** Waits until a condition holds, as long as a slow machine may take. */
async function holds(condition, what) {
  const end = Date.now() + patience;
  while (!await condition()) assert.ok(Date.now() < end, `${what}, within ${patience} ms`);
}

/** The pixels of the canvas, as they are on the screen. */
async function shoot(page) {
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  return (await page.screenshot({ clip: { x: 0, y: 0, ...canvasSize } })).toString('base64');
}
/** Keeps the pixels of the canvas in the page once they stand still, however slow the machine; returns their number in the page's list. */
async function look(page) {
  let shot = await shoot(page);
  const stands = async () => shot === (shot = await shoot(page));
  await holds(stands, 'the picture stands still');
  return page.evaluate(async text => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(text), c => c.charCodeAt(0))]));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    window.looks ??= [];
    return window.looks.push(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)) - 1;
  }, shot);
}
/** How many pixels differ between two looks. */
const changed = (page, a, b) => page.evaluate(([i, j]) =>
  window.looks[i].reduce((count, pixel, k) => count + (pixel !== window.looks[j][k]), 0), [a, b]);
const changedSince = async (page, a) => changed(page, a, await look(page));
/** Share of the pixels that are not of the colour of the corner. */
const drawn = (page, a) => page.evaluate(i =>
  window.looks[i].reduce((count, pixel) => count + (pixel !== window.looks[i][0]), 0) / window.looks[i].length, a);

async function scrub(page, record) {
  await page.evaluate(value => {
    const slider = document.getElementById('slider');
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
  }, record);
}
const record = page => page.evaluate(() => Number(document.getElementById('slider').value));
const textOf = (page, id) => page.locator(`#${id}`).textContent();

for (const [name, records, steps] of [['space', 91, 90], ['plane', 17, 61]])
  test(`${name}: the canvas is not empty, and scrubbing changes it`, async () => {
    const page = await open(`${name}.html`);
    const start = await look(page), share = await drawn(page, start);
    assert.ok(share > 0.1, `${share} of the pixels are drawn`);
    assert.equal(await changedSince(page, start), 0, 'what stands still looks the same');
    await scrub(page, records - 1);
    const moved = await changedSince(page, start);
    assert.ok(moved > 500, `${moved} pixels changed`);
    assert.ok((await textOf(page, 'time')).startsWith(`step ${steps} of ${steps}`));
    await scrub(page, 0);
    assert.equal(await changedSince(page, start), 0, 'the start looks as it did');
    assert.deepEqual(page.complaints, []);
    await page.close();
  });

for (const [name, shows] of [['doors', [1, 3, 5, 8, 11, 15]], ['cut', [0, 1, 4, 12]]])
  test(`${name}: walls are seen to come, go, and come back`, async () => {
    const page = await open(`${name}.html`), looks = [];
    for (const step of shows) {
      await scrub(page, step);
      looks.push(await look(page));
      if (looks.length > 1) {
        const pixels = await changed(page, looks.at(-2), looks.at(-1));
        assert.ok(pixels > 40, `step ${step}: ${pixels} pixels changed`);
      }
    }
    for (const i of [2, 1, 0]) {  // back in time
      await scrub(page, shows[i]);
      assert.equal(await changedSince(page, looks[i]), 0, `step ${shows[i]} looks as it did`);
    }
    assert.deepEqual(page.complaints, []);
    await page.close();
  });

test('a page without walls, bodies and contacts would be seen to be empty', async () => {
  const page = await open('space.html');
  await page.locator('#stage canvas').evaluate(canvas => { canvas.style.visibility = 'hidden'; });
  assert.equal(await drawn(page, await look(page)), 0);
  await page.close();
});

test('the path of a catheter is a line of its colour', async () => {
  const pathColour = 0xff0677d9;  // as the canvas has it: alpha, blue, green, red
  for (const [name, least, most] of [['plane', 20, Infinity], ['space', 0, 0]]) {
    const page = await open(`${name}.html`), start = await look(page);
    const count = await page.evaluate(([i, colour]) => window.looks[i].reduce((sum, pixel) => sum + (pixel === colour), 0), [start, pathColour]);
    assert.ok(count >= least && count <= most, `${name}: ${count} pixels`);
    await page.close();
  }
});

test('colours and switches change the picture', async () => {
  for (const name of ['space', 'plane']) {
    const page = await open(`${name}.html`);
    await page.locator('#last').click();
    const before = await look(page);
    for (const mode of ['cell', 'certificate']) {
      await page.locator(`[value=${mode}]`).click();
      assert.ok(await changedSince(page, before) > 50, `${name}: ${mode}`);
    }
    const counts = await page.locator('#legend td:last-child').allTextContents();
    const bodies = name === 'space' ? 14 : 9;
    assert.equal(counts.map(Number).reduce((a, b) => a + b, 0), bodies);
    await page.locator('[value=body]').click();
    assert.equal(await changedSince(page, before), 0);
    await page.locator('#walls').click();
    assert.ok(await changedSince(page, before) > 500);
    await page.locator('#walls').click();
    await page.locator('#window').selectOption('0');
    assert.ok(await changedSince(page, before) > 50, `${name}: all contacts`);
    assert.equal(await textOf(page, 'shown'), await textOf(page, 'sofar'));
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
});

test('keys step and play, the mouse turns, f fits', async () => {
  const page = await open('space.html');
  const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); };
  await press('ArrowRight', 'ArrowRight');
  assert.equal(await record(page), 2);
  await press('Shift+ArrowRight', 'ArrowLeft');
  assert.equal(await record(page), 11);
  await press('End');
  assert.equal(await record(page), 90);
  await press('Home');
  const start = await look(page);
  await press(' ');
  await holds(async () => await record(page) > 4, 'it plays');
  await press(' ');
  const stopped = await record(page);
  await page.waitForTimeout(300);
  assert.equal(await record(page), stopped, 'it is paused');
  await press('Home');
  assert.equal(await changedSince(page, start), 0);
  await page.mouse.move(150, 150);
  await page.mouse.down();
  await page.mouse.move(230, 190);
  await page.mouse.up();
  assert.ok(await changedSince(page, start) > 1000, 'dragging turns the view');
  await press('f');
  assert.ok(await changedSince(page, start) < 50, 'the view is as at first');
  await page.setViewportSize({ width: 900, height: 400 });
  const size = () => page.locator('#stage canvas').evaluate(canvas => [canvas.clientWidth, canvas.clientHeight].join());
  const stageSize = [900 - panelWidth, 400 - barHeight].join();
  await holds(async () => await size() === stageSize, `the canvas measures ${stageSize}`);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('the panel says what run.json says', async () => {
  const page = await open('space.html');
  const report = JSON.parse(readFileSync(folder.file('space/run.json'), 'utf8'));
  const rows = new Map(await page.locator('#run tr').evaluateAll(all => all.map(row => [...row.cells].map(cell => cell.textContent))));
  const value = name => Number(rows.get(name).replaceAll(',', ''));
  assert.equal(value('Cells'), report.environment.cells);
  assert.equal(value('with facets'), report.contacts.facet);
  assert.equal(value('with edges'), report.contacts.edge);
  assert.equal(value('Moves of vertices'), report.body_counts.moves);
  assert.equal(rows.get('same cell'), `${(100 * report.body_counts.shares.same_cell).toFixed(1)} %`);
  assert.equal(await textOf(page, 'title'), 'Boxes & <solid> cells');
  await page.locator('#last').click();
  const all = report.contacts.facet + report.contacts.edge + report.contacts.vertex;
  assert.equal(Number((await textOf(page, 'sofar')).replaceAll(',', '')), all);
  await page.close();
});
