// SPDX-License-Identifier: LGPL-3.0-or-later
// The facets of cells round a ridge, one after the other.
#ifndef CELLWALK_EDGE_CHAIN_RIDGE_H
#define CELLWALK_EDGE_CHAIN_RIDGE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/walk/signs.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk::detail {

/// A ridge by its points: two in 3D, in the order of the facet that it is seen from, and one in 2D, which
/// stands twice.
struct Ridge {
  std::uint32_t u, v;

  friend bool operator==(const Ridge&, const Ridge&) = default;
};

/// Ridge k of facet i.
template <int D>
Ridge ridge_of(const Cell_view<D>& cell, std::size_t i, std::size_t k) {
  const auto loop = cell.loop(i);
  const std::uint32_t u = cell.point_index(loop[k]);
  return {u, D == 2 ? u : cell.point_index(loop[k + 1 == loop.size() ? 0 : k + 1])};
}

/// The position of a ridge, in any order of its points, in the loop of facet i; none if it is not there.
template <int D>
std::optional<std::size_t> position_of(const Cell_view<D>& cell, std::size_t i, const Ridge& ridge) {
  for (std::size_t k = 0; k < cell.loop(i).size(); ++k) {
    const Ridge here = ridge_of(cell, i, k);
    if (here == ridge || here == Ridge{ridge.v, ridge.u}) return k;
  }
  return {};
}

/// The other facet of a cell at a ridge of one; Half_facet::none if the ridge is not there.
/// Cost: a look at the points of the cell's facets.
template <int D>
Half_facet across(const Snapshot<D>& snapshot, Half_facet f, const Ridge& ridge) {
  const Cell c = snapshot.cell_of(f);
  const Cell_view<D> cell = snapshot.view(c);
  const std::size_t i = snapshot.facet_of(f);
  const auto k = position_of(cell, i, ridge);
  const std::size_t j = k ? facet_across(cell, i, *k) : cell.facet_count();
  return j == cell.facet_count() ? Half_facet::none : Snapshot<D>::half_facet(c, j);
}

/// Calls visit(f) for the facets at a ridge on the other way round it, each seen from the cell
/// before it, until one leads to the last cell. True if it was reached, and visit(f) was true for all.
/// \pre the ridge is one of the first facet
template <int D, class Visit>
bool go_round(const Snapshot<D>& snapshot, Half_facet first, const Ridge& ridge, Cell last,
              const Visit& visit) {
  const Half_facet begin = across(snapshot, first, ridge);
  Half_facet f = begin;
  // In a certified environment this comes to the last cell or to a wall.
  while (f != Half_facet::none && visit(f)) {
    if (snapshot.neighbour(f) == last) return true;
    f = across(snapshot, snapshot.opposite(f), ridge);
    if (f == begin) return false;
  }
  return false;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_RIDGE_H
