// SPDX-License-Identifier: LGPL-3.0-or-later
// The contact of an edge with a wall at a point.
#ifndef CELLWALK_EDGE_CONTACT_EDGE_CONTACT_H
#define CELLWALK_EDGE_CONTACT_EDGE_CONTACT_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include "edge/chain/ridge.h"
#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// A contact with a wall, with its normal; the feature and the point are left to the caller.
template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall);

/// The contact at x, a point of the wall, with the normal of the wall.
template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall,
                        const Exact_point<D>& x);

/// The contact of an edge with a wall that it meets at the inside of a ridge.
/// \pre the line of the ridge is passed by the edge at one time
/// Cost: some 3,000 instructions
template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Half_facet wall,
                        const Ridge& ridge);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_EDGE_CONTACT_H
