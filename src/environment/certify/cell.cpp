// SPDX-License-Identifier: LGPL-3.0-or-later
// The geometry of one cell, by signs only. Proof that the conditions suffice: docs/certification.md.
#include <cellwalk/internal/environment/cell_check.h>

#include <algorithm>

#include "polygon.h"
#include "shape.h"

namespace cellwalk::detail {
namespace {

using Sides = boost::container::small_vector<signed char, 32>;

bool is_finite_cell(const auto& cell) {
  for (std::size_t v = 0; v < cell.vertex_count(); ++v)
    if (!is_finite(cell.point(v))) return false;
  return true;
}

Polygon<3> polygon_of(const Cell_view<3>& cell, std::size_t facet) {
  Polygon<3> polygon;
  for (const std::uint16_t v : cell.loop(facet)) polygon.push_back(cell.point(v));
  return polygon;
}

Cell_defect check_facet(Predicate_counts& counts, const Polygon<3>& polygon, Corners& corners) {
  const std::span<const Point<3>> points(polygon.data(), polygon.size());
  if (!find_corners(counts, points, corners)) return Cell_defect::degenerate_facet;
  if (points.size() == 3) return Cell_defect::none;
  if (!is_planar(counts, points, corners)) return Cell_defect::facet_not_planar;
  const Polygon<2> flat = drop(polygon, corners.axis);
  return convex_turn(counts, {flat.data(), flat.size()}) == 0 ? Cell_defect::facet_not_convex
                                                              : Cell_defect::none;
}

/// The side of every vertex of the cell: +1 strictly outside the facet, 0 on its plane. Vertices of the facet
/// are 0.
void sides_of_facet(Predicate_counts& counts, const Cell_view<3>& cell, std::size_t facet,
                    const Corners& corners, Sides& sides) {
  const auto loop = cell.loop(facet);
  const Point<3>&p = cell.point(loop[corners.at[0]]), &q = cell.point(loop[corners.at[1]]),
        &r = cell.point(loop[corners.at[2]]);
  constexpr signed char unknown = 2;
  sides.assign(cell.vertex_count(), unknown);
  for (const std::uint16_t v : loop) sides[v] = 0;
  for (std::size_t v = 0; v < sides.size(); ++v)
    if (sides[v] == unknown)
      sides[v] = static_cast<signed char>(Exact::orientation(counts, p, q, r, cell.point(v)));
}

/// The other facets with side 0 at all their vertices.
boost::container::small_vector<std::size_t, 8> coplanar_facets(const Cell_view<3>& cell, std::size_t facet,
                                                               const Sides& sides) {
  boost::container::small_vector<std::size_t, 8> found;
  for (std::size_t g = 0; g < cell.facet_count(); ++g) {
    const auto loop = cell.loop(g);
    if (g != facet && std::all_of(loop.begin(), loop.end(), [&](std::uint16_t v) { return sides[v] == 0; }))
      found.push_back(g);
  }
  return found;
}

/// True if a facet overlaps one of the facets in its plane.
/// \pre all of them are convex and have the same orientation
bool overlaps(Predicate_counts& counts, const Cell_view<3>& cell, std::size_t facet, const Corners& corners,
              std::span<const std::size_t> others) {
  const Polygon<2> own = drop(polygon_of(cell, facet), corners.axis);
  const std::span<const Point<2>> own_points(own.data(), own.size());
  const int sign = convex_turn(counts, own_points);
  return std::any_of(others.begin(), others.end(), [&](std::size_t g) {
    const Polygon<2> other = drop(polygon_of(cell, g), corners.axis);
    return !are_apart(counts, own_points, {other.data(), other.size()}, sign);
  });
}

/// \pre the shape is four triangles in a closed surface: either all face outwards, or all inwards
Cell_check check_tetrahedron(Predicate_counts& counts, const Cell_view<3>& cell) {
  const auto loop = cell.loop(0);
  const std::size_t apex = 6u - loop[0] - loop[1] - loop[2];
  const int side = Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]),
                                      cell.point(apex));
  if (side < 0) return {};
  if (side > 0) return {Cell_defect::inverted, 0};
  for (std::size_t f = 0; f < 4; ++f) {
    Corners corners;
    if (check_facet(counts, polygon_of(cell, f), corners) != Cell_defect::none)
      return {Cell_defect::degenerate_facet, f};
  }
  return {Cell_defect::flat, 0};
}

}  // namespace

template <>
Cell_check check_geometry<3>(const Cell_view<3>& cell) {
  if (!is_finite_cell(cell)) return {Cell_defect::not_finite, 0};
  Predicate_counts counts;
  const std::size_t facets = cell.facet_count();
  if (facets == 4 && cell.vertex_count() == 4) return check_tetrahedron(counts, cell);

  boost::container::small_vector<Corners, 12> corners(facets);
  std::size_t not_convex = facets;
  for (std::size_t f = 0; f < facets; ++f) {
    const Cell_defect defect = check_facet(counts, polygon_of(cell, f), corners[f]);
    if (defect == Cell_defect::facet_not_convex)
      not_convex = std::min(not_convex, f);  // reported only if all facets are planar
    else if (defect != Cell_defect::none)
      return {defect, f};
  }
  if (not_convex < facets) return {Cell_defect::facet_not_convex, not_convex};
  // A facet without another one in its plane covers a part of the hull once; then all of it is covered once.
  bool is_covered_once = false;
  std::size_t inward = 0, first_not_outward = facets;
  Sides sides;
  for (std::size_t f = 0; f < facets; ++f) {
    sides_of_facet(counts, cell, f, corners[f], sides);
    const bool has_outer = std::find(sides.begin(), sides.end(), 1) != sides.end();
    const bool has_inner = std::find(sides.begin(), sides.end(), -1) != sides.end();
    if (has_outer && has_inner) return {Cell_defect::not_convex, f};
    if (!has_outer && !has_inner) return {Cell_defect::flat, f};
    inward += has_outer;
    if (has_outer && first_not_outward == facets) first_not_outward = f;
    is_covered_once = is_covered_once || coplanar_facets(cell, f, sides).empty();
  }
  if (inward == facets) return {Cell_defect::inverted, 0};
  if (inward > 0) return {Cell_defect::not_convex, first_not_outward};
  if (is_covered_once) return {};
  sides_of_facet(counts, cell, 0, corners[0], sides);
  const auto others = coplanar_facets(cell, 0, sides);
  if (overlaps(counts, cell, 0, corners[0], {others.data(), others.size()})) return {Cell_defect::wound, 0};
  return {};
}

template <>
Cell_check check_geometry<2>(const Cell_view<2>& cell) {
  if (!is_finite_cell(cell)) return {Cell_defect::not_finite, 0};
  Predicate_counts counts;
  Polygon<2> polygon;
  const std::size_t n = cell.facet_count();
  for (std::size_t i = 0; i < n; ++i) polygon.push_back(cell.point(cell.loop(i)[0]));
  const int turning = convex_turn(counts, {polygon.data(), n});
  if (turning > 0) return {};
  if (turning < 0) return {Cell_defect::inverted, 0};

  // Not convex: find the facet and the defect.
  bool has_left = false;
  std::size_t right = n;
  for (std::size_t i = 0; i < n; ++i) {
    const Point<2>&a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    if (a == b) return {Cell_defect::degenerate_facet, i};
    const int side = Exact::orientation(counts, a, b, c);
    has_left |= side > 0;
    if (side < 0) right = std::min(right, i);
  }
  if (right < n) return {Cell_defect::not_convex, right};
  return {has_left ? Cell_defect::wound : Cell_defect::flat, 0};
}

}  // namespace cellwalk::detail
