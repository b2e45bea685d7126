// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds in which bodies move and walls are edited between moves of vertices, and which may be listed in
// another order or be of another size.
#ifndef CELLWALK_TESTS_RESHAPE_RESTLESS_WORLD_H
#define CELLWALK_TESTS_RESHAPE_RESTLESS_WORLD_H

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "body/random_edits.h"
#include "edge/relisted.h"
#include "reshape/reshape_world.h"

namespace cellwalk::test {

template <int D>
class Restless_world : public Reshape_world<D> {
 public:
  using Base = Reshape_world<D>;
  using Base::bodies, Base::environment, Base::particles, Base::random, Base::snapshot;

  Restless_world(std::uint64_t number, bool generic)
      : Base(made(number), number, generic), generic_(generic) {}

  /// Some edits near what lies there; everything is registered anew. An edit that leaves no room for a body
  /// is taken back.
  void edit() {
    std::vector<std::function<void()>> back;
    const std::size_t count = random.below(4);
    for (std::size_t k = 0; k < count; ++k) {
      const Cell cell = some_cell();
      if (environment.is_frozen() || !snapshot.is_cell(cell)) continue;
      if (auto taken_back = edit_near(environment, cell, random, generic_)) back.push_back(*taken_back);
    }
    edits += back.size();
    if (!register_all())
      while (!back.empty()) {
        try {
          back.back()();
        } catch (const Error&) {  // a cell that was replaced meanwhile
        }
        back.pop_back();
        if (register_all()) break;
      }
    if (back.empty() && !register_all()) drop_strays();
    locate_particles();
  }

  /// Some bodies move a little, and leave it to the next one who asks to register that.
  void step_bodies() {
    Step_report<D> report;
    Body_counts counts;
    for (const auto& body : bodies) {
      if (random.chance(0.4)) continue;
      Body_options options;
      options.sweep.sweep = D == 3 && !body->faces().empty() ? Sweep::faces : Sweep::triangle;
      options.rule = random.chance(0.5) ? Step_rule::slide : Step_rule::reject;
      options.clearance = random.chance(0.8);
      const double unit = std::ldexp(Base::unit_, static_cast<int>(random.below(6)));
      const std::size_t steps = 1 + random.below(3);
      for (std::size_t k = 0; k < steps; ++k) {
        std::vector<Point<D>> targets(body->positions().begin(), body->positions().end());
        for (Point<D>& x : targets)
          for (double& c : x)
            c += unit * (generic_ ? random.real(-1, 1) : static_cast<double>(random.below(3)) - 1);
        body->step(targets, options, report, counts);
      }
      if (random.chance(0.2)) body->refresh(counts);
    }
    in_region += counts.in_region;
  }

  std::uint64_t edits = 0, in_region = 0, dropped = 0;

 private:
  static oracle::World<D> made(std::uint64_t number) {
    oracle::World<D> world = oracle::make_world<D>(number);
    const std::uint64_t turn = number / oracle::world_kinds;
    if (turn % 3 == 1) {
      world.soup = relisted(world.soup, number).soup;
      world.name += ", relisted";
    }
    if (turn % 4 == 2) {
      const double scale = turn % 8 == 2 ? 0x1p-90 : 0x1p90;
      for (Point<D>& x : world.soup.points) x = Point<D>{} + scale * (x - Point<D>{});
      world.name += ", scaled";
    }
    return world;
  }

  Cell some_cell() {
    if (bodies.empty() || random.chance(0.2)) return snapshot.cell(0);
    const Body<D>& body = *bodies[random.below(bodies.size())];
    return body.particles()[random.below(body.vertex_count())].cell;
  }

  bool register_all() {
    const Locator<D> locator(snapshot);
    bool are_registered = true;
    for (const auto& body : bodies) try {
        body->register_again(locator);
      } catch (const Error&) {
        are_registered = false;
      }
    return are_registered;
  }

  void drop_strays() {
    const Locator<D> locator(snapshot);
    dropped += std::erase_if(bodies, [&](const auto& body) {
      try {
        body->register_again(locator);
        return false;
      } catch (const Error&) {
        return true;
      }
    });
  }

  void locate_particles() {
    const Locator<D> locator(snapshot);
    std::vector<Particle<D>> located;
    for (const Particle<D>& p : particles) {
      const auto sides = locator.particles_at(p.position);
      if (!sides.empty()) located.push_back(sides[random.below(sides.size())]);
    }
    particles = std::move(located);
  }

  bool generic_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_RESTLESS_WORLD_H
