// SPDX-License-Identifier: LGPL-3.0-or-later
// What colours mean. Components are linear, as shaders take them.
import { Color } from 'three';

/** Those of the program's pictures (src/drawing/bodies.cpp; tests/docs/test_colours.py compares). */
export const pictures = { wall: '#cc5e54', catheter: '#1a4587', particle: '#0d8580', contact: '#f59414' };

/** How a body's moves were decided, by the names that recordings have for it (docs/formats.md); costlier ones are warmer. */
export const decisions = {
  none: { title: 'at rest', colour: '#8a94a6' },
  region: { title: 'region free of walls', colour: '#2a9d63' },
  same_cell: { title: 'same cell', colour: '#4ab3c9' },
  same_chain: { title: 'same chain', colour: '#7a55c7' },
  relinked: { title: 'round ridges', colour: '#d9a400' },
  events: { title: 'events', colour: '#e8731a' },
  contact: { title: 'contact', colour: '#d02746' },
};

/** Other versions of the program may have other ways to decide. */
export const decisionOf = name => decisions[name] ?? { title: name.replaceAll('_', ' '), colour: '#2f6fd0' };

/** Features of the environment that were met, by kind. */
export const kinds = [
  { name: 'vertex', colour: '#9b1d8a' },
  { name: 'edge', colour: '#b4410b' },
  { name: 'facet', colour: pictures.contact },
];

const goldenRatio = 0.618033988749895;
const shades = [0.36, 0.43, 0.29];

/** A colour for a number: neighbours in number look different. */
export function ofNumber(number) {
  return new Color().setHSL((0.58 + number * goldenRatio) % 1, 0.68, shades[number % shades.length]);
}

export function tableOf(count, colourOf) {
  const table = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) colourOf(i).toArray(table, 3 * i);
  return table;
}
