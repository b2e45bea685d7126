// SPDX-License-Identifier: LGPL-3.0-or-later
#include "midpoints.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace cellwalk::track_lengths {
namespace {

using Doubles = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Doubles::Triangle_3>;
using Primitive =
#if CGAL_VERSION_MAJOR >= 6
    CGAL::AABB_triangle_primitive_3<Doubles, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Doubles, Primitive>>;
#else
    CGAL::AABB_triangle_primitive<Doubles, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Doubles, Primitive>>;
#endif

Doubles::Point_3 point(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// Where a ray meets the plane of a triangle, as a share of the ray.
double share(const Doubles::Triangle_3& triangle, const Doubles::Point_3& from,
             const Doubles::Vector_3& ray) {
  const Doubles::Vector_3 normal =
      CGAL::cross_product(triangle.vertex(1) - triangle.vertex(0), triangle.vertex(2) - triangle.vertex(0));
  return normal * (triangle.vertex(0) - from) / (normal * ray);
}

}  // namespace

struct Midpoints::Facets {
  Triangles triangles;
  Tree tree;
};

Midpoints::Midpoints(const World& world) : world_(world), facets_(std::make_unique<Facets>()) {
  const Snapshot<3>& snapshot = world.snapshot();
  for (std::size_t index = 0; index < snapshot.cell_count(); ++index)
    for (std::size_t i = 0; i < 4; ++i) {
      const Cell cell = snapshot.cell(index);
      const Half_facet f = Snapshot<3>::half_facet(cell, i);
      const Cell neighbour = snapshot.neighbour(f);
      if (neighbour != Cell::none && to_index(neighbour) < to_index(cell)) continue;
      const std::vector<std::uint32_t> v = snapshot.loop(f);
      facets_->triangles.emplace_back(point(snapshot.point(v[0])), point(snapshot.point(v[1])),
                                      point(snapshot.point(v[2])));
    }
  facets_->tree.insert(facets_->triangles.cbegin(), facets_->triangles.cend());
  facets_->tree.build();
}

Midpoints::~Midpoints() = default;

void Midpoints::run(const Rays& rays, Peer_rows& rows) const {
  Peer_rows::List& list = rows.lists[0];
  list.cells.clear();
  list.lengths.clear();
  rows.rows.clear();
  std::vector<Primitive::Id> met;
  std::vector<double> shares;
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    const Point<3>&a = rays.starts[ray].position, &b = rays.targets[ray];
    const Doubles::Point_3 from = point(a), to = point(b);
    const Doubles::Vector_3 along = to - from;
    const double length = std::sqrt(along.squared_length());
    met.clear();
    shares.clear();
    facets_->tree.all_intersected_primitives(Doubles::Segment_3(from, to), std::back_inserter(met));
    for (const Primitive::Id& id : met) {
      const double at = share(*id, from, along);
      if (std::isfinite(at)) shares.push_back(at);  // a plane that holds the ray gives no number
    }
    shares.push_back(1);
    std::ranges::sort(shares);
    const std::size_t begin = list.cells.size();
    auto how = Peer_row::arrived;
    double last = 0;
    for (const double next : shares) {
      if (next <= last || next > 1) continue;
      const double middle = (last + next) / 2;
      const std::optional<Particle<3>> particle = world_.locator.particle_at(
          {a[0] + middle * along.x(), a[1] + middle * along.y(), a[2] + middle * along.z()});
      if (!particle) {
        how = Peer_row::left;
        break;
      }
      list.cells.push_back(to_index(particle->cell));
      list.lengths.push_back((next - last) * length);
      last = next;
    }
    rows.rows.push_back({how, 0, begin, list.cells.size()});
  }
}

}  // namespace cellwalk::track_lengths
