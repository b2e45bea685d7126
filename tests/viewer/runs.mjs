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
};

export class Folder {
  constructor() { this.path = mkdtempSync(join(tmpdir(), 'cellwalk-viewer-')); }
  file(name) { return join(this.path, name); }
  cellwalk(...words) { return execFileSync(process.env.CELLWALK_PROGRAM, words, { cwd: this.path, encoding: 'utf8' }); }
  run(name) {
    writeFileSync(this.file(`${name}.json`), JSON.stringify(scenes[name]));
    this.cellwalk('run', `${name}.json`, '-o', name);
    this.cellwalk('view', name, '-o', `${name}.html`);
  }
  remove() { rmSync(this.path, { recursive: true }); }
}
