// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/generators/body_of_shape.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "records/body_checks.h"

namespace cellwalk {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;

template <int D>
Body_soup<D> sound(Body_soup<D> body) {
  EXPECT_EQ(test::flaw(body), "");
  return body;
}

/// True if the faces are a closed surface: every side once in each direction.
bool is_closed(const Body_soup<3>& body) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& f : body.faces)
    for (std::size_t i = 0; i < 3; ++i)
      if (!sides.insert({f[i], f[(i + 1) % 3]}).second) return false;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) return false;
  return sides.size() == 2 * body.edges.size();
}

/// Positive where faces are counterclockwise seen from outside.
double volume(const Body_soup<3>& body) {
  double six = 0;
  for (const auto& f : body.faces) six += dot(body.points[f[0]], cross(body.points[f[1]], body.points[f[2]]));
  return six / 6;
}

double area(const Body_soup<2>& body) {
  double two = 0;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const Point<2>&a = body.points[i], &b = body.points[(i + 1) % body.points.size()];
    two += a[0] * b[1] - a[1] * b[0];
  }
  return two / 2;
}

template <int D>
void expect_centred(const Body_soup<D>& body) {
  Vector<D> sum{};
  for (const auto& p : body.points) sum = sum + p;
  EXPECT_LE(length(sum), 1e-12 * static_cast<double>(body.points.size()));
}

template <int D>
void expect_edge_lengths(const Body_soup<D>& body, double expected) {
  for (const auto& e : body.edges)
    EXPECT_NEAR(length(body.points[e[1]] - body.points[e[0]]), expected, 1e-15 * expected);
}

template <class Shape>
std::string refusal(const Shape& shape) {
  try {
    generate_body(shape);
  } catch (const Error& e) {
    EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(Error_code::usage));
    return e.what();
  }
  return "accepted";
}

TEST(GenerateBody, HexahedronIsThatOfThePaper) {
  const auto body = sound(hexahedron_body(0.3));
  ASSERT_EQ(body.points.size(), 8u);
  Edges expected;
  for (std::uint32_t v = 0; v < 8; ++v) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(body.points[v][k], (v >> k & 1) ? 0.15 : -0.15);
    for (std::uint32_t bit : {1u, 2u, 4u})
      if (v < (v ^ bit)) expected.push_back({v, v ^ bit});
  }
  EXPECT_EQ(expected.size(), 12u);
  EXPECT_EQ(body.edges, expected);
  EXPECT_TRUE(body.faces.empty());
}

TEST(GenerateBody, HexahedronHasFacesOnRequest) {
  const auto wire = hexahedron_body(2), body = sound(hexahedron_body(2, true));
  EXPECT_EQ(body.points, wire.points);
  EXPECT_EQ(body.faces.size(), 12u);
  EXPECT_EQ(body.edges.size(), 18u);
  for (const auto& e : wire.edges) EXPECT_TRUE(std::binary_search(body.edges.begin(), body.edges.end(), e));
  EXPECT_TRUE(is_closed(body));
  EXPECT_EQ(volume(body), 8);
}

TEST(GenerateBody, BoxIsTheSurfaceOfALattice) {
  const Vector<3> size{3, 2, 1};
  const std::array<std::uint32_t, 3> cells{6, 4, 1};
  const auto wire = sound(box_body(size, cells, false));
  const auto body = sound(box_body(size, cells, true));
  EXPECT_EQ(body.points.size(), 70u);  // 7 * 5 * 2: none inside
  EXPECT_EQ(body.points, wire.points);
  EXPECT_EQ(body.points.front(), (Point<3>{-1.5, -1, -0.5}));
  EXPECT_EQ(body.points[1], (Point<3>{-1, -1, -0.5}));
  EXPECT_EQ(body.points.back(), (Point<3>{1.5, 1, 0.5}));
  EXPECT_EQ(body.faces.size(), 2u * 2 * (24 + 6 + 4));
  EXPECT_EQ(wire.edges.size(), body.edges.size() - 68);  // a diagonal a rectangle
  EXPECT_TRUE(is_closed(body));
  EXPECT_EQ(volume(body), 6);
  expect_centred(body);
  const auto cube = sound(box_body({1, 1, 1}, {3, 3, 3}, true));
  EXPECT_EQ(cube.points.size(), 64u - 8);
  EXPECT_TRUE(is_closed(cube));
  EXPECT_EQ(box_body({1, 1, 1}).edges, hexahedron_body(1).edges);
}

TEST(GenerateBody, TetrahedronIsRegular) {
  const auto body = sound(tetrahedron_body(3));
  EXPECT_EQ(body.edges.size(), 6u);
  EXPECT_EQ(body.faces.size(), 4u);
  expect_edge_lengths(body, 3);
  expect_centred(body);
  EXPECT_TRUE(is_closed(body));
  EXPECT_NEAR(volume(body), 27 / (6 * std::numbers::sqrt2), 1e-14);
}

TEST(GenerateBody, IcosphereApproachesTheSphere) {
  double last = 0;
  for (std::uint32_t n = 0; n <= 4; ++n) {
    SCOPED_TRACE(n);
    const auto body = sound(icosphere_body(2, n));
    const std::size_t fours = std::size_t{1} << (2 * n);
    EXPECT_EQ(body.points.size(), 10 * fours + 2);
    EXPECT_EQ(body.edges.size(), 30 * fours);
    EXPECT_EQ(body.faces.size(), 20 * fours);
    EXPECT_TRUE(is_closed(body));
    expect_centred(body);
    for (const auto& p : body.points) EXPECT_NEAR(length(p), 2, 1e-15);
    const double v = volume(body);
    EXPECT_GT(v, last);
    last = v;
  }
  EXPECT_NEAR(last, 4 * std::numbers::pi / 3 * 8, 0.15);
  EXPECT_LT(last, 4 * std::numbers::pi / 3 * 8);
}

TEST(GenerateBody, FiguresOfThePlane) {
  const auto triangle = sound(triangle_body(2));
  EXPECT_EQ(triangle.edges, (Edges{{0, 1}, {0, 2}, {1, 2}}));
  expect_edge_lengths(triangle, 2);
  expect_centred(triangle);
  EXPECT_NEAR(area(triangle), std::numbers::sqrt3, 1e-15);
  const auto quad = sound(quad_body(0.5));
  EXPECT_EQ(quad.points, (std::vector<Point<2>>{{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}}));
  EXPECT_EQ(quad.edges, (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  const auto square = sound(polygon_body(4, 3));
  EXPECT_EQ(square.points, (std::vector<Point<2>>{{3, 0}, {0, 3}, {-3, 0}, {0, -3}}));
  const auto hexagon = sound(polygon_body(6, 2));
  EXPECT_EQ(hexagon.edges.size(), 6u);
  EXPECT_EQ(hexagon.points[1][0], 1);
  EXPECT_EQ(hexagon.points[2][0], -1);
  expect_edge_lengths(hexagon, 2);
  const auto many = sound(polygon_body(360, 1));
  expect_centred(many);
  EXPECT_NEAR(area(many), 180 * std::sin(std::numbers::pi / 180), 1e-13);
}

TEST(GenerateBody, CathetersAndPolylines) {
  const auto catheter = sound(catheter_body<3>(4, 5));
  EXPECT_EQ(catheter.points,
            (std::vector<Point<3>>{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(catheter.edges, (Edges{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(catheter_body<2>(1, 2).points, (std::vector<Point<2>>{{-0.5, 0}, {0.5, 0}}));
  const auto uneven = sound(catheter_body<2>(1, 8));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(uneven.points[i][0], -uneven.points[7 - i][0]);
  const std::vector<Point<2>> points{{1, 2}, {3, 4}, {1, 2}};
  const auto polyline = sound(polyline_body<2>(points));
  EXPECT_EQ(polyline.points, points);
  EXPECT_EQ(polyline.edges, (Edges{{0, 1}, {1, 2}}));
  EXPECT_TRUE(polyline_body<3>({{1, 2, 3}}).edges.empty());
}

TEST(GenerateBody, AnyShape) {
  EXPECT_EQ(generate_body(Body_shape<3>(Tetrahedron_shape{2})).points, tetrahedron_body(2).points);
  EXPECT_EQ(generate_body(Body_shape<2>(Catheter_shape<2>{2, 3})).edges, (Edges{{0, 1}, {1, 2}}));
}

TEST(GenerateBody, RefusesWhatMakesNoSense) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(Hexahedron_shape{0}), "hexahedron: the side must be a positive number, not 0");
  EXPECT_EQ(refusal(Tetrahedron_shape{-1}), "tetrahedron: the side must be a positive number, not -1");
  EXPECT_EQ(refusal(Triangle_shape{nan}), "triangle: the side must be a positive number, not nan");
  EXPECT_EQ(refusal(Quad_shape{inf}), "quad: the side must be a positive number, not inf");
  EXPECT_EQ(refusal(Icosphere_shape{0, 1}), "icosphere: the radius must be a positive number, not 0");
  EXPECT_EQ(refusal(Icosphere_shape{1, 11}), "icosphere: 11 subdivisions; give at most 10");
  EXPECT_EQ(refusal(Polygon_shape{2, 1}), "polygon: 2 corners; give 3 to 16777216");
  EXPECT_EQ(refusal(Polygon_shape{3, 0}), "polygon: the radius must be a positive number, not 0");
  EXPECT_EQ(refusal(Catheter_shape<3>{1, 1}), "catheter: 1 vertices; give 2 to 16777216");
  EXPECT_EQ(refusal(Catheter_shape<2>{0, 2}), "catheter: the length must be a positive number, not 0");
  EXPECT_EQ(refusal(Polyline_shape<3>{}), "polyline: no points; give at least one");
  EXPECT_EQ(refusal(Polyline_shape<2>{{{0, 0}, {0, inf}}}),
            "polyline: point 1 has a coordinate that is not finite");
  EXPECT_EQ(refusal(Box_shape{{1, 0, 1}}), "box: its size must be positive numbers, not 0");
  EXPECT_EQ(refusal(Box_shape{{1, 1, 1}, {1, 0, 1}}),
            "box: no cells along an axis; give at least 1 along each");
  EXPECT_EQ(refusal(Box_shape{{1, 1, 1}, {1, 1, 4194304}}),
            "box: 16777220 vertices; give fewer cells, for at most 16777216");
}

TEST(GenerateBody, ARopePassesAllPointsOfItsPath) {
  const auto body = sound(rope({{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}}, 0.3));
  ASSERT_EQ(body.points.size(), 7u);
  EXPECT_EQ(body.edges.size(), 6u);
  EXPECT_EQ(body.points.front(), (Point<3>{0, 0, 0}));
  EXPECT_EQ(body.points[1], (Point<3>{0.25, 0, 0}));
  EXPECT_EQ(body.points[4], (Point<3>{1, 0, 0}));
  EXPECT_EQ(body.points.back(), (Point<3>{1, 0.5, 0}));
  for (const auto& [u, v] : body.edges) EXPECT_LE(length(body.points[v] - body.points[u]), 0.3);
  EXPECT_EQ(rope<2>({{0, 0}, {0, 2}}, 5).points.size(), 2u);
  EXPECT_EQ(rope({{1, 2, 3}}, 1).points.size(), 1u);
}

TEST(GenerateBody, ARopeNeedsAPathAndASpacing) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double spacing : {0.0, -1.0, infinity, 1e-9})
    EXPECT_THROW(rope({{0, 0, 0}, {1, 0, 0}}, spacing), Error) << spacing;
  EXPECT_THROW(rope<3>({}, 1), Error);
  EXPECT_THROW(rope({{0, 0, 0}, {infinity, 0, 0}}, 1), Error);
}

}  // namespace
}  // namespace cellwalk
