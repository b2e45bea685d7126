// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls at which a Boundary_tracer goes on, and the translation that takes walls to others. The extents
// of both sets give it; walks at the means of facets show that walls are there.
#include <cellwalk/body/boundary_tracer.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

namespace cellwalk {
namespace {

/// Shares of the size of two sets of walls: by how much the translations of their corners may differ, as they
/// do in files with ten digits; and how near to the mean of a facet a wall of the other set must be.
constexpr double rounding = 0x1p-30, nearness = 0x1p-24;

/// At least so many ulp: far from the origin the shares above are less.
constexpr double rounding_ulps = 4, nearness_ulps = 16;

template <int D>
struct Extent {
  Point<D> low, high;
};

template <int D>
Extent<D> extent(const Snapshot<D>& snapshot, std::span<const Half_facet> facets) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Extent<D> all;
  all.low.fill(infinity);
  all.high.fill(-infinity);
  for (const Half_facet facet : facets)
    for (const std::uint32_t p : snapshot.loop(facet))
      for (std::size_t k = 0; k < D; ++k) {
        all.low[k] = std::min(all.low[k], snapshot.point(p)[k]);
        all.high[k] = std::max(all.high[k], snapshot.point(p)[k]);
      }
  return all;
}

template <int D>
std::string name(const Snapshot<D>& snapshot, Half_facet facet) {
  return fmt::format("facet {} of cell {}", snapshot.facet_of(facet),
                     snapshot.index(snapshot.cell_of(facet)));
}

template <int D>
bool faces_free_space(const Snapshot<D>& snapshot, Half_facet facet) {
  return facet != Half_facet::none && !snapshot.is_solid(snapshot.cell_of(facet));
}

template <int D>
std::vector<Half_facet> free_sides(const Snapshot<D>& snapshot, std::span<const Half_facet> walls) {
  std::vector<Half_facet> sides;
  for (const Half_facet wall : walls) {
    const Half_facet opposite = snapshot.opposite(wall);
    const bool is_free = faces_free_space(snapshot, wall), is_other = faces_free_space(snapshot, opposite);
    if (!snapshot.is_impassable(wall) || is_free == is_other)
      throw Error(Error_code::input,
                  name(snapshot, wall) +
                      (!snapshot.is_impassable(wall)
                           ? " is open"
                           : " has free space on " + std::string(is_free ? "both sides" : "no side")) +
                      ": periodic walls have free space on one side");
    sides.push_back(is_free ? wall : opposite);
  }
  if (sides.empty()) throw Error(Error_code::input, "there is no wall: name a group that has some");
  return sides;
}

/// Each wall, translated, lies on a wall that it is to reach: a walk to its other side, from and to this near
/// to it, meets one.
template <int D>
void check_reaches(const Snapshot<D>& snapshot, const Locator<D>& locator, std::span<const Half_facet> from,
                   std::span<const Half_facet> to, const Vector<D>& translation, double near) {
  std::unordered_set<std::uint32_t> reached;
  for (const Half_facet facet : to) reached.insert(to_index(facet));
  for (const Half_facet facet : from) {
    const Cell cell = snapshot.cell_of(facet);
    const Vector<D> inwards = near * detail::inner_normal(snapshot.view(cell), snapshot.facet_of(facet));
    const Point<D> there = centroid(snapshot, facet) + translation;
    const auto particle = locator.particle_at(there - inwards);  // the other wall faces the other way
    Walk_counts counts;
    const auto met =
        particle ? walk<Exact>(snapshot, *particle, there + inwards, counts).contact : std::nullopt;
    if (!met || !reached.contains(to_index(met->facet)))
      throw Error(Error_code::input,
                  fmt::format("the two groups do not correspond: {}, translated by ({:.17g}), lies on no "
                              "wall of the other group",
                              name(snapshot, facet), fmt::join(translation, ", ")));
  }
}

/// The cells that have a point of these walls, and are reached from their cells by such cells.
template <int D>
std::unordered_set<std::uint32_t> cells_at(const Snapshot<D>& snapshot, std::span<const Half_facet> walls) {
  std::unordered_set<std::uint32_t> points, cells;
  std::vector<Cell> next;
  const auto add = [&](Cell cell) {
    if (cells.insert(to_index(cell)).second) next.push_back(cell);
  };
  for (const Half_facet wall : walls) {
    for (const std::uint32_t p : snapshot.loop(wall)) points.insert(p);
    add(snapshot.cell_of(wall));
  }
  while (!next.empty()) {
    const Cell cell = next.back();
    next.pop_back();
    for (std::size_t i = 0; i < snapshot.facet_count(cell); ++i) {
      const Half_facet facet = Snapshot<D>::half_facet(cell, i);
      if (snapshot.is_impassable(facet)) continue;
      const Cell beyond = snapshot.neighbour(facet);
      const auto vertices = snapshot.view(beyond).vertices;
      if (std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t p) { return points.contains(p); }))
        add(beyond);
    }
  }
  return cells;
}

}  // namespace

template <int D>
void Boundary_tracer<D>::answer(Half_facet wall, std::size_t how) {
  if (!answers_.emplace(to_index(wall), how).second)
    throw Error(
        Error_code::input,
        name(snapshot_, wall) + " is in two groups of walls: each wall reflects, or has one other wall");
}

template <int D>
void Boundary_tracer<D>::reflect(std::span<const Half_facet> walls) {
  for (const Half_facet wall : walls) {
    answer(wall, reflects);
    const Half_facet opposite = snapshot_.opposite(wall);
    if (opposite != Half_facet::none) answer(opposite, reflects);
  }
}

template <int D>
Vector<D> Boundary_tracer<D>::join(std::span<const Half_facet> left, std::span<const Half_facet> right) {
  const std::vector<Half_facet> from = free_sides(snapshot_, left), to = free_sides(snapshot_, right);
  const Extent<D> here = extent<D>(snapshot_, from), there = extent<D>(snapshot_, to);
  const Vector<D> low = there.low - here.low, high = there.high - here.high;
  const double size = std::max({length(here.high - here.low), length(there.high - there.low), length(low)});
  const double unit = std::max({detail::ulp<D>(here.low), detail::ulp<D>(here.high),
                                detail::ulp<D>(there.low), detail::ulp<D>(there.high)});
  const double tolerance = std::max(rounding * size, rounding_ulps * unit);
  const double near = std::max(nearness * size, nearness_ulps * unit);
  if (!(length(high - low) <= tolerance))
    throw Error(Error_code::input,
                fmt::format("the two groups do not correspond: their extents are ({:.17g}) and ({:.17g})",
                            fmt::join(here.high - here.low, ", "), fmt::join(there.high - there.low, ", ")));
  const Vector<D> translation = 0.5 * (low + high);
  check_reaches<D>(snapshot_, locator_, from, to, translation, near);
  check_reaches<D>(snapshot_, locator_, to, from, -1.0 * translation, near);
  for (const auto& [walls, others, way] :
       {std::tuple(&from, &to, translation), std::tuple(&to, &from, -1.0 * translation)}) {
    for (const Half_facet wall : *walls) answer(wall, passages_.size());
    passages_.push_back({way, tolerance, cells_at<D>(snapshot_, *others)});
  }
  return translation;
}

template void Boundary_tracer<2>::answer(Half_facet, std::size_t);
template void Boundary_tracer<3>::answer(Half_facet, std::size_t);
template void Boundary_tracer<2>::reflect(std::span<const Half_facet>);
template void Boundary_tracer<3>::reflect(std::span<const Half_facet>);
template Vector<2> Boundary_tracer<2>::join(std::span<const Half_facet>, std::span<const Half_facet>);
template Vector<3> Boundary_tracer<3>::join(std::span<const Half_facet>, std::span<const Half_facet>);

}  // namespace cellwalk
