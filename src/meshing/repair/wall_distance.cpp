// SPDX-License-Identifier: GPL-3.0-or-later
// Corners and samples of walls, and the nearest triangle to each.
#include "wall_distance.h"

#include <cellwalk/internal/kernel/random.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <cmath>
#include <cstdint>

namespace cellwalk::detail {
namespace {

using K = Repair_kernel;
using Triangles = std::vector<K::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<K, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<K, Primitive>>;

constexpr std::size_t samples = 60000;

}  // namespace

Wall_distance distance_of_walls(const std::vector<Point<3>>& points, std::span<const Facet> walls,
                                const Facets& surface) {
  Triangles triangles;
  for (const Facet& f : surface.facets)
    triangles.emplace_back(to_cgal(surface.corner(f, 0)), to_cgal(surface.corner(f, 1)),
                           to_cgal(surface.corner(f, 2)));
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  Wall_distance result;
  const auto project = K().construct_projected_point_3_object();
  auto nearest = triangles.cbegin();
  const auto visit = [&](const Point<3>& p) {
    const K::Point_3 place = to_cgal(p);
    // Mostly the triangle that was nearest to the place before is near enough.
    if (std::sqrt(CGAL::squared_distance(place, project(*nearest, place))) <= result.most) return;
    const auto [closest, triangle] = tree.closest_point_and_primitive(place);
    nearest = triangle;
    const double distance = std::sqrt(CGAL::squared_distance(place, closest));
    if (distance > result.most) result = {distance, p};
  };
  std::vector<bool> is_seen(points.size(), false);
  std::vector<const Facet*> own;
  for (const Facet& f : walls)
    if (f.part == Part::surface || f.part == Part::sheet) own.push_back(&f);
  for (const Facet* f : own)
    for (const std::uint32_t v : f->corners)
      if (!is_seen[v]) {
        is_seen[v] = true;
        visit(points[v]);
      }
  Random random(1);
  for (std::size_t i = 0; i < samples && !own.empty(); ++i) {
    const Triangle& t = own[i * own.size() / samples]->corners;
    double u = random.real(), v = random.real();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    visit(points[t[0]] + u * (points[t[1]] - points[t[0]]) + v * (points[t[2]] - points[t[0]]));
  }
  return result;
}

}  // namespace cellwalk::detail
