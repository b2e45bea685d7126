// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/walk/detail/signs.h>
#include <cellwalk/walk/locate.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cellwalk {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

/// Rounds outward: boxes may be larger than their cells, never smaller.
float down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float up(double x) { return -down(-x); }

}  // namespace

template <int D>
struct Locator<D>::Index {
  using Corner = bg::model::point<float, static_cast<std::size_t>(D), bg::cs::cartesian>;
  using Box = bg::model::box<Corner>;
  using Entry = std::pair<Box, std::uint32_t>;
  using Tree = bgi::rtree<Entry, bgi::rstar<16>>;

  static Box box(const Point<D>& low, const Point<D>& high) {
    if constexpr (D == 2)
      return {Corner(down(low[0]), down(low[1])), Corner(up(high[0]), up(high[1]))};
    else
      return {Corner(down(low[0]), down(low[1]), down(low[2])),
              Corner(up(high[0]), up(high[1]), up(high[2]))};
  }

  explicit Index(const Snapshot<D>& s) : snapshot(s), geometry_epoch(s.geometry_epoch()) {
    std::vector<Entry> entries;
    entries.reserve(s.cell_count());
    for (std::uint32_t i = 0; i < s.cell_slots(); ++i) {
      if (s.cell(i) == Cell::none) continue;
      const Cell_view<D> cell = s.view(s.cell(i));
      Point<D> low = cell.point(0), high = low;
      for (std::size_t v = 1; v < cell.vertex_count(); ++v)
        for (int k = 0; k < D; ++k) {
          low[k] = std::min(low[k], cell.point(v)[k]);
          high[k] = std::max(high[k], cell.point(v)[k]);
        }
      entries.emplace_back(box(low, high), i);
    }
    tree = Tree(entries);
  }

  const Snapshot<D>& snapshot;
  std::uint64_t geometry_epoch;  ///< that the boxes are of
  Tree tree;
};

template <int D>
Locator<D>::Locator(const Snapshot<D>& snapshot) : index_(std::make_unique<Index>(snapshot)) {}

template <int D>
Locator<D>::~Locator() = default;
template <int D>
Locator<D>::Locator(Locator&&) noexcept = default;
template <int D>
Locator<D>& Locator<D>::operator=(Locator&&) noexcept = default;

namespace {

/// Classes of cells joined by passable facets that contain p. All cells that contain p are in `cells`.
template <int D>
int count_sides(const Snapshot<D>& s, const std::vector<Cell>& cells, const Point<D>& p) {
  std::vector<std::size_t> parent(cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  int sides = static_cast<int>(cells.size());
  Walk_counts counts;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell_view<D> cell = s.view(cells[i]);
    for (std::size_t f = 0; f < cell.facet_count(); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(cells[i], f);
      if (s.is_impassable(facet)) continue;
      // p lies in both closed cells; it lies in this facet if it is on its plane and the neighbour holds it,
      // unless the two cells share several coplanar facets.
      const auto it = std::find(cells.begin(), cells.end(), s.neighbor(facet));
      if (it == cells.end() || detail::side<Exact>(cell, f, p, counts) != 0) continue;
      if (!detail::in_facet(cell, f, p)) continue;
      const std::size_t a = root(i), b = root(static_cast<std::size_t>(it - cells.begin()));
      if (a == b) continue;
      parent[a] = b;
      --sides;
    }
  }
  return sides;
}

}  // namespace

template <int D>
Location<D> Locator<D>::locate(const Point<D>& p) const {
  const Snapshot<D>& s = index_->snapshot;
  s.check_geometry_epoch(index_->geometry_epoch, "this Locator was made: make a new one");
  Location<D> location;
  std::vector<std::uint32_t> candidates;
  for (auto it = index_->tree.qbegin(bgi::intersects(Index::box(p, p))); it != index_->tree.qend(); ++it)
    candidates.push_back(it->second);
  std::sort(candidates.begin(), candidates.end());
  bool in_solid = false;
  Walk_counts counts;
  for (const std::uint32_t i : candidates) {
    const Cell c = s.cell(i);
    const Cell_view<D> cell = s.view(c);
    bool inside = true;
    std::vector<std::size_t> on;
    for (std::size_t f = 0; f < cell.facet_count() && inside; ++f) {
      const int side = detail::side<Exact>(cell, f, p, counts);
      inside = side <= 0;
      if (side == 0) on.push_back(f);
    }
    if (!inside) continue;
    if (s.is_solid(c)) {
      in_solid = true;
      continue;
    }
    if (location.cells.empty()) {
      location.cell = c;
      location.dimension = detail::lowest_dimension(
          cell, p, [&](std::size_t f) { return std::find(on.begin(), on.end(), f) != on.end(); });
    }
    location.cells.push_back(c);
  }
  if (location.cells.empty()) {
    if (in_solid) location.status = Location_status::solid;
    return location;
  }
  location.status = Location_status::free;
  location.sides = location.cells.size() == 1 ? 1 : count_sides(s, location.cells, p);
  return location;
}

template <int D>
Particle<D> Locator<D>::particle_at(const Point<D>& p) const {
  const Location<D> location = locate(p);
  Particle<D> particle;
  particle.position = p;
  particle.cell = location.cell;
  particle.dimension = location.dimension;
  return particle;
}

template class Locator<2>;
template class Locator<3>;

}  // namespace cellwalk
