// SPDX-License-Identifier: LGPL-3.0-or-later
// Small surfaces that meshers cannot cope with, or hardly: points, facets and edges that nearly meet, extreme
// sizes, and surfaces that bound nothing.
#ifndef CELLWALK_TESTS_MESHING_ODD_SURFACES_H
#define CELLWALK_TESTS_MESHING_ODD_SURFACES_H

#include <cellwalk/records/surface_soup.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include "meshing/shapes.h"

namespace cellwalk::test {

struct Odd_surface {
  std::string name;
  Surface_soup surface;
};

/// A prism over a polygon in the plane of x and y, counterclockwise.
inline Surface_soup prism(const std::vector<Point<2>>& polygon, double height) {
  Surface_soup s;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {0.0, height})
    for (const auto& p : polygon) s.points.push_back({p[0], p[1], z});
  std::vector<std::uint32_t> top, bottom;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    top.push_back(n + i);
    bottom.push_back(n - 1 - i);
    s.facets.push_back({i, j, n + j, n + i});
  }
  s.facets.push_back(top);
  s.facets.push_back(bottom);
  return s;
}

/// The unit cube with a point more: `along` the edge from (0, 0, 0) to (1, 0, 0).
inline Surface_soup cube_with_point_on_edge(double along) {
  Surface_soup s = box({0, 0, 0}, {1, 1, 1});
  s.points.push_back({along, 0, 0});
  for (auto& facet : s.facets)
    for (std::size_t i = 0; i < facet.size(); ++i) {
      if (facet[i] + facet[(i + 1) % facet.size()] == 1) {  // from 0 to 1, or back
        facet.insert(facet.begin() + static_cast<std::ptrdiff_t>(i) + 1, 8);
        break;
      }
    }
  return s;
}

/// The unit cube with a point over the middle of its upper side.
inline Surface_soup cube_with_roof(double height) {
  Surface_soup s = box({0, 0, 0}, {1, 1, 1});
  s.points.push_back({0.5, 0.5, 1 + height});
  const auto top = s.facets[1];
  s.facets.erase(s.facets.begin() + 1);
  for (std::size_t i = 0; i < top.size(); ++i) s.facets.push_back({top[i], top[(i + 1) % top.size()], 8});
  return s;
}

inline Surface_soup stretched(Surface_soup s, const Point<3>& factors) {
  for (auto& p : s.points)
    for (std::size_t k = 0; k < 3; ++k) p[k] *= factors[k];
  return s;
}

inline Surface_soup with_point(Surface_soup s, std::size_t v, const Point<3>& p) {
  s.points[v] = p;
  return s;
}

/// Turned about two axes, so that coordinates have many digits.
inline Surface_soup turned_by(Surface_soup s, double a, double b) {
  for (auto& p : s.points) {
    p = {std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    p = {p[0], std::cos(b) * p[1] - std::sin(b) * p[2], std::sin(b) * p[1] + std::cos(b) * p[2]};
  }
  return s;
}

/// The kinds, each for a small number.
inline Surface_soup odd_shape(std::size_t kind, double small) {
  const double large = 1 / small;
  switch (kind) {
    case 0:
      return cube_with_point_on_edge(small);
    case 1:
      return cube_with_roof(small);
    case 2:
      return cube_with_roof(-small);
    case 3:  // a crack
      return prism({{0, 0}, {4, 0}, {4, 2}, {2 + small, 2}, {2, 1}, {2 - small, 2}, {0, 2}}, 2);
    case 4:  // a wedge
      return prism({{0, 0}, {2, 0}, {2, small}}, 1);
    case 5:  // a slab, a lens, a needle
      return box({0, 0, 0}, {1, 1, small});
    case 6:
      return stretched(octahedron(1), {1, 1, small});
    case 7:
      return box({0, 0, 0}, {small, small, 1});
    case 8:  // a sliver
      return with_point(stretched(octahedron(), {1, 1, 1}), 2, {0.4, 0.4, small});
    case 9:  // a thin gap between two boxes, a thin shell
      return join(box({0, 0, 0}, {1, 1, 1}), box({0.2, 0.3, 1 + small}, {1.5, 1.25, 2}));
    case 10:
      return join(box({0, 0, 0}, {1, 1, 1}), turned(box({small, small, small}, {0.9, 0.9, 0.9})));
    case 11:  // a far corner
      return with_point(box({0, 0, 0}, {1, 1, 1}), 7, {1, 1, large});
    case 12:
      return stretched(box({0, 0, 0}, {1, 1, 1}), {large, 1, 1});
    case 13:  // a slot that nearly reaches the other side
      return prism({{0, 0}, {3, 0}, {3, 1}, {1.6, 1}, {1.5, small}, {1.4, 1}, {0, 1}}, 1);
    case 14:  // extreme sizes
      return stretched(octahedron(), {small, small, small});
    case 15:
      return stretched(cube_with_roof(0.25), {large, large, large});
    case 16:  // two cubes with a common edge, nearly
      return join(box({0, 0, 0}, {1, 1, 1}), box({1 + small, 1, 0}, {2, 2, 1}));
    case 17:  // no surface: two cubes with a common edge, one face less, crossing cubes
      return join(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1}));
    case 18: {
      Surface_soup s = cube_with_point_on_edge(small);
      s.facets.pop_back();
      return s;
    }
    default:
      return join(box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 1 - small}, {2, 2, 2}));
  }
}
constexpr std::size_t odd_kinds = 20;

/// The i-th odd surface: all kinds in turn, from slightly to extremely odd, every other one turned.
inline Odd_surface odd_surface(std::size_t i) {
  const std::size_t kind = i % odd_kinds, round = i / odd_kinds;
  std::mt19937 random(static_cast<unsigned>(i));
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  // Sizes: up to the end of doubles; others: up to what can be told from 1, and beyond for points at 0.
  const bool is_size = kind == 14 || kind == 15;
  const double exponent = is_size ? uniform(3, 300) : uniform(3, kind == 0 || kind == 8 ? 20 : 16);
  Odd_surface odd{"odd surface " + std::to_string(i), odd_shape(kind, std::pow(10.0, -exponent))};
  if (round % 2 == 1) odd.surface = turned_by(std::move(odd.surface), uniform(0, 3), uniform(0, 3));
  return odd;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_MESHING_ODD_SURFACES_H
