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
  const scene = {
    points: take(Float64Array, 3 * head.points),
    walls: takeLoops(head.walls, head.wall_corners),
    floor: takeLoops(head.floor, head.floor_corners),
    lines: take(Uint32Array, 2 * head.lines),
    edges: take(Uint32Array, 2 * head.edges),
    faces: take(Uint32Array, 3 * head.faces),
  };
  const vertices = head.bodies.reduce((sum, body) => sum + body.vertices, 0);
  const moving = head.particles + vertices, axes = head.dimension;
  const placed = moving + (head.walls_move ? head.points : 0), values = axes * placed;
  const packed = new Uint8Array(buffer, at);
  const places = new Uint16Array(head.records * values);
  const cells = new Uint32Array(head.records * moving);
  const decisions = new Uint8Array(head.records * head.bodies.length);
  const changing = (head.changing_walls ?? 0) + (head.changing_floor ?? 0);
  const there = new Uint8Array(head.records * changing);
  for (let r = 0, p = 0; r < head.records; ++r) {
    const now = r * values, last = now - values, before = last - values;
    for (let i = 0; i < values; ++i) {
      const expected = r > 1 ? 2 * places[last + i] - places[before + i] : r > 0 ? places[last + i] : 0;
      places[now + i] = expected + unfold(packed[p + i] | packed[p + values + i] << 8);
    }
    p += 2 * values;
    for (let i = 0; i < moving; ++i) {
      const change = packed[p + i] | packed[p + moving + i] << 8 | packed[p + 2 * moving + i] << 16 |
        packed[p + 3 * moving + i] << 24;
      cells[r * moving + i] = (r > 0 ? cells[(r - 1) * moving + i] : 0) + unfold(change);
    }
    p += 4 * moving;
    decisions.set(packed.subarray(p, p + head.bodies.length), r * head.bodies.length);
    p += head.bodies.length;
    there.set(packed.subarray(p, p + changing), r * changing);
    p += changing;
  }
  const unit = [0, 1, 2].map(axis => (head.upper[axis] - head.lower[axis]) / 65535);
  return {
    ...head, ...scene, vertices, moving,
    bodyCount: head.bodies.length,
    stepOf: record => Math.min(record * head.every, head.steps),
    /** Writes the places of points first..first+count-1 of a record as x, y, z after each other. If walls move, their points follow
     * the moving ones. */
    copyPlaces(record, first, count, out) {
      for (let axis = 0; axis < 3; ++axis) {
        const begin = record * values + axis * placed + first;
        for (let i = 0; i < count; ++i)
          out[3 * i + axis] = axis < axes ? head.lower[axis] + unit[axis] * places[begin + i] : 0;
      }
    },
    changing,
    /** Of each wall that comes and goes (they are the last ones), then of each such cell of the floor: 1 if it is there. */
    thereAt: record => there.subarray(record * changing, (record + 1) * changing),
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
