// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lane_kinds.h"

#include "plain_lanes.h"

namespace cellwalk::detail {

std::vector<Lane_kind> lane_kinds() {
  std::vector<Lane_kind> kinds{{"plain", plain_lane_functions}};
#if defined(CELLWALK_HAS_FUSED_LANES)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kinds.push_back({"fused", fused_lane_functions});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("bmi2"))
    kinds.push_back({"wide", wide_lane_functions});
#endif
  return kinds;
}

}  // namespace cellwalk::detail
