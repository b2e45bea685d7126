// SPDX-License-Identifier: LGPL-3.0-or-later
// The cost of a contact with an oblique wall: its time alone, beside the same by exact numbers; where the
// motion is at that time; and a whole contact of a particle, which walks into a wall of a jittered
// tetrahedral grid, one facet in eight a wall, has its contact located exactly, and stops at a verified
// position.
//
// Run natively: under valgrind rounding has no direction, and CGAL's intervals take other paths.
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <vector>

namespace {

using namespace cellwalk;

constexpr std::size_t sample_count = 4096;

/// Motions across planes in general position, or across planes of one coordinate.
std::vector<Crossing<3>> crossings(bool oblique) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&] { return Point<3>{unit(random), unit(random), unit(random)}; };
  std::vector<Crossing<3>> result;
  while (result.size() < sample_count) {
    Crossing<3> c{draw(), draw(), {draw(), draw(), draw()}};
    if (!oblique)
      for (Point<3>& x : c.plane) x[2] = 0.25;
    const auto side = [&](const Point<3>& x) {
      Predicate_counts counts;
      return Exact::orientation(counts, c.plane[0], c.plane[1], c.plane[2], x);
    };
    if (side(c.a) * side(c.b) < 0) result.push_back(c);
  }
  return result;
}

template <class Compute>
void for_each_crossing(benchmark::State& state, bool oblique, const Compute& compute) {
  const auto sample = crossings(oblique);
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(compute(sample[k++ % sample.size()]));
}

void time_certified(benchmark::State& state, bool oblique) {
  for_each_crossing(state, oblique, [](const Crossing<3>& c) { return crossing_time(c); });
}
void time_exact(benchmark::State& state, bool oblique) {
  for_each_crossing(state, oblique, [](const Crossing<3>& c) { return rounded_down(fraction_of(c)).value; });
}
void time_rational(benchmark::State& state, bool oblique) {
  for_each_crossing(state, oblique,
                    [](const Crossing<3>& c) { return CGAL::to_double(to_rational(fraction_of(c))); });
}
void place(benchmark::State& state, bool oblique) {
  for_each_crossing(state, oblique,
                    [](const Crossing<3>& c) { return bounds_at<3>(c.a, c.b, to_time(c)).below[0]; });
}

/// Particles that move into walls.
struct Motion {
  Particle<3> from;
  Point<3> target;
};

void contact_with_stop(benchmark::State& state) {
  Simplex_grid_options<3> options;
  options.cells = {12, 12, 12};
  options.jitter = 0.12;
  Cell_soup<3> soup = tetrahedral_grid(options);
  std::mt19937_64 random(2);
  for (auto& is_wall : soup.impassable) is_wall = random() % 16 == 0;
  const auto snapshot = Snapshot<3>::compile(soup, glue(soup));
  const Locator<3> locator(snapshot);
  std::uniform_real_distribution<double> inside(0.5, 11.5), step(-0.3, 0.3);
  std::vector<Motion> motions;
  Walk_counts counts;
  while (motions.size() < sample_count) {
    const Point<3> a{inside(random), inside(random), inside(random)};
    const auto here = locator.locate(a);
    if (here.sides.empty()) continue;
    const Motion motion{here.sides.front(), a + Vector<3>{step(random), step(random), step(random)}};
    if (walk(snapshot, motion.from, motion.target, counts).contact) motions.push_back(motion);
  }
  std::size_t k = 0, stopped = 0;
  for (auto _ : state) {
    const Motion& motion = motions[k++ % motions.size()];
    Particle<3> p = motion.from;
    const auto walked = move(snapshot, p, motion.target, counts);
    const Contact<3> contact =
        vertex_contact(snapshot, motion.from.position, motion.target, *walked.contact, counts);
    p = motion.from;
    stopped += stop_at_contact(snapshot, p, motion.target, contact, counts);
    benchmark::DoNotOptimize(p);
  }
  state.counters["stopped"] = static_cast<double>(stopped) / static_cast<double>(k);
}

BENCHMARK_CAPTURE(time_certified, oblique, true);
BENCHMARK_CAPTURE(time_exact, oblique, true);
BENCHMARK_CAPTURE(time_rational, oblique, true);
BENCHMARK_CAPTURE(time_certified, axis_parallel, false);
BENCHMARK_CAPTURE(time_exact, axis_parallel, false);
BENCHMARK_CAPTURE(time_rational, axis_parallel, false);
BENCHMARK_CAPTURE(place, oblique, true);
BENCHMARK_CAPTURE(place, axis_parallel, false);
BENCHMARK(contact_with_stop);

}  // namespace
