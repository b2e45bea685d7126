// SPDX-License-Identifier: GPL-3.0-or-later
// The tetrahedra inside the surfaces, collected as a soup with walls.
#include <cellwalk/meshing/tetrahedralize.h>

#include <algorithm>
#include <array>

#include "sizes.h"
#include "surface_mesh.h"
#include "tetgen_bounds.h"
#include "tetgen_call.h"
#include "tetgen_sides.h"

namespace cellwalk {
namespace {

using detail::Owners;
using detail::Sides;
using detail::Tetgen_result;
using detail::Triangle;

/// The tetrahedra inside, with the surfaces as walls.
Cell_soup<3> collect(const Tetgen_result& mesh, const Owners& owners, std::size_t surfaces,
                     const Tetrahedralize_options& options, Tetrahedralize_report& report) {
  const Sides sides(mesh, owners, surfaces);
  Cell_soup<3> soup;
  std::vector<std::uint32_t> number(mesh.points.size(), 0xffffffffu);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const auto& s = sides[i];
    if (!s[0]) continue;
    const bool in_obstacle = std::count(s.begin() + 1, s.end(), true) > 0;
    if (in_obstacle && !options.keep_obstacles) continue;
    const auto t = detail::positive(mesh, mesh.tetrahedra[i]);
    for (std::uint32_t v : t)
      if (number[v] == 0xffffffffu) {
        number[v] = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back(mesh.points[v]);
      }
    // The facets in the order of add_tetrahedron(), each with its wall.
    for (const Triangle& f : {Triangle{t[0], t[2], t[1]}, Triangle{t[0], t[1], t[3]},
                              Triangle{t[1], t[2], t[3]}, Triangle{t[2], t[0], t[3]}}) {
      const bool wall = owners.contains(detail::sorted(f));
      report.boundary_facets += wall && !in_obstacle;
      soup.add_facet({number[f[0]], number[f[1]], number[f[2]]}, wall || in_obstacle);
    }
    soup.end_cell(in_obstacle);
    report.solid_cells += in_obstacle;
    report.out_of_bounds += detail::is_out_of_bounds(mesh, t, options);
  }
  return soup;
}

}  // namespace

Cell_soup<3> tetrahedralize(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                            const Tetrahedralize_options& options, Tetrahedralize_report* report) {
  detail::check_bounds(options);
  Tetrahedralize_report own;
  Tetrahedralize_report& r = report ? *report : own;
  r = {};
  const detail::Checked_surfaces checked =
      detail::check_apart(surface, obstacles, options.obstacle_names, r.surface, r.obstacles);
  const std::vector<Surface_soup>& surfaces = checked.soups;
  if (options.cell_size > 0) detail::check_size(options, detail::free_volume(r.surface, r.obstacles));
  const Owners owners = detail::owners_of(surfaces);
  const Tetrahedralize_report before = r;
  Cell_soup<3> soup;
  const auto accept = [&](const Tetgen_result& mesh) {
    r = before;
    detail::check_kept(mesh, surfaces, owners, checked.names);
    r.added_points = mesh.points.size();
    for (const auto& s : surfaces) r.added_points -= s.points.size();
    soup = collect(mesh, owners, surfaces.size(), options, r);
  };
  r.tolerance = detail::mesh_by_tetgen(surfaces, checked.names, options, accept);
  return soup;
}

}  // namespace cellwalk
