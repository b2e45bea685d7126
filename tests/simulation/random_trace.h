// SPDX-License-Identifier: LGPL-3.0-or-later
// Small traces made at random: boxes that drift, turn round now and then, and tremble.
#ifndef CELLWALK_TESTS_SIMULATION_RANDOM_TRACE_H
#define CELLWALK_TESTS_SIMULATION_RANDOM_TRACE_H

#include <cellwalk/internal/simulation/trace_environment.h>
#include <cellwalk/internal/simulation/trace_recorder.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/random.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace cellwalk::test {

struct Random_trace_options {
  std::array<std::uint32_t, 3> cells{6, 5, 4};
  std::uint32_t bodies = 12, steps = 200;
  double obstacle_fraction = 0.15;  ///< solid cells may touch each other
  double body_side = 0.6, speed = 0.1;
  std::uint64_t seed = 1;
};

inline Body_soup<3> trace_body_at(const Point<3>* first) {
  return trace_body_soup(std::span<const Point<3>, trace_vertices>(first, trace_vertices));
}

inline std::array<Point<3>, trace_vertices> box(const Point<3>& middle, double side, double tremble,
                                                Random& random) {
  std::array<Point<3>, trace_vertices> corners;
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      corners[v][k] = middle[k] + ((v >> k & 1) == 0 ? -0.5 : 0.5) * side + random.real(-tremble, tremble);
  return corners;
}

inline Vector<3> random_drift(double speed, Random& random) {
  Vector<3> drift;
  for (double& v : drift) v = random.real(-speed, speed);
  return drift;
}

/// Header, solid cells and starts of a trace.
inline Trace random_start(const Random_trace_options& options) {
  Random random(options.seed);
  Trace trace;
  trace.nx = options.cells[0], trace.ny = options.cells[1], trace.nz = options.cells[2];
  trace.seed = options.seed;
  trace.obstacle_fraction = options.obstacle_fraction;
  trace.body_side = options.body_side;
  trace.speed = options.speed;
  for (std::uint32_t c = 0; c < trace.cells(); ++c)
    if (random.chance(options.obstacle_fraction)) trace.obstacles.push_back(c);
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  while (trace.bodies < options.bodies) {
    Point<3> middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = random.real(0, options.cells[k]);
    const auto corners = box(middle, options.body_side, 0.01, random);
    try {
      const Body<3> registered(environment.snapshot(), locator, trace_body_soup(corners));
    } catch (const Error&) {
      continue;
    }
    trace.start_positions.insert(trace.start_positions.end(), corners.begin(), corners.end());
    ++trace.bodies;
  }
  return trace;
}

inline Trace random_trace(const Random_trace_options& options) {
  Trace start = random_start(options);
  const Environment<3> environment = trace_environment(start);
  Trace_recorder recorder(environment.snapshot(), Locator<3>(environment.snapshot()), std::move(start));
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
