// SPDX-License-Identifier: LGPL-3.0-or-later
// One interface to sweeps, touches and searches: what each must be to the others.
#include <cellwalk/edge/sweep.h>

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
  Edge_counts counts;
};

constexpr double tolerance = 0x1p-12;

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
    EXPECT_FALSE(exact.contact->impact < touched.contact->impact);
  } else {
    seen.touched_only += touched.contact.has_value();
  }
  if (generic) {
    ASSERT_EQ(touched.contact.has_value(), exact.contact.has_value()) << w.world.name;
    if (exact.contact) {
      EXPECT_EQ(touched.contact->impact, exact.contact->impact) << w.world.name;
    }
  }
  const Sweep_result<D> segments = answer({.sweep = Sweep::three_segments});
  if (!exact.contact) {
    EXPECT_FALSE(segments.contact) << w.world.name;
    return;
  }
  seen.missed_by_segments += !segments.contact;
  seen.at_start += exact.contact->impact == Exact_time();
  if (segments.contact) {
    EXPECT_FALSE(segments.contact->impact < exact.contact->impact) << w.world.name;
  }
  if (exact.contact->body == Body_feature::vertex) return;

  const Sweep_result<D> bisected = answer({.search = Contact_search::dichotomic, .tolerance = tolerance});
  ASSERT_TRUE(bisected.contact);
  if (bisected.contact->body == Body_feature::edge) {
    EXPECT_FALSE(exact.contact->impact < bisected.contact->impact) << w.world.name;
    EXPECT_LE(exact.contact->time, bisected.contact->time + tolerance) << w.world.name;
    EXPECT_NEAR(length(bisected.contact->normal), 1, 1e-14);
  }

  Sweep_options exhaustive{.search = Contact_search::exhaustive};
  const std::uint64_t misses = seen.counts.search_misses;
  const Sweep_result<D> found = answer(exhaustive);
  const bool none = seen.counts.search_misses > misses;
  seen.exhaustive_none += none;
  ASSERT_TRUE(found.contact);
  const auto order = found.contact->impact <=> exact.contact->impact;
  seen.exhaustive_equal += !none && order == 0;
  seen.exhaustive_earlier += order < 0;  // an obstacle that is merely touched
  seen.exhaustive_later +=
      order > 0;  // no obstacle vertex or edge is met: an edge pulled out of the plane of a wall
  if (generic) {
    EXPECT_TRUE(!none && order == 0) << w.world.name;
  }
  exhaustive.cells = Search_cells::traversed;
  const std::uint64_t before = seen.counts.search_misses;
  const Sweep_result<D> paper = answer(exhaustive);
  const bool is_equal = seen.counts.search_misses == before && paper.contact->impact == found.contact->impact;
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
            << seen.traversed_other << "\n";
  return seen;
}

template <int D>
void test_searches() {
  for (const bool generic : {true, false}) {
    const Sweep_seen seen = run<D>(generic);
    if (oracle::scaled_count(2 * oracle::world_kinds) < 2 * oracle::world_kinds) continue;
    EXPECT_GT(seen.free, 500);
    EXPECT_GT(seen.by_vertex, 100);
    EXPECT_GT(seen.by_edge, 40);
    EXPECT_GT(seen.missed_by_segments, 0);
    EXPECT_GT(seen.exhaustive_equal, 20);
    EXPECT_GT(seen.traversed_equal, 10);
    if (!generic) {
      EXPECT_GT(seen.touched_only, 50);
    }
  }
}

TEST(Sweep, SearchesAgree2) { test_searches<2>(); }
TEST(Sweep, SearchesAgree3) { test_searches<3>(); }

}  // namespace
}  // namespace cellwalk::test
