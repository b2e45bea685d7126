// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds whose bodies have radii, and the judge of their distances from walls, in rationals.
#ifndef CELLWALK_TESTS_RESHAPE_THICK_WORLD_H
#define CELLWALK_TESTS_RESHAPE_THICK_WORLD_H

#include <cellwalk/body/body.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "edge/thick_oracle.h"
#include "kernel/rational_distance.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {

/// An edge or a face of a body.
template <int D>
struct Thick_part {
  Body_feature feature;
  std::uint32_t number;
  double radius;  ///< of a face, the least of its sides'
  std::vector<std::uint32_t> vertices;
  std::vector<Point<D>> corners;
};

template <int D>
std::vector<Thick_part<D>> thick_parts(const Body<D>& body) {
  std::vector<Thick_part<D>> parts;
  const auto add = [&](Body_feature feature, std::size_t number, double radius, const auto& vertices) {
    Thick_part<D>& part = parts.emplace_back();
    part.feature = feature;
    part.number = static_cast<std::uint32_t>(number);
    part.radius = radius;
    part.vertices.assign(vertices.begin(), vertices.end());
    for (const std::uint32_t v : vertices) part.corners.push_back(body.positions()[v]);
  };
  const auto edges = body.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) add(Body_feature::edge, e, body.radius(e), edges[e]);
  for (std::size_t f = 0; f < body.faces().size(); ++f) {
    std::vector<std::uint32_t> face(body.faces()[f].begin(), body.faces()[f].end());
    std::ranges::sort(face);
    double radius = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (std::ranges::includes(face, edges[e])) radius = std::min(radius, body.radius(e));
    add(Body_feature::face, f, radius, face);
  }
  return parts;
}

/// Gives each edge of the bodies of a world a radius of up to its distance from walls, some of them just
/// that, so that faces keep theirs; all of a body with faces the same one, at times. Bodies that touch walls
/// are dropped.
template <int D, class World>
void give_radii(World& world, double at_distance) {
  const Thick_oracle<D> oracle(world.snapshot);
  std::erase_if(world.bodies, [&](const std::unique_ptr<Body<D>>& body) {
    std::vector<double> radii;
    for (const Thick_part<D>& part : thick_parts(*body)) {
      const double most = root_rounded_down(oracle.square_to_walls(part.corners));
      if (part.feature == Body_feature::edge) {
        radii.push_back(world.random.chance(at_distance) ? most : most * world.random.real(0, 1));
        continue;
      }
      std::size_t side = 0;
      while (!std::ranges::includes(part.vertices, body->edges()[side])) ++side;
      radii[side] = std::min(radii[side], most);
    }
    if (!body->faces().empty() && world.random.chance(0.5))
      radii.assign(radii.size(), std::ranges::min(radii));
    if (std::ranges::any_of(radii, [](double r) { return !(r > 0x1p-30); })) return true;
    body->set_radii(radii);
    return false;
  });
}

/// Each edge and face keeps its distance, by the judge and by the body.
template <int D, class World>
int count_too_near(const World& world) {
  const Thick_oracle<D> oracle(world.snapshot);
  int wrong = 0;
  for (const auto& body : world.bodies) {
    EXPECT_NO_THROW(body->validate());
    for (const Thick_part<D>& part : thick_parts(*body))
      wrong += !root_is_at_least(oracle.square_to_walls(part.corners), part.radius);
  }
  return wrong;
}

/// How many worlds, also in a short run.
inline std::size_t some_worlds(std::size_t worlds) {
  return std::max<std::size_t>(oracle::scaled_count(worlds), 4);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_THICK_WORLD_H
