// SPDX-License-Identifier: LGPL-3.0-or-later
// Small traces in which much touches: boxes, targets and walls lie on one lattice, and all answers are those
// of brute force.
#ifndef CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H
#define CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H

#include <array>

#include "simulation/random_trace.h"
#include "simulation/trace_oracle.h"

namespace cellwalk::test {

struct Touching_trace_options {
  std::array<std::uint32_t, 3> cells{5, 4, 3};
  std::uint32_t bodies = 12, steps = 60;
  double obstacle_fraction = 0.15;
  int lattice = 4;  ///< points a unit of length
  std::uint64_t seed = 1;
};

/// Corners of a box on the lattice, whose sides are of at least half a unit.
inline std::array<Point<3>, trace_vertices> lattice_box(const Touching_trace_options& options,
                                                        Random& random) {
  const int n = options.lattice;
  Point<3> low, side;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = static_cast<double>(random.below(options.cells[k] * static_cast<unsigned>(n))) / n;
    side[k] = 0.5 + static_cast<double>(random.below(static_cast<unsigned>(n))) / n;
  }
  std::array<Point<3>, trace_vertices> corners;
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < 3; ++k) corners[v][k] = low[k] + ((v >> k & 1) == 0 ? 0 : side[k]);
  return corners;
}

/// Bodies that start where they can be registered; many of them touch walls there.
inline Trace touching_start(const Touching_trace_options& options, Random& random) {
  Trace trace;
  trace.nx = options.cells[0], trace.ny = options.cells[1], trace.nz = options.cells[2];
  trace.seed = options.seed;
  trace.obstacle_fraction = options.obstacle_fraction;
  for (std::uint32_t c = 0; c < trace.cells(); ++c)
    if (random.chance(options.obstacle_fraction)) trace.obstacles.push_back(c);
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  while (trace.bodies < options.bodies) {
    const auto corners = lattice_box(options, random);
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

/// The vertices of a body drift together, and each of them trembles by a point of the lattice.
inline Trace touching_trace(const Touching_trace_options& options) {
  Random random(options.seed);
  Trace trace = touching_start(options, random);
  const Trace_walls walls(trace);
  std::vector<Point<3>> positions = trace.start_positions;
  const auto step = [&] { return (static_cast<double>(random.below(3)) - 1) / options.lattice; };
  for (; trace.steps < options.steps; ++trace.steps)
    for (std::size_t b = 0; b < trace.bodies; ++b) {
      Vector<3> drift;
      for (double& d : drift) d = step();
      for (std::size_t v = 0; v < trace_vertices; ++v) {
        Point<3>& from = positions[b * trace_vertices + v];
        Point<3> target = from + drift;
        if (random.chance(0.3)) target[random.below(3)] += step();
        std::array<Point<3>, trace_edges> q;
        for (std::size_t k = 0; k < trace_edges; ++k)
          q[k] = positions[b * trace_vertices + trace_neighbour(v, k)];
        trace.targets.push_back(target);
        trace.answers.push_back(answer(walls, from, target, q));
        if ((trace.answers.back() & (trace_segment_bit | trace_edge_bits)) == 0) from = target;
      }
    }
  return trace;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H
