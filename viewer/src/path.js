// SPDX-License-Identifier: LGPL-3.0-or-later
// The path that a catheter is to follow.
import { fatLines } from './lines.js';

const width = 1.4, colour = '#d97706';

/** A thin line through the waypoints, seen through walls; none where the run has no catheter. */
export function makePath(waypoints = []) {
  const pieces = fatLines(Math.max(0, waypoints.length - 1), { width, colour, depth: false });
  pieces.object.renderOrder = 1.45;
  pieces.object.visible = waypoints.length > 1;
  pieces.setEnds((i, end) => 3 * (i + end), waypoints.flatMap(([x, y, z = 0]) => [x, y, z]));
  return pieces;
}
