// SPDX-License-Identifier: LGPL-3.0-or-later
// What moves: bodies with edges and faces, catheters, free particles.
import * as THREE from 'three';
import { decisionOf, ofNumber, pictures, tableOf } from './colours.js';
import { fatLines } from './lines.js';

const edgeWidth = 1.9, surfaceEdgeWidth = 0.9, catheterWidth = 5;  // pixels

/** A round dot for points. */
export function dot() {
  const size = 64, canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.beginPath();
  context.arc(size / 2, size / 2, size / 2 - 2, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
}

export function pointCloud(count, size, options) {
  const geometry = new THREE.BufferGeometry();
  const attribute = () => new THREE.BufferAttribute(new Float32Array(3 * count), 3).setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute('position', attribute());
  geometry.setAttribute('color', attribute());
  const material = new THREE.PointsMaterial({
    size: size * Math.min(window.devicePixelRatio, 2), sizeAttenuation: false, vertexColors: true, map: dot(), transparent: true, alphaTest: 0.1, ...options });
  const object = new THREE.Points(geometry, material);
  object.frustumCulled = false;
  return { object, places: geometry.attributes.position, tints: geometry.attributes.color, geometry };
}

export function makeBodies(motion) {
  const group = new THREE.Group();
  const places = new Float32Array(3 * motion.vertices), tints = new Float32Array(3 * motion.vertices);
  const bodyOf = new Uint32Array(motion.vertices);
  const kinds = { plain: [], surface: [], catheter: [] }, thick = new Map();
  let vertex = 0, edge = 0;
  motion.bodies.forEach((body, number) => {
    bodyOf.fill(number, vertex, vertex + body.vertices);
    const kind = body.kind === 'catheter' ? 'catheter' : body.faces > 0 ? 'surface' : 'plain';
    if (body.radius > 0 && !thick.has(body.radius)) thick.set(body.radius, []);
    const list = body.radius > 0 ? thick.get(body.radius) : kinds[kind];
    for (let i = 0; i < body.edges; ++i) list.push(edge + i);
    vertex += body.vertices;
    edge += body.edges;
  });
  const ends = list => (i, end) => 3 * motion.edges[2 * list[i] + end];
  const lines = [];
  const add = (list, options) => {
    if (list.length === 0) return;
    const made = fatLines(list.length, { depth: motion.dimension === 3, ...options });
    made.ends = ends(list);
    made.object.renderOrder = 1.5;
    made.isTinted = !!options.colours;
    lines.push(made);
    group.add(made.object);
  };
  add(kinds.plain, { width: edgeWidth, colours: true });
  add(kinds.surface, { width: surfaceEdgeWidth, colour: '#1e293b' });
  add(kinds.catheter, { width: catheterWidth, colours: true });
  for (const [radius, list] of thick) add(list, { width: 2 * radius, inUnits: true, colours: true });

  const faces = new THREE.BufferGeometry();
  faces.setAttribute('position', new THREE.BufferAttribute(places, 3).setUsage(THREE.DynamicDrawUsage));
  faces.setAttribute('color', new THREE.BufferAttribute(tints, 3).setUsage(THREE.DynamicDrawUsage));
  faces.setIndex(new THREE.BufferAttribute(motion.faces, 1));
  if (motion.faces.length > 0) {
    const mesh = new THREE.Mesh(faces, new THREE.MeshLambertMaterial({
      vertexColors: true, side: THREE.DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1,
      polygonOffsetUnits: 1 }));
    mesh.frustumCulled = false;
    group.add(mesh);
  }
  const free = pointCloud(motion.particles, 6, { depthTest: motion.dimension === 3 });
  free.object.renderOrder = 1.4;
  if (motion.particles > 0) group.add(free.object);

  const byBody = tableOf(Math.max(1, motion.bodyCount), i => motion.bodies[i]?.kind === 'catheter' ? new THREE.Color(pictures.catheter) : ofNumber(i));
  const byDecision = tableOf(motion.decisions.length, i => new THREE.Color(decisionOf(motion.decisions[i]).colour));
  const byCell = tableOf(Math.min(motion.cells, 1 << 16), ofNumber), cellColours = byCell.length / 3;
  const particleColour = new THREE.Color(pictures.particle);

  const put = (out, i, table, entry) => {
    for (let k = 0; k < 3; ++k) out[3 * i + k] = table[3 * entry + k];
  };
  function tint(record, mode) {
    const cells = motion.cellsOf(record), decided = motion.decisionsOf(record);
    for (let i = 0; i < motion.vertices; ++i) {
      if (mode === 'cell') put(tints, i, byCell, cells[motion.particles + i] % cellColours);
      else if (mode === 'certificate') put(tints, i, byDecision, decided[bodyOf[i]]);
      else put(tints, i, byBody, bodyOf[i]);
    }
    for (let i = 0; i < motion.particles; ++i) {
      if (mode === 'cell') put(free.tints.array, i, byCell, cells[i] % cellColours);
      else particleColour.toArray(free.tints.array, 3 * i);
    }
  }

  let shownRecord, shownMode;
  function move(record) {
    motion.copyPlaces(record, motion.particles, motion.vertices, places);
    for (const made of lines) made.setEnds(made.ends, places);
    motion.copyPlaces(record, 0, motion.particles, free.places.array);
    faces.attributes.position.needsUpdate = free.places.needsUpdate = true;
  }
  function recolour(record, mode) {
    tint(record, mode);
    for (const made of lines)
      if (made.isTinted) made.setColours(made.ends, tints);
    faces.attributes.color.needsUpdate = free.tints.needsUpdate = true;
  }
  return {
    group, lines,
    /** Sends to the graphics card what differs from what it has: the colours of bodies, for example, never change. */
    show(record, mode) {
      if (record !== shownRecord) move(record);
      if (mode !== shownMode || (record !== shownRecord && mode !== 'body')) recolour(record, mode);
      shownRecord = record;
      shownMode = mode;
    },
  };
}
