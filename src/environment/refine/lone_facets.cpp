// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets without an opposite, found by their boxes.
#include "lone_facets.h"

#include <cellwalk/internal/environment/box_grid.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <limits>

#include "environment/certify/common_part.h"
#include "environment/certify/polygon.h"
#include "environment/soup/parallel.h"

namespace cellwalk::detail {
namespace {

/// Normal and plane of an edge. The outer side is on its right.
void find_plane(std::span<const Point<2>> points, Lone_facet<2>& facet) {
  const std::uint32_t a = facet.loop[0], b = facet.loop[1];
  facet.is_sound = points[a] != points[b];
  facet.plane = {a, b};
  facet.normal = unit_normal(points[b], points[a]);
}

/// Normal and plane of a polygon. One that is not planar gets the normal of its area.
void find_plane(std::span<const Point<3>> points, Lone_facet<3>& facet) {
  Predicate_counts counts;
  Polygon<3> polygon;
  for (const std::uint32_t v : facet.loop) polygon.push_back(points[v]);
  const std::span<const Point<3>> corners_of(polygon.data(), polygon.size());
  Corners corners;
  facet.is_sound = false;
  if (find_corners(counts, corners_of, corners) && is_planar(counts, corners_of, corners)) {
    const Polygon<2> flat = drop(polygon, corners.axis);
    facet.is_sound = convex_turn(counts, {flat.data(), flat.size()}) != 0;
    const auto [i, j, k] = corners.at;
    facet.plane = {facet.loop[i], facet.loop[j], facet.loop[k]};
    facet.normal = unit_normal(polygon[i], polygon[j], polygon[k]);
    return;
  }
  Vector<3> area{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area = area + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  facet.normal = normalized(area, {});
}

template <int D>
bool is_touching(std::span<const Point<D>> points, const Lone_facet<D>& f, const Lone_facet<D>& g) {
  if (!f.is_sound || !g.is_sound || !f.box.meets(g.box)) return false;
  Predicate_counts counts;
  const Boundary_facet<D> facet{Half_facet::none, f.plane, f.loop};
  return lies_in_plane<D>(counts, points, facet, g.loop) &&
         overlap_in_plane<D>(counts, points, facet, g.loop, true);
}

}  // namespace

template <int D>
std::vector<Lone_facet<D>> lone_facets(const Cell_soup<D>& soup, const Gluing& gluing) {
  std::vector<Lone_facet<D>> facets;
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      if (gluing.opposite[f] == no_facet) {
        const auto loop = soup.facet(f);
        facets.push_back({f, c, soup.solid[c] != 0, false, {}, {loop.begin(), loop.end()}, {}, {}});
      }
  for_each_parallel(facets.size(), [&](std::size_t i) {
    for (const std::uint32_t v : facets[i].loop) facets[i].box.extend(soup.points[v]);
    find_plane(soup.points, facets[i]);
  });
  return facets;
}

template <int D>
Facing_pairs facing_pairs(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                          double tolerance, bool is_exact) {
  Facing_pairs pairs;
  Box_grid<D> grid;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    const Lone_facet<D>& f = facets[i];
    if (is_exact && f.is_solid) continue;
    const Vector<D> margin = with_all_coordinates<D>(largest_gap<D>(f.box, tolerance));
    found.clear();
    grid.find({f.box.low - margin, f.box.high + margin}, found);
    grid.set(i, f.box);
    for (const std::uint32_t j : found) {
      const Lone_facet<D>& g = facets[j];
      if (f.cell == g.cell || !(dot(f.normal, g.normal) < facing_cosine)) continue;
      if (is_exact && is_touching<D>(points, g, f))
        pairs.touching.push_back({j, i});
      else if (is_near<D>(points, g.loop, g.normal, f.loop, tolerance))
        pairs.near.push_back({j, i});
    }
  }
  std::sort(pairs.touching.begin(), pairs.touching.end());
  std::sort(pairs.near.begin(), pairs.near.end());
  return pairs;
}

template <int D>
Facing_facets described(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                        std::span<const Facet_pair> pairs) {
  Facing_facets result;
  result.pairs = pairs.size();
  if (pairs.empty()) return result;
  const Lone_facet<D>&f = facets[pairs.front()[0]], &g = facets[pairs.front()[1]];
  result.cells = {f.cell, g.cell};
  const Common_part<D> part = common_part<D>(points, f.loop, f.normal, g.loop);
  result.place = centre_of<D>(part, points[f.loop[0]]);
  result.distance = part.gap;
  return result;
}

template std::vector<Lone_facet<2>> lone_facets(const Cell_soup<2>&, const Gluing&);
template std::vector<Lone_facet<3>> lone_facets(const Cell_soup<3>&, const Gluing&);
template Facing_pairs facing_pairs<2>(std::span<const Point<2>>, std::span<const Lone_facet<2>>, double,
                                      bool);
template Facing_pairs facing_pairs<3>(std::span<const Point<3>>, std::span<const Lone_facet<3>>, double,
                                      bool);
template Facing_facets described<2>(std::span<const Point<2>>, std::span<const Lone_facet<2>>,
                                    std::span<const Facet_pair>);
template Facing_facets described<3>(std::span<const Point<3>>, std::span<const Lone_facet<3>>,
                                    std::span<const Facet_pair>);

}  // namespace cellwalk::detail
