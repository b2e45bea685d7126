// SPDX-License-Identifier: LGPL-3.0-or-later
// The icosahedron, subdivided and projected onto a sphere.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace cellwalk {
namespace {

constexpr std::uint32_t most_subdivisions = 10;  // 10 million vertices

using Triangles = std::vector<std::vector<std::uint32_t>>;

/// Cuts every triangle into four at the middles of its sides.
Triangles subdivided(const Triangles& triangles, std::vector<Point<3>>& points) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(normalized(points[a] + points[b]));
    return found->second;
  };
  Triangles result;
  result.reserve(4 * triangles.size());
  for (const auto& t : triangles) {
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    result.insert(result.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return result;
}

}  // namespace

Body_soup<3> icosphere_body(double radius, std::uint32_t subdivisions) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw Error(Error_code::usage,
                fmt::format("icosphere: the radius must be a positive number, not {}", radius));
  if (subdivisions > most_subdivisions)
    throw Error(Error_code::usage,
                fmt::format("icosphere: {} subdivisions; give at most {}", subdivisions, most_subdivisions));
  constexpr double g = std::numbers::phi;
  Body_parts<3> parts;
  parts.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Point<3>& p : parts.points) p = normalized(p);
  Triangles triangles{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (std::uint32_t i = 0; i < subdivisions; ++i) triangles = subdivided(triangles, parts.points);
  for (Point<3>& p : parts.points) p = radius * p;
  parts.polygons = std::move(triangles);
  return make_body<3>(std::move(parts)).body;
}

}  // namespace cellwalk
