// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads what the page carries: motion files (docs/formats.md) and the table of contacts.

export async function unpacked(id) {
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

const unfold = value => (value >>> 1) ^ -(value & 1);

/** Walls, bodies, and every record: positions in units of the environment, cells, decisions. */
export function parseMotion(buffer) {
  const headAt = 12;
  const headSize = new DataView(buffer).getUint32(8, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, headAt, headSize)));
  let at = headAt + headSize;
  const take = (Type, count) => {
    const bytes = count * Type.BYTES_PER_ELEMENT;
    const part = new Type(buffer.slice(at, at + bytes));
    at += bytes;
    return part;
  };
  const takeLoops = (count, corners) => {
    const sizes = take(Uint32Array, count), all = take(Uint32Array, corners), loops = [];
    let begin = 0;
    for (const size of sizes) loops.push(all.subarray(begin, begin += size));
    return loops;
  };
  const points = [take(Float64Array, 3 * head.points)];
  const kinds = { walls: takeLoops(head.walls, head.wall_corners), floor: takeLoops(head.floor, head.floor_corners) };
  const lines = take(Uint32Array, 2 * head.lines);
  kinds.lines = Array.from({ length: head.lines }, (_, i) => lines.subarray(2 * i, 2 * i + 2));
  const edges = take(Uint32Array, 2 * head.edges), faces = take(Uint32Array, 3 * head.faces);
  const vertices = head.bodies.reduce((sum, body) => sum + body.vertices, 0);
  const moving = head.particles + vertices, axes = head.dimension;
  const axis16 = (value, axis) =>
    Math.round(Math.min(Math.max((value - head.lower[axis]) / (head.upper[axis] - head.lower[axis]), 0), 1) * 65535);
  const versions = [], changes = { walls: [], floor: [], lines: [] };
  /** Reads what became of the walls since the record before. Returns the new points, and whether loops changed. */
  const takeChange = () => {
    const added = take(Float64Array, 3 * take(Uint32Array, 1)[0]);
    let changed = false;
    for (const kind of Object.keys(changes)) {
      const [toggledCount, addedCount, corners] = take(Uint32Array, 3);
      const toggled = take(Uint32Array, toggledCount), begin = kinds[kind].length;
      for (const loop of takeLoops(addedCount, corners)) kinds[kind].push(loop);
      changes[kind].push({ toggled, begin, end: kinds[kind].length });
      changed ||= toggledCount + addedCount > 0;
    }
    return { added, changed };
  };
  const packed = new Uint8Array(buffer), places = [];
  const cells = new Uint32Array(head.records * moving);
  const decisions = new Uint8Array(head.records * head.bodies.length);
  // Places of the last two records, for each axis; new points of walls are expected where they appear.
  const start = moving + (head.walls_move ? head.points : 0);
  let last = Array.from({ length: axes }, () => new Uint16Array(start)), before = last, version = 0;
  for (let r = 0; r < head.records; ++r) {
    if (head.walls_change) {
      const { added, changed } = takeChange();
      version += changed;
      points.push(added);
      if (head.walls_move && added.length > 0) {
        const grown = (list, axis) => Uint16Array.from({ length: list.length + added.length / 3 }, (_, i) =>
          i < list.length ? list[i] : axis16(added[3 * (i - list.length) + axis], axis));
        last = last.map(grown);
        before = before.map(grown);
      }
    }
    versions.push(version);
    const placed = last[0].length, values = axes * placed, now = last.map(() => new Uint16Array(placed));
    for (let axis = 0, i = at; axis < axes; ++axis)
      for (let j = 0; j < placed; ++j, ++i) {
        const expected = r > 1 ? 2 * last[axis][j] - before[axis][j] : last[axis][j];
        now[axis][j] = expected + unfold(packed[i] | packed[i + values] << 8);  // modulo 2^16
      }
    at += 2 * values;
    places.push(now);
    before = last;
    last = now;
    for (let i = 0; i < moving; ++i) {
      const change = packed[at + i] | packed[at + moving + i] << 8 | packed[at + 2 * moving + i] << 16 |
        packed[at + 3 * moving + i] << 24;
      cells[r * moving + i] = (r > 0 ? cells[(r - 1) * moving + i] : 0) + unfold(change);
    }
    at += 4 * moving;
    decisions.set(packed.subarray(at, at + head.bodies.length), r * head.bodies.length);
    at += head.bodies.length;
  }
  const unit = [0, 1, 2].map(axis => (head.upper[axis] - head.lower[axis]) / 65535);
  const allPoints = new Float64Array(points.reduce((sum, part) => sum + part.length, 0));
  for (let i = 0, begin = 0; i < points.length; begin += points[i++].length) allPoints.set(points[i], begin);
  return {
    ...head, ...kinds, points: allPoints, edges, faces, vertices, moving,
    bodyCount: head.bodies.length,
    stepOf: record => Math.min(record * head.every, head.steps),
    /** The number of points that a record has places of: those that move, then if walls move, theirs so far. */
    placedAt: record => places[record][0].length,
    /** Writes the places of points first..first+count-1 of a record as x, y, z after each other. */
    copyPlaces(record, first, count, out) {
      for (let axis = 0; axis < 3; ++axis)
        for (let i = 0; i < count; ++i)
          out[3 * i + axis] = axis < axes ? head.lower[axis] + unit[axis] * places[record][axis][first + i] : 0;
    },
    /** Grows with the records at which walls came or went. */
    versionAt: record => versions[record],
    /** Those of all `walls`, of the cells of the `floor` or of the passable edges (`lines`) that are there at a record. */
    loopsAt(kind, record) {
      const there = new Uint8Array(kinds[kind].length).fill(1, 0, head[kind]);
      for (const { toggled, begin, end } of changes[kind].slice(0, record + 1)) {
        for (const number of toggled) there[number] ^= 1;
        there.fill(1, begin, end);
      }
      return kinds[kind].filter((_, i) => there[i] === 1);
    },
    cellsOf: record => cells.subarray(record * moving, (record + 1) * moving),
    decisionsOf: record => decisions.subarray(record * head.bodies.length, (record + 1) * head.bodies.length),
  };
}

/** Contacts in the order of their steps. */
export function parseContacts(buffer) {
  const count = new DataView(buffer).getUint32(0, true);
  let at = 4;
  const take = (Type, n) => {
    const part = new Type(buffer.slice(at, at + n * Type.BYTES_PER_ELEMENT));
    at += n * Type.BYTES_PER_ELEMENT;
    return part;
  };
  const contacts = {
    count,
    step: take(Uint32Array, count),
    point: take(Float32Array, 3 * count),
    normal: take(Float32Array, 3 * count),
    kind: take(Uint8Array, count),
  };
  /** The first contact of a step or of a later one. */
  contacts.begin = step => {
    let low = 0, high = count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (contacts.step[middle] < step) low = middle + 1; else high = middle;
    }
    return low;
  };
  return contacts;
}
