// SPDX-License-Identifier: LGPL-3.0-or-later
// The contact of an edge that meets a wall at a ridge. Theory: docs/sweep.md, relinking at ridges.
#ifndef CELLWALK_INTERNAL_EDGE_EDGE_CONTACT_H
#define CELLWALK_INTERNAL_EDGE_EDGE_CONTACT_H

#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

namespace cellwalk::detail {

/// The first contact of an edge that relink_at_ridges() found blocked, with the normal of the wall.
/// \pre the other end lies in the interior of its cell; else there may be others at the same time
/// Cost: some 3,000 instructions
template <int D>
Contact<D> contact_at_ridge(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle,
                            const Relink_scratch<D>& blocked);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_EDGE_CONTACT_H
