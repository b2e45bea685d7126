// SPDX-License-Identifier: LGPL-3.0-or-later
// Whatever takes coordinates or a particle refuses what is not finite, and particles without a cell, and
// leaves the particle as it was.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/query/kernel_choice.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "query/refusal.h"

namespace cellwalk {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double not_finite_numbers[] = {not_a_number, -not_a_number, unbounded, -unbounded};

template <int D>
Environment<D> grid_of(std::uint32_t cells) {
  Grid_options<D> options;
  options.cells.fill(cells);
  if constexpr (D == 2)
    return Environment<D>::build(square_grid(options));
  else
    return Environment<D>::build(hex_grid(options));
}

template <int D>
Point<D> all(double x) {
  Point<D> p;
  p.fill(x);
  return p;
}

/// Every function that takes points, each by its number: calls it with x for one of them.
template <int D>
struct Point_calls {
  const Snapshot<D>& snapshot;
  const Locator<D>& locator;

  static constexpr int count = 24;

  void call(int number, const Point<D>& x) const {
    const Point<D> here = all<D>(0.5), there = all<D>(1.5), near = all<D>(0.625);
    const Particle<D> particle = locator.particle_at(here).value(),
                      other = locator.particle_at(there).value();
    Particle<D> bad = particle, moved = particle;
    bad.position = x;
    Edge_counts counts;
    Walk_counts& walks = counts.walk;
    const Chain chain = find_chain(snapshot, particle, other, walks).chain;
    const auto exit_rule = Walk_strategy::exit_rule, forecast = Walk_strategy::predictive_simplex;
    const Walk_method in_floats{Kernel_choice::float_precision, exit_rule};
    switch (number) {
      case 0:
        return void(move(snapshot, moved, x, walks));
      case 1:
        return void(move(snapshot, moved, x, walks, exit_rule));
      case 2:
        return void(move(snapshot, moved, x, walks, forecast));
      case 3:
        return void(walk(snapshot, particle, x, walks));
      case 4:
        return void(walk<Lazy>(snapshot, particle, x, walks));
      case 5:
        return void(walk<Double>(snapshot, particle, x, walks, exit_rule));
      case 6:
        return void(walk<Float>(snapshot, particle, x, walks, exit_rule));
      case 7:
        return void(walk(snapshot, bad, all<D>(9), walks));
      case 8:
        return void(walk(snapshot, bad, there, walks));
      case 9:
        return void(locator.locate(x));
      case 10:
        return void(locator.particle_at(x));
      case 11:
        return void(locator.particles_at(x));
      case 12:
        return void(first_touch(snapshot, particle, x, counts));
      case 13:
        return void(closed_meeting<D>(snapshot, particle.cell, {x, near, there}, counts));
      case 14:
        return void(closed_meeting<D>(snapshot, particle.cell, {here, x, there}, counts));
      case 15:
        return void(closed_meeting<D>(snapshot, particle.cell, {here, near, x}, counts));
      case 16:
        return void(sweep_edge(snapshot, particle, x, other, chain, {}, counts));
      case 17:
        return void(sweep_edge(snapshot, other, near, bad, reversed(snapshot, chain), {}, counts));
      case 18:
        return void(answer_move(snapshot, locator, x, there, {}, counts));
      case 19:
        return void(answer_move(snapshot, locator, here, x, Touch::stop, counts));
      case 20:
        return void(answer_move(snapshot, locator, here, x, Touch::pass, in_floats, counts));
      case 21:
        return void(answer_sweep<D>(snapshot, locator, {x, near, there}, {}, counts));
      case 22:
        return void(answer_sweep<D>(snapshot, locator, {here, x, there}, {}, counts));
      default:
        return void(answer_sweep<D>(snapshot, locator, {here, near, x}, {}, counts));
    }
  }
};

template <int D>
void expect_points_are_refused() {
  const Environment<D> environment = grid_of<D>(4);
  const Locator<D> locator(environment.snapshot());
  const Point_calls<D> calls{environment.snapshot(), locator};
  int refused = 0;
  for (int number = 0; number < calls.count; ++number) {
    EXPECT_FALSE(test::refusal_of([&] { calls.call(number, all<D>(0.75)); })) << number;
    for (const double bad : not_finite_numbers)
      for (std::size_t k = 0; k < D; ++k) {
        Point<D> x = all<D>(0.75);
        x[k] = bad;
        const auto code = test::refusal_of([&] { calls.call(number, x); });
        EXPECT_EQ(code, Error_code::input) << number << ", " << bad << " as coordinate " << k;
        refused += code.has_value();
      }
  }
  EXPECT_EQ(refused, calls.count * 4 * D);
}

TEST(RefusedQueries, PointsThatAreNotFinite) {
  expect_points_are_refused<2>();
  expect_points_are_refused<3>();
}

/// The same of particles.
template <int D>
void expect_particles_are_refused() {
  Environment<D> environment = grid_of<D>(3);
  const Cell removed = Locator<D>(environment.snapshot()).particle_at(all<D>(1.5)).value().cell;
  const std::uint32_t last = static_cast<std::uint32_t>(environment.snapshot().half_facet_slots() / 4);
  environment.insert_point(removed, all<D>(1.4375));
  const Snapshot<D>& snapshot = environment.snapshot();
  const Locator<D> locator(snapshot);
  const Particle<D> good = locator.particle_at(all<D>(0.5)).value();
  ASSERT_FALSE(snapshot.is_cell(removed));
  int refused = 0;
  for (const Cell cell : {Cell::none, Cell{last + 1000}, Cell{0xfffffff0u}, removed}) {
    Particle<D> bad{all<D>(1.5), cell, D, 0};
    const Particle<D> before = bad;
    Edge_counts counts;
    const auto exit_rule = Walk_strategy::exit_rule;
    const std::vector<std::function<void(const Point<D>&)>> calls{
        [&](const Point<D>& x) { move(snapshot, bad, x, counts.walk); },
        [&](const Point<D>& x) { move(snapshot, bad, x, counts.walk, exit_rule); },
        [&](const Point<D>& x) { move<Double>(snapshot, bad, x, counts.walk, exit_rule); },
        [&](const Point<D>& x) { walk(snapshot, bad, x, counts.walk); },
        [&](const Point<D>& x) { first_touch(snapshot, bad, x, counts); },
        [&](const Point<D>& x) {
          closed_meeting<D>(snapshot, bad.cell, {bad.position, x, x}, counts);
        },
        [&](const Point<D>& x) { sweep_edge(snapshot, bad, x, good, {}, {}, counts); },
        [&](const Point<D>& x) { sweep_edge(snapshot, good, x, bad, {}, {}, counts); },
        [&](const Point<D>&) { find_chain(snapshot, bad, good, counts.walk); }};
    for (const double target : {1.5, 1.625, 2.5, 9.0})
      for (const auto& call : calls) {
        const auto code = test::refusal_of([&] { call(all<D>(target)); });
        EXPECT_EQ(code, Error_code::usage)
            << to_index(cell) << " to " << target << ", call " << &call - calls.data();
        refused += code.has_value();
        EXPECT_EQ(std::memcmp(&bad, &before, sizeof bad), 0);
      }
    EXPECT_FALSE(in_closure(snapshot, cell, all<D>(1.5)));
  }
  EXPECT_EQ(refused, 4 * 4 * 9);
}

TEST(RefusedQueries, ParticlesWithoutACell) {
  expect_particles_are_refused<2>();
  expect_particles_are_refused<3>();
}

TEST(RefusedQueries, TolerancesAndLengthsThatAreNone) {
  const Environment<2> environment = grid_of<2>(2);
  const Snapshot<2>& snapshot = environment.snapshot();
  const Locator<2> locator(snapshot);
  const Edge_motion<2> through_a_wall{{0.5, 0.5}, {-1, 0.5}, {0.75, 1.5}};
  for (const double bad : {not_a_number, 0.0, -1.0, 1.5, unbounded})
    for (const auto method : {Contact_search::dichotomic, Contact_search::dichotomic_segment}) {
      Search_options search{method, bad};
      const Sweep_options options{.search = &search};
      Edge_counts counts;
      EXPECT_EQ(test::refusal_of([&] { answer_sweep(snapshot, locator, through_a_wall, options, counts); }),
                Error_code::usage);
      search.method = Contact_search::exhaustive;
      EXPECT_FALSE(
          test::refusal_of([&] { answer_sweep(snapshot, locator, through_a_wall, options, counts); }));
    }
  for (const double bad : {not_a_number, -not_a_number, -1.0, unbounded, -unbounded})
    EXPECT_EQ(test::refusal_of([&] { count_edge_cells(snapshot, {.length = bad}); }), Error_code::usage);
}

}  // namespace
}  // namespace cellwalk
