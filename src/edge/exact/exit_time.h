// SPDX-License-Identifier: LGPL-3.0-or-later
// The time at which a moving point leaves a cell.
#ifndef CELLWALK_EDGE_EXACT_EXIT_TIME_H
#define CELLWALK_EDGE_EXACT_EXIT_TIME_H

#include <optional>

#include "moving_line.h"

namespace cellwalk::detail {

/// The parameter at which the path from a to b leaves a cell: at the plane of the first facet that has b
/// outside.
/// \pre the path passes the closed cell, and b lies outside
template <int D>
Event_time<D> exit_time(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, Walk_counts& counts) {
  std::optional<Event_time<D>> first;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const Moving_orientation<D> side = moving_side<D>(cell, i, a, b, counts);
    if (side.at_1() <= 0) continue;
    if (!side.has_root()) return {};  // a lies in the plane
    const auto time = Event_time<D>::root_of(side);
    if (!first || time < *first) first = time;
  }
  // Of cells that somebody forged in a compiled file, b may lie outside of none of these planes.
  return first ? *first : Event_time<D>(1.0);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXACT_EXIT_TIME_H
