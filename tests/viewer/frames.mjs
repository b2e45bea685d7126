// SPDX-License-Identifier: LGPL-3.0-or-later
// What a frame of a page costs: the time of its scripts, and what they ask of the graphics card. Drawing itself is not in it, since that is
// the card's.
import { pathToFileURL } from 'node:url';

// Few pixels: without a card the drawing of many would hold up the scripts, whose work does not depend on their number.
const canvasSize = { width: 496, height: 64 }, panelWidth = 304, barHeight = 56;

/** In the page, before its scripts: counts what they ask of WebGL, and `waits` for its answer, and times what they do in frames. */
function watch() {
  const now = { draws: 0, triangles: 0, bytes: 0, waits: 0, script: 0 };
  const gl = WebGL2RenderingContext.prototype;
  const wrap = (name, note) => {
    const plain = gl[name];
    gl[name] = function (...words) {
      note.apply(this, words);
      return plain.apply(this, words);
    };
  };
  const drawn = (mode, count, instances = 1) => {
    ++now.draws;
    if (mode === gl.TRIANGLES) now.triangles += count / 3 * instances;
  };
  wrap('drawArrays', (mode, first, count) => drawn(mode, count));
  wrap('drawElements', (mode, count) => drawn(mode, count));
  wrap('drawArraysInstanced', (mode, first, count, instances) => drawn(mode, count, instances));
  wrap('drawElementsInstanced', (mode, count, type, offset, instances) => drawn(mode, count, instances));
  const size = (data, first = 0, length = 0) =>
    typeof data === 'number' ? 0 : length > 0 ? length * data.BYTES_PER_ELEMENT : data.byteLength - first * (data.BYTES_PER_ELEMENT ?? 1);
  wrap('bufferData', (target, data, usage, first, length) => { now.bytes += size(data, first, length); });
  wrap('bufferSubData', (target, at, data, first, length) => { now.bytes += size(data, first, length); });
  for (const name of ['texImage2D', 'texSubImage2D'])
    wrap(name, (...words) => { now.bytes += words.at(-1)?.byteLength ?? 0; });
  for (const name of ['finish', 'readPixels', 'getError', 'getBufferSubData', 'clientWaitSync']) wrap(name, () => { ++now.waits; });
  const ask = window.requestAnimationFrame;
  window.timed = work => {
    const start = performance.now();
    work();
    now.script += performance.now() - start;
  };
  // What each frame that draws something costs. A record that is shown while playing is prepared in one callback and drawn in the next one.
  window.drawn = [];
  let last = { ...now };
  const difference = () => Object.fromEntries(Object.keys(now).map(key => [key, now[key] - last[key]]));
  window.requestAnimationFrame = callback => ask.call(window, time => {
    window.timed(() => callback(time));
    if (now.draws === last.draws) return;
    window.drawn.push(difference());
    last = { ...now };
  });
  window.frame = work => new Promise(done => {
    last = { ...now };
    window.drawn.length = 0;
    window.timed(work);
    ask.call(window, () => ask.call(window, () => done(window.drawn[0] ?? difference())));
  });
}

/** Opens a page so that its frames can be looked at. */
export async function openWatched(browser, file) {
  const page = await browser.newPage({ viewport: { width: canvasSize.width + panelWidth, height: canvasSize.height + barHeight } });
  await page.addInitScript(watch);
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('body[data-state=ready]', { timeout: 60000 });
  page.session = await page.context().newCDPSession(page);
  await page.session.send('Performance.enable', { timeDomain: 'threadTicks' });
  await scrubbed(page, [1, 0]);
  return page;
}

/** Seconds of processor time that the page's main thread has spent so far: in scripts, and in scripts, styles and layout. */
async function processorTime(page) {
  const { metrics } = await page.session.send('Performance.getMetrics');
  const of = name => metrics.find(metric => metric.name === name).value;
  return { inScripts: of('ScriptDuration'), inPage: of('ScriptDuration') + of('LayoutDuration') + of('RecalcStyleDuration') };
}

async function cost(page, work, argument) {
  const before = await processorTime(page), counts = await page.evaluate(work, argument), after = await processorTime(page);
  const ms = key => 1000 * (after[key] - before[key]);
  return { ...counts, inScripts: ms('inScripts'), inPage: ms('inPage') };
}

/** The cost of each of the frames that show these records, as if the slider were drawn. */
export async function scrubbed(page, records) {
  const frames = [];
  for (const record of records)
    frames.push(await cost(page, value => window.frame(() => {
      const slider = document.getElementById('slider');
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }), record));
  return frames;
}

/** The cost of frames in which nothing happens: that of looking. */
export async function idle(page, count) {
  const frames = [];
  for (let i = 0; i < count; ++i) frames.push(await cost(page, () => window.frame(() => {})));
  return frames;
}

/** What it costs on average, and at most, to draw a frame while the page plays for some seconds, or to its end. */
export async function played(page, seconds) {
  const before = await processorTime(page);
  const frames = await page.evaluate(async time => {
    const button = document.getElementById('play'), isPlaying = () => button.getAttribute('aria-label') === 'Pause';
    document.getElementById('first').click();
    window.drawn.length = 0;
    button.click();
    await new Promise(done => {
      const end = performance.now() + 1000 * time;
      const look = () => performance.now() < end && isPlaying() ? setTimeout(look, 100) : done();
      look();
    });
    if (isPlaying()) button.click();
    return window.drawn;
  }, seconds);
  const after = await processorTime(page);
  return { frames, inScripts: 1000 * (after.inScripts - before.inScripts) / frames.length };
}

// Both end when what they change is drawn: the next frame looked at is not theirs.
export const choose = (page, selector) => page.evaluate(which => window.frame(() => document.querySelector(which).click()), selector);
export const chooseWindow = (page, value) => page.evaluate(chosen => window.frame(() => {
  const list = document.getElementById('window');
  list.value = chosen;
  list.dispatchEvent(new Event('change'));
}), value);

/** The value below which the share `part` of the frames stays. */
export function quantile(frames, key, part) {
  const sorted = frames.map(frame => frame[key]).sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
}
