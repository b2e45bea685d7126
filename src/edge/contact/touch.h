// SPDX-License-Identifier: LGPL-3.0-or-later
// Closed walls that a swept triangle meets: Touch::stop.
#ifndef CELLWALK_EDGE_CONTACT_TOUCH_H
#define CELLWALK_EDGE_CONTACT_TOUCH_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <optional>

namespace cellwalk::detail {

/// The first point off its start at which the edge that sweeps a triangle meets a closed wall reachable from
/// `start`; with_start: the first point at all.
/// \pre a lies in the closure of `start`, a free cell
/// Cost: some twenty signs a facet of the cells that meet the triangle, and rational arithmetic for each wall
/// near it.
template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, Cell start,
                                      const Swept_triangle<D>& triangle, Edge_counts& counts,
                                      bool with_start = false);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_TOUCH_H
