// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons, polylines, boxes and ropes, with checks of their sizes.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/make_body.h>

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

}  // namespace

Body_soup<3> generate_body(const Tetrahedron_shape& shape) {
  check_positive("tetrahedron", "side", shape.side);
  const double h =
      nearest(Quad(shape.side) / (2 * sqrt(Quad(2))));  // four corners of a cube, no two on an edge
  return make_body<3>({{{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}},
                       {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}},
                       {}})
      .body;
}

Body_soup<2> generate_body(const Triangle_shape& shape) {
  check_positive("triangle", "side", shape.side);
  const double half = shape.side / 2, inner = nearest(Quad(shape.side) / (2 * sqrt(Quad(3))));
  const double outer = nearest(Quad(shape.side) / sqrt(Quad(3)));
  return closed_polygon<2>({{-half, -inner}, {half, -inner}, {0, outer}});
}

Body_soup<2> generate_body(const Quad_shape& shape) {
  check_positive("quad", "side", shape.side);
  const double h = shape.side / 2;
  return closed_polygon<2>({{-h, -h}, {h, -h}, {h, h}, {-h, h}});
}

Body_soup<2> generate_body(const Polygon_shape& shape) {
  constexpr std::uint32_t fewest = 3;
  check_count("polygon", "corners", shape.corners, fewest);
  check_positive("polygon", "radius", shape.radius);
  std::vector<Point<2>> points;
  for (std::uint32_t i = 0; i < shape.corners; ++i) {
    const auto [c, s] = detail::sine_cosine(Quad(360) * i / shape.corners);
    points.push_back({nearest(shape.radius * c), nearest(shape.radius * s)});
  }
  return closed_polygon<2>(std::move(points));
}

template <int D>
Body_soup<D> generate_body(const Catheter_shape<D>& shape) {
  constexpr std::uint32_t fewest = 2;
  check_count("catheter", "vertices", shape.vertices, fewest);
  check_positive("catheter", "length", shape.length);
  std::vector<Point<D>> points(shape.vertices);
  for (std::uint32_t i = 0; i < shape.vertices; ++i)
    points[i][0] = spaced(shape.length, i, shape.vertices - 1);
  return open_polyline<D>(std::move(points));
}

template <int D>
Body_soup<D> generate_body(const Polyline_shape<D>& shape) {
  if (shape.points.empty()) throw Error(Error_code::usage, "polyline: no points; give at least one");
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    if (!is_finite(shape.points[i]))
      throw Error(Error_code::usage,
                  fmt::format("polyline: point {} has a coordinate that is not finite", i));
  return open_polyline<D>(shape.points);
}

template <int D>
Body_soup<D> rope(const std::vector<Point<D>>& path, double spacing) {
  check_positive("rope", "spacing", spacing);
  Polyline_shape<D> shape{path};
  (void)generate_body(shape);  // refuses a path that is none
  shape.points.assign(1, path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector<D> way = path[i] - path[i - 1];
    const double pieces = std::max(1.0, std::ceil(length(way) / spacing));
    if (!(static_cast<double>(shape.points.size()) + pieces <= most_generated_vertices))
      throw Error(Error_code::usage,
                  fmt::format("rope: more than {} vertices; give a larger spacing", most_generated_vertices));
    for (double k = 1; k < pieces; ++k) shape.points.push_back(path[i - 1] + (k / pieces) * way);
    shape.points.push_back(path[i]);
  }
  return generate_body(shape);
}

Body_soup<2> generate_body(const Body_shape<2>& shape) {
  return std::visit([](const auto& s) { return generate_body(s); }, shape);
}

Body_soup<3> generate_body(const Body_shape<3>& shape) {
  return std::visit([](const auto& s) { return generate_body(s); }, shape);
}

template Body_soup<2> generate_body(const Catheter_shape<2>&);
template Body_soup<3> generate_body(const Catheter_shape<3>&);
template Body_soup<2> generate_body(const Polyline_shape<2>&);
template Body_soup<3> generate_body(const Polyline_shape<3>&);
template Body_soup<2> rope(const std::vector<Point<2>>&, double);
template Body_soup<3> rope(const std::vector<Point<3>>&, double);

}  // namespace cellwalk
