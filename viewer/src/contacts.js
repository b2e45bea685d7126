// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of the latest steps: a point each, with its normal.
import { Color, Group } from 'three';
import { pointCloud } from './bodies.js';
import { kinds } from './colours.js';
import { fatLines } from './lines.js';

const mostShown = 20000;

export function makeContacts(contacts, normalLength, isFlat) {
  const size = Math.max(1, Math.min(mostShown, contacts.count));
  const points = pointCloud(size, 7, { depthTest: !isFlat });
  const normals = fatLines(size, { width: 1.8, colours: true, depth: !isFlat });
  points.object.renderOrder = 4;
  normals.object.renderOrder = 3.9;
  const group = new Group();
  group.add(points.object, normals.object);
  const colours = kinds.map(kind => new Color(kind.colour));
  const tints = new Float32Array(3 * size);
  return {
    group, normals,
    /** Shows the contacts of the steps after `after` up to `step`, the latest ones if they are too many. */
    show(after, step) {
      const end = contacts.begin(step + 1), begin = Math.max(contacts.begin(after + 1), end - size);
      for (let i = begin; i < end; ++i) {
        const at = 3 * (i - begin);
        colours[contacts.kind[i]].toArray(tints, at);
        for (let k = 0; k < 3; ++k) {
          const x = contacts.point[3 * i + k];
          points.places.array[at + k] = normals.places[2 * at + k] = x;
          normals.places[2 * at + 3 + k] = x + normalLength * contacts.normal[3 * i + k];
        }
      }
      points.tints.array.set(tints);
      points.places.needsUpdate = points.tints.needsUpdate = true;
      points.geometry.setDrawRange(0, end - begin);
      normals.setColours(i => 3 * i, tints);
      normals.touch(end - begin);
      return end - begin;
    },
  };
}
