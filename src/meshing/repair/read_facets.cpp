// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons cut into triangles.
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/version.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "meshing/fill/surface_topology.h"
#include "tidy.h"

namespace cellwalk::detail {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Loop = std::vector<std::uint32_t>;

/// The largest distance of the corners from the plane through their mean, normal to the loop.
double off_plane(const std::vector<Point<3>>& points, const Loop& loop) {
  Point<3> mean{};
  for (const std::uint32_t v : loop) mean = mean + (1.0 / static_cast<double>(loop.size())) * points[v];
  Vector<3> normal{};
  for (std::size_t i = 0; i < loop.size(); ++i)
    normal = normal + cross(points[loop[i]] - mean, points[loop[(i + 1) % loop.size()]] - mean);
  normal = normalized(normal, {0, 0, 1});
  double most = 0;
  for (const std::uint32_t v : loop) most = std::max(most, std::abs(dot(points[v] - mean, normal)));
  return most;
}

std::vector<Triangle> cut_quadrangle(const std::vector<Point<3>>& points, const Loop& q) {
  struct Cut {
    std::vector<Triangle> triangles;
    double fold;  // the cosine between both halves
    double diagonal;
  };
  const auto cut = [&](int i) {
    const std::uint32_t a = q[i], b = q[i + 1], c = q[(i + 2) % 4], d = q[(i + 3) % 4];
    const auto normal = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return normalized(cross(points[y] - points[x], points[z] - points[x]), {});
    };
    return Cut{{{a, b, c}, {a, c, d}}, dot(normal(a, b, c), normal(a, c, d)), length(points[c] - points[a])};
  };
  const Cut one = cut(0), other = cut(1);
  // A fold by more than a right angle is that of a quadrangle that is not convex, or the wrong diagonal.
  if ((one.fold > 0) != (other.fold > 0)) return one.fold > 0 ? one.triangles : other.triangles;
  // Both sides of a sheet are cut alike, also where rounding decides.
  constexpr double rounding = 1e-9;
  if (std::abs(one.diagonal - other.diagonal) <= rounding * one.diagonal)
    return (std::min_element(q.begin(), q.end()) - q.begin()) % 2 == 0 ? one.triangles : other.triangles;
  return one.diagonal < other.diagonal ? one.triangles : other.triangles;
}

std::vector<Triangle> cut_polygon(const std::vector<Point<3>>& points, const Loop& loop) {
  std::vector<Repair_kernel::Point_3> border;
  for (const std::uint32_t v : loop) border.push_back(to_cgal(points[v]));
  std::vector<CGAL::Triple<int, int, int>> cuts;
  PMP::triangulate_hole_polyline(border, std::back_inserter(cuts),
                                 CGAL::parameters::use_2d_constrained_delaunay_triangulation(true));
  std::vector<Triangle> triangles;
  for (const auto& t : cuts) triangles.push_back({loop[t.first], loop[t.second], loop[t.third]});
  if (triangles.size() + 2 == loop.size()) return triangles;
  triangles.clear();
  for (std::size_t i = 2; i < loop.size(); ++i) triangles.push_back({loop[0], loop[i - 1], loop[i]});
  return triangles;
}

}  // namespace

Facets read_facets(const Surface_soup& surface, std::vector<Repair_change>& changes) {
  Surface_report report;
  const Traced_surface traced = clean(surface, "surface", report);
  Facets result;
  result.points = traced.soup.points;
  result.given_points = result.points.size();
  Point<3> low = result.points[0], high = low;
  for (const Point<3>& p : result.points)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  result.size = length(high - low);
  Found cut, bent;
  for (std::size_t f = 0; f < traced.soup.facets.size(); ++f) {
    const Loop& loop = traced.soup.facets[f];
    const std::uint32_t number = traced.input_facet[f];
    if (loop.size() == 3) {
      result.facets.push_back({{loop[0], loop[1], loop[2]}, Part::surface, number});
      continue;
    }
    cut.add(result.points[loop[0]]);
    const double bend = off_plane(result.points, loop) / result.size;
    constexpr double rounding = 1e-12;
    if (bend > rounding) bent.add(result.points[loop[0]], bend);
    for (const Triangle& t :
         loop.size() == 4 ? cut_quadrangle(result.points, loop) : cut_polygon(result.points, loop))
      result.facets.push_back({t, Part::surface, number});
  }
  const auto simple = [&](const std::string& step, std::size_t count, const std::string& text) {
    if (count != 0) changes.push_back({step, text, count, {}, 0});
  };
  simple("merged", report.merged_points,
         counted(report.merged_points, "point", "points") + " in the place of others joined with them");
  simple("unused", report.unused_points,
         counted(report.unused_points, "point", "points") + " of no facet left out");
  simple("collapsed", report.collapsed_facets,
         counted(report.collapsed_facets, "collapsed facet", "collapsed facets") + " left out");
  simple("triangulated", cut.count, counted(cut.count, "polygon", "polygons") + " cut into triangles");
  if (bent.count != 0)
    changes.push_back(
        {"bent",
         fmt::format("{} not planar, up to {:.2g} of the size off their plane: the walls are "
                     "those of their triangles{}",
                     counted(bent.count, "polygon is", "polygons are"), bent.measured, bent.where()),
         bent.count, bent.places, 0});
  return result;
}

}  // namespace cellwalk::detail
