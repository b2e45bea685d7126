// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons, polylines, boxes and ropes, with checks of their sizes.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/generators/body_of_shape.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quad_rotation.h"

namespace cellwalk {
namespace {

using detail::nearest;
using detail::Quad;

/// \throw Error(usage) unless the value is a positive number
void check_positive(const char* shape, const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(Error_code::usage,
                fmt::format("{}: the {} must be a positive number, not {}", shape, what, value));
}

void check_count(const char* shape, const char* what, std::uint32_t value, std::uint32_t low) {
  if (value < low || value > most_generated_vertices)
    throw Error(Error_code::usage,
                fmt::format("{}: {} {}; give {} to {}", shape, value, what, low, most_generated_vertices));
}

/// Point i of n + 1 at equal distances on a segment of that length with its middle at 0.
double spaced(double length, std::uint32_t i, std::uint32_t n) {
  return nearest(Quad(length) * (2 * static_cast<std::int64_t>(i) - static_cast<std::int64_t>(n)) /
                 (2 * Quad(n)));
}

template <int D>
Body_soup<D> closed_polygon(std::vector<Point<D>> points) {
  std::vector<std::uint32_t> loop;
  for (std::uint32_t i = 0; i < points.size(); ++i) loop.push_back(i);
  return make_body<D>({std::move(points), {std::move(loop)}, {}}).body;
}

template <int D>
Body_soup<D> open_polyline(std::vector<Point<D>> points) {
  Body_parts<D> parts;
  for (std::uint32_t i = 1; i < points.size(); ++i) parts.segments.push_back({i - 1, i});
  parts.points = std::move(points);
  return make_body<D>(std::move(parts)).body;
}

template <class... Cases>
struct Overloads : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloads(Cases...) -> Overloads<Cases...>;  // Clang 14

}  // namespace

Body_soup<3> tetrahedron_body(double side) {
  check_positive("tetrahedron", "side", side);
  const double h = nearest(Quad(side) / (2 * sqrt(Quad(2))));  // four corners of a cube, no two on an edge
  return make_body<3>({{{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}},
                       {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}},
                       {}})
      .body;
}

Body_soup<2> triangle_body(double side) {
  check_positive("triangle", "side", side);
  const double half = side / 2, inner = nearest(Quad(side) / (2 * sqrt(Quad(3))));
  const double outer = nearest(Quad(side) / sqrt(Quad(3)));
  return closed_polygon<2>({{-half, -inner}, {half, -inner}, {0, outer}});
}

Body_soup<2> quad_body(double side) {
  check_positive("quad", "side", side);
  const double h = side / 2;
  return closed_polygon<2>({{-h, -h}, {h, -h}, {h, h}, {-h, h}});
}

Body_soup<2> polygon_body(std::uint32_t corners, double radius) {
  constexpr std::uint32_t fewest = 3;
  check_count("polygon", "corners", corners, fewest);
  check_positive("polygon", "radius", radius);
  std::vector<Point<2>> points;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const auto [c, s] = detail::sine_cosine(Quad(360) * i / corners);
    points.push_back({nearest(radius * c), nearest(radius * s)});
  }
  return closed_polygon<2>(std::move(points));
}

template <int D>
Body_soup<D> catheter_body(double length, std::uint32_t vertices) {
  constexpr std::uint32_t fewest = 2;
  check_count("catheter", "vertices", vertices, fewest);
  check_positive("catheter", "length", length);
  std::vector<Point<D>> points(vertices);
  for (std::uint32_t i = 0; i < vertices; ++i) points[i][0] = spaced(length, i, vertices - 1);
  return open_polyline<D>(std::move(points));
}

template <int D>
Body_soup<D> polyline_body(const std::vector<Point<D>>& points) {
  if (points.empty()) throw Error(Error_code::usage, "polyline: no points; give at least one");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i]))
      throw Error(Error_code::usage,
                  fmt::format("polyline: point {} has a coordinate that is not finite", i));
  return open_polyline<D>(points);
}

template <int D>
Body_soup<D> rope(const std::vector<Point<D>>& path, double spacing) {
  check_positive("rope", "spacing", spacing);
  (void)polyline_body<D>(path);  // refuses a path that is none
  std::vector<Point<D>> points{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector<D> way = path[i] - path[i - 1];
    const double pieces = std::max(1.0, std::ceil(length(way) / spacing));
    if (!(static_cast<double>(points.size()) + pieces <= most_generated_vertices))
      throw Error(Error_code::usage,
                  fmt::format("rope: more than {} vertices; give a larger spacing", most_generated_vertices));
    for (double k = 1; k < pieces; ++k) points.push_back(path[i - 1] + (k / pieces) * way);
    points.push_back(path[i]);
  }
  return polyline_body<D>(points);
}

Body_soup<2> generate_body(const Body_shape<2>& shape) {
  return std::visit(
      Overloads{[](const Triangle_shape& s) { return triangle_body(s.side); },
                [](const Quad_shape& s) { return quad_body(s.side); },
                [](const Polygon_shape& s) { return polygon_body(s.corners, s.radius); },
                [](const Catheter_shape<2>& s) { return catheter_body<2>(s.length, s.vertices); },
                [](const Polyline_shape<2>& s) { return polyline_body<2>(s.points); }},
      shape);
}

Body_soup<3> generate_body(const Body_shape<3>& shape) {
  return std::visit(
      Overloads{[](const Hexahedron_shape& s) { return hexahedron_body(s.side, s.faces); },
                [](const Box_shape& s) { return box_body(s.size, s.cells, s.faces); },
                [](const Tetrahedron_shape& s) { return tetrahedron_body(s.side); },
                [](const Icosphere_shape& s) { return icosphere_body(s.radius, s.subdivisions); },
                [](const Catheter_shape<3>& s) { return catheter_body<3>(s.length, s.vertices); },
                [](const Polyline_shape<3>& s) { return polyline_body<3>(s.points); }},
      shape);
}

template Body_soup<2> catheter_body(double, std::uint32_t);
template Body_soup<3> catheter_body(double, std::uint32_t);
template Body_soup<2> polyline_body(const std::vector<Point<2>>&);
template Body_soup<3> polyline_body(const std::vector<Point<3>>&);
template Body_soup<2> rope(const std::vector<Point<2>>&, double);
template Body_soup<3> rope(const std::vector<Point<3>>&, double);

}  // namespace cellwalk
