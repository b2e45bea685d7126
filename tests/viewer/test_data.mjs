// SPDX-License-Identifier: LGPL-3.0-or-later
// What the page reads is what the run wrote.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { parseContacts, parseMotion } from '../../viewer/src/motion.js';
import { Folder } from './runs.mjs';

const folder = new Folder();
before(() => { folder.run('space'); folder.run('plane'); });
after(() => folder.remove());

const bytes = packed => {
  const data = gunzipSync(packed);
  return data.buffer.slice(data.byteOffset, data.byteOffset + data.length);
};
const motionOf = name => parseMotion(bytes(readFileSync(folder.file(`${name}/motion.gz`))));
const embedded = (name, id) => {
  const page = readFileSync(folder.file(`${name}.html`), 'utf8');
  return page.split(`id="${id}">`)[1].split('</script>')[0];
};

/** The points of a .vtu file: base64 of their number of bytes, then of the doubles. */
function pointsOf(name) {
  const text = readFileSync(folder.file(name), 'utf8').match(/<Points>[^]*?<DataArray[^>]*>\s*([^\s<]+)/)[1];
  const sizeLength = 12;  // base64 of 8 bytes
  const data = Buffer.from(text.slice(sizeLength), 'base64');
  return Array.from({ length: data.length / 8 }, (_, i) => data.readDoubleLE(8 * i));
}

test('positions are those of the frames, to 16 bits of the box', () => {
  const motion = motionOf('space');
  assert.equal(motion.records, 91);
  assert.equal(motion.vertices, 12 * 8 + 2 * 42);
  const box = Math.max(...motion.upper.map((high, axis) => high - motion.lower[axis]));
  let compared = 0, moved = 0;
  const start = new Float64Array(3 * motion.moving), now = new Float64Array(3 * motion.moving);
  motion.copyPlaces(0, 0, motion.moving, start);
  for (let frame = 0; frame <= 3; ++frame) {
    const number = String(frame).padStart(5, '0');
    const expected = [...pointsOf(`space/frames/particles_${number}.vtu`), ...pointsOf(`space/frames/bodies_${number}.vtu`)];
    assert.equal(expected.length, 3 * motion.moving);
    motion.copyPlaces(30 * frame, 0, motion.moving, now);
    expected.forEach((x, i) => {
      assert.ok(Math.abs(x - now[i]) <= 0.5001 * box / 65535, `value ${i} of frame ${frame}: ${x} and ${now[i]}`);
      ++compared;
      moved += Math.abs(now[i] - start[i]) > 0.1;
    });
  }
  assert.equal(compared, 4 * 3 * (9 + 12 * 8 + 2 * 42));
  assert.ok(moved > 500, `${moved} coordinates moved`);
});

test('cells hold what is said to lie in them', () => {
  const motion = motionOf('space'), places = new Float64Array(3 * motion.moving);
  const rounding = 1e-3;
  let changes = 0;
  for (let record = 0; record < motion.records; ++record) {
    motion.copyPlaces(record, 0, motion.moving, places);
    motion.cellsOf(record).forEach((cell, i) => {
      const low = [cell % 5, Math.floor(cell / 5) % 4, Math.floor(cell / 20)];
      for (let k = 0; k < 3; ++k)
        assert.ok(places[3 * i + k] >= low[k] - rounding && places[3 * i + k] <= low[k] + 1 + rounding,
                  `point ${i} of record ${record} is not in cell ${cell}`);
      changes += record > 0 && cell !== motion.cellsOf(record - 1)[i];
    });
  }
  assert.ok(changes > 200, `${changes} changes of cells`);
});

test('bodies that met a wall say so, others moved in regions', () => {
  const motion = motionOf('space');
  const rows = readFileSync(folder.file('space/contacts.csv'), 'utf8').trim().split('\n').map(row => row.split(','));
  const body = rows[0].indexOf('body'), step = rows[0].indexOf('step');
  const met = new Set(rows.slice(1).filter(row => row[body] !== '').map(row => `${row[step]} ${row[body]}`));
  assert.ok(met.size > 20, `${met.size} bodies met walls`);
  const seen = new Map();
  for (let record = 1; record < motion.records; ++record)
    motion.decisionsOf(record).forEach((decision, b) => {
      const name = motion.decisions[decision];
      seen.set(name, (seen.get(name) ?? 0) + 1);
      assert.equal(name === 'contact', met.has(`${record} ${b}`), `body ${b} in step ${record}: ${name}`);
    });
  assert.ok(seen.get('region') > 200, JSON.stringify([...seen]));
  assert.deepEqual([...new Set(motion.decisionsOf(0))], [0]);
});

test('contacts are the rows of the table', () => {
  for (const [name, axes] of [['space', 3], ['plane', 2]]) {
    const rows = readFileSync(folder.file(`${name}/contacts.csv`), 'utf8').trim().split('\n').slice(1).map(row => row.split(','));
    const contacts = parseContacts(bytes(Buffer.from(embedded(name, 'contact-data'), 'base64')));
    assert.equal(contacts.count, rows.length);
    assert.ok(rows.length > 20, `${rows.length} contacts`);
    rows.forEach((row, i) => {
      assert.equal(contacts.step[i], Number(row[0]));
      assert.equal(['vertex', 'edge', 'facet'][contacts.kind[i]], row[6]);
      for (let k = 0; k < 3; ++k) {
        assert.equal(contacts.point[3 * i + k], k < axes ? Math.fround(Number(row[3 + k])) : 0);
        assert.equal(contacts.normal[3 * i + k], k < axes ? Math.fround(Number(row[7 + k])) : 0);
      }
    });
    assert.equal(contacts.begin(0), 0);
    assert.equal(contacts.begin(1e9), rows.length);
    assert.equal(contacts.begin(20), rows.filter(row => Number(row[0]) < 20).length);
  }
});

test('a run of the plane is recorded every few steps and at its end', () => {
  const motion = motionOf('plane');
  assert.equal(motion.records, 1 + 15 + 1);
  assert.deepEqual([motion.stepOf(15), motion.stepOf(16)], [60, 61]);
  assert.equal(motion.bodies.at(-1).kind, 'catheter');
  assert.equal(motion.bodies.at(-1).vertices, 40);
  assert.ok(motion.floor.length > 100 && motion.floor.every(loop => loop.length >= 3));
  assert.ok(motion.walls.length > 20 && motion.walls.every(loop => loop.length === 2));
});

test('the page names nothing outside itself, and a title cannot end it', () => {
  const page = readFileSync(folder.file('space.html'), 'utf8');
  assert.equal(JSON.parse(embedded('space', 'run-data')).manifest.scene.title, 'Boxes & <solid> cells');
  assert.ok(!/<(script|link|img|iframe)[^>]*(src|href)=/.test(page));
  assert.ok(page.includes("default-src 'none'"));
});
