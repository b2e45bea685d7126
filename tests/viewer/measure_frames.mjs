// SPDX-License-Identifier: LGPL-3.0-or-later
// Prints what frames of a page cost: node tests/viewer/measure_frames.mjs PAGE.html [FRAMES OF EACH SORT, default 300]
//
//   VIEWER_MODULES     where the packages are; those of a build are in build/release/viewer/node_modules
//   CELLWALK_CHROMIUM  default /usr/bin/chromium
import { resolve } from 'node:path';
import { launch } from './browser.mjs';
import { choose, chooseWindow, idle, openWatched, played, quantile, scrubbed } from './frames.mjs';

const [file, most = '300'] = process.argv.slice(2);
const browser = await launch();
const page = await openWatched(browser, resolve(file));
const last = await page.evaluate(() => Number(document.getElementById('slider').max));
const count = Math.min(Number(most), last);
// From one end to the other, so that frames of all parts of the run count.
const records = Array.from({ length: count }, (_, i) => Math.round((i + 1) * last / count));
const row = (name, frames) => {
  const ms = (key, part) => quantile(frames, key, part).toFixed(2);
  const kilobytes = part => (quantile(frames, 'bytes', part) / 1000).toFixed(1);
  console.log(`| ${name} | ${frames.length} | ${ms('inScripts', 0.5)} | ${ms('inScripts', 0.99)} | ${ms('inPage', 0.99)} | ` +
    `${ms('script', 0.5)} | ${ms('script', 0.99)} | ${quantile(frames, 'draws', 1)} | ` +
    `${quantile(frames, 'triangles', 1).toLocaleString('en-US')} | ${kilobytes(0.5)} | ${kilobytes(1)} |`);
};
console.log('| | frames | scripts: ms of the processor, median | 99 % | with styles and layout, 99 % | ms passed, median | 99 % | ' +
  'draw calls | triangles | kB sent, median | most |');
console.log('|---|---|---|---|---|---|---|---|---|---|---|');
row('nothing', await idle(page, count));
row('by body', await scrubbed(page, records));
for (const mode of ['cell', 'certificate']) {
  await choose(page, `[value=${mode}]`);
  row(`by ${mode}`, await scrubbed(page, records));
}
await choose(page, '[value=body]');
await chooseWindow(page, '0');
row('all contacts so far', await scrubbed(page, records));
await chooseWindow(page, '20');
const { frames, inScripts } = await played(page, 10);
console.log(`Played: ${frames.length} frames drawn; a frame takes ${inScripts.toFixed(2)} ms of the processor in scripts on average; ` +
  `ms passed: median ${quantile(frames, 'script', 0.5).toFixed(2)}, 99 % ${quantile(frames, 'script', 0.99).toFixed(2)}; ` +
  `draw calls ${quantile(frames, 'draws', 1)}, kB sent ${(quantile(frames, 'bytes', 1) / 1000).toFixed(1)}`);
await browser.close();
