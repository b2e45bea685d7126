// SPDX-License-Identifier: LGPL-3.0-or-later
// The removal of unused names of points and cells, from the map and the snapshot alike.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/star_index.h>

#include <utility>

#include "environment/map/map_matches_snapshot.h"
#include "environment/snapshot/compiler.h"
#include "snapshot_soup.h"

namespace cellwalk {

template <int D>
Compaction Environment<D>::compact() {
  Compaction result;
  std::vector<Half_facet> old_names, names;
  Cell_soup<D> soup = soup_of(*snapshot_, &old_names);
  const Gluing gluing = gluing_of(*snapshot_, old_names);

  // Points in use keep their order.
  std::vector<char> is_used(soup.points.size(), 0);
  for (const std::uint32_t p : soup.vertices) is_used[p] = 1;
  result.points.assign(soup.points.size(), Compaction::none);
  std::vector<Point<D>> points;
  for (std::uint32_t p = 0; p < is_used.size(); ++p) {
    if (!is_used[p]) continue;
    result.points[p] = static_cast<std::uint32_t>(points.size());
    points.push_back(soup.points[p]);
  }
  soup.points = std::move(points);
  for (std::uint32_t& p : soup.vertices) p = result.points[p];

  Snapshot<D> snapshot = Snapshot<D>::compile(soup, gluing, &names);
  std::unique_ptr<Map_storage<D>> storage;
  if (storage_) {
    storage = build_map(soup, gluing);
    const std::vector<Dart<D>> darts = storage->dart_of_half_facet;
    assign_half_facets<D>(*storage, darts, names, snapshot.half_facet_slots());
  }
  result.half_facets.assign(snapshot_->half_facet_slots(), Half_facet::none);
  result.cells.assign(snapshot_->half_facet_slots() / 4, Cell::none);
  for (std::size_t f = 0; f < names.size(); ++f) {
    result.half_facets[to_index(old_names[f])] = names[f];
    result.cells[to_index(snapshot_->cell_of(old_names[f]))] = snapshot.cell_of(names[f]);
  }
  Snapshot_compiler<D>(snapshot).follow(*snapshot_, {result.cells, result.half_facets});
  *snapshot_ = std::move(snapshot);
  storage_ = std::move(storage);
  boundary_.reset();
  stars_.reset();
  return result;
}

template Compaction Environment<2>::compact();
template Compaction Environment<3>::compact();

}  // namespace cellwalk
