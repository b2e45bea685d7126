// SPDX-License-Identifier: LGPL-3.0-or-later
// Grids with walls, membranes and solid cells, which change among small bodies: these lie anywhere, or on a
// lattice, so that nearly all is touched.
#ifndef CELLWALK_TESTS_RESHAPE_TOGGLE_WORLD_H
#define CELLWALK_TESTS_RESHAPE_TOGGLE_WORLD_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "oracle/seed.h"
#include "reshape/grids.h"

namespace cellwalk::test {

template <int D>
class Toggle_world {
 public:
  Toggle_world(std::uint64_t number, bool generic)
      : environment(simplex_grid<D>(size)),
        snapshot(environment.snapshot()),
        random(oracle::reseeded(number)),
        generic_(generic) {
    const double walls = 0.3 * random.real(0, 1), solid = 0.3 * random.real(0, 1);
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      if (random.chance(solid)) environment.fill(snapshot.cell(i));
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k <= D; ++k)
        if (random.chance(walls))
          environment.set_impassable(Snapshot<D>::half_facet(snapshot.cell(i), k), true);
    if (generic_)
      for (std::uint32_t p = 0; p < snapshot.points().size(); ++p) {
        Point<D> x = snapshot.point(p);
        for (double& c : x) c += random.real(-0.1, 0.1);
        try {
          environment.move_vertex(p, x);
        } catch (const Error&) {  // into itself
        }
      }
  }
  Toggle_world(const Toggle_world&) = delete;
  Toggle_world& operator=(const Toggle_world&) = delete;

  void populate(std::size_t particle_count, std::size_t body_count) {
    const Locator<D> locator(snapshot);
    for (int tries = 0; particles.size() < particle_count && tries < 100; ++tries) {
      const auto sides = locator.particles_at(place());
      if (!sides.empty()) particles.push_back(sides[random.below(sides.size())]);
    }
    for (int tries = 0; bodies.size() < body_count && tries < 200; ++tries) {
      Body_soup<D> soup;
      const std::size_t n = 2 + random.below(3);
      soup.points.push_back(place());
      for (std::size_t i = 1; i < n; ++i) soup.points.push_back(beside(soup.points[random.below(i)]));
      for (std::uint32_t i = 1; i < n; ++i) soup.edges.push_back({i - 1, i});
      if (n > 2 && random.chance(0.6)) {
        soup.edges.push_back({0, 2});
        soup.faces.push_back({0, 1, 2});
        if (n > 3 && random.chance(0.5)) {
          soup.edges.push_back({1, 3});
          soup.faces.push_back({1, 2, 3});
        }
      }
      std::sort(soup.edges.begin(), soup.edges.end());
      try {
        bodies.push_back(std::make_unique<Body<D>>(snapshot, locator, soup));
      } catch (const Error&) {  // across a wall
      }
    }
  }

  Residents<D> residents() {
    Residents<D> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }

  void step_bodies() {
    Step_report<D> report;
    Body_counts counts;
    for (const auto& body : bodies) {
      if (random.chance(0.3)) continue;
      Body_options options;
      options.sweep.sweep = D == 3 && !body->faces().empty() ? Sweep::faces : Sweep::triangle;
      options.rule = random.chance(0.5) ? Step_rule::slide : Step_rule::reject;
      options.clearance = random.chance(0.8);
      for (std::size_t k = 0; k < 2; ++k) {
        std::vector<Point<D>> targets(body->positions().begin(), body->positions().end());
        const Point<D> by = step();
        for (Point<D>& x : targets)
          for (std::size_t c = 0; c < D; ++c) x[c] += by[c];
        body->step(targets, options, report, counts);
      }
    }
  }

  /// A cell, of a resident in most cases.
  Cell cell() {
    if (bodies.empty() || random.chance(0.1))
      for (;;)
        if (const Cell c = snapshot.cell(random.below(snapshot.cell_slots())); c != Cell::none) return c;
    if (!particles.empty() && random.chance(0.2)) return particles[random.below(particles.size())].cell;
    Body<D>& body = *bodies[random.below(bodies.size())];
    if (const auto& chain = body.chain(random.below(body.edges().size()));
        !chain.empty() && random.chance(0.6))
      return snapshot.cell_of(chain[random.below(chain.size())]);
    return body.particles()[random.below(body.vertex_count())].cell;
  }

  static constexpr std::uint32_t size = D == 2 ? 4 : 3;
  Environment<D> environment;
  const Snapshot<D>& snapshot;
  Random random;
  std::vector<Particle<D>> particles;
  std::vector<std::unique_ptr<Body<D>>> bodies;

 private:
  double somewhere(double low, double high) {
    return generic_ ? random.real(low, high) : low + (high - low) * static_cast<double>(random.below(9)) / 8;
  }
  Point<D> place() {
    Point<D> x;
    for (double& c : x) {
      c = somewhere(0, size);
      if (!generic_ && random.chance(0.5)) c = static_cast<double>(random.below(size + 1));
    }
    return x;
  }
  Point<D> beside(Point<D> x) {
    for (double& c : x)
      if (generic_ || random.chance(0.6)) c += somewhere(-1, 1);
    return x;
  }
  Point<D> step() {
    Point<D> x{};
    for (double& c : x)
      if (generic_ || random.chance(0.6)) c = somewhere(-0.5, 0.5);
    return x;
  }

  bool generic_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_TOGGLE_WORLD_H
