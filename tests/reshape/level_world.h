// SPDX-License-Identifier: LGPL-3.0-or-later
// Pieces of a membrane at height 2 of a grid, which beat around that height, among bodies whose faces, edges
// and vertices lie at it: nearly all is touched.
#ifndef CELLWALK_TESTS_RESHAPE_LEVEL_WORLD_H
#define CELLWALK_TESTS_RESHAPE_LEVEL_WORLD_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <memory>
#include <string>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk::test {

class Level_world {
 public:
  explicit Level_world(std::uint64_t number)
      : environment(simplex_grid<3>(4)), snapshot(environment.snapshot()), random(number), number_(number) {
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
        bool is_level = true;
        for (const std::uint32_t v : snapshot.loop(f)) is_level &= snapshot.point(v)[2] == 2;
        if (is_level && f < snapshot.opposite(f) && random.chance(0.6)) environment.set_impassable(f, true);
      }
    for (double x = 1; x < 4; ++x)
      for (double y = 1; y < 4; ++y) vertices_.push_back(point_at<3>(environment, {x, y, 2}));
  }
  Level_world(const Level_world&) = delete;

  std::string name() const { return "level world " + std::to_string(number_); }

  void populate(std::size_t particle_count, std::size_t body_count) {
    const Locator<3> locator(snapshot);
    while (particles.size() < particle_count) {
      const auto sides = locator.particles_at(place(2));
      if (!sides.empty()) particles.push_back(sides[random.below(sides.size())]);
    }
    for (int tries = 0; bodies.size() < body_count && tries < 100; ++tries) {
      const double level = random.chance(0.7) ? 2 : height();
      Body_soup<3> soup{{place(level), place(level), place(random.chance(0.7) ? level : height())},
                        {{0, 1}, {0, 2}, {1, 2}},
                        {{0, 1, 2}}};
      try {
        bodies.push_back(std::make_unique<Body<3>>(snapshot, locator, soup));
      } catch (const Error&) {  // across a wall
      }
    }
  }

  Residents<3> residents() {
    Residents<3> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }
  std::uint32_t vertex() { return vertices_[random.below(vertices_.size())]; }
  Point<3> target(std::uint32_t v) {
    Point<3> x = snapshot.point(v);
    if (random.chance(0.4))
      for (std::size_t k = 0; k < 2; ++k) x[k] += (static_cast<double>(random.below(5)) - 2) / 8;
    x[2] = random.chance(0.5) ? 2 : height();
    return x;
  }

  Environment<3> environment;
  const Snapshot<3>& snapshot;
  Random random;
  std::vector<Particle<3>> particles;
  std::vector<std::unique_ptr<Body<3>>> bodies;

 private:
  double height() { return 1.5 + static_cast<double>(random.below(9)) / 8; }
  Point<3> place(double level) {
    return {0.5 + static_cast<double>(random.below(25)) / 8, 0.5 + static_cast<double>(random.below(25)) / 8,
            level};
  }

  std::uint64_t number_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_LEVEL_WORLD_H
