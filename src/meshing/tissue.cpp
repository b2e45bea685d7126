// SPDX-License-Identifier: GPL-3.0-or-later
// The hull of the cells, a box around it, and the tetrahedra between them as solid cells.
#include <cellwalk/internal/meshing/tissue.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "meshing/fill/tetgen_bounds.h"
#include "meshing/fill/tetgen_call.h"
#include "meshing/fill/tetgen_sides.h"

namespace cellwalk {
namespace {

constexpr std::uint32_t no_number = 0xffffffffu;
/// The largest number of squares along an edge of the box.
constexpr double most_squares = 32;
/// Bounds of the thickness, as fractions of the diagonal of the cells. TetGen takes points on a line or in a
/// plane to within 1e-8 of the extent for collinear or coplanar; where both are so different in size, it
/// stops.
constexpr double least_thickness = 0x1p-16, most_thickness = 0x1p10;

/// The boundary of cells, and the point of the cells that each of its points is.
struct Hull {
  Surface_soup surface;
  std::vector<std::uint32_t> points;
};

/// A facet is on the boundary if it has one side. Points and facets are numbered in the order of the soup.
Hull hull_of(const Cell_soup<3>& cells) {
  std::set<std::vector<std::uint32_t>> open;
  for (std::size_t f = 0; f < cells.facet_count(); ++f) {
    std::vector<std::uint32_t> key(cells.facet(f).begin(), cells.facet(f).end());
    std::sort(key.begin(), key.end());
    if (const auto [at, is_first] = open.insert(key); !is_first) open.erase(at);
  }
  Hull hull;
  std::vector<std::uint32_t> number(cells.points.size(), no_number);
  for (std::size_t f = 0; f < cells.facet_count(); ++f) {
    const auto facet = cells.facet(f);
    std::vector<std::uint32_t> key(facet.begin(), facet.end());
    std::sort(key.begin(), key.end());
    if (!open.contains(key)) continue;
    if (facet.size() != 3)
      throw Error(
          Error_code::input,
          "tissue: a facet of the boundary is not a triangle; split all cells into simplices (--simplicial)");
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t v : facet) {
      if (number[v] == no_number) {
        number[v] = static_cast<std::uint32_t>(hull.points.size());
        hull.points.push_back(v);
        hull.surface.points.push_back(cells.points[v]);
      }
      loop.push_back(number[v]);
    }
    hull.surface.facets.push_back(std::move(loop));
  }
  if (hull.points.empty()) throw Error(Error_code::input, "tissue: there are no cells to surround");
  return hull;
}

/// Coordinates from one to another in equal steps.
std::vector<double> steps(double low, double high, double size) {
  const double count = std::clamp(std::ceil((high - low) / size), 1.0, most_squares);
  std::vector<double> result;
  for (double i = 0; i < count; ++i) result.push_back(low + (i / count) * (high - low));
  result.push_back(high);
  return result;
}

/// The sides of the box around points, cut into triangles.
Surface_soup box_around(const std::vector<Point<3>>& points, double thickness, Tissue_report& report) {
  Point<3> low = points[0], high = low;
  for (const auto& p : points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double diagonal = length(high - low);
  if (!(thickness >= least_thickness * diagonal && thickness <= most_thickness * diagonal))
    throw Error(
        Error_code::usage,
        fmt::format("tissue: a thickness of {:g} does not suit cells of diagonal {:g}: give one between "
                    "{:.2g} and {:.2g}",
                    thickness, diagonal, 1.05 * least_thickness * diagonal,
                    0.95 * most_thickness * diagonal));
  std::array<std::vector<double>, 3> at;
  for (int k = 0; k < 3; ++k) {
    report.low[k] = low[k] - thickness, report.high[k] = high[k] + thickness;
    at[k] = steps(report.low[k], report.high[k], thickness);
    // Not so for cells that are tiny beside their distance from the origin.
    if (std::adjacent_find(at[k].begin(), at[k].end(), std::greater_equal<>()) != at[k].end() ||
        !(report.low[k] < low[k] && high[k] < report.high[k]))
      throw Error(Error_code::usage,
                  "tissue: the box cannot be told from the cells in double precision; move "
                  "them to the origin, or give a larger thickness");
  }
  Surface_soup box;
  std::map<Point<3>, std::uint32_t> number;
  const auto point = [&](const Point<3>& p) {
    const auto [it, is_new] = number.insert({p, static_cast<std::uint32_t>(box.points.size())});
    if (is_new) box.points.push_back(p);
    return it->second;
  };
  for (int k = 0; k < 3; ++k)
    for (const double side : {at[k].front(), at[k].back()}) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      for (std::size_t i = 0; i + 1 < at[u].size(); ++i)
        for (std::size_t j = 0; j + 1 < at[v].size(); ++j) {
          const auto corner = [&](std::size_t di, std::size_t dj) {
            Point<3> p;
            p[k] = side, p[u] = at[u][i + di], p[v] = at[v][j + dj];
            return point(p);
          };
          const auto a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          box.facets.push_back({a, b, c});
          box.facets.push_back({a, c, d});
        }
    }
  return box;
}

}  // namespace

Cell_soup<3> surround_by_tissue(Cell_soup<3> cells, const Tissue_options& options, Tissue_report* report) {
  if (!(options.thickness > 0 && std::isfinite(options.thickness)))
    throw Error(Error_code::usage, "tissue: the thickness must be positive and finite");
  Tetrahedralize_options tetgen;
  tetgen.quality = options.quality;
  tetgen.most_added_points = options.most_added_points;
  tetgen.limits = options.limits;
  detail::check_bounds(tetgen);
  Tissue_report own;
  Tissue_report& r = report ? *report : own;
  r = {};
  Hull hull = hull_of(cells);
  const Surface_soup box = box_around(hull.surface.points, options.thickness, r);
  const std::vector<Surface_soup> surfaces{std::move(hull.surface), box};
  const detail::Owners owners = detail::owners_of(surfaces);
  detail::Feature_names names;
  names.add("the boundary of the cells", hull.points, hull.points.size(), {}, surfaces[0].facets.size());
  names.add("the box", {}, box.points.size(), {}, box.facets.size());
  detail::Tetgen_result mesh;
  std::vector<std::array<std::uint32_t, 4>> tissue;
  const auto accept = [&](const detail::Tetgen_result& made) {
    detail::check_kept(made, surfaces, owners, names);
    const detail::Sides sides(made, owners, surfaces.size());
    tissue.clear();
    for (std::size_t i = 0; i < made.tetrahedra.size(); ++i)
      if (!sides[i][0]) tissue.push_back(detail::positive(made, made.tetrahedra[i]));
    mesh = made;
  };
  r.tolerance = detail::mesh_by_tetgen(surfaces, names, tetgen, accept);
  r.inner_facets = surfaces[0].facets.size();

  std::vector<std::uint32_t> number(mesh.points.size(), no_number);
  std::copy(hull.points.begin(), hull.points.end(), number.begin());
  const std::size_t points_before = cells.points.size();
  for (const auto& t : tissue) {
    for (const std::uint32_t v : t)
      if (number[v] == no_number) {
        number[v] = static_cast<std::uint32_t>(cells.points.size());
        cells.points.push_back(mesh.points[v]);
      }
    add_tetrahedron(cells, number[t[0]], number[t[1]], number[t[2]], number[t[3]]);
    cells.solid.back() = 1;
    ++r.solid_cells;
    r.out_of_bounds += detail::is_out_of_bounds(mesh, t, tetgen);
  }
  r.added_points = cells.points.size() - points_before;
  return cells;
}

}  // namespace cellwalk
