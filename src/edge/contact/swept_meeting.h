// SPDX-License-Identifier: LGPL-3.0-or-later
// The meetings of the edge that sweeps a triangle with closed features of the environment, exactly. Theory:
// docs/sweep.md, touches.
#ifndef CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H
#define CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <optional>

#include "edge/exact/half_space.h"

namespace cellwalk::detail {

/// The time and point at which the edge meets a feature.
template <int D>
struct Meeting {
  Fraction time;
  Exact_point<D> point;
  bool at_p = false;  ///< the point is p itself
};

/// The first meeting of the edge with an intersection of half-spaces, off the start of the edge: 0 if they
/// meet at the start and continue to do so. Of several points at that time, the one nearest to p.
/// Degenerate cases: the triangle may be a segment; a and q may coincide.
template <int D>
std::optional<Meeting<D>> first_meeting(const Swept_triangle<D>& triangle, const Half_spaces<D>& feature);

/// The same, but the start of the edge counts as well: 0 if the two meet there.
template <int D>
std::optional<Meeting<D>> first_closed_meeting(const Swept_triangle<D>& triangle,
                                               const Half_spaces<D>& feature);

/// The contact with a wall at a point: the lowest feature there, and the normal that belongs to it.
template <int D>
Contact<D> contact_with(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Half_facet wall,
                        const Meeting<D>& meeting);

/// The unit normal of a contact of p, given that of the wall. If the latter points along the motion of p, as
/// where p touches a corner in passing, the result is the direction against the motion.
template <int D>
Vector<D> vertex_normal(const Swept_triangle<D>& triangle, const Vector<D>& of_wall);

/// The unit normal of a contact of the edge at a time, see Contact: perpendicular to the edge and the
/// feature; if they are parallel, that of the wall; if that is not against the motion, the reversed component
/// of the motion across the edge, or, if that is 0, the reversed motion. Always against the motion. It
/// depends on directions only, not on the scale.
template <int D>
Vector<D> edge_normal(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle,
                      const Contact<D>& contact, const Vector<D>& of_wall);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_SWEPT_MEETING_H
