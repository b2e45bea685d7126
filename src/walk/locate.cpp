// SPDX-License-Identifier: LGPL-3.0-or-later
// A tree of the boxes of cells, and the sides of walls at a point among the cells that hold it.
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/gradual_underflow.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/walk/locate.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

/// Rounds outward: boxes may be larger than their cells, never smaller.
float down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
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
  std::uint64_t geometry_epoch;  ///< of the boxes
  Tree tree;
};

template <int D>
Locator<D>::Locator(const Snapshot<D>& snapshot) {
  expect_gradual_underflow();
  index_ = std::make_unique<Index>(snapshot);
}

template <int D>
Locator<D>::~Locator() = default;
template <int D>
Locator<D>::Locator(Locator&&) noexcept = default;
template <int D>
Locator<D>& Locator<D>::operator=(Locator&&) noexcept = default;

namespace {

constexpr std::size_t no_side = ~std::size_t{0};

/// A cell whose closure contains a point.
template <int D>
struct Found {
  Cell cell;
  std::vector<std::size_t> facets;  ///< those whose planes contain the point
  std::size_t side = no_side;       ///< its class of linked cells
};

/// Finds the sides: classes of cells linked at p. All cells that contain p are given.
template <int D>
void find_sides(const Snapshot<D>& s, std::vector<Found<D>>& found, const Point<D>& p) {
  for (std::size_t side = 0; side < found.size(); ++side) {
    if (found[side].side != no_side) continue;
    detail::Link_search<D> links(s, found[side].cell);
    while (links.next()) {
      const auto here = std::find_if(found.begin(), found.end(),
                                     [c = links.cell()](const Found<D>& x) { return x.cell == c; });
      if (here == found.end()) continue;
      here->side = side;
      links.expand([&](const Cell_view<D>& cell, std::size_t i) {
        // A cell may have several facets in one plane.
        return std::find(here->facets.begin(), here->facets.end(), i) != here->facets.end() &&
               detail::in_facet(cell, i, p);
      });
    }
  }
}

/// The key of the order of sides: whether the displaced point lies there, then the corners of the first cell.
template <int D>
struct Side_rank {
  std::size_t side;
  bool is_displaced = false;
  std::vector<Point<D>> corners;

  bool operator<(const Side_rank& other) const {
    if (is_displaced != other.is_displaced) return is_displaced;
    return corners < other.corners;
  }
};

template <int D>
std::vector<Side_rank<D>> ordered_sides(const Snapshot<D>& s, const std::vector<Found<D>>& found) {
  std::vector<Side_rank<D>> ranks;
  for (const Found<D>& x : found) {
    auto rank = std::find_if(ranks.begin(), ranks.end(), [&](const auto& r) { return r.side == x.side; });
    if (rank == ranks.end()) rank = ranks.insert(ranks.end(), {x.side, false, {}});
    const Cell_view<D> cell = s.view(x.cell);
    rank->is_displaced |= std::all_of(x.facets.begin(), x.facets.end(),
                                      [&](std::size_t f) { return detail::displaced_side(cell, f) < 0; });
    detail::take_least(cell, rank->corners);
  }
  std::sort(ranks.begin(), ranks.end());
  return ranks;
}

/// The dimension of the lowest cell of the complex that contains p, a point of the closed cell.
template <int D>
std::uint16_t dimension_at(const Snapshot<D>& s, Cell c, const Point<D>& p) {
  const Cell_view<D> cell = s.view(c);
  Walk_counts counts;
  return detail::lowest_dimension(
      cell, p, [&](std::size_t f) { return detail::side<Exact>(cell, f, p, counts) == 0; });
}

}  // namespace

template <int D>
Location<D> Locator<D>::locate(const Point<D>& p) const {
  const Snapshot<D>& s = index_->snapshot;
  s.check_geometry_epoch(index_->geometry_epoch, "this Locator was made: make a new one");
  detail::check_finite(p, "the point to be located");
  Location<D> location;
  std::vector<std::uint32_t> candidates;
  for (auto it = index_->tree.qbegin(bgi::intersects(Index::box(p, p))); it != index_->tree.qend(); ++it)
    candidates.push_back(it->second);
  std::sort(candidates.begin(), candidates.end());
  bool in_solid = false;
  Walk_counts counts;
  std::vector<Found<D>> found;
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
    if (s.is_solid(c))
      in_solid = true;
    else
      found.push_back({c, std::move(on)});
  }
  if (found.empty()) {
    if (in_solid) location.status = Location_status::solid;
    return location;
  }
  location.status = Location_status::free;
  find_sides(s, found, p);
  for (const Side_rank<D>& rank : ordered_sides(s, found)) {
    const std::size_t first = location.cells.size();
    for (const Found<D>& x : found) {
      if (x.side != rank.side) continue;
      location.cells.push_back(x.cell);
      location.side_of_cell.push_back(static_cast<int>(location.sides.size()));
    }
    const Cell cell = location.cells[first];
    location.sides.push_back({p, cell, dimension_at(s, cell, p), 0});
  }
  location.cell = location.sides.front().cell;
  location.dimension = location.sides.front().dimension;
  return location;
}

template <int D>
std::optional<Particle<D>> Locator<D>::particle_at(const Point<D>& p) const {
  const Location<D> location = locate(p);
  if (location.sides.empty()) return {};
  return location.sides.front();
}

template <int D>
std::vector<Particle<D>> Locator<D>::particles_at(const Point<D>& p) const {
  return locate(p).sides;
}

template class Locator<2>;
template class Locator<3>;

}  // namespace cellwalk
