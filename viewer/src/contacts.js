// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of the latest steps: a point each, with its normal.
import { Color, Group } from 'three';
import { pointCloud } from './bodies.js';
import { kinds } from './colours.js';
import { fatLines } from './lines.js';

const mostShown = 20000;

/** All contacts lie in buffers that never change, in the order of their steps; what is shown is a part of them. */
export function makeContacts(contacts, normalLength, isFlat) {
  const size = Math.max(1, contacts.count);
  const points = pointCloud(size, 7, { depthTest: !isFlat });
  const normals = fatLines(size, { width: 1.8, colours: true, depth: !isFlat });
  points.object.renderOrder = 4;
  normals.object.renderOrder = 3.9;
  const group = new Group();
  group.add(points.object, normals.object);
  const ends = new Float32Array(6 * size), colours = kinds.map(kind => new Color(kind.colour));
  for (let i = 0; i < contacts.count; ++i) {
    colours[contacts.kind[i]].toArray(points.tints.array, 3 * i);
    for (let k = 0; k < 3; ++k) {
      const x = contacts.point[3 * i + k];
      points.places.array[3 * i + k] = ends[6 * i + k] = x;
      ends[6 * i + 3 + k] = x + normalLength * contacts.normal[3 * i + k];
    }
  }
  normals.setEnds((i, end) => 6 * i + 3 * end, ends);
  normals.setColours(i => 3 * i, points.tints.array);
  return {
    group, normals,
    /** Shows the contacts of the steps after `after` up to `step`, the latest ones if they are too many. */
    show(after, step) {
      const end = contacts.begin(step + 1), begin = Math.max(contacts.begin(after + 1), end - mostShown);
      points.geometry.setDrawRange(begin, end - begin);
      normals.showPart(begin, end - begin);
      return end - begin;
    },
  };
}
