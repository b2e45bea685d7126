// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds whose bodies have radii, and the judge of their distances from walls, in rationals.
#ifndef CELLWALK_TESTS_RESHAPE_THICK_WORLD_H
#define CELLWALK_TESTS_RESHAPE_THICK_WORLD_H

#include <cellwalk/body/body.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "edge/thick_oracle.h"
#include "kernel/rational_distance.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {

/// Gives each edge of the bodies of a world a radius of up to its distance from walls, some of them just
/// that. Bodies that touch walls are dropped.
template <int D, class World>
void give_radii(World& world, double at_distance) {
  const Thick_oracle<D> oracle(world.snapshot);
  std::erase_if(world.bodies, [&](const std::unique_ptr<Body<D>>& body) {
    std::vector<double> radii;
    for (const auto& [u, v] : body->edges()) {
      const double most =
          root_rounded_down(oracle.square_to_walls(std::array{body->positions()[u], body->positions()[v]}));
      radii.push_back(world.random.chance(at_distance) ? most : most * world.random.real(0, 1));
    }
    if (std::ranges::any_of(radii, [](double r) { return !(r > 0x1p-30); })) return true;
    body->set_radii(radii);
    return false;
  });
}

/// Each edge keeps its distance, by the judge and by the body.
template <int D, class World>
int count_too_near(const World& world) {
  const Thick_oracle<D> oracle(world.snapshot);
  int wrong = 0;
  for (const auto& body : world.bodies) {
    EXPECT_NO_THROW(body->validate());
    for (std::size_t e = 0; e < body->edges().size(); ++e) {
      const auto& [u, v] = body->edges()[e];
      wrong += !root_is_at_least(
          oracle.square_to_walls(std::array{body->positions()[u], body->positions()[v]}), body->radius(e));
    }
  }
  return wrong;
}

/// How many worlds, also in a short run.
inline std::size_t some_worlds(std::size_t worlds) {
  return std::max<std::size_t>(oracle::scaled_count(worlds), 4);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_THICK_WORLD_H
