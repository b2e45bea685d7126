// SPDX-License-Identifier: LGPL-3.0-or-later
// Small traces in which much touches: boxes, targets and walls lie on one lattice, and all answers are those
// of brute force.
#ifndef CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H
#define CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H

#include <algorithm>
#include <array>
#include <vector>

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
inline Corners lattice_box(const Touching_trace_options& options, Random& random) {
  const int n = options.lattice;
  Point<3> low, side;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = static_cast<double>(random.below(options.cells[k] * static_cast<unsigned>(n))) / n;
    side[k] = 0.5 + static_cast<double>(random.below(static_cast<unsigned>(n))) / n;
  }
  Corners corners;
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t k = 0; k < 3; ++k) corners[v][k] = low[k] + ((v >> k & 1) == 0 ? 0 : side[k]);
  return corners;
}

/// Many bodies touch walls at the start. The vertices of a body drift together, and each of them trembles by
/// a point of the lattice.
inline Body_trace touching_trace(const Touching_trace_options& options) {
  Random random(options.seed);
  Body_trace trace = start_of_hexahedra(options.cells, options.obstacle_fraction, options.bodies, random,
                                        [&] { return lattice_box(options, random); });
  const Trace_walls walls(*trace.grid);
  std::vector<Point<3>> positions = trace.before;
  const auto step = [&] { return (static_cast<double>(random.below(3)) - 1) / options.lattice; };
  for (; trace.steps < options.steps; ++trace.steps) {
    for (std::size_t first = 0; first < positions.size(); first += 8) {
      Vector<3> drift;
      for (double& d : drift) d = step();
      for (std::size_t v = 0; v < 8; ++v) {
        Point<3>& from = positions[first + v];
        Point<3> target = from + drift;
        if (random.chance(0.3)) target[random.below(3)] += step();
        std::array<std::size_t, 3> others{v ^ 1, v ^ 2, v ^ 4};
        std::ranges::sort(others);
        std::vector<Point<3>> neighbours;
        for (const std::size_t w : others) neighbours.push_back(positions[first + w]);
        const auto answers = answers_where_touches_block(walls, from, target, neighbours);
        trace.answers.insert(trace.answers.end(), answers.begin(), answers.end());
        trace.targets.push_back(target);
        if (std::ranges::none_of(answers, [](unsigned a) { return (a & body_trace_blocked) != 0; }))
          from = target;
      }
    }
    trace.before.insert(trace.before.end(), positions.begin(), positions.end());
  }
  return trace;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_TOUCHING_TRACE_H
