// SPDX-License-Identifier: LGPL-3.0-or-later
// What traces need of an environment, made at the first one.
#ifndef CELLWALK_PYTHON_TRACING_H
#define CELLWALK_PYTHON_TRACING_H

#include <cellwalk/walk/trace.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::python {

/// Calls visit(facet) for each facet once, seen from the cell of lower number: in the order of
/// Environment.facets().
template <int D, class Visit>
void for_each_facet(const Snapshot<D>& snapshot, const Visit& visit) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet facet = Snapshot<D>::half_facet(cell, k);
      const Cell other = snapshot.neighbour(facet);
      if (other == Cell::none || snapshot.index(other) > i) visit(facet);
    }
  }
}

/// Valid until points move or cells are replaced.
template <int D>
struct Tracing {
  explicit Tracing(const Snapshot<D>& snapshot)
      : tracer(snapshot), row_of(snapshot.half_facet_slots()), diameter(diameter_of(snapshot.points())) {
    std::int32_t row = 0;
    for_each_facet(snapshot, [&](Half_facet facet) {
      row_of[to_index(facet)] = row;
      const Half_facet opposite = snapshot.opposite(facet);
      if (opposite != Half_facet::none) row_of[to_index(opposite)] = row;
      ++row;
    });
  }

  Tracer<D> tracer;
  std::vector<std::int32_t> row_of;  ///< of a half-facet: its row in Environment.facets()
  double diameter;                   ///< no two points are further apart, but for rounding

 private:
  static double diameter_of(std::span<const Point<D>> points) {
    double diameter = 0;
    for (std::size_t k = 0; k < D && !points.empty(); ++k) {
      const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                   [k](const auto& a, const auto& b) { return a[k] < b[k]; });
      diameter = std::hypot(diameter, (*high)[k] - (*low)[k]);
    }
    return diameter;
  }
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_TRACING_H
