// SPDX-License-Identifier: GPL-3.0-or-later
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/meshing/mesh3.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/version.h>
#include <fmt/format.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "sizes.h"
#include "surface_mesh.h"

namespace cellwalk {
namespace {

using detail::Surface_mesh;
using Kernel = detail::Mesh_kernel;
using Domain = CGAL::Polyhedral_mesh_domain_3<Surface_mesh, Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Triangle_3 = Kernel::Triangle_3;
using Triangles = std::vector<Triangle_3>;
#if CGAL_VERSION_MAJOR >= 6
using Triangle_traits =
    CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
using Triangle_traits =
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif
using Triangle_tree = CGAL::AABB_tree<Triangle_traits>;

/// The largest number of cells or facets: more take an hour, and some tens of gigabytes.
constexpr double most_elements = 1e8;
/// The least distance, as a fraction of the diagonal. Near edges of the surface, facets are about as small as
/// the distance: a million in a row.
constexpr double least_distance = 0x1p-20;

/// The region to be filled, and its boundary.
struct Extent {
  double diagonal = 0, volume = 0, area = 0;
};

/// Refuses sizes at which meshing would not end.
void check_sizes(const Mesh3_options& options, double cell, double facet, const Extent& extent) {
  constexpr const char* mesher = "Mesh_3";
  constexpr double triangle = 1.2991;  // the area of the largest in a circle of radius 1: 3 sqrt(3)/4
  detail::check_cell_size(mesher, cell, extent.volume, most_elements);
  detail::check_least(mesher, "facet size", facet, std::sqrt(extent.area / (triangle * most_elements)),
                      fmt::format("with an area of {:g}", extent.area));
  if (options.facet_distance > 0)
    detail::check_least(mesher, "distance", options.facet_distance, least_distance * extent.diagonal,
                        fmt::format("of diagonal {:g}", extent.diagonal));
}

Criteria criteria(const Mesh3_options& options, const Extent& extent) {
  // NaN fails every comparison.
  if (!(options.cell_size >= 0 && options.facet_size >= 0 && options.facet_distance >= 0))
    throw Error(Error_code::usage, "Mesh_3: sizes and distances must not be negative");
  if (!(options.facet_angle >= 0 && options.facet_angle <= 30))
    throw Error(Error_code::usage,
                "Mesh_3: the facet angle must lie in [0,30] degrees; above, meshing may not end");
  if (!(options.radius_edge >= 2))
    throw Error(Error_code::usage,
                "Mesh_3: the radius-edge bound must be at least 2; below, meshing may not end");
  const double cell = options.cell_size > 0 ? options.cell_size : extent.diagonal / 20;
  const double facet = options.facet_size > 0 ? options.facet_size : cell;
  const double distance = options.facet_distance > 0 ? options.facet_distance : facet / 50;
  check_sizes(options, cell, facet, extent);
  namespace P = CGAL::parameters;
  return Criteria(P::facet_angle = options.facet_angle, P::facet_size = facet, P::facet_distance = distance,
                  P::cell_radius_edge_ratio = options.radius_edge, P::cell_size = cell);
}

Extent extent_of(const std::vector<Surface_soup>& surfaces, const Mesh3_report& report) {
  Extent extent;
  Point<3> low = surfaces[0].points[0], high = low;
  for (const auto& p : surfaces[0].points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  extent.diagonal = length(high - low);
  extent.volume = detail::free_volume(report.surface, report.obstacles);
  for (const Surface_soup& s : surfaces)
    for (const auto& f : s.facets)
      extent.area += length(cross(s.points[f[1]] - s.points[f[0]], s.points[f[2]] - s.points[f[0]])) / 2;
  return extent;
}

Cell_soup<3> collect(const Complex& complex) {
  Cell_soup<3> soup;
  std::map<Triangulation::Vertex_handle, std::uint32_t> number;
  Predicate_counts counts;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<std::uint32_t, 4> t;
    for (int i = 0; i < 4; ++i) {
      const auto [it, is_new] =
          number.insert({cell->vertex(i), static_cast<std::uint32_t>(soup.points.size())});
      t[i] = it->second;
      const auto& p = cell->vertex(i)->point();
      if (is_new) soup.points.push_back({p.x(), p.y(), p.z()});
    }
    const auto& p = soup.points;
    if (Exact::orientation(counts, p[t[0]], p[t[1]], p[t[2]], p[t[3]]) <= 0)
      throw Error(Error_code::not_certified, "Mesh_3 made a flat tetrahedron; change the cell size a little");
    add_tetrahedron(soup, t[0], t[1], t[2], t[3]);
  }
  if (soup.cell_count() == 0)
    throw Error(Error_code::not_certified,
                "Mesh_3 made no tetrahedron; give a smaller cell size and facet size");
  return soup;
}

/// The boundary of the mesh.
Triangles boundary(const Complex& complex) {
  Triangles triangles;
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f) {
    std::array<Kernel::Point_3, 3> p;
    for (int i = 0; i < 3; ++i) {
      const auto& w = f->first->vertex((f->second + 1 + i) & 3)->point();
      p[i] = {w.x(), w.y(), w.z()};
    }
    triangles.emplace_back(p[0], p[1], p[2]);
  }
  return triangles;
}

void measure(const Triangles& mesh, const std::vector<Surface_soup>& surfaces, Mesh3_report& report) {
  Triangles input;
  const auto at = [](const Point<3>& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  for (const auto& s : surfaces)
    for (const auto& f : s.facets)
      input.emplace_back(at(s.points[f[0]]), at(s.points[f[1]]), at(s.points[f[2]]));
  const Triangle_tree input_tree(input.begin(), input.end()), mesh_tree(mesh.begin(), mesh.end());
  double to_surface = 0, from_surface = 0;  // squared
  for (const Triangle_3& t : mesh)
    for (int i = 0; i < 3; ++i)
      for (const auto& p : {t[i], CGAL::midpoint(t[i], t[(i + 1) % 3]), CGAL::centroid(t)})
        to_surface = std::max(to_surface, input_tree.squared_distance(p));
  for (const auto& s : surfaces)
    for (const auto& p : s.points) from_surface = std::max(from_surface, mesh_tree.squared_distance(at(p)));
  report.distance_to_surface = std::sqrt(to_surface);
  report.distance_from_surface = std::sqrt(from_surface);
}

}  // namespace

Cell_soup<3> mesh3(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                   const Mesh3_options& options, Mesh3_report* report) {
  Mesh3_report own;
  Mesh3_report& r = report ? *report : own;
  r = {};
  const auto surfaces =
      detail::check_apart(surface, obstacles, options.obstacle_names, r.surface, r.obstacles);
  const Criteria bounds = criteria(options, extent_of(surfaces, r));
  // A point is inside if a ray from it crosses the surfaces an odd number of times, so obstacles are omitted.
  Surface_mesh mesh;
  for (const auto& s : surfaces) detail::append(mesh, s);
  // Mesh_3 uses the random generator of the domain and the thread's default one.
  CGAL::Random random(0);
  CGAL::get_default_random() = CGAL::Random(0);
  const Domain domain(mesh, &random);
  // Without perturber and exuder, whose order of work depends on addresses, so that the mesh would change
  // from run to run. They remove slivers, which do not affect a walk.
  namespace P = CGAL::parameters;
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, bounds, P::no_perturb(), P::no_exude());
  Cell_soup<3> soup = collect(complex);
  const Triangles triangles = boundary(complex);
  r.boundary_facets = triangles.size();
  measure(triangles, surfaces, r);
  return soup;
}

}  // namespace cellwalk
