// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to simulation: the cheapest way from cell to cell through passable facets.
#ifndef CELLWALK_SIMULATION_BODIES_CHEAPEST_WAY_H
#define CELLWALK_SIMULATION_BODIES_CHEAPEST_WAY_H

#include <cellwalk/environment/snapshot.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <vector>

namespace cellwalk::detail {

/// Cells where a way may begin or end, and what that costs.
using Cell_costs = std::map<Cell, double>;

/// Cells from one of `from` to one of `to`, both included; empty if passable facets do not connect them. Of
/// ways that cost the same, the numbers of the input decide, not the order of the snapshot.
/// \param cost of going from a cell to a neighbour, not negative
/// \pre the cells exist, and are free
/// Cost: about 1 us a cell that is nearer than the end, and that of `cost`.
template <int D, class Cost>
std::vector<Cell> cheapest_way(const Snapshot<D>& snapshot, const Cell_costs& from, const Cell_costs& to,
                               const Cost& cost) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> spent(snapshot.cell_slots(), never);
  std::vector<Cell> before(snapshot.cell_slots(), Cell::none);
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](Cell c, double total, Cell earlier) {
    const std::uint32_t index = snapshot.index(c);
    if (!(total < spent[index])) return;
    spent[index] = total;
    before[index] = earlier;
    open.emplace(total, index);
  };
  for (const auto& [cell, first] : from) reach(cell, first, Cell::none);
  double least = never;
  Cell end = Cell::none;
  while (!open.empty()) {
    const auto [total, index] = open.top();
    open.pop();
    if (!(total < least)) break;
    if (total > spent[index]) continue;
    const Cell c = snapshot.cell(index);
    if (const auto last = to.find(c); last != to.end() && total + last->second < least) {
      least = total + last->second;
      end = c;
    }
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const Cell next = snapshot.neighbour(f);
      if (next != Cell::none && !snapshot.is_impassable(f)) reach(next, total + cost(c, next), c);
    }
  }
  std::vector<Cell> way;
  for (Cell c = end; c != Cell::none; c = before[snapshot.index(c)]) way.push_back(c);
  std::reverse(way.begin(), way.end());
  return way;
}

/// The points of a way from cell to cell: centroids of cells, and between them of the facets. Up to rounding
/// each piece lies in one convex cell.
/// \pre passable facets join successive cells
template <int D>
std::vector<Point<D>> points_of_way(const Snapshot<D>& snapshot, const std::vector<Cell>& way);

extern template std::vector<Point<2>> points_of_way(const Snapshot<2>&, const std::vector<Cell>&);
extern template std::vector<Point<3>> points_of_way(const Snapshot<3>&, const std::vector<Cell>&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_CHEAPEST_WAY_H
