// SPDX-License-Identifier: LGPL-3.0-or-later
#include "pooled_region.h"

#include <vector>

#include "region_search.h"

namespace cellwalk::detail {

template <int D>
std::optional<Pooled_region<D>> find_pooled_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                   const Region_request<D>& request, Region_effort& effort) {
  std::vector<Cell> found;
  Region_search<D, Pooled_region<D>> search(snapshot, anchor, request, effort, found);
  if (!search.find_by_clusters()) return {};
  return search.region();
}

template std::optional<Pooled_region<2>> find_pooled_region<2>(const Snapshot<2>&, const Particle<2>&,
                                                               const Region_request<2>&, Region_effort&);
template std::optional<Pooled_region<3>> find_pooled_region<3>(const Snapshot<3>&, const Particle<3>&,
                                                               const Region_request<3>&, Region_effort&);

}  // namespace cellwalk::detail
