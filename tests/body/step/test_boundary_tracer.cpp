// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles that bounce, and that go on from corresponding walls: against folded motions in boxes, and in
// jittered rooms, which no particle leaves.
#include <cellwalk/body/boundary_tracer.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "body/placing.h"
#include "body/rooms.h"

namespace cellwalk {
namespace {

using test::Placing;
using test::turned;
using test::turned_back;

constexpr double room_size = 3;

/// The walls whose mean satisfies a condition, seen from their free side.
template <int D, class Condition>
std::vector<Half_facet> walls(const Snapshot<D>& snapshot, const Condition& condition) {
  std::vector<Half_facet> found;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet facet = Snapshot<D>::half_facet(cell, k);
      if (snapshot.is_impassable(facet) && !snapshot.is_solid(cell) && condition(centroid(snapshot, facet)))
        found.push_back(facet);
    }
  }
  return found;
}

template <int D>
std::vector<Half_facet> walls_at(const Snapshot<D>& snapshot, std::size_t axis, double coordinate) {
  return walls(snapshot, [&](const Point<D>& mean) { return mean[axis] == coordinate; });
}

/// A room, the tools to trace in it, and random motions; every other one from and to eighths.
template <int D>
struct Motions {
  Motions(Snapshot<D> compiled, std::size_t count, double reach, std::uint64_t seed, Placing placing = {})
      : snapshot(std::move(compiled)), locator(snapshot), tracer(snapshot) {
    Random random(seed);
    const auto draw = [&](double low, double high, bool is_coarse) {
      const double x = random.real(low, high);
      return is_coarse ? std::round(8 * x) / 8 : x;
    };
    while (particles.size() < count) {
      const bool is_coarse = particles.size() % 2 == 0;
      Point<D> from, to;
      for (double& x : from) x = draw(0.25, room_size - 0.25, is_coarse);
      for (std::size_t k = 0; k < D; ++k) to[k] = draw(from[k] - reach, from[k] + reach, is_coarse);
      particles.push_back(locator.particle_at(placing.placed(from)).value());
      targets.push_back(placing.placed(to));
    }
  }

  Snapshot<D> snapshot;
  Locator<D> locator;
  Tracer<D> tracer;
  std::vector<Particle<D>> particles;
  std::vector<Point<D>> targets;
};

template <int D>
Cell_soup<D> room_soup(double jitter) {
  Simplex_grid_options<D> options;
  options.cells.fill(static_cast<std::uint32_t>(room_size));
  options.jitter = jitter;
  if constexpr (D == 2)
    return triangle_grid(options);
  else
    return tetrahedral_grid(options);
}

template <int D>
Snapshot<D> room(double jitter) {
  return test::compile(room_soup<D>(jitter));
}

/// A room whose points are rounded where it stands: its sides are no planes any more if it is turned.
template <int D>
Snapshot<D> placed_room(const Placing& placing) {
  Cell_soup<D> soup = room_soup<D>(0);
  for (Point<D>& p : soup.points) {
    p = placing.placed(p);
    if (placing.unit > 0)
      for (double& x : p) x = std::round(x / placing.unit) * placing.unit;
  }
  return test::compile(soup);
}

/// Where a motion without walls is in [0, size] if both ends reflect, or if they are joined.
double folded(double x, bool reflects) {
  const double period = reflects ? 2 * room_size : room_size;
  const double rest = x - period * std::floor(x / period);
  return rest > room_size ? period - rest : rest;
}

double sum_of_row(const Traces& traces, std::size_t row) {
  return std::accumulate(traces.lengths.begin() + static_cast<std::ptrdiff_t>(traces.offsets[row]),
                         traces.lengths.begin() + static_cast<std::ptrdiff_t>(traces.offsets[row + 1]), 0.0);
}

/// Rows that arrive, in their cells, whose lengths sum up; all others are as they were.
template <int D>
void expect_whole_rows(const Motions<D>& before, const std::vector<Particle<D>>& after, const Traces& traces,
                       double rounding = 0) {
  ASSERT_EQ(traces.size(), after.size());
  for (std::size_t row = 0; row < after.size(); ++row) {
    ASSERT_TRUE(in_closure(before.snapshot, after[row].cell, after[row].position));
    ASSERT_EQ(traces.ends[row].status, Walk_status::arrived) << row;
    const double asked = length(before.targets[row] - before.particles[row].position);
    ASSERT_NEAR(sum_of_row(traces, row), asked, 1e-12 * (1 + asked) + rounding) << row;
    ASSERT_EQ(traces.ends[row].cell, after[row].cell);
  }
}

template <int D>
void test_folded(bool reflects, const Placing& placing) {
  const std::size_t count = placing.offset == 0 ? 20'000 : 2000;
  Motions<D> motions(placed_room<D>(placing), count, 4 * room_size, 1, placing);
  const auto upright = [&](const Point<D>& x) { return placing.upright(x); };
  const double unit = std::max(placing.unit, 0x1p-51 * placing.offset);  // to which points are rounded
  Boundary_tracer<D> boundary(motions.snapshot, motions.tracer, motions.locator);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto at = [&](double side) {
      return walls(motions.snapshot, [&](const Point<D>& mean) {
        return std::abs(upright(mean)[axis] - side) < 1e-8 + 8 * unit;
      });
    };
    const auto low = at(0), high = at(room_size);
    if (reflects) {
      boundary.reflect(low);
      boundary.reflect(high);
    } else {
      Point<D> along{};
      along[axis] = room_size;
      const Vector<D> expected = placing.placed(along) - placing.placed(Point<D>{});
      EXPECT_LT(length(boundary.join(low, high) - expected),
                2 * unit + (placing.is_turned ? 1e-14 : 0x1p-60));
    }
  }
  std::vector<Particle<D>> after = motions.particles;
  Traces traces;
  Walk_counts counts;
  boundary.trace(after, motions.targets, 1000, traces, counts);
  expect_whole_rows(motions, after, traces, 100 * unit);
  std::size_t bounces = 0;
  for (std::size_t row = 0; row < after.size(); ++row)
    for (std::size_t k = 0; k < D; ++k) {
      const double expected = folded(upright(motions.targets[row])[k], reflects);
      const double off = std::abs(upright(after[row].position)[k] - expected);
      // What ends at a joined wall may end at the other.
      ASSERT_LT(reflects ? off : std::min(off, std::abs(room_size - off)), 1e-11 + 100 * unit) << row;
    }
  for (const Half_facet facet : traces.crossings) bounces += motions.snapshot.is_impassable(facet);
  EXPECT_GT(bounces, 3 * after.size());
}

TEST(BoundaryTracer, ReflectsLikeMirrors2) { test_folded<2>(true, {}); }
TEST(BoundaryTracer, ReflectsLikeMirrors3) { test_folded<3>(true, {}); }
TEST(BoundaryTracer, ReflectsLikeRoundedMirrors2) { test_folded<2>(true, {true}); }
TEST(BoundaryTracer, ReflectsLikeRoundedMirrors3) { test_folded<3>(true, {true}); }
TEST(BoundaryTracer, JoinsLikeATorus2) { test_folded<2>(false, {}); }
TEST(BoundaryTracer, JoinsLikeATorus3) { test_folded<3>(false, {}); }
TEST(BoundaryTracer, JoinsLikeARoundedTorus2) { test_folded<2>(false, {true}); }
TEST(BoundaryTracer, JoinsLikeARoundedTorus3) { test_folded<3>(false, {true}); }
TEST(BoundaryTracer, JoinsWallsOfTenDigits2) { test_folded<2>(false, {true, 0, 1e-10}); }
TEST(BoundaryTracer, JoinsWallsOfTenDigits3) { test_folded<3>(false, {true, 0, 1e-10}); }

/// Where doubles are further apart than corners of joined walls may differ elsewhere.
template <int D>
void test_far(bool reflects) {
  for (const bool is_turned : {false, true})
    for (const double offset : {0x1p30, 0x1p36, 0x1p42}) test_folded<D>(reflects, {is_turned, offset});
}

TEST(BoundaryTracer, ReflectsFarFromTheOrigin2) { test_far<2>(true); }
TEST(BoundaryTracer, ReflectsFarFromTheOrigin3) { test_far<3>(true); }
TEST(BoundaryTracer, JoinsWallsFarFromTheOrigin2) { test_far<2>(false); }
TEST(BoundaryTracer, JoinsWallsFarFromTheOrigin3) { test_far<3>(false); }

/// Motions along a side whose facets are in no plane: they do not bounce to and fro on the spot.
TEST(BoundaryTracer, GrazesWalls) {
  Motions<3> motions(placed_room<3>({true}), 0, 0, 0);
  Boundary_tracer<3> boundary(motions.snapshot, motions.tracer, motions.locator);
  boundary.reflect(walls(motions.snapshot, [](const Point<3>&) { return true; }));
  Random random(3);
  std::vector<Particle<3>> particles;
  std::vector<Point<3>> targets;
  for (const Half_facet wall :
       walls(motions.snapshot, [](const Point<3>& mean) { return std::abs(turned_back(mean)[0]) < 0x1p-40; }))
    for (int i = 0; i < 100; ++i) {
      // From points of its plane, or near it.
      const std::vector<std::uint32_t> corners = motions.snapshot.loop(wall);
      const Point<3> from =
          i % 2 == 0 ? motions.snapshot.point(corners[0]) : centroid(motions.snapshot, wall);
      const auto particle = motions.locator.particle_at(from);
      if (!particle) continue;  // its rounded mean lies outside
      particles.push_back(*particle);
      targets.push_back(turned(Point<3>{0, random.real(0, room_size), random.real(0, room_size)}));
    }
  ASSERT_GT(particles.size(), 200u);
  Traces traces;
  Walk_counts counts;
  boundary.trace(particles, targets, 1000, traces, counts);
  std::size_t bounces = 0;
  for (const Half_facet facet : traces.crossings) bounces += motions.snapshot.is_impassable(facet);
  EXPECT_GT(bounces, particles.size() / 4);
  EXPECT_LT(bounces, 4 * particles.size());
  for (std::size_t row = 0; row < particles.size(); ++row) {
    ASSERT_EQ(traces.ends[row].status, Walk_status::arrived);
    ASSERT_LT(length(particles[row].position - targets[row]), 1e-13);
  }
}

/// Headings are mirrored; those of rows that do not arrive stay.
TEST(BoundaryTracer, MirrorsHeadings) {
  Motions<2> motions(room<2>(0), 0, 0, 0);
  Boundary_tracer<2> boundary(motions.snapshot, motions.tracer, motions.locator);
  boundary.reflect(walls_at(motions.snapshot, 0, 0));
  std::vector<Particle<2>> particles(3, motions.locator.particle_at({1, 1}).value());
  const std::vector<Point<2>> targets{{-0.5, 1.5}, {-0.5, 7}, {2, 2}};
  std::vector<Vector<2>> headings{{-3, 1}, {-3, 12}, {2, 2}};
  Traces traces;
  Walk_counts counts;
  boundary.trace(particles, targets, 1000, traces, counts, headings);
  EXPECT_EQ(headings, (std::vector<Vector<2>>{{3, 1}, {-3, 12}, {2, 2}}));
  EXPECT_EQ(traces.ends[1].status, Walk_status::contact);
}

/// Walls in general position: nobody leaves, lengths sum up, and rows do not depend on how they are divided.
template <int D>
void test_jittered(std::size_t count) {
  Motions<D> motions(room<D>(0.15), count, 2 * room_size, 2);
  Boundary_tracer<D> boundary(motions.snapshot, motions.tracer, motions.locator);
  boundary.reflect(walls(motions.snapshot, [](const Point<D>&) { return true; }));
  std::vector<Particle<D>> after = motions.particles;
  Traces traces;
  Walk_counts counts;
  boundary.trace(after, motions.targets, 1000, traces, counts);
  expect_whole_rows(motions, after, traces);

  std::vector<Particle<D>> again = motions.particles;
  Traces in_parts;
  const std::size_t part = count / 3;
  const std::span<Particle<D>> all(again);
  const std::span<const Point<D>> targets(motions.targets);
  boundary.trace(all.first(part), targets.first(part), 1000, in_parts, counts);
  boundary.trace(all.subspan(part), targets.subspan(part), 1000, in_parts, counts);
  EXPECT_EQ(traces.offsets, in_parts.offsets);
  EXPECT_EQ(traces.cells, in_parts.cells);
  EXPECT_EQ(traces.lengths, in_parts.lengths);
  EXPECT_EQ(traces.crossings, in_parts.crossings);
  for (std::size_t row = 0; row < count; ++row) ASSERT_EQ(after[row].position, again[row].position);
}

TEST(BoundaryTracer, NobodyLeaves2) { test_jittered<2>(20'000); }
TEST(BoundaryTracer, NobodyLeaves3) { test_jittered<3>(100'000); }

/// 2 x 1 squares, whose left and right walls are joined.
struct Channel {
  Channel() : snapshot(test::rooms<2>({2, 1})), locator(snapshot), tracer(snapshot) {}
  Snapshot<2> snapshot;
  Locator<2> locator;
  Tracer<2> tracer;
};

TEST(BoundaryTracer, PutsLegsTogether) {
  Channel channel;
  Boundary_tracer<2> boundary(channel.snapshot, channel.tracer, channel.locator);
  const auto left = walls_at(channel.snapshot, 0, 0), right = walls_at(channel.snapshot, 0, 2);
  boundary.join(left, right);
  std::vector<Particle<2>> particles(3, channel.locator.particle_at({1.5, 0.5}).value());
  particles[2] = {};
  const std::vector<Point<2>> targets{{3.25, 0.5}, {1.75, 3}, {0, 0}};
  Traces traces;
  Walk_counts counts;
  boundary.trace(particles, targets, 10, traces, counts);
  EXPECT_EQ(traces.offsets, (std::vector<std::uint64_t>{0, 3, 4, 4}));
  EXPECT_EQ(traces.lengths, (std::vector<double>{0.5, 1, 0.25, length(Vector<2>{0.05, 0.5})}));
  const Cell first = channel.snapshot.cell(0), second = channel.snapshot.cell(1);
  EXPECT_EQ(traces.cells, (std::vector<Cell>{second, first, second, second}));
  ASSERT_EQ(traces.crossing_offsets, (std::vector<std::uint64_t>{0, 2, 2, 2}));
  EXPECT_EQ(traces.crossings[0], right[0]);
  EXPECT_EQ(particles[0].position, (Point<2>{1.25, 0.5}));
  EXPECT_EQ(particles[1].position, (Point<2>{1.5, 0.5})) << "the upper wall blocks it";
  EXPECT_EQ(traces.ends[1].status, Walk_status::contact);
  EXPECT_EQ(traces.ends[1].wall, walls_at(channel.snapshot, 1, 1)[1]);
  EXPECT_EQ(traces.ends[2].status, Walk_status::lost);
}

TEST(BoundaryTracer, StopsAfterTheMostBounces) {
  Channel channel;
  Boundary_tracer<2> boundary(channel.snapshot, channel.tracer, channel.locator);
  boundary.reflect(walls(channel.snapshot, [](const Point<2>&) { return true; }));
  const auto start = channel.locator.particle_at({1, 0.5}).value();
  const std::vector<Point<2>> targets{{1, 3.75}};  // three bounces
  Walk_counts counts;
  for (int most = 0; most <= 3; ++most) {
    std::vector<Particle<2>> particles{start};
    Traces traces;
    boundary.trace(particles, targets, most, traces, counts);
    EXPECT_EQ(traces.ends[0].status, most < 3 ? Walk_status::contact : Walk_status::arrived);
    EXPECT_NEAR(sum_of_row(traces, 0), most < 3 ? 0.5 + most : 3.25, 1e-15);
    EXPECT_NEAR(particles[0].position[1], most < 3 ? 0.5 : 0.25, 1e-15);
    EXPECT_EQ(traces.crossings.size(), static_cast<std::size_t>(most));
  }
  std::vector<Particle<2>> particles{start};
  Traces traces;
  EXPECT_THROW(boundary.trace(particles, targets, -1, traces, counts), Error);
}

TEST(BoundaryTracer, ReflectsInCorners) {
  Channel channel;
  Boundary_tracer<2> boundary(channel.snapshot, channel.tracer, channel.locator);
  boundary.reflect(walls(channel.snapshot, [](const Point<2>&) { return true; }));
  std::vector<Particle<2>> particles{channel.locator.particle_at({0.5, 0.5}).value()};
  const std::vector<Point<2>> targets{{-0.25, -0.25}};
  Traces traces;
  Walk_counts counts;
  boundary.trace(particles, targets, 10, traces, counts);
  EXPECT_EQ(particles[0].position, (Point<2>{0.25, 0.25}));
  EXPECT_EQ(traces.crossings.size(), 2u);
  EXPECT_NEAR(sum_of_row(traces, 0), length(Vector<2>{0.75, 0.75}), 1e-15);
}

/// The message of the error by which walls are refused.
template <class Try>
std::string refusal(const Try& attempt) {
  Channel channel;
  Boundary_tracer<2> boundary(channel.snapshot, channel.tracer, channel.locator);
  try {
    attempt(boundary, channel.snapshot);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BoundaryTracer, RefusesWallsThatDoNotCorrespond) {
  using Boundary = Boundary_tracer<2>;
  const auto is_part = [](const std::string& part, const std::string& of) {
    return of.find(part) != std::string::npos;
  };
  std::string said = refusal([](Boundary& boundary, const Snapshot<2>& snapshot) {
    boundary.join(walls_at(snapshot, 0, 0), walls_at(snapshot, 1, 0));
  });
  EXPECT_TRUE(is_part("do not correspond: their extents are (0, 1) and (2, 0)", said)) << said;
  said = refusal([](Boundary& boundary, const Snapshot<2>& snapshot) {
    boundary.join(walls_at(snapshot, 0, 0), walls_at(snapshot, 0, 0));
  });
  EXPECT_TRUE(is_part("lies on no wall of the other group", said)) << said;
  said = refusal([](Boundary& boundary, const Snapshot<2>& snapshot) {
    boundary.join(walls_at(snapshot, 0, 0), walls_at(snapshot, 0, 2));
    boundary.reflect(walls_at(snapshot, 0, 2));
  });
  EXPECT_TRUE(is_part("is in two groups of walls", said)) << said;
  said = refusal([](Boundary& boundary, const Snapshot<2>&) { boundary.join({}, {}); });
  EXPECT_TRUE(is_part("there is no wall", said)) << said;
  said = refusal([](Boundary& boundary, const Snapshot<2>& snapshot) {
    const Half_facet inner = snapshot.opposite(snapshot.opposite([&] {
      for (std::size_t k = 0;; ++k) {
        const Half_facet facet = Snapshot<2>::half_facet(snapshot.cell(0), k);
        if (snapshot.neighbour(facet) != Cell::none) return facet;
      }
    }()));
    boundary.join(std::span(&inner, 1), walls_at(snapshot, 0, 2));
  });
  EXPECT_TRUE(is_part("is open: periodic walls have free space on one side", said)) << said;
}

}  // namespace
}  // namespace cellwalk
