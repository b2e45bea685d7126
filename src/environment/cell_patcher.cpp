// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/star_index.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "environment/map/map_patch.h"

namespace cellwalk::detail {

namespace {

void assign(boost::container::small_vector<std::uint32_t, 8>& key, std::span<const std::uint32_t> points) {
  key.assign(points.begin(), points.end());
}
template <std::size_t N>
void assign(std::array<std::uint32_t, N>& key, std::span<const std::uint32_t> points) {
  std::copy_n(points.begin(), N, key.begin());
}

/// \tparam Key holds the points of a facet
template <class Key, int D>
Gluing glue_by(const Cell_soup<D>& soup) {
  Gluing gluing;
  gluing.opposite.assign(soup.facet_count(), no_facet);
  // The points of each facet, ascending, and its number.
  std::vector<std::pair<Key, std::uint32_t>> keys(soup.facet_count());
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    auto& [key, number] = keys[f];
    assign(key, soup.facet(f));
    std::sort(key.begin(), key.end());
    number = f;
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k - 1].first != keys[k].first) continue;
    gluing.opposite[keys[k - 1].second] = keys[k].second;
    gluing.opposite[keys[k].second] = keys[k - 1].second;
  }
  return gluing;
}

}  // namespace

template <int D>
Gluing glue_patch(const Cell_soup<D>& soup) {
  constexpr auto corners = static_cast<std::size_t>(D);
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    if (soup.facet(f).size() != corners)
      return glue_by<boost::container::small_vector<std::uint32_t, 8>>(soup);
  return glue_by<std::array<std::uint32_t, corners>>(soup);
}

template <int D>
std::vector<Cell> Cell_patcher<D>::replace(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                           const Gluing& gluing, const std::optional<Point<D>>& added) {
  using Boundary = Boundary_index<D>;
  Map_storage<D>& storage = environment_.editable();
  Snapshot<D>& snapshot = environment_.snapshot_;
  std::vector<Half_facet> half_facets, slots;
  std::vector<std::uint32_t> points;
  for (const Cell c : removed) {
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i)
      half_facets.push_back(Snapshot<D>::half_facet(c, i));
    const auto own = snapshot.view(c).vertices;
    points.insert(points.end(), own.begin(), own.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const std::vector<Half_facet> old_boundary = Boundary::facets(snapshot, removed);
  const std::uint32_t point = added ? snapshot.add_point(*added) : Map_patch<D>::no_point;
  std::vector<Cell> cells;
  try {
    Map_patch<D> patch(storage, half_facets, soup, gluing, point);
    cells = snapshot.replace_cells(removed, soup, gluing, &slots);
    patch.apply(snapshot, slots);
  } catch (...) {
    if (added) snapshot.remove_point(point);
    throw;
  }
  for (const std::uint32_t p : points)
    if (storage.vertices_of(p).empty()) snapshot.remove_point(p);
  if (std::unique_ptr<Boundary> boundary = std::move(environment_.boundary_)) {
    // If memory runs out, the index is dropped, and rebuilt when it is needed.
    boundary->replace(snapshot, old_boundary, Boundary::facets(snapshot, cells));
    environment_.boundary_ = std::move(boundary);
  }
  if (std::unique_ptr<Star_index<D>> stars = std::move(environment_.stars_)) {
    stars->replace(snapshot, removed, points, cells);
    environment_.stars_ = std::move(stars);
  }
  return cells;
}

template Gluing glue_patch(const Cell_soup<2>&);
template Gluing glue_patch(const Cell_soup<3>&);
template class Cell_patcher<2>;
template class Cell_patcher<3>;

}  // namespace cellwalk::detail
