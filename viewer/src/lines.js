// SPDX-License-Identifier: LGPL-3.0-or-later
// Many segments of a width in pixels, or in units of the environment, moved every frame.
import { DynamicDrawUsage, InstancedInterleavedBuffer, InterleavedBufferAttribute } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';

/** `count` segments; they have one colour, or with `colours` one at each end. What is not set again is not sent again. */
export function fatLines(count, { width, inUnits = false, colour = '#ffffff', colours = false, depth = true }) {
  const geometry = new LineSegmentsGeometry();
  const buffer = () => new InstancedInterleavedBuffer(new Float32Array(6 * count), 6, 1).setUsage(DynamicDrawUsage);
  const places = buffer(), tints = colours ? buffer() : null;
  // WebGL draws instances from the first one on, so another first one is another offset of the attributes.
  let first = -1;
  const showPart = (begin, shown) => {
    geometry.instanceCount = shown;
    if (begin === first) return;
    first = begin;
    const bind = (name, data, offset) => geometry.setAttribute(name, new InterleavedBufferAttribute(data, 3, 6 * begin + offset));
    bind('instanceStart', places, 0);
    bind('instanceEnd', places, 3);
    if (!tints) return;
    bind('instanceColorStart', tints, 0);
    bind('instanceColorEnd', tints, 3);
  };
  showPart(0, count);
  const material = new LineMaterial({ color: colour, linewidth: width, worldUnits: inUnits, vertexColors: colours, depthTest: depth });
  const object = new LineSegments2(geometry, material);
  object.frustumCulled = false;
  const fill = (data, from, source) => {
    const out = data.array;
    for (let i = 0; i < count; ++i)
      for (let end = 0; end < 2; ++end) {
        const at = from(i, end);
        for (let k = 0; k < 3; ++k) out[6 * i + 3 * end + k] = source[at + k];
      }
    data.needsUpdate = true;
  };
  return {
    object,
    /** `from(i, end)` is where the place of an end of segment i stands in `source`. */
    setEnds: (from, source) => fill(places, from, source),
    setColours: (from, source) => fill(tints, from, source),
    setResolution: (w, h) => material.resolution.set(w, h),
    /** Shows `shown` segments from `begin` on. */
    showPart,
  };
}
