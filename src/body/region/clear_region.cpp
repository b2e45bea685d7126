// SPDX-License-Identifier: LGPL-3.0-or-later
// The region of a whole body, by a search from the cells of its vertices.
#include "clear_region.h"

#include "region_search.h"

namespace cellwalk::detail {

template <int D>
std::optional<Clear_region<D>> find_clear_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                 const Region_request<D>& request, Region_effort& effort) {
  thread_local Cell_list found;
  Region_search<D> search(snapshot, anchor, request, effort, found);
  if (!(request.by_clusters ? search.find_by_clusters() : search.find())) return {};
  return search.region();
}

template std::optional<Clear_region<2>> find_clear_region<2>(const Snapshot<2>&, const Particle<2>&,
                                                             const Region_request<2>&, Region_effort&);
template std::optional<Clear_region<3>> find_clear_region<3>(const Snapshot<3>&, const Particle<3>&,
                                                             const Region_request<3>&, Region_effort&);

}  // namespace cellwalk::detail
