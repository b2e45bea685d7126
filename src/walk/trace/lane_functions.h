// SPDX-License-Identifier: LGPL-3.0-or-later
// The functions that are compiled for kinds of processors. All give the same lengths; of the walks, one may
// decide what another leaves to exact numbers.
#ifndef CELLWALK_WALK_TRACE_LANE_FUNCTIONS_H
#define CELLWALK_WALK_TRACE_LANE_FUNCTIONS_H

#include "lane_lengths.h"
#include "lane_walk.h"

namespace cellwalk::detail {

struct Lane_functions {
  void (*set_directions)(const Lane_segments& segments, unsigned long count);
  void (*place)(const Lane_segments& segments, unsigned long segment, const Lane_crossings& crossings,
                const Lane_places& places, unsigned long& at);
  unsigned long (*measure)(const Lane_places& places, unsigned long count, double error, double* lengths);
  Lane_walk walk_2, walk_3;  ///< in 2D and 3D, if any
};

extern const Lane_functions fused_lane_functions, wide_lane_functions;

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_FUNCTIONS_H
