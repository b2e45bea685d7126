// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle against answers known by hand: who guards the guards.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/oracle.h"
#include "oracle/parity.h"
#include "oracle/squares_and_cubes.h"

namespace cellwalk::oracle {
namespace {

using Cells = std::vector<std::uint32_t>;

template <int D>
Truth judge_motion(const Oracle<D>& oracle, std::uint32_t start, const Point<D>& a, const Point<D>& b) {
  return judge(oracle.trace(a, b), start);
}

/// The time of a stop as a double; the cases here have times that are doubles.
template <int D>
double stop_time(const Oracle<D>& oracle, std::uint32_t start, const Point<D>& a, const Point<D>& b) {
  const Trace trace = oracle.trace(a, b);
  const Truth truth = judge(trace, start);
  if (truth.stops.size() != 1 || !truth.arrivals.empty()) return -1;
  const auto& t = trace.events[truth.stops[0].event];
  return static_cast<double>(t.numerator) / static_cast<double>(t.denominator);
}

TEST(Oracle, PassesAPassableFacetAndStopsAtAWall) {
  Cell_soup<2> soup = make_squares(2, 1);
  const Truth passes = judge_motion<2>(Oracle<2>(soup), 0, {0.5, 0.25}, {1.5, 0.75});
  EXPECT_EQ(passes.arrivals, Cells{1});
  EXPECT_TRUE(passes.stops.empty());
  EXPECT_EQ(passes.choices, 0);
  EXPECT_TRUE(passes.unique_cells);
  set_wall(soup, 0, 1);
  const Oracle<2> walled(soup);
  EXPECT_EQ(stop_time<2>(walled, 0, {0.5, 0.25}, {1.5, 0.75}), 0.5);
  EXPECT_EQ(judge_motion<2>(walled, 0, {0.5, 0.25}, {1.5, 0.75}).stops[0].dimension, 1);
  EXPECT_EQ(judge_motion<2>(walled, 0, {0.5, 0.25}, {1.5, 0.75}).stops[0].cell, 0u);
  EXPECT_EQ(stop_time<2>(walled, 1, {1.5, 0.5}, {2.5, 0.5}), 0.5) << "the boundary is a wall";
}

TEST(Oracle, TouchingAWallIsNoCrossing) {
  Cell_soup<2> soup = make_squares(2, 2);
  set_wall(soup, 0, 2);
  const Oracle<2> oracle(soup);
  EXPECT_EQ(judge_motion<2>(oracle, 0, {0.5, 0.5}, {0.5, 1}).arrivals, Cells{0});
  EXPECT_EQ(judge_motion<2>(oracle, 0, {0.25, 1}, {0.75, 1}).arrivals, Cells{0});
  EXPECT_EQ(judge_motion<2>(oracle, 2, {0.25, 1}, {0.75, 1}).arrivals, Cells{2});
  EXPECT_EQ(judge_motion<2>(oracle, 0, {0.5, 1}, {0.5, 0.5}).arrivals, Cells{0});
  EXPECT_EQ(stop_time<2>(oracle, 2, {0.5, 1}, {0.5, 0.5}), 0) << "the other side of the membrane";
  EXPECT_EQ(judge_motion<2>(oracle, 2, {0.5, 1}, {0.5, 1}).arrivals, Cells{2}) << "zero motion";
}

TEST(Oracle, PassesAVertexThroughPassableFacetsOnly) {
  const Point<2> a{0.5, 0.5}, b{1.5, 1.5};
  Cell_soup<2> soup = make_squares(2, 2);
  EXPECT_EQ(judge_motion<2>(Oracle<2>(soup), 0, a, b).arrivals, Cells{3});
  set_wall(soup, 0, 1);
  EXPECT_EQ(judge_motion<2>(Oracle<2>(soup), 0, a, b).arrivals, Cells{3}) << "round the other way";
  Cell_soup<2> pinched = soup;
  set_wall(pinched, 2, 3);
  EXPECT_EQ(stop_time<2>(Oracle<2>(pinched), 0, a, b), 0.5) << "two walls that meet end to end";
  EXPECT_EQ(judge_motion<2>(Oracle<2>(pinched), 0, a, b).stops[0].dimension, 0);
  set_wall(soup, 0, 2);
  EXPECT_EQ(stop_time<2>(Oracle<2>(soup), 0, a, b), 0.5) << "a walled corner";
  EXPECT_EQ(judge_motion<2>(Oracle<2>(soup), 0, a, {1, 1}).arrivals, Cells{0}) << "up to the corner";
}

TEST(Oracle, OffersBothSidesPastTheRimOfAMembrane) {
  Cell_soup<2> soup = make_squares(2, 2);
  set_wall(soup, 0, 2);
  const Oracle<2> oracle(soup);
  const Truth off = judge_motion<2>(oracle, 0, {0.5, 1}, {2, 1});
  EXPECT_EQ(off.arrivals, (Cells{1, 3})) << "both hold the piece off the membrane, joined all along it";
  EXPECT_EQ(off.choices, 0);
  EXPECT_FALSE(off.unique_cells);
  const Truth onto = judge_motion<2>(oracle, 1, {1.5, 1}, {0.5, 1});
  EXPECT_EQ(onto.arrivals, (Cells{0, 2}));
  EXPECT_EQ(onto.choices, 1);
  set_wall(soup, 1, 3);
  EXPECT_EQ(judge_motion<2>(Oracle<2>(soup), 1, {1.5, 1}, {0.5, 1}).arrivals, Cells{0});
}

TEST(Oracle, ALegalChoiceMayLeadIntoAWallAndTheOtherNot) {
  // Along the membranes between the rows of 4 x 2; a wall closes the upper row at the end.
  Cell_soup<2> soup = make_squares(4, 2);
  set_wall(soup, 1, 5);
  set_wall(soup, 6, 7);
  set_wall(soup, 2, 6);
  set_wall(soup, 3, 7);
  const Truth truth = judge_motion<2>(Oracle<2>(soup), 0, {0.5, 1}, {3.5, 1});
  EXPECT_EQ(truth.arrivals, Cells{3});
  ASSERT_EQ(truth.stops.size(), 1u);
  EXPECT_EQ(truth.stops[0].cell, 6u);
  EXPECT_EQ(truth.stops[0].dimension, 0);
  EXPECT_EQ(truth.choices, 1);
}

/// Two rectangles one above the other that share two facets, the right one a wall.
Cell_soup<2> make_twice_joined() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {2, 2}, {0, 2}};
  const std::uint32_t lower[] = {0, 1, 2, 3, 4}, upper[] = {4, 3, 2, 5, 6};
  add_polygon(soup, lower);
  add_polygon(soup, upper);
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto loop = soup.facet(f);
    if ((loop[0] == 2 && loop[1] == 3) || (loop[0] == 3 && loop[1] == 2)) soup.impassable[f] = 1;
  }
  return soup;
}

TEST(Oracle, TellsApartTwoFacetsSharedByTheSameCells) {
  const Oracle<2> oracle(make_twice_joined());
  EXPECT_EQ(judge_motion<2>(oracle, 0, {0.5, 0.5}, {0.5, 1.5}).arrivals, Cells{1});
  EXPECT_EQ(stop_time<2>(oracle, 0, {1.5, 0.5}, {1.5, 1.5}), 0.5);
  EXPECT_EQ(judge_motion<2>(oracle, 0, {1, 0.5}, {1, 1.5}).arrivals, Cells{1})
      << "through the rim of the wall";
  const Truth along = judge_motion<2>(oracle, 0, {0.5, 1}, {1.5, 1});
  EXPECT_EQ(along.arrivals, (Cells{0, 1}));
  EXPECT_EQ(along.choices, 1);
  const Truth on_wall = judge_motion<2>(oracle, 0, {1.25, 1}, {1.75, 1});
  EXPECT_EQ(on_wall.arrivals, Cells{0});
}

TEST(Oracle, NeverEntersASolidCell) {
  Cell_soup<2> soup = make_squares(3, 1);
  soup.solid[1] = 1;  // walled off by being solid
  const Oracle<2> oracle(soup);
  EXPECT_EQ(stop_time<2>(oracle, 0, {0.5, 0.5}, {1.5, 0.5}), 0.5);
  const Place inside = oracle.place({1.5, 0.5});
  EXPECT_TRUE(inside.free_cells.empty());
  EXPECT_EQ(inside.solid_cells, Cells{1});
  EXPECT_EQ(inside.sides, 0);
  EXPECT_EQ(oracle.place({1, 0.5}).free_cells, Cells{0});
  EXPECT_EQ(oracle.place({1, 0.5}).dimension, 1);
}

TEST(Oracle, PlacesPointsWithTheirSidesAndDimension) {
  Cell_soup<3> soup = make_cubes(2, 2, 1);
  set_wall(soup, 0, 1);
  const Oracle<3> oracle(soup);
  EXPECT_EQ(oracle.place({1, 0.5, 0.5}).sides, 2);
  EXPECT_EQ(oracle.place({1, 0.5, 0.5}).dimension, 2);
  EXPECT_EQ(oracle.place({1, 1, 0.5}).sides, 1) << "the rim of the membrane";
  EXPECT_EQ(oracle.place({1, 1, 0.5}).dimension, 1);
  EXPECT_EQ(oracle.place({1, 1, 1}).free_cells, (Cells{0, 1, 2, 3}));
  EXPECT_EQ(oracle.place({1, 1, 1}).dimension, 0);
  EXPECT_EQ(oracle.place({0.5, 0.5, 0.5}).dimension, 3);
  EXPECT_TRUE(oracle.place({0.5, 0.5, 2}).free_cells.empty());
}

TEST(Oracle, PassesEdgesAndVerticesInSpace) {
  Cell_soup<3> soup = make_cubes(2, 2, 2);
  const Oracle<3> open(soup);
  EXPECT_EQ(judge_motion<3>(open, 0, {0.5, 0.5, 0.25}, {1.5, 1.5, 0.75}).arrivals, Cells{3});
  EXPECT_EQ(judge_motion<3>(open, 0, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}).arrivals, Cells{7});
  EXPECT_EQ(judge_motion<3>(open, 0, {1, 1, 0}, {1, 1, 2}).arrivals, (Cells{4, 5, 6, 7})) << "along the axis";
  EXPECT_EQ(judge_motion<3>(open, 0, {1, 1, 0}, {1, 1, 2}).choices, 0);
  set_wall(soup, 0, 1);
  set_wall(soup, 0, 2);
  const Oracle<3> corner(soup);
  EXPECT_EQ(stop_time<3>(corner, 0, {0.5, 0.5, 0.25}, {1.5, 1.5, 0.75}), 0.5);
  EXPECT_EQ(judge_motion<3>(corner, 0, {0.5, 0.5, 0.25}, {1.5, 1.5, 0.75}).stops[0].dimension, 1);
  EXPECT_EQ(judge_motion<3>(corner, 0, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}).arrivals, Cells{7})
      << "over the top";
  set_wall(soup, 0, 4);
  EXPECT_EQ(judge_motion<3>(Oracle<3>(soup), 0, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}).stops[0].dimension, 0);
}

TEST(Oracle, KnowsExactTimes) {
  Cell_soup<3> soup = make_cubes(2, 1, 1);
  set_wall(soup, 0, 1);
  const Trace trace = Oracle<3>(soup).trace({0, 0.25, 0.5}, {3, 0.5, 0.5});
  const Truth truth = judge(trace, 0);
  ASSERT_EQ(truth.stops.size(), 1u);
  const auto& t = trace.events[truth.stops[0].event];
  EXPECT_EQ(Wide(t.numerator * 3), t.denominator);
}

TEST(Oracle, ChecksTheWayOfAWalk) {
  Cell_soup<2> soup = make_squares(2, 2);
  set_wall(soup, 0, 1);
  const Trace trace = Oracle<2>(soup).trace({0.5, 0.5}, {1.5, 1.5});
  const auto check = [&](const Cells& path) { return check_path(trace, 0, path); };
  EXPECT_EQ(check({0, 3}), Path_fault::none);
  EXPECT_EQ(check({0}), Path_fault::none);
  EXPECT_EQ(check({}), Path_fault::wrong_start);
  EXPECT_EQ(check({3}), Path_fault::wrong_start);
  EXPECT_EQ(check({0, 2, 3}), Path_fault::no_further_piece);
  EXPECT_EQ(check({0, 3, 0}), Path_fault::no_further_piece);
  set_wall(soup, 0, 2);
  const Trace walled = Oracle<2>(soup).trace({0.5, 0.5}, {1.5, 1.5});
  EXPECT_EQ(check_path(walled, 0, Cells{0, 3}), Path_fault::not_linked);
  EXPECT_EQ(check_path(Oracle<2>(make_squares(4, 1)).trace({0.5, 0.5}, {1.5, 0.5}), 0, Cells{0, 3}),
            Path_fault::not_met);
}

TEST(Oracle, RefusesComplexesItCannotJudge) {
  Cell_soup<3> warped = make_cubes(1, 1, 1);
  warped.points[7][2] = 1.25;
  EXPECT_THROW(Oracle<3>{warped}, std::invalid_argument);
  Cell_soup<2> inverted;
  inverted.points = {{0, 0}, {0, 1}, {1, 0}};
  const std::uint32_t clockwise[] = {0, 1, 2};
  add_polygon(inverted, clockwise);
  EXPECT_THROW(Oracle<2>{inverted}, std::invalid_argument);
  EXPECT_THROW(judge(Oracle<2>(make_squares(2, 1)).trace({0.5, 0.5}, {0.25, 0.5}), 1), std::invalid_argument);
}

TEST(Oracle, NarrowAndWideIntegersAgree) {
  // The same motion, asked once with 128-bit integers and once so that they do not suffice.
  Cell_soup<3> soup = make_cubes(3, 3, 3);
  set_wall(soup, 13, 14);
  Oracle<3> narrow(soup);
  Cell_soup<3> fine = soup;
  fine.points.push_back({0x1p-60, 0, 0});  // not used by any cell, but all coordinates are scaled by it
  Oracle<3> wide(fine);
  int stops = 0;
  for (int i = 0; i < 400; ++i) {
    const Point<3> a{1.5, 1.5, 1.5}, b{(i * 37 % 49) / 16., (i * 11 % 47) / 16., (i * 29 % 53) / 16.};
    const Trace s = narrow.trace(a, b), t = wide.trace(a, b);
    const Truth u = judge(s, 13), v = judge(t, 13);
    EXPECT_EQ(u.arrivals, v.arrivals);
    EXPECT_EQ(u.choices, v.choices);
    ASSERT_EQ(s.events.size(), t.events.size());
    for (std::size_t e = 0; e < s.events.size(); ++e) EXPECT_EQ(compare(s.events[e], t.events[e]), 0);
    ASSERT_EQ(u.stops.size(), v.stops.size());
    stops += static_cast<int>(u.stops.size());
  }
  EXPECT_EQ(narrow.narrow_traces(), 400u);
  EXPECT_EQ(wide.wide_traces(), 400u);
  EXPECT_GT(stops, 20);
}

TEST(Oracle, AgreesWithTheArithmeticOfUnitCubes) {
  // Generic motions through cubes with every third inner facet a wall, followed plane by plane in integers.
  constexpr int n = 4, unit = 1024;
  Cell_soup<3> soup = make_cubes(n, n, n);
  std::uint64_t state = 12345;
  const auto random = [&](int below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<int>((state >> 33) % below);
  };
  const std::array<int, 3> stride{1, n, n * n};
  std::set<std::pair<int, int>> walls;
  for (int c = 0; c < n * n * n; ++c)
    for (int axis = 0; axis < 3; ++axis)
      if (c / stride[axis] % n + 1 < n && random(3) == 0) {
        set_wall(soup, c, c + stride[axis]);
        walls.insert({c, c + stride[axis]});
      }
  const Oracle<3> oracle(soup);
  int free = 0, blocked = 0;
  for (int k = 0; k < 3000; ++k) {
    std::array<int, 3> a, b;
    Point<3> from, to;
    int cell = 0;
    for (int i = 0; i < 3; ++i) {
      a[i] = random(n * unit), b[i] = random(n * unit);
      from[i] = double(a[i]) / unit, to[i] = double(b[i]) / unit;
      cell += a[i] / unit * stride[i];
    }
    std::vector<std::pair<Fraction<Int128>, int>> crossings;  // time, change of the cell's index
    bool generic = true;
    for (int i = 0; i < 3; ++i) {
      generic = generic && a[i] % unit != 0 && b[i] % unit != 0;
      for (int plane = 1; plane < n; ++plane)
        if ((a[i] < plane * unit) != (b[i] < plane * unit))
          crossings.push_back(
              {{std::abs(plane * unit - a[i]), std::abs(b[i] - a[i])}, a[i] < b[i] ? stride[i] : -stride[i]});
    }
    std::sort(crossings.begin(), crossings.end(),
              [](auto& s, auto& t) { return compare(s.first, t.first) < 0; });
    for (std::size_t i = 1; i < crossings.size(); ++i)
      generic = generic && compare(crossings[i - 1].first, crossings[i].first) < 0;
    if (!generic) continue;
    const Trace trace = oracle.trace(from, to);
    const Truth truth = judge(trace, cell);
    EXPECT_EQ(truth.choices, 0);
    std::size_t crossed = 0;
    for (; crossed < crossings.size(); ++crossed) {
      const int next = cell + crossings[crossed].second;
      if (walls.contains(std::minmax(cell, next))) break;
      cell = next;
    }
    if (crossed == crossings.size()) {
      ++free;
      EXPECT_EQ(truth.arrivals, Cells{static_cast<std::uint32_t>(cell)});
      EXPECT_TRUE(truth.stops.empty());
    } else {
      ++blocked;
      EXPECT_TRUE(truth.arrivals.empty());
      ASSERT_EQ(truth.stops.size(), 1u);
      EXPECT_EQ(truth.stops[0].cell, static_cast<std::uint32_t>(cell));
      const auto& t = trace.events[truth.stops[0].event];
      EXPECT_EQ(Wide(t.numerator * Wide(crossings[crossed].first.denominator)),
                Wide(t.denominator * Wide(crossings[crossed].first.numerator)));
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(blocked, 500);
}

TEST(Parity, TellsInsideFromOutside) {
  // A tetrahedron whose vertices and edges lie in the way of axis-parallel rays.
  Surface_soup surface;
  surface.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  surface.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(is_inside(surface, {1, 1, 1}));
  EXPECT_TRUE(is_inside(surface, {0x1p-40, 0x1p-40, 0x1p-40}));
  EXPECT_FALSE(is_inside(surface, {-1, 0, 0}));
  EXPECT_FALSE(is_inside(surface, {-1, 1, 1}));
  EXPECT_FALSE(is_inside(surface, {2, 2, 2}));
  EXPECT_FALSE(is_inside(surface, {5, 0, 0}));
  EXPECT_TRUE(is_inside(surface, {1, 1, 2 - 0x1p-50}));
  EXPECT_FALSE(is_inside(surface, {1, 1, 2 + 0x1p-50}));
  EXPECT_THROW(is_inside(surface, {1, 1, 2}), std::runtime_error);
}

}  // namespace
}  // namespace cellwalk::oracle
