// SPDX-License-Identifier: LGPL-3.0-or-later
// The overlap of two facets in a plane, decided by their projections.
#include "boundary_facet.h"

#include <algorithm>

#include "polygon.h"

namespace cellwalk::detail {
namespace {

Polygon<2> flat_loop(std::span<const Point<3>> points, const Facet_loop& loop, int axis) {
  Polygon<2> polygon;
  for (const std::uint32_t v : loop) polygon.push_back(drop(points[v], axis));
  return polygon;
}

}  // namespace

template <int D>
bool lies_in_plane(Predicate_counts& counts, std::span<const Point<D>> points, const Boundary_facet<D>& facet,
                   const Facet_loop& loop) {
  return std::all_of(loop.begin(), loop.end(),
                     [&](std::uint32_t v) { return side<D>(counts, points, facet.plane, v) == 0; });
}

template <>
bool overlap_in_plane<2>(Predicate_counts&, std::span<const Point<2>> points, const Boundary_facet<2>& facet,
                         const Facet_loop& loop, bool) {
  const auto [a, b] = std::minmax(points[facet.loop[0]], points[facet.loop[1]]);
  const auto [c, d] = std::minmax(points[loop[0]], points[loop[1]]);
  return a < d && c < b;
}

template <>
bool overlap_in_plane<3>(Predicate_counts& counts, std::span<const Point<3>> points,
                         const Boundary_facet<3>& facet, const Facet_loop& loop, bool is_opposite) {
  const auto& [p, q, r] = facet.plane;
  const int axis = projection_axis(counts, points[p], points[q], points[r]);
  const int sign = turn(counts, points[p], points[q], points[r], axis);
  const Polygon<2> own = flat_loop(points, facet.loop, axis);
  Polygon<2> other = flat_loop(points, loop, axis);
  if (is_opposite) std::reverse(other.begin(), other.end());
  return !are_apart(counts, {own.data(), own.size()}, {other.data(), other.size()}, sign);
}

template bool lies_in_plane(Predicate_counts&, std::span<const Point<2>>, const Boundary_facet<2>&,
                            const Facet_loop&);
template bool lies_in_plane(Predicate_counts&, std::span<const Point<3>>, const Boundary_facet<3>&,
                            const Facet_loop&);

}  // namespace cellwalk::detail
