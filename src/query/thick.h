// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions of points and edges with a radius.
#ifndef CELLWALK_QUERY_THICK_H
#define CELLWALK_QUERY_THICK_H

#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/query/query.h>

namespace cellwalk {

/// answer_move() and answer_sweep() for a radius that is not 0.
template <int D>
Answer<D> answer_thick(const Snapshot<D>& snapshot, const Locator<D>& locator,
                       const detail::Thick_motion<D>& motion, const Sweep_options& options,
                       Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_THICK_H
