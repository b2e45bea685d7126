// SPDX-License-Identifier: GPL-3.0-or-later
// Rays from the triangles of a surface to both sides.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/meshing/repair_surface.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavity.h"
#include "meshing/fill/scale.h"

namespace cellwalk::detail {
namespace {

using K = Repair_kernel;
using Triangles = std::vector<K::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<K, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<K, Primitive>>;

constexpr std::size_t samples_of_surface = 2000, rays_of_seed = 200, most_seeds = 500;
/// A wall is thick if this part of the rays meets it again, this many times farther than it is thick.
constexpr double enough = 0.25, farther = 3;
/// Around a lumen, this part of the rays from its middle meets the wall. Measured: 0.86 to 1 for thick tubes,
/// 0.3 to 0.82 for channels that bend back and for plates that face each other.
constexpr double closed = 0.85;
/// Where two solids touch, there is no wall: from either side a ray meets the other one at once.
constexpr double no_wall = 1e-11;  // of the largest coordinate

double distance_along(const Tree& tree, const K::Ray_3& ray, const K::Triangle_3* own) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto hit = tree.first_intersection(ray, [own](const auto& id) { return &*id == own; });
  if (!hit) return never;
  // The place as that of the triangle's plane: enough for a comparison.
  const K::Plane_3 plane = hit->second->supporting_plane();
  const K::Vector_3 direction = ray.to_vector();
  const double along = plane.a() * direction.x() + plane.b() * direction.y() + plane.c() * direction.z();
  const double height =
      plane.a() * ray.source().x() + plane.b() * ray.source().y() + plane.c() * ray.source().z() + plane.d();
  return along == 0 ? never : std::abs(height / along) * std::sqrt(direction.squared_length());
}

}  // namespace

std::optional<Point<3>> find_lumen(const Facets& given) {
  // At a size near 1: CGAL multiplies many coordinates.
  Facets oriented = given;
  double largest = 0;
  for (const Point<3>& p : given.points)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (Point<3>& p : oriented.points) p = scaled(p, -exponent);
  Triangles triangles;
  std::vector<double> areas;
  double total = 0;
  std::vector<Vector<3>> normals;
  for (const Facet& f : oriented.facets) {
    if (f.part == Part::sheet) continue;
    triangles.emplace_back(to_cgal(oriented.corner(f, 0)), to_cgal(oriented.corner(f, 1)),
                           to_cgal(oriented.corner(f, 2)));
    areas.push_back(total += area(oriented, f));
    normals.push_back(normalized(area_vector(oriented, f), {}));
  }
  if (triangles.size() < 4) return {};
  const Tree tree(triangles.begin(), triangles.end());
  Random random(1);
  std::vector<std::pair<Point<3>, double>> seeds;  // and the distance from the surface
  std::size_t apart = 0;
  for (std::size_t i = 0; i < samples_of_surface; ++i) {
    const double at = (static_cast<double>(i) + random.real()) / samples_of_surface * total;
    const std::size_t f = std::min<std::size_t>(
        std::upper_bound(areas.begin(), areas.end(), at) - areas.begin(), triangles.size() - 1);
    if (normals[f] == Vector<3>{}) continue;
    double u = random.real(), v = random.real();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const K::Point_3 origin =
        triangles[f][0] + u * (triangles[f][1] - triangles[f][0]) + v * (triangles[f][2] - triangles[f][0]);
    const K::Vector_3 normal(normals[f][0], normals[f][1], normals[f][2]);
    const double inwards = distance_along(tree, K::Ray_3(origin, -normal), &triangles[f]);
    const double outwards = distance_along(tree, K::Ray_3(origin, normal), &triangles[f]);
    if (std::min(inwards, outwards) <= no_wall) continue;
    ++apart;
    if (!std::isfinite(outwards) || !(outwards > farther * inwards)) continue;
    const K::Point_3 middle = origin + 0.5 * outwards * normal;
    seeds.push_back({{middle.x(), middle.y(), middle.z()}, outwards / 2});
  }
  if (static_cast<double>(seeds.size()) <= enough * static_cast<double>(apart)) return {};
  // The seed that is surrounded the most; of equal ones, the farthest from the surface.
  if (seeds.size() > most_seeds) {
    random.shuffle(seeds);
    seeds.resize(most_seeds);
  }
  std::vector<Vector<3>> directions;
  while (directions.size() < rays_of_seed) {
    const Vector<3> d{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    if (const double l = length(d); l > 0.1 && l <= 1) directions.push_back((1 / l) * d);
  }
  std::size_t best_hits = 0;
  const std::pair<Point<3>, double>* best = nullptr;
  for (const auto& seed : seeds) {
    std::size_t hits = 0;
    for (const Vector<3>& d : directions)
      hits += tree.do_intersect(K::Ray_3(to_cgal(seed.first), K::Vector_3(d[0], d[1], d[2])));
    if (best == nullptr || hits > best_hits || (hits == best_hits && seed.second > best->second))
      best = &seed, best_hits = hits;
  }
  if (static_cast<double>(best_hits) < closed * rays_of_seed) return {};
  return scaled(best->first, exponent);
}

}  // namespace cellwalk::detail

std::optional<cellwalk::Point<3>> cellwalk::lumen_around(const Surface_soup& surface) {
  detail::Facets facets;
  facets.points = surface.points;
  for (const auto& f : surface.facets) facets.facets.push_back({{f[0], f[1], f[2]}});
  return detail::find_lumen(facets);
}
