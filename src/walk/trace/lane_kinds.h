// SPDX-License-Identifier: LGPL-3.0-or-later
// The kinds of processors for which the arithmetic of lanes is compiled.
#ifndef CELLWALK_WALK_TRACE_LANE_KINDS_H
#define CELLWALK_WALK_TRACE_LANE_KINDS_H

#include <vector>

#include "lane_functions.h"

namespace cellwalk::detail {

struct Lane_kind {
  const char* name;
  const Lane_functions& functions;
};

/// The kinds that this processor is, from any processor to the one with the widest lanes.
std::vector<Lane_kind> lane_kinds();

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_KINDS_H
