// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks that the edges of a face lie on the same sides of walls as the face. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_EDGE_FACE_BORDERS_H
#define CELLWALK_EDGE_FACE_BORDERS_H

#include "find_supporting_walls.h"

namespace cellwalk::detail {

/// A wall that lies between a face and one of its edges: it contains a piece of the edge, but not the face,
/// and the chain of the edge is not linked there with the cells in which the face begins. Seen from the side
/// of the face if it has that side; none if there is no such wall.
/// \param supporting_walls all of the face
/// \pre no wall pierces the interior of the face
/// Cost: six signs a wall; some hundred us if an edge lies in one.
Half_facet wall_at_border(const Snapshot<3>& snapshot, const std::array<Face_side, 3>& sides,
                          const Candidate_walls& candidates, const Supporting_walls& supporting_walls,
                          Walk_counts& counts);

/// The contact of a face, one of whose edges lies on the other side of a wall, at the start of a move.
Contact<3> contact_at_start(const Snapshot<3>& snapshot, Half_facet wall, const Point<3>& start);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_BORDERS_H
