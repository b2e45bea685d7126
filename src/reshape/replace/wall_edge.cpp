// SPDX-License-Identifier: LGPL-3.0-or-later
// The two halves of each cell at an edge of walls, if the new point lies exactly on the edge.
#include "wall_edge.h"

#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace cellwalk::detail {
namespace {

/// The facets of a simplex, in 2D around it.
template <int D>
std::array<Half_facet, static_cast<std::size_t>(D) + 1> facets_around(const Snapshot<D>& snapshot, Cell c) {
  std::array<Half_facet, static_cast<std::size_t>(D) + 1> result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = Snapshot<D>::half_facet(c, i);
  if (D == 2 && snapshot.loop(result[0])[1] != snapshot.loop(result[1])[0]) std::swap(result[1], result[2]);
  return result;
}

}  // namespace

template <int D>
std::string check_wall_edge(const Snapshot<D>& snapshot, std::span<const Cell> cells,
                            const std::array<std::uint32_t, 2>& edge, const Point<D>& position,
                            Cell_soup<D>& soup) {
  const Point<D>&a = snapshot.point(edge[0]), &b = snapshot.point(edge[1]);
  const std::uint32_t point = snapshot.next_point();
  if (position == a || position == b || !on_segment<D>(a, b, position))
    return "a wall has the edge, and the position is not exactly on it";
  for (const Cell c : cells) {
    const Cell_view<D> view = snapshot.view(c);
    // The cell on the side of each end has the new point for the other one.
    for (std::size_t gone = 0; gone < 2; ++gone) {
      for (const Half_facet f : facets_around<D>(snapshot, c)) {
        const std::size_t i = snapshot.facet_of(f);
        const bool is_at_edge = has_point(view, i, edge[0]) && has_point(view, i, edge[1]);
        if (is_at_edge && snapshot.neighbour(f) == Cell::none) return "the boundary has the edge";
        std::vector<std::uint32_t> loop = snapshot.loop(f);
        std::ranges::replace(loop, edge[gone], point);
        soup.add_facet(loop, is_at_edge && snapshot.is_impassable(f));
      }
      soup.end_cell(snapshot.is_solid(c));
    }
  }
  return "";
}

template std::string check_wall_edge(const Snapshot<2>&, std::span<const Cell>,
                                     const std::array<std::uint32_t, 2>&, const Point<2>&, Cell_soup<2>&);
template std::string check_wall_edge(const Snapshot<3>&, std::span<const Cell>,
                                     const std::array<std::uint32_t, 2>&, const Point<3>&, Cell_soup<3>&);

}  // namespace cellwalk::detail
