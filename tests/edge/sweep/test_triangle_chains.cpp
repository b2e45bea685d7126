// SPDX-License-Identifier: LGPL-3.0-or-later
// The complete sweep against the oracle that follows the definition of chains: on the worlds of the walk, and
// on worlds of spikes and long edges, where edges slide in planes of walls.
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <sstream>

#include "edge/edge_worlds.h"
#include "edge/forgotten_slits.h"
#include "edge/sweep_judge.h"
#include "edge/thin_worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

using Faults = std::array<int, static_cast<std::size_t>(Sweep_fault::count)>;

struct Chains_seen {
  int judged = 0;                                 ///< sweeps
  int p_blocked = 0;                              ///< p was
  int collinear = 0;                              ///< p moved in the line of the edge
  int must_block = 0, must_free = 0, either = 0;  ///< by the oracle
  int only_together = 0;                          ///< blocked, but crossed by no single wall
  int at_once = 0;                                ///< blocked at time 0
  int touching = 0;                               ///< a point of the edge had free space on several sides
  int in_wall = 0;                                ///< a piece of it had
  int in_wall_free = 0;                           ///< and was not blocked
  int choices = 0;                                ///< sides were chosen
  int long_chains = 0;                            ///< of 8 facets or more
  Faults faults{}, faults_of_third_side{};
  Edge_counts counts;
  bool is_broken = false;  ///< on purpose: faults are counted only
  int wrong = 0;           ///< proved by a certificate that is wrong
  int crossed_free = 0;    ///< by a single wall, and not blocked: what the oracle of walls sees of that
};

int count(const Faults& faults) { return std::accumulate(faults.begin() + 1, faults.end(), 0); }
int misses(const Faults& faults) { return faults[static_cast<std::size_t>(Sweep_fault::false_free)]; }

/// All that is needed to repeat a motion: points, and cells and half-facets of the soup.
template <int D>
std::string describe(const oracle::Edge_motion<D>& motion) {
  std::ostringstream text;
  const auto add = [&](const char* name, const auto& values) {
    text << ", " << name;
    for (const auto& x : values) text << ' ' << x;
  };
  text << std::hexfloat;
  add("p from", motion.a), add("to", motion.b), add("q", motion.q);
  add("cells of p", motion.path), add("chain", motion.chain);
  text << ", cell of q " << motion.q_cell << (motion.blocked ? ", p blocked" : "");
  return text.str();
}

/// A sweep, and what is said of it.
template <int D>
void judge(const Edge_world<D>& w, const oracle::Chain_oracle<D>& oracle, const Vertex_path<D>& path,
           const Particle<D>& q, const Chain& before, const Sweep_result<D>& result, Chains_seen& seen) {
  const auto motion = motion_of(w.world.soup, w.snapshot, path, q, before);
  const oracle::Outcomes outcomes = oracle.judge(motion);
  const auto fault = fault_of(oracle, motion, outcomes, w.snapshot, result);
  ++seen.judged;
  ++seen.faults[static_cast<std::size_t>(fault)];
  if (seen.is_broken)
    seen.crossed_free += !result.contact && !path.blocked && w.walls.is_crossed(motion.a, motion.b, motion.q);
  else
    EXPECT_EQ(fault, Sweep_fault::none)
        << w.world.name << ": " << fault_names[static_cast<std::size_t>(fault)] << describe(motion);
  seen.p_blocked += path.blocked;
  seen.collinear += are_collinear(motion.a, motion.b, motion.q);
  seen.must_block += !outcomes.may_be_free();
  seen.must_free += outcomes.blocks.empty();
  seen.either += outcomes.may_be_free() && !outcomes.blocks.empty();
  seen.touching += outcomes.touches;
  seen.in_wall += outcomes.lies_in_wall;
  seen.in_wall_free += outcomes.lies_in_wall && !result.contact;
  seen.choices += outcomes.choices > 0;
  seen.long_chains += before.size() >= 8;
  if (path.blocked) return;
  seen.only_together += result.contact && !w.walls.is_crossed(motion.a, motion.b, motion.q);
  seen.at_once += result.contact && result.contact->time == 0;
  // A weaker sweep must not satisfy the oracle.
  Walk_counts counts;
  const Chain_result<D> found = find_chain(w.snapshot, path.to, q, counts);
  Sweep_result<D> third{{}, found.chain};
  third.contact = found.contact;
  if (third.contact) third.contact->body = Body_feature::edge;
  const Sweep_fault of_third = fault_of(oracle, motion, outcomes, w.snapshot, third);
  ++seen.faults_of_third_side[static_cast<std::size_t>(of_third)];
}

/// Edges of one world, one end of which is moved on and on.
template <int D>
void sweep(Edge_world<D>& w, int edges, Chains_seen& seen) {
  const oracle::Chain_oracle<D> oracle(w.world.soup);
  for_each_sweep(w, edges, seen.counts.walk,
                 [&](const Moved_end<D>& moved, const Particle<D>& q, const Chain& chain) {
                   Sweep_result<D> result;
                   result.chain = chain;
                   prepend_crossed_facets(w.snapshot, result.chain, moved.path().crossed);
                   if (seen.is_broken && passes_but_for_slits(w.snapshot, result.chain))
                     ++seen.wrong;
                   else
                     result = sweep_triangle<D>(w.snapshot, moved.path(), q, chain, seen.counts);
                   judge(w, oracle, moved.path(), q, chain, result, seen);
                   return result.contact ? std::nullopt : std::optional(result.chain);
                 });
}

void report(const std::string& name, const Chains_seen& seen) {
  const Edge_counts& c = seen.counts;
  std::cout << name << ": " << seen.judged << " sweeps, p blocked " << seen.p_blocked << ", in line "
            << seen.collinear << "; same cell " << c.same_cell << ", same chain " << c.same_chain
            << ", relinked " << c.relinked << ", events " << c.event_sweeps << "; blocked " << seen.must_block
            << ", free " << seen.must_free << ", either " << seen.either << "; by no single wall "
            << seen.only_together << ", at once " << seen.at_once << "; touching " << seen.touching
            << ", in a wall " << seen.in_wall << ", of these free " << seen.in_wall_free << ", choices "
            << seen.choices << ", long chains " << seen.long_chains << "; wrong " << count(seen.faults)
            << ", of the third side " << count(seen.faults_of_third_side) << "\n";
}

/// Other worlds than those of test_triangle.cpp, at any length of the tests.
constexpr std::uint64_t first_world = 1'000'000 * oracle::world_kinds;

template <int D>
void test_worlds() {
  const std::size_t worlds = oracle::scaled_count(6 * oracle::world_kinds);
  for (const bool generic : {true, false}) {
    Chains_seen seen;
    int beside = 0;
    for (std::uint64_t number = 0; number < worlds; ++number) {
      Edge_world<D> w(first_world + number, generic);
      beside += walls_beside_ways(w.snapshot);
      sweep(w, D == 2 ? 60 : 44, seen);
    }
    report(std::to_string(D) + (generic ? "D, generic" : "D, degenerate"), seen);
    if (worlds < 6 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.judged, 4'000);
    EXPECT_GT(seen.must_block, 300);
    EXPECT_GT(seen.p_blocked, 1'500);
    EXPECT_GT(seen.counts.event_sweeps, 800u);
    EXPECT_GT(misses(seen.faults_of_third_side), 5);
    if (generic) continue;
    EXPECT_GT(beside, 15);
    EXPECT_GT(seen.collinear, 1'500);
    EXPECT_GT(seen.in_wall_free, 300);
    EXPECT_GT(seen.only_together, 10);
    EXPECT_GT(seen.at_once, 80);
  }
}

TEST(TriangleChains, AreRight2) { test_worlds<2>(); }
TEST(TriangleChains, AreRight3) { test_worlds<3>(); }

template <int D>
void test_spikes() {
  const std::size_t worlds = oracle::scaled_count(24);
  Chains_seen seen;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(spikes<D>(number), number, number % 4 == 3);
    sweep(w, 30, seen);
  }
  report(std::to_string(D) + "D, spikes", seen);
  if (worlds < 24) return;
  EXPECT_GT(seen.must_block, 150);
  EXPECT_GT(seen.long_chains, 80);
  EXPECT_GT(misses(seen.faults_of_third_side), 10);
}

TEST(TriangleChains, AreRightAmongSpikes2) { test_spikes<2>(); }
TEST(TriangleChains, AreRightAmongSpikes3) { test_spikes<3>(); }

/// Edges at rest in planes of walls slide there.
template <int D>
void test_sliding() {
  const std::size_t worlds = oracle::scaled_count(24);
  Chains_seen seen;
  int beside = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(sheets<D>(number), number, false);
    w.slides = true;
    beside += walls_beside_ways(w.snapshot);
    sweep(w, 40, seen);
  }
  report(std::to_string(D) + "D, sliding", seen);
  if (worlds < 24) return;
  EXPECT_GT(seen.judged, 2'000);
  EXPECT_GT(beside, 15);
  EXPECT_GT(seen.in_wall_free, 250);
  EXPECT_GT(D == 2 ? seen.collinear : seen.choices, 10);
}

TEST(TriangleChains, AreRightWhereEdgesSlide2) { test_sliding<2>(); }
TEST(TriangleChains, AreRightWhereEdgesSlide3) { test_sliding<3>(); }

/// Edges about slits, which cells on both sides share windows beside: what lies behind a slit is not known
/// through it.
template <int D>
void test_slits() {
  const std::size_t worlds = oracle::scaled_count(24);
  for (const bool slides : {false, true}) {
    Chains_seen seen;
    int beside = 0;
    for (std::uint64_t number = 0; number < worlds; ++number) {
      Edge_world<D> w(slit_world<D>(number), number, number % 4 == 3);
      w.slides = slides;
      beside += slits_beside_ways(w.snapshot);
      sweep(w, 40, seen);
    }
    report(std::to_string(D) + (slides ? "D, sliding along slits" : "D, slits"), seen);
    if (worlds < 24) continue;
    EXPECT_GT(beside, D == 2 ? 20 : 50);
    EXPECT_GT(seen.judged, 1'000);
    EXPECT_GT(seen.touching, 100);
    if (slides) continue;
    EXPECT_GT(seen.must_block, 100);
    EXPECT_GT(misses(seen.faults_of_third_side), 10);
  }
}

TEST(TriangleChains, AreRightBesideSlits2) { test_slits<2>(); }
TEST(TriangleChains, AreRightBesideSlits3) { test_slits<3>(); }

/// Cells with a convex union that are parted by a slit beside the facet that they share, as if they were not:
/// edges then pass through slits.
template <int D>
void test_forgotten_slits() {
  Chains_seen seen;
  seen.is_broken = true;
  for (std::uint64_t number = 0; number < 48; ++number) {
    Edge_world<D> w(windows<D>(number), number, number % 4 == 3);
    try {
      sweep(w, 40, seen);
    } catch (const std::invalid_argument&) {  // an edge that passed a wall has no chain to start with
    } catch (const Error&) {                  // or none to go on with
    }
  }
  report(std::to_string(D) + "D, slits forgotten", seen);
  EXPECT_GT(seen.wrong, 10);
  EXPECT_GT(misses(seen.faults), 0) << "by the oracle of chains";
  EXPECT_GT(seen.crossed_free, 0) << "by the oracle of walls";
}

TEST(TriangleChains, ForgottenSlitsAreCaught2) { test_forgotten_slits<2>(); }
TEST(TriangleChains, ForgottenSlitsAreCaught3) { test_forgotten_slits<3>(); }

/// The oracle takes for granted that nothing changes between its critical times: two times of each interval
/// must agree.
template <int D>
void test_critical_times() {
  const std::size_t worlds = std::max<std::size_t>(1, oracle::scaled_count(oracle::world_kinds));
  std::size_t intervals = 0, differ = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(number, number % 3 == 0);
    const oracle::Integer_complex<D> complex(w.world.soup);
    for (int k = 0; k < 12; ++k) {
      const Particle<D> a = w.start();
      const Point<D> b = w.target(a), q = w.target(a);
      const oracle::Moving_segment<D> segment(complex, a.position, b, q);
      const auto times = segment.critical_times();
      for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        const auto middle = oracle::between(times[i], times[i + 1]);
        const auto first = segment.cut(middle), second = segment.cut(oracle::between(middle, times[i + 1]));
        ++intervals;
        EXPECT_TRUE(first.is_like(second)) << w.world.name;
        differ += !first.is_like(segment.cut(times[i + 1]));
      }
    }
  }
  EXPECT_GT(intervals, 5u);
  if (worlds < oracle::world_kinds) return;
  EXPECT_GT(intervals, 500u);
  EXPECT_GT(differ, intervals / 4) << "most critical times are there for a reason";
}

TEST(TriangleChains, NothingChangesBetweenCriticalTimes2) { test_critical_times<2>(); }
TEST(TriangleChains, NothingChangesBetweenCriticalTimes3) { test_critical_times<3>(); }

}  // namespace
}  // namespace cellwalk::test
