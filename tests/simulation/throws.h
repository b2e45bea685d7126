// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies thrown around, and what must hold of them.
#ifndef CELLWALK_TESTS_SIMULATION_THROWS_H
#define CELLWALK_TESTS_SIMULATION_THROWS_H

#include <cellwalk/generators/transform.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/rigid_body.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace cellwalk::test {

/// Bodies at random places where they fit, thrown in random directions.
template <int D>
std::vector<Rigid_body<D>> throw_bodies(const Snapshot<D>& snapshot, const Body_soup<D>& shape, int count,
                                        double speed, std::uint64_t seed) {
  const Locator<D> locator(snapshot);
  Random random(seed);
  std::vector<Rigid_body<D>> result;
  for (int tries = 0; static_cast<int>(result.size()) < count; ++tries) {
    if (tries == 10000) {
      ADD_FAILURE() << "no room for bodies";
      break;
    }
    const auto vertex = static_cast<std::uint32_t>(random.below(snapshot.points().size()));
    Body_placement<D> placement;
    placement.rotation.degrees = random.real(0, 360);
    Vector<D> velocity;
    Spin<D> spin;
    for (int k = 0; k < D; ++k) {
      placement.position[k] = snapshot.point(vertex)[k] + random.real(-1, 1);
      velocity[k] = speed * random.real(-1, 1);
    }
    for (double& x : spin) x = random.real(-2, 2);
    try {
      result.emplace_back(Body<D>(snapshot, locator, transformed(shape, placement)), velocity, spin);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::outside);
    }
  }
  return result;
}

/// What was seen of flights.
struct Flown {
  Body_counts counts;
  std::uint64_t contacts = 0, edge_contacts = 0, face_contacts = 0, validated = 0, differing = 0, stuck = 0;
};

/// Throws bodies, each twice: with clearance and without. They must do the same, bit for bit; I1 and I2 hold
/// every so many steps; and every body keeps moving.
template <int D>
Flown fly(const Snapshot<D>& snapshot, const Body_soup<D>& shape, int bodies, int steps, double time_step,
          int steps_between_checks, std::uint64_t seed, bool compare, const Body_options& options = {}) {
  Flown flown;
  std::vector<Rigid_body<D>> rigid_bodies = throw_bodies(snapshot, shape, bodies, 1.0, seed);
  std::vector<Rigid_body<D>> plain = rigid_bodies;
  Dynamics_options<D> conditions, without;
  conditions.time_step = time_step;
  conditions.body = options;
  without = conditions;
  without.body.clearance = false;
  Step_report<D> report, others;
  std::vector<double> way(rigid_bodies.size());
  Body_counts plain_counts;
  for (int s = 0; s < steps; ++s)
    for (std::size_t i = 0; i < rigid_bodies.size(); ++i) {
      const Point<D> before = rigid_bodies[i].body().positions()[0];
      report.clear();
      rigid_bodies[i].step(conditions, report, flown.counts);
      flown.contacts += report.contacts.size();
      for (const auto& c : report.contacts) {
        flown.edge_contacts += c.body == Body_feature::edge;
        flown.face_contacts += c.body == Body_feature::face;
      }
      if (compare) {
        others.clear();
        plain[i].step(without, others, plain_counts);
        bool is_same = others.contacts.size() == report.contacts.size();
        for (std::uint32_t v = 0; v < shape.points.size(); ++v)
          is_same = is_same && rigid_bodies[i].body().positions()[v] == plain[i].body().positions()[v];
        flown.differing += !is_same;
      }
      if (s >= steps / 2) way[i] += length(rigid_bodies[i].body().positions()[0] - before);
      if (s % steps_between_checks != 0 && s + 1 != steps) continue;
      rigid_bodies[i].body().refresh(flown.counts);
      EXPECT_NO_THROW(rigid_bodies[i].body().validate());
      ++flown.validated;
    }
  for (std::size_t i = 0; i < rigid_bodies.size(); ++i)
    flown.stuck += !(way[i] > 0.02 * length(rigid_bodies[i].velocity()) * time_step * steps / 2);
  return flown;
}

template <int D>
void expect_flights_are_sound(const Snapshot<D>& snapshot, const Body_soup<D>& shape, int bodies, int steps) {
  const Flown flown = fly<D>(snapshot, shape, bodies, steps, 0.05, 5, 7, true);
  const Body_counts& c = flown.counts;
  std::cout << c.moves << " moves, " << c.in_region << " in regions (" << c.regions << ", " << c.no_region
            << " not found), " << flown.contacts << " contacts, " << flown.edge_contacts << " by edges, "
            << c.stop_tries << " tries to stop, " << c.held << " held; edges " << c.edges.edges
            << ": same cell " << c.edges.same_cell << ", same chain " << c.edges.same_chain << ", relinked "
            << c.edges.relinked << ", events " << c.edges.event_sweeps << "; " << flown.stuck << " stuck\n";
  EXPECT_EQ(flown.differing, 0u) << "clearance changes what happens";
  EXPECT_EQ(flown.stuck, 0u);
  EXPECT_GT(flown.contacts, 100u);
  EXPECT_GT(flown.edge_contacts, 10u);
  EXPECT_GT(c.in_region, 100u);
  EXPECT_GT(c.catch_ups, 100u);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_THROWS_H
