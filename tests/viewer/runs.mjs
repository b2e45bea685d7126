// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs made for tests, in a folder of their own.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const scenes = {
  space: {
    title: 'Boxes & <solid> cells', environment: { generate: 'hexes', cells: [5, 4, 3], solid: 0.1 },
    bodies: [{ shape: 'hexahedron', side: 0.3, count: 12, seed: 7, speed: 6, spin: [0.5, 0.3, 0.2] },
      { shape: 'icosphere', radius: 0.3, subdivisions: 1, count: 2, seed: 3, speed: 4 }],
    particles: [{ count: 9, speed: 5 }],
    time_step: 0.02, steps: 90, output: { frame_every: 30 },
  },
  plane: {
    dimension: 2, title: 'Rooms', environment: { generate: 'room2d' },
    catheter: { path: [[1.5, 1.5], [12, 8]], find_route: true, spacing: 0.4, particles: 40, advance: 0.3 },
    bodies: [{ shape: 'polygon', radius: 0.6, count: 8, speed: 9 }],
    time_step: 0.02, steps: 61, output: { frame_every: 0, motion_every: 4 },
  },
  // Walls of space and of the plane that come, go and come back; cells that are filled, cut, and gape.
  doors: {
    dimension: 2, environment: { generate: 'squares', cells: [8, 5] },
    particles: [{ position: [1.5, 1.5] }],
    groups: { door: { plane: [[4, 0], [1, 0]] }, rock: { box: [[6, 0], [8, 5]] } },
    changes: [{ step: 2, until: 20, close: 'door' }, { step: 5, until: 20, fill: 'rock' },
      { step: 8, excavate: { box: [[6, 1], [7, 4]] } }, { step: 11, open: 'door' }, { step: 15, until: 20, close: 'door' }],
    time_step: 0.02, steps: 20, output: { frame_every: 2, motion_every: 1 },
  },
  cut: {
    environment: { generate: 'tets', cells: [4, 4, 6], jitter: 0.1 },
    particles: [{ position: [2, 2, 0.5] }],
    walls: { tissue: { tension: 0.2 } },
    changes: [{ step: 1, fill: { box: [[0, 0, 2], [4, 4, 4]] } },
      { step: 4, cut: { blade: [[0.5, 2.1, 5], [3.5, 2.1, 5], [3.5, 2.1, 1], [0.5, 2.1, 1]], opening: 0.05 } }],
    time_step: 0.02, steps: 12, output: { frame_every: 3, motion_every: 1 },
  },
};

/** Tables beside the scenes: a solid square that goes through a grid, whose cells are replaced before it. */
const wayOfSquare = Array.from({ length: 20 }, (_, i) => [[2, 1], [3, 1], [2, 2], [3, 2]].map(([x, y]) =>
  `${i + 1},${x + 9 * y},${x + 0.1 * (i + 1)},${y}`)).flat();
const tables = { 'square.csv': ['step,point,x,y', ...wayOfSquare, ''].join('\n') };
scenes.relaxed = {
  dimension: 2, environment: { generate: 'triangles', cells: [8, 4] },
  particles: [{ position: [0.5, 0.5] }],
  walls: { motion: 'square.csv', relax: {} },
  changes: [{ step: 1, fill: { box: [[2, 1], [3, 2]] } }],
  time_step: 0.02, steps: 20, output: { frame_every: 5, motion_every: 1 },
};

export class Folder {
  constructor() { this.path = mkdtempSync(join(tmpdir(), 'cellwalk-viewer-')); }
  file(name) { return join(this.path, name); }
  cellwalk(...words) { return execFileSync(process.env.CELLWALK_PROGRAM, words, { cwd: this.path, encoding: 'utf8' }); }
  run(name) {
    for (const table of Object.keys(tables)) writeFileSync(this.file(table), tables[table]);
    writeFileSync(this.file(`${name}.json`), JSON.stringify(scenes[name]));
    this.cellwalk('run', `${name}.json`, '-o', name);
    this.cellwalk('view', name, '-o', `${name}.html`);
  }
  remove() { rmSync(this.path, { recursive: true }); }
}
