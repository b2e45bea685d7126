// SPDX-License-Identifier: LGPL-3.0-or-later
// When a moving point leaves a cell.
#ifndef CELLWALK_EDGE_EXIT_TIME_H
#define CELLWALK_EDGE_EXIT_TIME_H

#include <cellwalk/kernel/exact_value.h>
#include <cellwalk/walk/detail/signs.h>

#include <optional>

namespace cellwalk::detail {

/// The share of the way from a to b at which it leaves a cell: where it passes the plane of the first facet that has b outside.
/// \pre the way passes the closed cell, and b lies outside
template <int D>
Rational exit_time(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, Walk_counts& counts) {
  std::optional<Rational> first;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    if (side<Exact>(cell, i, b, counts) <= 0) continue;
    const Rational at_a = side<Exact_value>(cell, i, a, counts);
    const Rational time = at_a / (at_a - side<Exact_value>(cell, i, b, counts));
    if (!first || time < *first) first = time;
  }
  return *first;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXIT_TIME_H
