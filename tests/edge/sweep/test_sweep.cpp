// SPDX-License-Identifier: LGPL-3.0-or-later
// One interface to sweeps, touches and searches: what each must be to the others.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "edge/edge_worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Sweep_seen {
  int sweeps = 0, free = 0, by_vertex = 0, by_edge = 0, touched_only = 0, at_start = 0,
      missed_by_segments = 0;
  int exhaustive_equal = 0, exhaustive_earlier = 0, exhaustive_later = 0, exhaustive_none = 0;
  int traversed_equal = 0, traversed_other = 0;
  int against = 0, segments_when_blocked = 0;
  int bisected_close = 0, bisected_late = 0, bisected_none = 0, bisected_grazing = 0, bisected_elsewhere = 0;
  Edge_counts counts;
};

constexpr double tolerance = 0x1p-12;

/// Of a normal whose components are right to 1e-14.
constexpr double normal_error = 1e-13;

/// The normal of an edge is against the motion; that of a wall is, too, unless it is that by less than it is
/// rounded.
template <int D>
void expect_against(const Edge_world<D>& w, const Particle<D>& p, const Point<D>& target,
                    const Contact<D>& contact, Sweep_seen& seen) {
  const Vector<D> motion = target - p.position;
  const double along = dot(contact.normal, motion);
  EXPECT_LT(along, contact.body == Body_feature::edge ? 0 : normal_error * length(motion))
      << w.world.name << ", kind " << static_cast<int>(contact.kind);
  ++seen.against;
}

/// The paper's bisection: the edge is free where it says, as far as a walk along it tells.
template <int D>
void compare_bisected_segment(const Edge_world<D>& w, const Particle<D>& p, const Point<D>& target,
                              const Particle<D>& q, const Chain& chain, const Sweep_result<D>& exact,
                              bool generic, Sweep_seen& seen) {
  const std::uint64_t misses = seen.counts.search_misses, walks = seen.counts.search_walks;
  const Search_options search{Contact_search::dichotomic_segment, tolerance};
  const Sweep_result<D> found = sweep_edge(w.snapshot, p, target, q, chain, {.search = &search}, seen.counts);
  ASSERT_TRUE(found.contact);
  if (found.contact->body == Body_feature::edge) expect_against(w, p, target, *found.contact, seen);
  if (seen.counts.search_misses > misses) {
    // The edge is free at the end, and the exact contact is reported, or before it that of p.
    EXPECT_FALSE(exact.contact->exact_time() < found.contact->exact_time());
    ++seen.bisected_none;
    return;
  }
  EXPECT_LE(seen.counts.search_walks - walks, 2 * 13u);  // twice, if other sides were tried
  if (found.contact->body == Body_feature::vertex) return;
  Particle<D> here = p;
  const Point<D> place = point_on<D>(p.position, target, found.contact->time);
  const bool is_free = move(w.snapshot, here, place, seen.counts.walk).status == Walk_status::arrived &&
                       !find_any_chain(w.snapshot, here, q, seen.counts.walk).contact;
  // The search comes there by several moves between rounded points, so it may be on another side of a wall,
  // or where a wall is in the way of one move.
  seen.bisected_elsewhere += !is_free;
  if (generic) {
    EXPECT_TRUE(is_free) << w.world.name;
  }
  if (exact.contact->exact_time() < found.contact->exact_time())
    ++seen.bisected_late;
  else if (exact.contact->time <= found.contact->time + tolerance)
    ++seen.bisected_close;
  else
    ++seen.bisected_grazing;  // p(s), rounded, met what p(s) passes
  if (generic) {
    EXPECT_EQ(seen.bisected_grazing, 0);
  }
}

/// A sweep by all searches and policies. `exact` is the complete one with an exact search.
template <int D>
void compare(const Edge_world<D>& w, const Particle<D>& p, const Point<D>& target, const Particle<D>& q,
             const Chain& chain, const Sweep_result<D>& exact, bool generic, Sweep_seen& seen) {
  const auto answer = [&](const Sweep_options& options) {
    return sweep_edge(w.snapshot, p, target, q, chain, options, seen.counts);
  };
  Sweep_options options;
  options.touch = Touch::stop;
  const Sweep_result<D> touched = answer(options);
  if (exact.contact) {
    ASSERT_TRUE(touched.contact) << w.world.name;
    EXPECT_FALSE(exact.contact->exact_time() < touched.contact->exact_time());
  } else {
    seen.touched_only += touched.contact.has_value();
  }
  if (generic) {
    ASSERT_EQ(touched.contact.has_value(), exact.contact.has_value()) << w.world.name;
    if (exact.contact) {
      EXPECT_EQ(touched.contact->exact_time(), exact.contact->exact_time()) << w.world.name;
    }
  }
  if (touched.contact) expect_against(w, p, target, *touched.contact, seen);
  const Sweep_result<D> segments = answer({.sweep = Sweep::three_segments});
  if (segments.contact) expect_against(w, p, target, *segments.contact, seen);
  if (!exact.contact) {
    EXPECT_FALSE(segments.contact) << w.world.name;
    return;
  }
  seen.missed_by_segments += !segments.contact;
  seen.at_start += exact.contact->exact_time() == Exact_time();
  if (segments.contact) {
    EXPECT_FALSE(segments.contact->exact_time() < exact.contact->exact_time()) << w.world.name;
  }
  expect_against(w, p, target, *exact.contact, seen);
  if (exact.contact->body == Body_feature::vertex) return;
  Particle<D> walked = p;
  if (segments.contact && segments.contact->body == Body_feature::edge &&
      move(w.snapshot, walked, target, seen.counts.walk).contact)
    ++seen.segments_when_blocked;
  compare_bisected_segment(w, p, target, q, chain, exact, generic, seen);

  const Search_options bisection{Contact_search::dichotomic, tolerance};
  const Sweep_result<D> bisected = answer({.search = &bisection});
  ASSERT_TRUE(bisected.contact);
  if (bisected.contact->body == Body_feature::edge) {
    EXPECT_FALSE(exact.contact->exact_time() < bisected.contact->exact_time()) << w.world.name;
    EXPECT_LE(exact.contact->time, bisected.contact->time + tolerance) << w.world.name;
    EXPECT_NEAR(length(bisected.contact->normal), 1, 1e-14);
    expect_against(w, p, target, *bisected.contact, seen);
  }

  Search_options exhaustive{.method = Contact_search::exhaustive};
  const std::uint64_t misses = seen.counts.search_misses;
  const Sweep_result<D> found = answer({.search = &exhaustive});
  const bool none = seen.counts.search_misses > misses;
  seen.exhaustive_none += none;
  ASSERT_TRUE(found.contact);
  const auto order = found.contact->exact_time() <=> exact.contact->exact_time();
  seen.exhaustive_equal += !none && order == 0;
  seen.exhaustive_earlier += order < 0;  // an obstacle that is merely touched
  seen.exhaustive_later +=
      order > 0;  // no obstacle vertex or edge is met: an edge pulled out of the plane of a wall
  if (generic) {
    EXPECT_TRUE(!none && order == 0) << w.world.name;
  }
  // The search looks at obstacles as they lie; where they block without being met, the exact contact is in
  // the plane of a wall.
  if (order > 0) {
    EXPECT_NE(exact.contact->kind, Contact_kind::facet) << w.world.name;
  }
  if (found.contact->body == Body_feature::edge) expect_against(w, p, target, *found.contact, seen);
  const std::uint64_t walls = seen.counts.search_walls;
  answer({.search = &exhaustive});
  const std::uint64_t walls_below = seen.counts.search_walls - walls;
  exhaustive.below = false;
  const Sweep_result<D> of_all = answer({.search = &exhaustive});
  EXPECT_EQ(of_all.contact->exact_time(), found.contact->exact_time());
  EXPECT_EQ(of_all.contact->facet, found.contact->facet);
  EXPECT_GE(seen.counts.search_walls - walls, 2 * walls_below);
  exhaustive.below = true;
  exhaustive.cells = Search_cells::traversed;
  const std::uint64_t before = seen.counts.search_misses;
  const Sweep_result<D> paper = answer({.search = &exhaustive});
  const bool is_equal =
      seen.counts.search_misses == before && paper.contact->exact_time() == found.contact->exact_time();
  (is_equal ? seen.traversed_equal : seen.traversed_other) += 1;
}

template <int D>
Sweep_seen run(bool generic) {
  Sweep_seen seen;
  const std::size_t worlds = oracle::scaled_count(2 * oracle::world_kinds);
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(number, generic);
    for (int k = 0; k < 40; ++k) {
      Particle<D> p = w.start();
      if (p.cell == Cell::none) continue;
      const Particle<D> q = w.end(p);
      if (q.cell == Cell::none) continue;
      Chain_result<D> edge = find_chain(w.snapshot, p, q, seen.counts.walk);
      if (edge.contact) continue;
      Chain chain = edge.chain;
      for (int step = 0; step < 4; ++step) {
        w.choose_kind();
        const Point<D> target = w.target(p);
        const Sweep_result<D> exact = sweep_edge(w.snapshot, p, target, q, chain, {}, seen.counts);
        ++seen.sweeps;
        compare(w, p, target, q, chain, exact, generic, seen);
        if (exact.contact) {
          ++(exact.contact->body == Body_feature::vertex ? seen.by_vertex : seen.by_edge);
          EXPECT_EQ(exact.p.position, p.position);
          EXPECT_NEAR(length(exact.contact->normal), 1, 1e-14) << w.world.name;
          continue;
        }
        ++seen.free;
        EXPECT_EQ(exact.p.position, target);
        p = exact.p;
        chain = exact.chain;
      }
    }
  }
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.sweeps << " sweeps, "
            << seen.free << " free (" << seen.touched_only << " of them touch a wall), " << seen.by_vertex
            << " stopped by p, " << seen.by_edge << " by the edge (" << seen.missed_by_segments
            << " missed by three segments, " << seen.at_start << " contacts at 0); exhaustive equal to exact "
            << seen.exhaustive_equal << ", earlier " << seen.exhaustive_earlier << ", later "
            << seen.exhaustive_later << ", no obstacle " << seen.exhaustive_none
            << "; with the cells traversed equal " << seen.traversed_equal << ", other "
            << seen.traversed_other << "; bisected segment close " << seen.bisected_close << ", late "
            << seen.bisected_late << ", grazing " << seen.bisected_grazing << ", free at the end "
            << seen.bisected_none << "; " << seen.segments_when_blocked
            << " by the edge before a wall stops p, of three segments; " << seen.against
            << " normals against the motion\n";
  return seen;
}

template <int D>
void test_searches() {
  for (const bool generic : {true, false}) {
    const Sweep_seen seen = run<D>(generic);
    EXPECT_LE(seen.bisected_elsewhere, seen.bisected_close / 100);
    if (oracle::scaled_count(2 * oracle::world_kinds) < 2 * oracle::world_kinds) continue;
    EXPECT_GT(seen.free, 500);
    EXPECT_GT(seen.by_vertex, 100);
    EXPECT_GT(seen.by_edge, 40);
    EXPECT_GT(seen.missed_by_segments, 0);
    EXPECT_GT(seen.exhaustive_equal, 20);
    EXPECT_GT(seen.traversed_equal, 10);
    EXPECT_GT(seen.against, 1000);
    EXPECT_GT(seen.segments_when_blocked, 10);
    EXPECT_GT(seen.bisected_close, 20);
    EXPECT_GT(seen.bisected_none, 0);
    if (!generic) {
      EXPECT_GT(seen.touched_only, 50);
      EXPECT_GT(seen.at_start, 100);
    }
  }
}

/// A grid of unit cells, some of them solid, and an edge in it.
struct Room_2 {
  Snapshot<2> snapshot;
  Locator<2> locator;

  Room_2(std::array<std::uint32_t, 2> cells, std::vector<std::uint32_t> solid)
      : snapshot(compiled(cells, std::move(solid))), locator(snapshot) {}

  static Snapshot<2> compiled(std::array<std::uint32_t, 2> cells, std::vector<std::uint32_t> solid) {
    Grid_options<2> options;
    options.cells = cells;
    options.solid_cells = std::move(solid);
    const Cell_soup<2> soup = square_grid(options);
    return Snapshot<2>::compile(soup, glue(soup));
  }
  Sweep_result<2> sweep(const Point<2>& from, const Point<2>& to, const Point<2>& q,
                        const Sweep_options& options, Edge_counts& counts) const {
    const Particle<2> p = locator.particle_at(from).value(), end = locator.particle_at(q).value();
    const auto before = find_chain(snapshot, p, end, counts.walk);
    EXPECT_FALSE(before.contact);
    return sweep_edge(snapshot, p, to, end, before.chain, options, counts);
  }
};

/// What the paper's bisection misses: the edge meets one obstacle and leaves it behind before half of the
/// motion, where it is free again; then it meets the next.
TEST(Sweep, BisectionOfTheSegmentMissesWhatTheEdgeLeavesBehind) {
  const Room_2 room({7, 5}, {8, 13});  // at (1,1) and (6,1)
  const Point<2> from{0.25, 0.75}, to{6.75, 0.75}, q{0.5, 4.75};
  Edge_counts counts;
  const auto time = [&](const Sweep_options& options) {
    const auto contact = room.sweep(from, to, q, options, counts).contact;
    EXPECT_TRUE(contact);
    return contact ? contact->time : 0;
  };
  // In the line from q through (1,1) p is at x = 31/30; the other obstacle begins at (6,1).
  const double first = (31.0 / 30 - 0.25) / 6.5, second = (0.5 + 5.5 * 16 / 15 - 0.25) / 6.5;
  for (const Sweep sweep : {Sweep::triangle, Sweep::three_segments}) {
    EXPECT_NEAR(time({.sweep = sweep}), first, 1e-15);
    Search_options search{Contact_search::dichotomic, 0x1p-10};
    const Sweep_options options{.sweep = sweep, .search = &search};
    EXPECT_NEAR(time(options), first, 0x1p-10);
    EXPECT_EQ(counts.search_walks, 0u);
    search.method = Contact_search::dichotomic_segment;
    EXPECT_NEAR(time(options), second, 0x1p-10);
    EXPECT_EQ(counts.search_walks, 11u) << "the end, and ten halves";
    counts = {};
  }
  // Where the edge is free at its end there is nothing to bisect: the exact contact is reported.
  const Search_options search{Contact_search::dichotomic_segment};
  EXPECT_NEAR(room.sweep(from, {4, 0.75}, q, {.search = &search}, counts).contact->time,
              (31.0 / 30 - 0.25) / 3.75, 1e-15);
  EXPECT_EQ(counts.search_misses, 1u);
}

/// Three segments look at the edge where a wall stops p, too, exactly: here it is free there, though it is
/// not beyond the wall.
TEST(Sweep, ThreeSegmentsEndWhereAWallStopsP) {
  const Room_2 room({4, 3}, {5});  // at (1,1)
  Edge_counts counts;
  const auto by = [&](const Point<2>& to, Sweep sweep) {
    return room.sweep({0.5, 0.25}, to, {2.5, 0.5}, {.sweep = sweep}, counts).contact;
  };
  for (const Sweep sweep : {Sweep::triangle, Sweep::three_segments}) {
    // The line from q through (1,1) meets that of p at y = 7/6.
    const auto met = by({0.5, 5}, sweep);
    ASSERT_TRUE(met);
    EXPECT_EQ(met->body, Body_feature::edge);
    EXPECT_NEAR(met->time, (7.0 / 6 - 0.25) / 4.75, 1e-15);
    // p leaves the room to the left, below that line; with the motion as far, above it.
    const auto left = by({-2.5, 2.5}, sweep);
    ASSERT_TRUE(left);
    EXPECT_EQ(left->body, Body_feature::vertex);
    EXPECT_NEAR(left->time, 1.0 / 6, 1e-15);
  }
  EXPECT_EQ(by({0.5, 5}, Sweep::three_segments)->normal, by({0.5, 5}, Sweep::triangle)->normal);
}

/// A body edge that is nearly parallel to the edge of a solid cell which it meets. The wall that is named may
/// face along the motion.
TEST(Sweep, NormalsAtParallelEdgesAreAgainstTheMotion) {
  Grid_options<3> grid;
  grid.cells = {3, 3, 3};
  grid.solid_cells = {13};
  const Cell_soup<3> soup = hex_grid(grid);
  const auto snapshot = Snapshot<3>::compile(soup, glue(soup));
  const Locator<3> locator(snapshot);
  Edge_counts counts;
  int parallel = 0, skew = 0;
  for (const bool is_mirrored : {false, true})
    for (int bits = 20; bits <= 50; ++bits) {
      // q is next to the edge x = y = 2; p passes the plane in which that and q lie.
      const double d = std::ldexp(1.0, -bits);
      const auto at = [&](double x, double y, double z) {
        return is_mirrored ? Point<3>{y, x, z} : Point<3>{x, y, z};
      };
      const Particle<3> q = locator.particle_at(at(2 - d, 2 + d, 1.125)).value();
      const Particle<3> p = locator.particle_at(at(1.625 + 2 * d, 2.625, 2.625)).value();
      const Point<3> target = at(2.375 + 2 * d, 1.375, 2.625);
      const auto before = find_any_chain(snapshot, p, q, counts.walk);
      ASSERT_FALSE(before.contact);
      const auto contact = sweep_edge(snapshot, p, target, q, before.chain, {}, counts).contact;
      ASSERT_TRUE(contact) << bits;
      EXPECT_LT(dot(contact->normal, target - p.position), 0) << "2^-" << bits;
      EXPECT_NEAR(length(contact->normal), 1, 1e-14);
      ++(bits > 42 ? parallel : skew);
    }
  EXPECT_EQ(parallel, 16);
  EXPECT_EQ(skew, 46);
}

TEST(Sweep, SearchesAgree2) { test_searches<2>(); }
TEST(Sweep, SearchesAgree3) { test_searches<3>(); }

}  // namespace
}  // namespace cellwalk::test
