// SPDX-License-Identifier: LGPL-3.0-or-later
// The patch glued to the cells that stay, applied to the map, the snapshot and the indices in turn.
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/facet_table.h>
#include <cellwalk/internal/environment/star_index.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include "environment/map/map_patch.h"
#include "environment/snapshot/compiler.h"

namespace cellwalk::detail {

template <int D>
Gluing glue_patch(const Cell_soup<D>& soup) {
  Gluing gluing;
  gluing.opposite.assign(soup.facet_count(), no_facet);
  Facet_table table(soup.facet_count());
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = table.enter(f, [&](std::uint32_t n) { return soup.facet(n); });
    if (g == f) continue;
    gluing.opposite[f] = g;
    gluing.opposite[g] = f;
  }
  return gluing;
}

template <int D>
void Cell_patcher<D>::prefetch(std::span<const Cell> cells) const {
  if (!environment_.storage_) return;
  const Map_storage<D>& storage = *environment_.storage_;
  for (const Cell c : cells)
    for (std::size_t i = 0; i < snapshot().facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (const Cell other = snapshot().neighbour(f); other != Cell::none) {
        __builtin_prefetch(snapshot().links(other), 1);
        __builtin_prefetch(&storage.dart_of_half_facet[4 * std::size_t{to_index(other)}]);
      }
      const Dart<D> dart = storage.dart_of_half_facet[to_index(f)];
      if (dart == Dart<D>{}) continue;
      // The darts of a facet follow one another in most cases.
      const char* const first = reinterpret_cast<const char*>(&*dart);
      constexpr std::size_t line = 64;
      for (std::size_t k = 0; k < D * sizeof(*dart); k += line) __builtin_prefetch(first + k, 1);
    }
}

template <int D>
std::vector<Cell> Cell_patcher<D>::replace(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                           const Gluing& gluing, const std::optional<Point<D>>& added) {
  using Boundary = Boundary_index<D>;
  Map_storage<D>& storage = environment_.editable();
  Snapshot<D>& snapshot = *environment_.snapshot_;
  boost::container::small_vector<std::uint32_t, 32> points;  // of the removed cells
  for (const Cell c : removed)
    for (const std::uint32_t p : snapshot.view(c).vertices)
      if (std::ranges::find(points, p) == points.end()) points.push_back(p);
  std::vector<Half_facet> old_boundary, slots;
  if (environment_.boundary_) old_boundary = Boundary::facets(snapshot, removed);
  const std::uint32_t point = added ? snapshot.add_point(*added) : Map_patch<D>::no_point;
  std::vector<Cell> cells;
  try {
    const Cell_exchange<D> exchange(snapshot, removed, soup, gluing);
    Map_patch<D> patch(storage, snapshot, exchange, point);
    cells = Snapshot_compiler<D>(snapshot).exchange(exchange, slots);
    patch.apply(snapshot, slots);
  } catch (...) {
    if (added) snapshot.remove_point(point);
    throw;
  }
  for (const std::uint32_t p : points)
    if (storage.vertex_of_point[p] == Map_vertex<D>{}) snapshot.remove_point(p);
  if (std::unique_ptr<Boundary> boundary = std::move(environment_.boundary_)) {
    // If memory runs out, the index is dropped, and rebuilt when it is needed.
    boundary->replace(snapshot, old_boundary, Boundary::facets(snapshot, cells));
    environment_.boundary_ = std::move(boundary);
  }
  if (std::unique_ptr<Star_index<D>> stars = std::move(environment_.stars_)) {
    stars->replace(snapshot, removed, {points.data(), points.size()}, cells);
    environment_.stars_ = std::move(stars);
  }
  return cells;
}

template Gluing glue_patch(const Cell_soup<2>&);
template Gluing glue_patch(const Cell_soup<3>&);
template class Cell_patcher<2>;
template class Cell_patcher<3>;

}  // namespace cellwalk::detail
