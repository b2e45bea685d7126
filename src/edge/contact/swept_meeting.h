// SPDX-License-Identifier: LGPL-3.0-or-later
// When the edge that sweeps a triangle meets closed features of the environment, exactly. Theory:
// docs/sweep.md, touches.
#ifndef CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H
#define CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H

#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/swept_triangle.h>

#include <optional>

#include "edge/exact/half_space.h"

namespace cellwalk::detail {

/// The edge meets a feature.
template <int D>
struct Meeting {
  Fraction time;
  Exact_point<D> point;
  bool at_p = false;  ///< the point is p itself
};

/// The first meeting of the edge with an intersection of half-spaces, off the edge where it starts: 0 if the
/// two meet there and go on to do so. Of several points at that time, the one nearest to p.
/// Degenerate cases: the triangle may be a segment; a and q may coincide.
template <int D>
std::optional<Meeting<D>> first_meeting(const Swept_triangle<D>& triangle, const Half_spaces<D>& feature);

/// The same, and the edge where it starts counts: 0 if the two meet there.
template <int D>
std::optional<Meeting<D>> first_closed_meeting(const Swept_triangle<D>& triangle,
                                               const Half_spaces<D>& feature);

/// A contact with a wall at a point of it: its lowest feature there, and the normal that goes with it.
template <int D>
Contact<D> contact_with(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Half_facet wall,
                        const Meeting<D>& meeting);

/// The unit normal of a contact of p, given that of the wall: against the motion of p if that is along it, as
/// where p touches a corner in passing.
template <int D>
Vector<D> vertex_normal(const Swept_triangle<D>& triangle, const Vector<D>& of_wall);

/// The unit normal of a contact of the edge at a time, see Contact: at right angles to both; where these are
/// parallel that of the wall; where that is not against the motion the part of the motion across the edge,
/// turned round, or if there is none all of it. Always against the motion, and a function of directions only:
/// it does not depend on the scale.
template <int D>
Vector<D> edge_normal(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle,
                      const Contact<D>& contact, const Vector<D>& of_wall);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H
