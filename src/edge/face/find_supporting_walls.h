// SPDX-License-Identifier: LGPL-3.0-or-later
// On which sides of the walls in its plane a standing face lies. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H
#define CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H

#include <cellwalk/edge/face.h>

#include "broad_phase.h"
#include "triangle_in_plane.h"

namespace cellwalk::detail {

/// A side of a face: its chain, and the cell in which that starts.
struct Face_side {
  Side_chain chain;
  Point<3> from, to;  ///< as the chain goes
  Cell start;
};

/// The sides of a face in the order of its corners.
std::array<Face_side, 3> sides_of(const Face_chains& chains, const Particle<3>& p, const Particle<3>& q,
                                  const Particle<3>& r);

/// What rests that are known count for.
enum class Known {
  binding,   ///< the face has them: an edge on another side is in the way
  preferred  ///< they are kept where the edges allow it
};

/// Rests of a face, all walls near it given: known ones, those that its edges say, and where nothing says
/// which, one by the direction of its plane. piercing is set where walls at one ridge, or an edge, leave no
/// side for the face: to a wall seen from the side on which the face lies, if it lies on one.
Face_registration find_supporting_walls(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                                        const std::array<Face_side, 3>& sides,
                                        const Candidate_walls& candidates, const Supporting_walls& known,
                                        Known use);

/// Puts rests into their order.
void sort(Supporting_walls& supporting_walls);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_FIND_SUPPORTING_WALLS_H
