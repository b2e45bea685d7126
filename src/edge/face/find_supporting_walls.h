// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of the walls in its plane on which a standing face lies. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H
#define CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H

#include <cellwalk/internal/edge/face.h>

#include <array>
#include <vector>

#include "broad_phase.h"
#include "triangle_in_plane.h"

namespace cellwalk::detail {

/// A side of a face: its chain, and the cell in which the chain starts.
struct Face_side {
  Side_chain chain;
  Point<3> from, to;  ///< in the direction of the chain
  Cell start;
};

/// The sides of a face in the order of its corners.
std::array<Face_side, 3> sides_of(const Face_chains& chains, const Particle<3>& p, const Particle<3>& q,
                                  const Particle<3>& r);

/// The role of known supporting walls.
enum class Known {
  binding,   ///< they hold: an edge on another side is an obstacle
  preferred  ///< they are kept if the edges allow it
};

/// Triangles in one plane that cover the area that a face sweeps there: a set overlaps the area if it
/// overlaps one of them.
using Swept_in_plane = std::vector<Triangle_in_plane>;

/// The area that a face sweeps while a corner moves in its plane, from the first of four points to the
/// second: their convex hull. Empty if they are collinear.
Swept_in_plane swept_in_plane(const Corners& corners, Walk_counts& counts);

/// The supporting walls of a face, given all walls near it: known ones, those that its edges determine, and
/// otherwise those on a side that depends on the direction of its plane only. Walls that are joined under the
/// area that the face swept have the face on one side. `piercing` is set if walls at one ridge, or an edge,
/// leave no side for the face: to a wall, seen from the side of the face if the face lies on one.
/// \param swept the area that the face swept on its way to this place; the triangle alone if it stands
Face_registration find_supporting_walls(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                                        const Swept_in_plane& swept, const std::array<Face_side, 3>& sides,
                                        const Candidate_walls& candidates, const Supporting_walls& known,
                                        Known use);

/// A face where it stands, as register_face(), with a role for the supporting walls that are known.
/// Cost: that of register_face().
Face_registration stand_face(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                             const Particle<3>& r, const Face_chains& chains, const Supporting_walls& known,
                             Known use, Face_counts& counts);

/// Sorts supporting walls.
void sort(Supporting_walls& supporting_walls);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H
