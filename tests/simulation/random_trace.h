// SPDX-License-Identifier: LGPL-3.0-or-later
// Small traces made at random: boxes that drift, turn round now and then, and tremble.
#ifndef CELLWALK_TESTS_SIMULATION_RANDOM_TRACE_H
#define CELLWALK_TESTS_SIMULATION_RANDOM_TRACE_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/target_recorder.h>
#include <cellwalk/internal/simulation/trace_environment.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cellwalk::test {

struct Random_trace_options {
  std::array<std::uint32_t, 3> cells{6, 5, 4};
  std::uint32_t bodies = 12, steps = 200;
  double obstacle_fraction = 0.15;  ///< solid cells may touch each other
  double body_side = 0.6, speed = 0.1;
  std::uint64_t seed = 1;
};

/// Where the vertices of a hexahedron are. Edges join vertex v to v^1, v^2 and v^4.
using Corners = std::array<Point<3>, 8>;

inline Traced_body hexahedron() {
  Traced_body body;
  body.vertices = 8;
  for (std::uint32_t v = 0; v < 8; ++v)
    for (const std::uint32_t w : {v ^ 1, v ^ 2, v ^ 4})
      if (v < w) body.edges.push_back({v, w});
  return body;
}

inline Corners box(const Point<3>& middle, double side, double tremble, Random& random) {
  Corners corners;
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      corners[v][k] = middle[k] + ((v >> k & 1) == 0 ? -0.5 : 0.5) * side + random.real(-tremble, tremble);
  return corners;
}

inline Vector<3> random_drift(double speed, Random& random) {
  Vector<3> drift;
  for (double& v : drift) v = random.real(-speed, speed);
  return drift;
}

/// A trace in which touches block, without steps: hexahedra in a grid in which each cell may be solid. They
/// start where they can be registered.
template <class Next_corners>
Body_trace start_of_hexahedra(const std::array<std::uint32_t, 3>& cells, double solid_share,
                              std::uint32_t bodies, Random& random, const Next_corners& next_corners) {
  Body_trace trace;
  trace.touch_blocks = true;
  Traced_grid& grid = trace.grid.emplace();
  grid.cells = cells;
  for (std::uint32_t c = 0; c < grid.cell_count(); ++c)
    if (random.chance(solid_share)) grid.solid.push_back(c);
  const Environment<3> environment = trace_environment(grid);
  const Locator<3> locator(environment.snapshot());
  while (trace.bodies.size() < bodies) {
    const Corners corners = next_corners();
    try {
      const Body<3> registered(environment.snapshot(), locator,
                               {{corners.begin(), corners.end()}, hexahedron().edges, {}});
    } catch (const Error&) {
      continue;
    }
    trace.before.insert(trace.before.end(), corners.begin(), corners.end());
    trace.bodies.push_back(hexahedron());
  }
  return trace;
}

inline Body_trace random_trace(const Random_trace_options& options) {
  Random start_random(options.seed);
  Body_trace start =
      start_of_hexahedra(options.cells, options.obstacle_fraction, options.bodies, start_random, [&] {
        Point<3> middle;
        for (std::size_t k = 0; k < 3; ++k) middle[k] = start_random.real(0, options.cells[k]);
        return box(middle, options.body_side, 0.01, start_random);
      });
  const Environment<3> environment = trace_environment(*start.grid);
  const Locator<3> locator(environment.snapshot());
  Target_recorder recorder(environment.snapshot(), locator, std::move(start));
  Random random(options.seed + 1);
  std::vector<Vector<3>> drifts(options.bodies);
  std::vector<Point<3>> targets;
  for (std::uint32_t step = 0; step < options.steps; ++step) {
    targets.clear();
    for (std::size_t b = 0; b < drifts.size(); ++b) {
      Point<3> middle = drifts[b];
      for (const Point<3>& x : recorder.bodies()[b].positions()) middle = middle + 0.125 * x;
      if (step == 0 || random.chance(0.1)) drifts[b] = random_drift(options.speed, random);
      const auto corners = box(middle, options.body_side, options.speed, random);
      targets.insert(targets.end(), corners.begin(), corners.end());
    }
    recorder.step(targets);
  }
  return recorder.trace();
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_RANDOM_TRACE_H
