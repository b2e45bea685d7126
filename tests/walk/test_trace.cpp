// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces against the oracle: there are events of the motion between which each piece lies in its closed cell,
// one piece after the other from the start to the end, and each length is the double nearest to the exact
// one. In all worlds of the oracle, half of the motions degenerate.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/trace.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <tuple>

#include "oracle/oracle.h"
#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::oracle {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;

Rational to_rational(double x) {
  const Dyadic d = to_dyadic(x);
  const Integer power = Integer(1) << std::abs(d.exponent);
  return d.exponent < 0 ? Rational(Integer(d.mantissa), power) : Rational(Integer(d.mantissa) * power);
}

Rational to_rational(const Fraction<Wide>& x) { return {Integer(x.numerator), Integer(x.denominator)}; }

template <int D>
Rational squared_length(const Point<D>& a, const Point<D>& b) {
  Rational sum = 0;
  for (std::size_t k = 0; k < D; ++k) {
    const Rational d = to_rational(b[k]) - to_rational(a[k]);
    sum += d * d;
  }
  return sum;
}

/// True if x is the double nearest to the root of a square.
bool is_nearest_root(double x, const Rational& square) {
  if (!(x >= 0)) return false;
  const Rational at = to_rational(x);
  const Rational low = x == 0 ? Rational(0) : (at + to_rational(std::nextafter(x, 0.0))) / 2;
  const Rational high = (at + to_rational(std::nextafter(x, std::numeric_limits<double>::infinity()))) / 2;
  return low * low <= square && square <= high * high;
}

/// Particles in one world, and the targets of a batch.
template <int D>
struct Batch {
  std::vector<Particle<D>> particles;
  std::vector<Point<D>> targets;
};

template <int D>
Batch<D> make_batch(const World<D>& world, const Locator<D>& locator, std::uint64_t seed, std::size_t count) {
  Motion_source<D> source(world, seed);
  Batch<D> batch;
  Point<D> last{};
  while (batch.particles.size() < count) {
    const Motion_kind kind = source.kind(batch.particles.size() % 2 == 0);
    const Point<D> start = source.start(kind);
    std::vector<Particle<D>> sides = locator.particles_at(start);
    if (sides.empty()) sides.push_back({start});
    batch.particles.push_back(sides[source.random().below(sides.size())]);
    batch.particles.back().aimed = static_cast<std::uint16_t>(source.random().below(3));
    Point<D> target = source.target(kind, start, last);
    if (batch.particles.size() % 64 == 0) target = start + 64.0 * (target - start);  // far out of the frame
    batch.targets.push_back(target);
    last = start;
  }
  return batch;
}

struct Traced {
  Walk_counts counts;  ///< of the walks
  std::size_t rows = 0, pieces = 0, blocked = 0, with_shared_pieces = 0, left_out = 0, without_cell = 0;
};

/// The events at which the pieces of a row may begin and end, as sets of events after each piece; empty where
/// there are none.
template <int D>
std::set<int> ends_of_pieces(const Trace& truth, const Snapshot<D>& snapshot, const Traces& traces,
                             std::size_t row, const Rational& square, Traced& seen) {
  std::set<int> here{0};
  bool had_several = false;
  for (std::size_t i = traces.offsets[row]; i < traces.offsets[row + 1]; ++i) {
    const int number = truth.visit_of(snapshot.index(traces.cells[i]));
    if (number < 0) return {};
    const Visit& visit = truth.visits[static_cast<std::size_t>(number)];
    std::set<int> next;
    for (const int begin : here)
      for (int end = begin + 1; begin >= visit.first && end <= visit.last; ++end) {
        const Rational share = to_rational(truth.events[static_cast<std::size_t>(end)]) -
                               to_rational(truth.events[static_cast<std::size_t>(begin)]);
        if (is_nearest_root(traces.lengths[i], square * share * share)) next.insert(end);
      }
    had_several |= i > traces.offsets[row] && visit.first < *here.begin();
    here = next;
    ++seen.pieces;
  }
  seen.with_shared_pieces += had_several;
  return here;
}

template <int D>
void expect_row(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Particle<D>& start,
                const Particle<D>& after, const Point<D>& target, const Traces& traces, std::size_t row,
                Traced& seen) {
  ++seen.rows;
  const Trace_end& end = traces.ends[row];
  if (start.cell == Cell::none) {
    EXPECT_EQ(end.status, Walk_status::lost);
    EXPECT_EQ(traces.offsets[row], traces.offsets[row + 1]);
    ++seen.without_cell;
    return;
  }
  // The same end, cells and facets as a walk.
  Particle<D> walked = start;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  const Walk_result<D> result = move(snapshot, walked, target, seen.counts, {&visited, &crossed});
  EXPECT_EQ(end.status, result.status);
  EXPECT_EQ(end.cell, result.cell);
  EXPECT_EQ(end.wall, result.contact ? result.contact->facet : Half_facet::none);
  EXPECT_EQ(std::tie(after.position, after.cell, after.dimension, after.aimed),
            std::tie(walked.position, walked.cell, walked.dimension, walked.aimed));
  const std::vector<Half_facet> crossings(
      traces.crossings.begin() + static_cast<std::ptrdiff_t>(traces.crossing_offsets[row]),
      traces.crossings.begin() + static_cast<std::ptrdiff_t>(traces.crossing_offsets[row + 1]));
  EXPECT_EQ(crossings, crossed);
  std::size_t listed = traces.offsets[row];
  for (const Cell cell : visited)
    if (listed < traces.offsets[row + 1] && traces.cells[listed] == cell) ++listed;
  EXPECT_EQ(listed, traces.offsets[row + 1]);
  seen.left_out += visited.size() - (listed - traces.offsets[row]);

  // The truth.
  const Trace truth = oracle.trace(start.position, target);
  const Rational square = squared_length<D>(start.position, target);
  const std::set<int> ends = ends_of_pieces(truth, snapshot, traces, row, square, seen);
  if (result.status == Walk_status::arrived) {
    EXPECT_TRUE(ends.contains(truth.last_event()));
  } else {
    ++seen.blocked;
    bool is_legal = false;
    for (const Stop& stop : judge(truth, snapshot.index(start.cell)).stops)
      is_legal |= stop.cell == snapshot.index(end.cell) && ends.contains(stop.event) &&
                  is_within_4_ulp(result.contact->time, truth.events[static_cast<std::size_t>(stop.event)]);
    EXPECT_TRUE(is_legal);
  }

  // The lengths sum up to that of the way.
  Rational sum = 0;
  for (std::size_t i = traces.offsets[row]; i < traces.offsets[row + 1]; ++i)
    sum += to_rational(traces.lengths[i]);
  if (result.status == Walk_status::arrived && square > 0) {
    const double length = std::sqrt(square.convert_to<double>());
    const Rational ulp = to_rational(std::nextafter(length, 2 * length)) - to_rational(length);
    const Rational low = sum - ulp, high = sum + ulp;
    EXPECT_TRUE((low < 0 || low * low <= square) && square <= high * high);
  }
}

template <int D>
Traced trace_worlds(std::size_t rows, std::uint64_t seed) {
  Traced seen;
  Walk_counts traced;
  const std::size_t rows_of_world = 300;
  for (std::uint64_t number = seed; seen.rows < rows; ++number) {
    const World<D> world = make_world<D>(number);
    const Oracle<D> oracle(world.soup);
    const Snapshot<D> snapshot = Snapshot<D>::compile(world.soup, glue(world.soup));
    const Locator<D> locator(snapshot);
    const Tracer<D> tracer(snapshot);
    Batch<D> batch = make_batch(world, locator, number, rows_of_world);
    const std::vector<Particle<D>> starts = batch.particles;
    Traces traces;
    Walk_counts counts;
    tracer.trace(batch.particles, batch.targets, traces, counts);
    for (std::size_t row = 0; row < rows_of_world; ++row) {
      expect_row(oracle, snapshot, starts[row], batch.particles[row], batch.targets[row], traces, row, seen);
      if (testing::Test::HasFailure()) {
        ADD_FAILURE() << "world " << number << " (" << world.name << "), row " << row;
        return seen;
      }
    }
    traced.walks += counts.walks;
    traced.stays += counts.stays;
    traced.crossings += counts.crossings;
  }
  EXPECT_EQ(std::tie(traced.walks, traced.stays, traced.crossings),
            std::tie(seen.counts.walks, seen.counts.stays, seen.counts.crossings));
  return seen;
}

template <int D>
void test_worlds() {
  const std::size_t rows = scaled_count(60 * 300);
  const Traced seen = trace_worlds<D>(rows, 0);
  if (is_shortened()) return;
  EXPECT_GT(seen.pieces, rows);
  EXPECT_GT(seen.blocked, rows / 10);
  EXPECT_GT(seen.with_shared_pieces, rows / 1000);
  EXPECT_GT(seen.left_out, rows / 1000);
  EXPECT_GT(seen.without_cell, rows / 1000);
}

TEST(TraceOracle, LengthsAreThoseOfTheTruth2) { test_worlds<2>(); }
TEST(TraceOracle, LengthsAreThoseOfTheTruth3) { test_worlds<3>(); }

/// Rays far beyond a cube far from the origin, past its edges by less than the coordinates there resolve.
TEST(TraceOracle, RaysLeaveAWorldFarFromTheOriginWhereTheyDo) {
  constexpr double offset = 0x1p36, ulp = 0x1p-16, side = 1.9375;
  World<3> world;
  for (int i = 0; i < 8; ++i)
    world.soup.points.push_back(
        {offset + side * (i & 1), -offset + side * (i >> 1 & 1), offset + side * (i >> 2 & 1)});
  add_hexahedron(world.soup, {0, 1, 3, 2, 4, 5, 7, 6});
  const Oracle<3> oracle(world.soup);
  const Snapshot<3> snapshot = Snapshot<3>::compile(world.soup, glue(world.soup));
  const Locator<3> locator(snapshot);
  Random random(1);
  const auto few_ulp = [&] { return (static_cast<double>(random.below(5)) - 2) * ulp; };
  Batch<3> batch;
  for (int i = 0; i < 3000; ++i) {
    Point<3> from = world.soup.points[0], on_edge = world.soup.points[7];
    for (double& x : from) x += random.real(0.0625, 0.25);
    on_edge[random.below(3)] -= random.real(0, 1);
    const double times = static_cast<double>(4 << random.below(10));
    batch.particles.push_back(locator.particle_at(from).value());
    batch.targets.push_back(from + times * (on_edge - from) + Vector<3>{few_ulp(), few_ulp(), few_ulp()});
  }
  const std::vector<Particle<3>> starts = batch.particles;
  Traces traces;
  Walk_counts counts;
  Tracer<3>(snapshot).trace(batch.particles, batch.targets, traces, counts);
  Traced seen;
  for (std::size_t row = 0; row < starts.size(); ++row)
    expect_row(oracle, snapshot, starts[row], batch.particles[row], batch.targets[row], traces, row, seen);
  EXPECT_EQ(seen.blocked, starts.size());
}

template <int D>
void test_calls() {
  const World<D> world = make_world<D>(3);
  const Snapshot<D> snapshot = Snapshot<D>::compile(world.soup, glue(world.soup));
  const Locator<D> locator(snapshot);
  const Tracer<D> tracer(snapshot);
  const Batch<D> batch = make_batch(world, locator, 3, 700);  // more rows than are walked at a time
  Traces whole;
  Walk_counts counts;
  std::vector<Particle<D>> particles = batch.particles;
  tracer.trace(particles, batch.targets, whole, counts);
  for (const std::size_t rows : {1u, 7u, 299u}) {
    Traces parts;
    std::vector<Particle<D>> moved = batch.particles;
    for (std::size_t begin = 0; begin < moved.size(); begin += rows) {
      const std::size_t count = std::min(rows, moved.size() - begin);
      tracer.trace(std::span(moved).subspan(begin, count), std::span(batch.targets).subspan(begin, count),
                   parts, counts);
    }
    EXPECT_EQ(parts.offsets, whole.offsets);
    EXPECT_EQ(parts.cells, whole.cells);
    EXPECT_EQ(parts.lengths, whole.lengths);
    EXPECT_EQ(parts.crossing_offsets, whole.crossing_offsets);
    EXPECT_EQ(parts.crossings, whole.crossings);
    for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_EQ(moved[i].cell, particles[i].cell);
  }
}

TEST(Tracer, GivesTheSameRowsHoweverTheyAreDividedAmongCalls) {
  test_calls<2>();
  test_calls<3>();
}

TEST(Tracer, FollowsRowsThroughThousandsOfCells) {
  Simplex_grid_options<3> options;
  options.cells = {2000, 1, 1};
  options.jitter = 0.12;
  const Cell_soup<3> soup = tetrahedral_grid(options);
  const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
  const Locator<3> locator(snapshot);
  Random random(5);
  const auto place = [&](double x) { return Point<3>{x, random.real(0.3, 0.7), random.real(0.3, 0.7)}; };
  std::vector<Particle<3>> particles;
  std::vector<Point<3>> targets;
  for (int i = 0; i < 40; ++i) {
    particles.push_back(locator.particle_at(place(1.5)).value());
    targets.push_back(place(i % 4 == 0 ? 2.5 : 1998.5));
  }
  Walk_counts counts;
  std::vector<std::vector<Cell>> expected;
  std::vector<Particle<3>> walked = particles;
  for (std::size_t i = 0; i < walked.size(); ++i) {
    std::vector<Cell>& cells = expected.emplace_back();
    ASSERT_EQ(walk(snapshot, walked[i], targets[i], counts, {&cells}).status, Walk_status::arrived);
  }
  Traces traces;
  Tracer<3>(snapshot).trace(particles, targets, traces, counts);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::vector<Cell> cells(traces.cells.begin() + static_cast<std::ptrdiff_t>(traces.offsets[i]),
                                  traces.cells.begin() + static_cast<std::ptrdiff_t>(traces.offsets[i + 1]));
    EXPECT_EQ(cells, expected[i]) << i;
    EXPECT_EQ(i % 4 != 0, cells.size() > 4000) << cells.size();
  }
}

TEST(Tracer, RefusesAndLeavesAllAsItWas) {
  const World<3> world = make_world<3>(0);
  Snapshot<3> snapshot = Snapshot<3>::compile(world.soup, glue(world.soup));
  const Locator<3> locator(snapshot);
  const Tracer<3> tracer(snapshot);
  Batch<3> batch = make_batch(world, locator, 0, 20);
  batch.particles[19] = {snapshot.point(0), Cell{0}, 0, 0};  // in a cell
  const std::vector<Particle<3>> starts = batch.particles;
  Traces traces;
  Walk_counts counts;
  const auto expect_refusal = [&](std::span<const Point<3>> targets, Error_code code) {
    try {
      tracer.trace(batch.particles, targets, traces, counts);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
    }
    EXPECT_EQ(traces.size(), 0u);
    EXPECT_TRUE(traces.cells.empty());
    EXPECT_TRUE(traces.lengths.empty());
    EXPECT_TRUE(traces.crossings.empty());
    EXPECT_EQ(traces.offsets, std::vector<std::uint64_t>{0});
    for (std::size_t i = 0; i < starts.size(); ++i)
      EXPECT_EQ(batch.particles[i].position, starts[i].position);
  };
  expect_refusal(std::span(batch.targets).first(19), Error_code::usage);
  std::vector<Point<3>> infinite = batch.targets;
  infinite[19][1] = std::numeric_limits<double>::infinity();
  expect_refusal(infinite, Error_code::input);
  batch.particles[19].cell = Cell{static_cast<std::uint32_t>(snapshot.half_facet_slots())};
  expect_refusal(batch.targets, Error_code::usage);
  batch.particles = starts;
  const std::vector<Cell> cells{snapshot.cell(0)};
  snapshot.update_geometry(cells);
  expect_refusal(batch.targets, Error_code::usage);
}

}  // namespace
}  // namespace cellwalk::oracle
