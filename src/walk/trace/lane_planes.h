// SPDX-License-Identifier: LGPL-3.0-or-later
// The planes of all facets to twice the precision of a double, as lane_lengths.h takes them.
#ifndef CELLWALK_WALK_TRACE_LANE_PLANES_H
#define CELLWALK_WALK_TRACE_LANE_PLANES_H

#include <cellwalk/environment/snapshot.h>

#include <vector>

#include "lane_lengths.h"

namespace cellwalk::detail {

struct Lane_planes {
  std::vector<Lane_plane> planes;  ///< of each half-facet; both sides of a facet have the same
  double size = 0;                 ///< at least that of every coordinate in the frame
};

/// A facet whose plane is not known well enough gets one that leaves all lengths uncertain.
template <int D>
Lane_planes lane_planes(const Snapshot<D>& snapshot);

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_PLANES_H
