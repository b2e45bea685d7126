// SPDX-License-Identifier: LGPL-3.0-or-later
// A long run: different bodies thrown around in one environment.
#ifndef CELLWALK_TESTS_SIMULATION_LONG_FLIGHT_H
#define CELLWALK_TESTS_SIMULATION_LONG_FLIGHT_H

#include <cellwalk/generators/body_shapes.h>

#include "simulation/throws.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {

/// Throws hexahedra, spheres and catheters of about this size for so many moves of vertices in CI; ten times
/// as many in the long test.
inline void expect_long_flights_are_sound(const Snapshot<3>& snapshot, double size, std::size_t moves_in_ci) {
  const Body_soup<3> shapes[] = {hexahedron_body(size, false), icosphere_body(0.6 * size, 1),
                                 catheter_body<3>(3 * size, 12)};
  constexpr int bodies = 10;
  const double step = 0.1 * size;  // at speed 1
  for (const Body_soup<3>& shape : shapes) {
    const std::size_t moves = oracle::scaled_count(moves_in_ci) / std::size(shapes);
    const auto steps = static_cast<int>(moves / (bodies * shape.points.size()));
    const Flown flown = fly<3>(snapshot, shape, bodies, steps, step, 20, 11, false);
    const Body_counts& c = flown.counts;
    std::cout << shape.points.size() << " vertices, " << shape.edges.size() << " edges: " << c.moves
              << " moves, " << c.in_region << " in regions, " << flown.contacts << " contacts, "
              << flown.edge_contacts << " of them of edges, " << c.edges.event_sweeps << " event sweeps, "
              << flown.validated << " validations, " << flown.stuck << " stuck\n";
    EXPECT_EQ(flown.stuck, 0u);
    EXPECT_GT(flown.validated, 10u);
    if (!oracle::is_shortened()) {
      EXPECT_GT(flown.contacts, 20u);
    }
  }
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_LONG_FLIGHT_H
