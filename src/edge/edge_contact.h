// SPDX-License-Identifier: LGPL-3.0-or-later
// The contact of an edge with a wall at a point.
#ifndef CELLWALK_EDGE_EDGE_CONTACT_H
#define CELLWALK_EDGE_EDGE_CONTACT_H

#include <cellwalk/kernel/exact_time.h>

#include "rational_segment.h"

namespace cellwalk::detail {

/// x is a point of the wall.
template <int D>
Wall_contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall,
                             const Exact_point<D>& x);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EDGE_CONTACT_H
