// SPDX-License-Identifier: LGPL-3.0-or-later
// What a frame asks of the graphics card: few draws, what changed and nothing else, no answer. Times are bounded loosely, for busy machines.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';
import { choose, chooseWindow, idle, openWatched, quantile, scrubbed } from './frames.mjs';
import { Folder } from './runs.mjs';

const folder = new Folder(), floats = 4;
const bytesOfEdge = 2 * 3 * floats;  // both ends
const mostMilliseconds = 8;          // of the processor, in the middle one of the frames: half of what 60 a second leave
let browser;

before(async () => {
  folder.cellwalk('run', '-o', 'many', '--steps', '30');  // 225 hexahedra
  folder.cellwalk('view', 'many', '-o', 'many.html');
  folder.run('space');
  browser = await launch();
});
after(async () => {
  await browser?.close();
  folder.remove();
});

const records = [2, 3, 4, 9, 10, 20, 30, 29, 28];
/** All frames cost the same; that. */
function same(frames, keys) {
  const [first] = frames;
  for (const frame of frames) for (const key of keys) assert.equal(frame[key], first[key], key);
  return first;
}

test('225 bodies: their edges are one draw, and only their places are sent', async () => {
  const page = await openWatched(browser, folder.file('many.html'));
  const frames = await scrubbed(page, records), { draws, bytes, waits } = same(frames, ['draws', 'bytes', 'waits']);
  assert.equal(draws, 3 + 1 + 2, 'walls from inside, from outside and their creases; edges; contacts and normals');
  assert.equal(bytes, 225 * 12 * bytesOfEdge);
  assert.equal(waits, 0);
  const time = quantile(frames, 'inScripts', 0.5);
  assert.ok(time > 0 && time < mostMilliseconds, `${time} ms of scripts`);

  await choose(page, '[value=certificate]');
  assert.equal(same(await scrubbed(page, records), ['bytes']).bytes, 2 * 225 * 12 * bytesOfEdge, 'places and colours');
  await choose(page, '[value=body]');
  await chooseWindow(page, '0');
  const all = await scrubbed(page, records);
  assert.equal(same(all, ['bytes', 'draws']).bytes, bytes, 'contacts are not sent again');
  assert.ok(all[6].triangles > all[0].triangles, 'though more of them are drawn');
  await page.close();
});

test('faces and particles: one draw each', async () => {
  const page = await openWatched(browser, folder.file('space.html'));
  const { draws, bytes } = same(await scrubbed(page, records), ['draws', 'bytes']);
  assert.equal(draws, 3 + 2 + 1 + 1 + 2, 'walls, edges of two widths, faces, particles, contacts and normals');
  assert.equal(bytes, (12 * 12 + 2 * 120) * bytesOfEdge + (12 * 8 + 2 * 42 + 9) * 3 * floats);
  await page.close();
});

test('a page that stands still draws and sends nothing', async () => {
  const page = await openWatched(browser, folder.file('many.html'));
  const { draws, bytes } = same(await idle(page, 5), ['draws', 'bytes']);
  assert.deepEqual([draws, bytes], [0, 0]);
  await page.close();
});

test('contacts shown are those of the table', async () => {
  const page = await openWatched(browser, folder.file('many.html'));
  const rows = readFileSync(folder.file('many/contacts.csv'), 'utf8').trim().split('\n').slice(1).map(row => Number(row.split(',')[0]));
  const trianglesOfSegment = 6;  // of a line of a width in pixels
  await chooseWindow(page, '1');
  const here = rows.filter(step => step === 20).length, [without, withSome] = await scrubbed(page, [0, 20]);
  assert.ok(here > 0);
  assert.equal(withSome.triangles - without.triangles, trianglesOfSegment * here);
  await page.close();
});
