// SPDX-License-Identifier: LGPL-3.0-or-later
// What the page reads is what the run wrote.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { parseContacts, parseMotion } from '../../viewer/src/motion.js';
import { Folder } from './runs.mjs';

const folder = new Folder();
before(() => { for (const name of ['space', 'plane', 'doors', 'cut', 'relaxed']) folder.run(name); });
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

/** An array of a .vtu file: base64 of its number of bytes, then of its numbers. */
function arrayOf(name, begin, read) {
  const text = readFileSync(folder.file(name), 'utf8').match(new RegExp(`${begin}[^>]*>\\s*([^\\s<]+)`))[1];
  const sizeLength = 12;  // base64 of 8 bytes
  const data = Buffer.from(text.slice(sizeLength), 'base64');
  return Array.from({ length: data.length / 8 }, (_, i) => data[read](8 * i));
}
const pointsOf = name => arrayOf(name, '<Points>[^]*?<DataArray', 'readDoubleLE');

/** The walls of a .vtu file as lists of places. */
function wallsOf(name) {
  const integers = array => arrayOf(name, `<DataArray[^>]*Name="${array}"`, 'readBigInt64LE').map(Number);
  const points = pointsOf(name), corners = integers('connectivity'), ends = integers('offsets');
  return ends.map((end, i) => corners.slice(i > 0 ? ends[i - 1] : 0, end).map(v => points.slice(3 * v, 3 * v + 3)));
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

test('walls that come, go and are cut are those of the frames, each seen from its free sides', () => {
  const total = { loops: 0, twoSided: 0, back: 0, added: 0 };
  for (const [name, every, steps] of [['doors', 2, 20], ['cut', 3, 12], ['relaxed', 5, 20]]) {
    const motion = motionOf(name), box = Math.max(...motion.upper.map((high, axis) => high - motion.lower[axis]));
    assert.equal(motion.walls_move, name !== 'doors');
    const seen = [];
    for (let frame = 0; frame <= steps / every; ++frame) {
      const record = every * frame, count = motion.placedAt(record) - motion.moving;
      const places = Float64Array.from(motion.points);
      if (motion.walls_move) motion.copyPlaces(record, motion.moving, count, places);
      // To the rounding of 16 bits: loops are found again by the places of their corners.
      const key = loop => loop.map(x => x.map(value => Math.round(value / box * 4096)).join(' ')).sort().join(';');
      const near = (a, b) => a.every((x, i) => Math.abs(x - b[i]) < 2 * box / 65535);
      const expected = wallsOf(`${name}/frames/walls_${String(frame).padStart(5, '0')}.vtu`);
      const recorded = motion.loopsAt('walls', record).map(loop => [...loop].map(v => [...places.subarray(3 * v, 3 * v + 3)]));
      const matches = (a, b) => a.length === b.length && a.every(x => b.some(y => near(x, y)));
      const left = new Map();
      for (const loop of recorded) left.set(key(loop), (left.get(key(loop)) ?? 0) + 1);
      let sides = 0;
      for (const wall of expected) {
        const found = left.get(key(wall)) ?? recorded.filter(loop => matches(wall, loop)).length;
        assert.ok(found === 1 || found === 2, `${name}, frame ${frame}: a wall is recorded ${found} times`);
        sides += found;
        total.twoSided += found === 2;
      }
      assert.equal(recorded.length, sides, `${name}, frame ${frame}: as many walls`);
      total.loops += recorded.length;
      const numbers = new Set(motion.loopsAt('walls', record).map(loop => motion.walls.indexOf(loop)));
      if (seen.length > 1) total.back += [...numbers].filter(i => !seen.at(-1).has(i) && seen.some(known => known.has(i))).length;
      seen.push(numbers);
    }
    total.added += motion.walls.length - motion.loopsAt('walls', 0).length;
    assert.ok(motion.versionAt(motion.records - 1) > motion.versionAt(0));
  }
  assert.ok(total.loops > 1000 && total.twoSided > 30 && total.back > 5 && total.added > 80, JSON.stringify(total));
});

test('a cut adds points, and cells of the floor and lines come and go with cells', () => {
  const cut = motionOf('cut');
  // Wall points appear with the walls: inner ones of the septum's two sides when it is filled, others where it is cut.
  const added = Array.from({ length: cut.records - 1 }, (_, i) => cut.placedAt(i + 1) - cut.placedAt(i));
  assert.equal(added[0], 2 * 3 * 3);
  assert.ok(added[3] >= 3, `${added[3]} new points`);
  assert.equal(added.reduce((a, b) => a + b), added[0] + added[3]);
  const doors = motionOf('doors'), counts = kind => [0, 4, 7, 10].map(record => doors.loopsAt(kind, record).length);
  assert.deepEqual(counts('floor'), [40, 40, 30, 33]);
  // 7 * 5 + 8 * 4 edges; the door has 5; the rock takes its own 13 and the 5 beside it, and gives back 2 within the cave and 3 beside it.
  assert.deepEqual(counts('lines'), [67, 62, 44, 49]);
});

test('where cells are replaced, the floor and its lines are those of the cells as they are', () => {
  const motion = motionOf('relaxed'), operations = relaxedCount();
  assert.ok(operations > 10, `${operations} operations`);
  for (let record = 1; record < motion.records; ++record) {
    const places = new Float64Array(motion.points.length);
    motion.copyPlaces(record, motion.moving, motion.placedAt(record) - motion.moving, places);
    let area = 0;
    for (const [a, b, c] of motion.loopsAt('floor', record)) {
      const [x, y, z] = [a, b, c].map(v => places.subarray(3 * v, 3 * v + 2));
      const twice = (y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]);
      assert.ok(twice > -1e-3, `a cell of record ${record} is inverted`);
      area += twice / 2;
    }
    assert.ok(Math.abs(area - 31) < 0.01, `the floor of record ${record} has the area ${area}`);
  }
});
const relaxedCount = () => Object.values(JSON.parse(readFileSync(folder.file('relaxed/run.json'), 'utf8')).walls.relaxed)
  .reduce((a, b) => a + b);
