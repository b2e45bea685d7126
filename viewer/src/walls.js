// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment: walls one can see through, in the plane also free cells and the edges between them.
import * as THREE from 'three';
import { pictures } from './colours.js';
import { fatLines } from './lines.js';

const trianglesOf = loops => {
  const index = [];
  for (const loop of loops)
    for (let i = 2; i < loop.length; ++i) index.push(loop[0], loop[i - 1], loop[i]);
  return index;
};

const loopsToMesh = (points, loops) => {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
  geometry.setIndex(trianglesOf(loops));
  return geometry;
};

/** Edges at which walls meet at an angle, or where only one wall ends. */
function creases(points, loops) {
  const fewestDegrees = 50, mostLoops = 60000;
  if (loops.length > mostLoops) return null;
  return new THREE.EdgesGeometry(loopsToMesh(points, loops), fewestDegrees);
}

/** Walls seen from free space are drawn; those seen through from outside only hinted at, so that one looks in. */
function wallsInSpace(motion, points) {
  let indexed = loopsToMesh(points, motion.loopsAt('walls', 0));
  const geometry = indexed.toNonIndexed();
  geometry.computeVertexNormals();
  const material = (side, opacity) => new THREE.MeshLambertMaterial(
    { color: pictures.wall, transparent: true, opacity, side, depthWrite: false });
  const group = new THREE.Group();
  const inside = new THREE.Mesh(geometry, material(THREE.BackSide, 0.36));
  const outside = new THREE.Mesh(geometry, material(THREE.FrontSide, 0.07));
  inside.renderOrder = 1;
  outside.renderOrder = 3;
  group.add(inside, outside);
  const lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(
    { color: pictures.wall, transparent: true, opacity: 0.35, depthWrite: false }));
  lines.renderOrder = 2;
  group.add(lines);
  const drawCreases = loops => {
    const edges = motion.walls_move ? null : creases(points, loops);
    lines.geometry.dispose();
    lines.geometry = edges ?? new THREE.BufferGeometry();
    lines.visible = edges !== null;
  };
  drawCreases(motion.loopsAt('walls', 0));
  /** Takes the walls to where their points are now. */
  const follow = () => {
    const corners = indexed.getIndex().array, places = geometry.getAttribute('position');
    for (let i = 0; i < corners.length; ++i)
      places.array.set(points.subarray(3 * corners[i], 3 * corners[i] + 3), 3 * i);
    places.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
  };
  /** Draws the walls of a record instead. */
  const choose = record => {
    const loops = motion.loopsAt('walls', record);
    indexed = loopsToMesh(points, loops);
    geometry.dispose();
    geometry.deleteAttribute('normal');
    geometry.setAttribute('position', indexed.toNonIndexed().getAttribute('position'));
    drawCreases(loops);
    follow();
  };
  return { group, lines: [], follow, choose };
}

function wallsInPlane(motion, points) {
  const group = new THREE.Group();
  const geometries = [];
  const flat = (loops, colour) => {
    const mesh = new THREE.Mesh(loopsToMesh(points, loops), new THREE.MeshBasicMaterial(
      { color: colour, side: THREE.DoubleSide, depthWrite: false }));
    geometries.push(mesh.geometry);
    group.add(mesh);
    return mesh;
  };
  const floor = flat(motion.loopsAt('floor', 0), '#ffffff');
  floor.renderOrder = -3;
  const thin = new THREE.BufferGeometry();
  thin.setAttribute('position', new THREE.BufferAttribute(points, 3));
  const indexOf = loops => loops.flatMap(loop => Array.from(loop));
  thin.setIndex(indexOf(motion.loopsAt('lines', 0)));
  geometries.push(thin);
  const grid = new THREE.LineSegments(thin, new THREE.LineBasicMaterial({ color: '#e3e8ef', depthWrite: false }));
  grid.renderOrder = -2;
  const walls = fatLines(motion.walls.length, { width: 2.5, colour: '#334155', depth: false });
  let shown = motion.loopsAt('walls', 0);
  const setEnds = () => walls.setEnds((i, end) => i < shown.length ? 3 * shown[i][end] : 0, points);
  walls.showPart(0, shown.length);
  setEnds();
  walls.object.renderOrder = -1;
  group.add(grid, walls.object);
  const follow = () => {
    for (const geometry of geometries) {
      geometry.getAttribute('position').needsUpdate = true;
      geometry.computeBoundingSphere();
    }
    setEnds();
  };
  const choose = record => {
    shown = motion.loopsAt('walls', record);
    walls.showPart(0, shown.length);
    floor.geometry.setIndex(trianglesOf(motion.loopsAt('floor', record)));
    thin.setIndex(indexOf(motion.loopsAt('lines', record)));
    follow();
  };
  return { group, lines: [walls], follow, choose };
}

export function makeWalls(motion) {
  const points = Float32Array.from(motion.points);
  const walls = motion.dimension === 2 ? wallsInPlane(motion, points) : wallsInSpace(motion, points);
  let version = motion.versionAt(0);
  return {
    ...walls,
    show(record) {
      if (motion.walls_move) motion.copyPlaces(record, motion.moving, motion.placedAt(record) - motion.moving, points);
      if (motion.versionAt(record) !== version) {
        version = motion.versionAt(record);
        walls.choose(record);
      } else if (motion.walls_move) {
        walls.follow();
      }
    },
  };
}
