// SPDX-License-Identifier: GPL-3.0-or-later
// The tests that closed surfaces do not meet, and that obstacles lie inside and apart.
#include <cellwalk/kernel/error.h>

#include <CGAL/Side_of_triangle_mesh.h>

#include <string>
#include <utility>

#include "surface_mesh.h"

namespace cellwalk::detail {
namespace {

using Side = CGAL::Side_of_triangle_mesh<Surface_mesh, Mesh_kernel>;

void check_disjoint(const std::vector<Surface_soup>& surfaces, const std::vector<std::string>& names) {
  Surface_mesh mesh;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    append(mesh, surfaces[i]);
    owner.resize(mesh.number_of_faces(), i);
  }
  const auto pairs = intersecting_faces(mesh);
  if (!pairs.empty())
    throw Error(Error_code::input, names[owner[pairs[0].second]] + " meets " + names[owner[pairs[0].first]] +
                                       ": " + std::to_string(pairs.size()) +
                                       (pairs.size() == 1 ? " pair" : " pairs") +
                                       " of facets intersect; move it, or join the surfaces beforehand");
}

/// The number of points in `points` that the closed surface encloses.
std::size_t enclosed(const Surface_soup& surface, const Surface_soup& points) {
  Surface_mesh mesh;
  append(mesh, surface);
  const Side side(mesh);
  std::size_t n = 0;
  for (const auto& p : points.points) n += side({p[0], p[1], p[2]}) == CGAL::ON_BOUNDED_SIDE;
  return n;
}

}  // namespace

Checked_surfaces check_apart(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                             const std::vector<std::string>& obstacle_names, Surface_report& surface_report,
                             std::vector<Surface_report>& obstacle_reports) {
  Checked_surfaces result;
  std::vector<Surface_soup>& checked = result.soups;
  std::vector<std::string> names;
  const auto check = [&](const Surface_soup& soup, const std::string& name, Surface_report& report) {
    Traced_surface traced = check_traced(soup, name, report);
    result.names.add(name, std::move(traced.input_point), traced.soup.points.size(),
                     std::move(traced.input_facet), traced.soup.facets.size());
    checked.push_back(std::move(traced.soup));
    names.push_back(name);
  };
  check(surface, "surface", surface_report);
  obstacle_reports.resize(obstacles.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    check(obstacles[i], i < obstacle_names.size() ? obstacle_names[i] : "obstacle " + std::to_string(i + 1),
          obstacle_reports[i]);
  if (obstacles.empty()) return result;
  check_disjoint(checked, names);
  for (std::size_t i = 1; i < checked.size(); ++i) {
    if (enclosed(checked[0], checked[i]) != checked[i].points.size())
      throw Error(Error_code::input, names[i] + " does not lie inside the surface; move it, or leave it out");
    for (std::size_t j = 1; j < checked.size(); ++j)
      if (j != i && enclosed(checked[j], checked[i]) > 0)
        throw Error(Error_code::input, names[i] + " lies inside " + names[j] + "; leave it out");
  }
  return result;
}

}  // namespace cellwalk::detail
