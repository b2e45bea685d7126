// SPDX-License-Identifier: LGPL-3.0-or-later
// Pairs of facets with opposite normals from a grid of boxes, and the width of their common part.
#include "facing.h"

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "environment/soup/parallel.h"

namespace cellwalk::detail {
namespace {

/// Of the diagonal: gaps of meshes whose points were rounded or written with few digits. It counts, and
/// decides nothing.
constexpr double near_share = 1e-9;
/// Of the largest coordinate: the error of a few roundings, where that is larger.
constexpr double rounding_share = 0x1p-49;
/// Facets are near within this share of the smaller one at most, so that not many are near one, however large
/// the tolerance is.
constexpr double largest_gap_share = 0x1p-6;
/// Facets face each other if the cosine of their normals is below this.
constexpr double facing_cosine = -0.5;

Vector<2> outer_normal(std::span<const Point<2>> points, const Plane_points<2>& plane) {
  return unit_normal(points[plane[1]], points[plane[0]]);
}

Vector<3> outer_normal(std::span<const Point<3>> points, const Plane_points<3>& plane) {
  return unit_normal(points[plane[0]], points[plane[1]], points[plane[2]]);
}

template <int D>
Box<D> box_of_loop(const Snapshot<D>& snapshot, const Facet_loop& loop) {
  Box<D> box;
  for (const std::uint32_t v : loop) box.extend(snapshot.point(v));
  return box;
}

template <int D>
double longest_side(const Box<D>& box) {
  const Vector<D> sides = box.high - box.low;
  return *std::max_element(sides.begin(), sides.end());
}

/// The part of a convex polygon at which a linear function is at least 0.
template <int D>
std::vector<Vector<D>> cut_off(const std::vector<Vector<D>>& polygon, const Vector<D>& inwards,
                               const Vector<D>& from) {
  std::vector<Vector<D>> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = dot(inwards, p - from), at_q = dot(inwards, q - from);
    if (at_p >= 0) rest.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      rest.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
  return rest;
}

/// True if a convex polygon (2D: a segment, twice) is wider than a length.
template <int D>
bool is_wider(const std::vector<Vector<D>>& polygon, double width) {
  double perimeter = 0;
  Vector<3> doubled_area{};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    perimeter += length(q - p);
    if constexpr (D == 3) doubled_area = doubled_area + cross(p - polygon[0], q - polygon[0]);
  }
  // The area is at most the perimeter times the radius of the largest circle inside.
  return D == 2 ? perimeter > 4 * width : length(doubled_area) > 2 * width * perimeter;
}

}  // namespace

template <int D>
Facing_search<D>::Facing_search(const Snapshot<D>& snapshot, std::span<const Boundary_facet<D>> facets)
    : snapshot_(snapshot), facets_(facets), normals_(facets.size()) {
  const auto points = snapshot.points();
  for_each_parallel(facets.size(),
                    [&](std::size_t i) { normals_[i] = outer_normal(points, facets[i].plane); });
  Box<D> box;
  for (const Boundary_facet<D>& facet : facets)
    for (const std::uint32_t v : facet.loop) box.extend(points[v]);
  double largest = 0;
  for (std::size_t k = 0; k < D; ++k)
    largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
  tolerance_ = std::max(near_share * length(box.high - box.low), rounding_share * largest);
  if (!std::isfinite(tolerance_)) tolerance_ = 0;
}

template <int D>
double Facing_search<D>::largest_gap(const Box<D>& box) const {
  return std::min(tolerance_, largest_gap_share * longest_side(box));
}

template <int D>
Box<D> Facing_search<D>::enlarged(const Box<D>& cell) const {
  const Vector<D> margin = with_all_coordinates<D>(largest_gap(cell));
  return {cell.low - margin, cell.high + margin};
}

template <int D>
typename Facing_search<D>::Common_part Facing_search<D>::common_part(std::uint32_t f, std::uint32_t g) const {
  const Facet_loop& loop = facets_[f].loop;
  const double size = longest_side(box_of_loop<D>(snapshot_, loop));
  Common_part part{{}, size > 0 && std::isfinite(size) ? std::ilogb(size) : 0};
  const auto at = [&](std::uint32_t v) {
    Vector<D> x = snapshot_.point(v) - snapshot_.point(loop[0]);
    for (double& coordinate : x) coordinate = std::scalbn(coordinate, -part.exponent);
    return x;
  };
  for (const std::uint32_t v : facets_[g].loop) part.corners.push_back(at(v));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector<D> p = at(loop[i]), q = at(loop[(i + 1) % loop.size()]);
    if constexpr (D == 2)
      part.corners = cut_off<2>(part.corners, q - p, p);
    else
      part.corners = cut_off<3>(part.corners, cross(normals_[f], q - p), p);
  }
  double gap = 0;
  for (const Vector<D>& x : part.corners) gap = std::max(gap, std::abs(dot(normals_[f], x)));
  part.gap = std::scalbn(gap, part.exponent);
  return part;
}

template <int D>
bool Facing_search<D>::is_near(std::uint32_t f, std::uint32_t g) const {
  const Box<D> own = box_of_loop<D>(snapshot_, facets_[f].loop),
               other = box_of_loop<D>(snapshot_, facets_[g].loop);
  const double within = std::min(largest_gap(own), largest_gap(other));
  if (!enlarged(own).meets(other)) return false;
  // Most are seen to be apart by the heights of the corners above the plane.
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const std::uint32_t v : facets_[g].loop) {
    const double height = dot(normals_[f], snapshot_.point(v) - snapshot_.point(facets_[f].loop[0]));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (lowest > within || highest < -within) return false;
  const Common_part part = common_part(f, g);
  return part.gap <= within && is_wider<D>(part.corners, std::scalbn(within, -part.exponent));
}

template <int D>
void Facing_search<D>::add(Pairs& pairs, std::uint32_t f, std::uint32_t g) {
  const auto index_of = [&](std::uint32_t i) { return snapshot_.index(snapshot_.cell_of(facets_[i].facet)); };
  const Key key{index_of(f), index_of(g), f, g};
  const std::lock_guard lock(mutex_);
  if (pairs.count++ == 0 || key < pairs.first) pairs.first = key;
}

template <int D>
void Facing_search<D>::compare(std::span<const std::uint32_t> own, std::span<const Facing_candidate> others) {
  if (own.empty()) return;
  const Cell c = snapshot_.cell_of(facets_[own[0]].facet);
  if (snapshot_.is_solid(c)) return;
  Predicate_counts counts;
  const auto points = snapshot_.points();
  for (const auto& [i, is_in_contact] : others) {
    const Boundary_facet<D>& f = facets_[i];
    const Cell d = snapshot_.cell_of(f.facet);
    if (snapshot_.is_solid(d) || snapshot_.index(d) > snapshot_.index(c)) continue;
    for (const std::uint32_t j : own) {
      const Boundary_facet<D>& g = facets_[j];
      if (is_in_contact && lies_in_plane<D>(counts, points, f, g.loop) &&
          overlap_in_plane<D>(counts, points, f, g.loop, true))
        add(overlapping_, i, j);
      else if (dot(normals_[i], normals_[j]) < facing_cosine && is_near(i, j))
        add(near_, i, j);
    }
  }
}

template <int D>
Facing_facets Facing_search<D>::described(const Pairs& pairs) const {
  Facing_facets result;
  result.pairs = pairs.count;
  if (pairs.count == 0) return result;
  result.cells = {pairs.first[0], pairs.first[1]};
  const Common_part part = common_part(pairs.first[2], pairs.first[3]);
  const Point<D>& vertex = snapshot_.point(facets_[pairs.first[2]].loop[0]);
  Vector<D> centre{};
  for (const Vector<D>& x : part.corners)
    centre = centre + (1 / static_cast<double>(part.corners.size())) * x;
  for (std::size_t k = 0; k < D; ++k)
    result.place.push_back(vertex[k] + std::scalbn(centre[k], part.exponent));
  result.distance = part.gap;
  return result;
}

template <int D>
Facing_walls Facing_search<D>::result() const {
  return {described(overlapping_), described(near_), tolerance_};
}

template class Facing_search<2>;
template class Facing_search<3>;

}  // namespace cellwalk::detail
