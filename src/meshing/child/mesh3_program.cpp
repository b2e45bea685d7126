// SPDX-License-Identifier: GPL-3.0-or-later
// The program cellwalk-mesh3, which runs CGAL's Mesh_3. Its options are the bounds of Mesh_criteria_3, in
// hexadecimal: facet angle, facet size, facet distance, radius to edge, cell size.
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>
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
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <string>

#include "meshing/child/helper.h"

namespace {

using namespace cellwalk::detail;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface_mesh = CGAL::Surface_mesh<Kernel::Point_3>;
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

Criteria criteria(std::span<char* const> options) {
  constexpr std::size_t bounds = 5;
  if (options.size() != bounds) end_helper(cut_short);
  const auto bound = [&](std::size_t i) { return std::strtod(options[i], nullptr); };
  namespace P = CGAL::parameters;
  return Criteria(P::facet_angle = bound(0), P::facet_size = bound(1), P::facet_distance = bound(2),
                  P::cell_radius_edge_ratio = bound(3), P::cell_size = bound(4));
}

Surface_mesh mesh_of(const Mesher_input& input) {
  Surface_mesh mesh;
  for (const auto& p : input.points) mesh.add_vertex({p[0], p[1], p[2]});
  const auto vertex = [](std::int32_t v) {
    return Surface_mesh::Vertex_index(static_cast<std::uint32_t>(v));
  };
  for (const auto& t : input.triangles) mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return mesh;
}

void collect(const Complex& complex, Mesher_output& output) {
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<std::int32_t, 4> t;
    for (int i = 0; i < 4; ++i) {
      const auto [it, is_new] =
          number.insert({cell->vertex(i), static_cast<std::int32_t>(output.points.size())});
      t[static_cast<std::size_t>(i)] = it->second;
      const auto& p = cell->vertex(i)->point();
      if (is_new) output.points.push_back({p.x(), p.y(), p.z()});
    }
    output.tetrahedra.push_back(t);
  }
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

/// The largest distances from the boundary of the mesh to the surfaces, and from these to the former.
void measure(const Triangles& boundary, const Mesher_input& input, Mesher_output& output) {
  const auto at = [&input](auto v) {
    const auto& p = input.points[static_cast<std::size_t>(v)];
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  Triangles surface;
  for (const auto& t : input.triangles) surface.emplace_back(at(t[0]), at(t[1]), at(t[2]));
  const Triangle_tree surface_tree(surface.begin(), surface.end()), tree(boundary.begin(), boundary.end());
  double to_surface = 0, from_surface = 0;  // squared
  for (const Triangle_3& t : boundary)
    for (int i = 0; i < 3; ++i)
      for (const auto& p : {t[i], CGAL::midpoint(t[i], t[(i + 1) % 3]), CGAL::centroid(t)})
        to_surface = std::max(to_surface, surface_tree.squared_distance(p));
  for (std::size_t v = 0; v < input.points.size(); ++v)
    from_surface = std::max(from_surface, tree.squared_distance(at(v)));
  output.measures = {static_cast<double>(boundary.size()), std::sqrt(to_surface), std::sqrt(from_surface)};
}

Mesher_output run(std::span<char* const> options, const Mesher_input& input) {
  const Criteria bounds = criteria(options);
  Surface_mesh mesh = mesh_of(input);
  // Mesh_3 uses the random generator of the domain and the thread's default one.
  CGAL::Random random(0);
  CGAL::get_default_random() = CGAL::Random(0);
  const Domain domain(mesh, &random);
  // Without perturber and exuder, whose order of work depends on addresses, so that the mesh would change
  // from run to run. They remove slivers, which do not affect a walk.
  namespace P = CGAL::parameters;
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, bounds, P::no_perturb(), P::no_exude());
  Mesher_output output;
  collect(complex, output);
  if (!output.tetrahedra.empty()) measure(boundary(complex), input, output);
  return output;
}

}  // namespace

int main(int argc, char** argv) {
  Mesher_input input;
  const auto options = begin_helper(argc, argv, input);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
  // CGAL prints much, too, of which only the exception matters.
  for (std::ostream* const stream : {&std::cerr, &std::clog}) stream->setstate(std::ios_base::failbit);
  try {
    end_with(run(options, input));
  } catch (const CGAL::Failure_exception& failure) {
    const bool has_message = !failure.message().empty();
    std::fprintf(stderr, "%s\n", (has_message ? failure.message() : failure.expression()).c_str());
  } catch (const std::bad_alloc&) {
    end_helper(out_of_memory);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
  }
  std::fflush(stderr);
  end_helper(mesher_failed);
}
