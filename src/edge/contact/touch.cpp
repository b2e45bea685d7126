// SPDX-License-Identifier: LGPL-3.0-or-later
// The first of all meetings, where of several in one place the walls that face the edge are preferred.
#include "touch.h"

#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <limits>
#include <vector>

#include "swept_meeting.h"

namespace cellwalk::detail {
namespace {

/// True if the edge comes from the side of the wall that a contact refers to.
template <int D>
bool is_faced(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, const Contact<D>& contact,
              Walk_counts& counts) {
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(contact.facet));
  const std::size_t i = snapshot.facet_of(contact.facet);
  const int of_a = side<Exact>(cell, i, triangle.a, counts);
  return (of_a != 0 ? of_a : side<Exact>(cell, i, triangle.q, counts)) <= 0;
}

/// The order of contacts, except that of two sides of a wall, or of several walls in one place, a side from
/// which the edge comes is preferred. A triangle may reach around a rim, so that it meets both sides.
template <int D>
bool is_preferred(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, const Contact<D>& contact,
                  const Contact<D>& other, Walk_counts& counts) {
  if (contact.exact_time() == other.exact_time() && contact.body == other.body &&
      contact.kind == other.kind) {
    const bool is_first = is_faced(snapshot, triangle, contact, counts);
    if (is_first != is_faced(snapshot, triangle, other, counts)) return is_first;
  }
  return is_before(contact, other);
}

}  // namespace

template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, Cell start,
                                      const Swept_triangle<D>& triangle, Edge_counts& counts,
                                      bool with_start) {
  std::optional<Contact<D>> first;
  const auto look_at = [&](Half_facet wall) {
    ++counts.search_walls;
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(wall));
    const auto facet = half_spaces(cell, snapshot.facet_of(wall));
    const auto meeting =
        with_start ? first_closed_meeting<D>(triangle, facet) : first_meeting<D>(triangle, facet);
    if (!meeting) return true;
    const Contact<D> contact = contact_with(snapshot, triangle, wall, *meeting);
    if (!first || is_preferred(snapshot, triangle, contact, *first, counts.walk)) first = contact;
    return true;
  };
  Flooded cells;
  flood(snapshot, start, triangle, counts, std::numeric_limits<std::size_t>::max(), cells, look_at);
  return first;
}

template std::optional<Contact<2>> first_touch<2>(const Snapshot<2>&, Cell, const Swept_triangle<2>&,
                                                  Edge_counts&, bool);
template std::optional<Contact<3>> first_touch<3>(const Snapshot<3>&, Cell, const Swept_triangle<3>&,
                                                  Edge_counts&, bool);

}  // namespace cellwalk::detail
