// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds given to the helper of Mesh_3, scaled to a size without overflow, and its tetrahedra.
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "meshing/child/run_helper.h"
#include "meshing/fill/mesher_input.h"
#include "meshing/fill/narrow_place.h"
#include "meshing/fill/scale.h"
#include "meshing/fill/sizes.h"
#include "meshing/fill/surface_mesh.h"

namespace cellwalk {
namespace {

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

/// Of the input of Mesh_3.
Extent extent_of(const detail::Mesher_input& input, const Mesh3_report& report, int scale) {
  Extent extent;
  Point<3> low = input.points[0], high = low;
  for (const Point<3>& p : input.points)
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  const Vector<3> sides = high - low;
  extent.diagonal = length(sides);
  const double volume = detail::free_volume(report.surface, report.obstacles);
  extent.volume = std::isnormal(volume) ? std::ldexp(volume, 3 * scale) : sides[0] * sides[1] * sides[2];
  for (const auto& f : input.triangles) {
    const auto p = [&](std::size_t i) { return input.points[static_cast<std::size_t>(f[i])]; };
    extent.area += length(cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  return extent;
}

/// The options for a surface of another size.
Mesh3_options in_size(Mesh3_options options, int scale) {
  for (double* length : {&options.cell_size, &options.facet_size, &options.facet_distance})
    *length = std::ldexp(*length, scale);
  return options;
}

/// The bounds as cellwalk-mesh3 takes them.
std::vector<std::string> bounds(const Mesh3_options& options, const Extent& extent) {
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
  std::vector<std::string> words;
  for (const double bound : {options.facet_angle, facet, distance, options.radius_edge, cell})
    words.push_back(fmt::format("{:a}", bound));
  return words;
}

/// The tetrahedra that Mesh_3 made, in the size that it was given.
/// \throw Error(not_certified) if there are none, or flat ones
Cell_soup<3> collect(const detail::Mesher_output& output, int scale) {
  Cell_soup<3> soup;
  Predicate_counts counts;
  for (const Point<3>& p : output.points) soup.points.push_back(detail::scaled(p, -scale));
  for (const auto& corners : output.tetrahedra) {
    std::array<std::uint32_t, 4> t;
    for (std::size_t i = 0; i < 4; ++i) {
      t[i] = static_cast<std::uint32_t>(corners[i]);
      if (t[i] >= soup.points.size() || !is_finite(soup.points[t[i]]))
        throw Error(Error_code::not_certified, "Mesh_3 made no mesh: a tetrahedron lacks a vertex");
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

}  // namespace

Cell_soup<3> mesh3(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                   const Mesh3_options& options, Mesh3_report* report) {
  Mesh3_report own;
  Mesh3_report& r = report ? *report : own;
  r = {};
  detail::Checked_surfaces checked =
      detail::check_apart(surface, obstacles, options.obstacle_names, r.surface, r.obstacles);
  const int scale = detail::scale_of(checked.soups);
  const detail::Mesher_input input = detail::mesher_input(checked.soups, scale);
  const auto words = bounds(in_size(options, scale), extent_of(input, r, scale));
  try {
    const detail::Mesher_output output =
        detail::run_helper(detail::mesh3_helper, words, input, options.limits);
    Cell_soup<3> soup = collect(output, scale);
    r.boundary_facets = static_cast<std::size_t>(output.measures[0]);
    r.distance_to_surface = std::ldexp(output.measures[1], -scale);
    r.distance_from_surface = std::ldexp(output.measures[2], -scale);
    return soup;
  } catch (const Error& error) {
    if (error.code() != Error_code::not_certified) throw;
    const std::string place = describe(detail::narrow_places(checked.soups), checked.names);
    throw Error(Error_code::not_certified, fmt::format("{}; {}", error.what(), place));
  }
}

}  // namespace cellwalk
