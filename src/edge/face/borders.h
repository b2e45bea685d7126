// SPDX-License-Identifier: LGPL-3.0-or-later
// Do the edges of a face lie on the same sides of walls as the face itself? Theory: docs/sweep.md, faces.
#ifndef CELLWALK_EDGE_FACE_BORDERS_H
#define CELLWALK_EDGE_FACE_BORDERS_H

#include "find_supporting_walls.h"

namespace cellwalk::detail {

/// A wall that lies between a face and one of its edges: it holds a piece of the edge, not the face, and the
/// chain of the edge is not linked there with the cells in which the face begins. Seen from the side of the
/// face if it has that side; none if there is no such wall.
/// \pre the face has an inside that no wall pierces, and rests on the sides on which its edges pass
/// Cost: six signs a wall; some hundred us where an edge lies in one.
Half_facet wall_at_border(const Snapshot<3>& snapshot, const std::array<Face_side, 3>& sides,
                          const Candidate_walls& candidates, Walk_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_BORDERS_H
