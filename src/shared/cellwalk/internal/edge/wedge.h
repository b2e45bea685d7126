// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces that share an edge which moves: the walls that come between them. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_INTERNAL_EDGE_WEDGE_H
#define CELLWALK_INTERNAL_EDGE_WEDGE_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>

#include <optional>

namespace cellwalk::detail {

/// The first wall in the plane of the triangle that the edge pq sweeps with an inner point inside of it,
/// while p moves along its path and q stands still. If the edge belongs to faces on both sides of that plane,
/// such a wall comes between them, although the edge may pass it on either side. The time is that at which
/// the edge first meets the part of the wall inside; the normal lies in the plane, across the edge, and
/// points against the motion. Contacts after p is blocked are returned, too.
/// \pre the sweep of the edge is free, at least up to the time of a contact
/// Cost: some hundred ns if walls are near; some ten us for a contact.
std::optional<Contact<3>> wall_in_wedge(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                                        const Point<3>& q, Face_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_WEDGE_H
