// SPDX-License-Identifier: LGPL-3.0-or-later
#include "touch.h"

#include <limits>
#include <vector>

#include "may_meet.h"
#include "swept_meeting.h"

namespace cellwalk::detail {

template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, Cell start,
                                      const Swept_triangle<D>& triangle, Edge_counts& counts) {
  std::optional<Contact<D>> first;
  const auto look_at = [&](Half_facet wall) {
    ++counts.search_walls;
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(wall));
    const auto meeting = first_meeting<D>(triangle, half_spaces(cell, snapshot.facet_of(wall)));
    if (!meeting) return true;
    const Contact<D> contact = contact_with(snapshot, triangle, wall, *meeting);
    if (!first || is_before(contact, *first)) first = contact;
    return true;
  };
  Flooded cells;
  flood(snapshot, start, triangle, counts, std::numeric_limits<std::size_t>::max(), cells, look_at);
  return first;
}

template std::optional<Contact<2>> first_touch<2>(const Snapshot<2>&, Cell, const Swept_triangle<2>&,
                                                  Edge_counts&);
template std::optional<Contact<3>> first_touch<3>(const Snapshot<3>&, Cell, const Swept_triangle<3>&,
                                                  Edge_counts&);

}  // namespace cellwalk::detail
