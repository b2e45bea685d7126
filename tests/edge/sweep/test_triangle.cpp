// SPDX-License-Identifier: LGPL-3.0-or-later
// The complete sweep against brute force over all walls in rationals.
#include <cellwalk/internal/edge/triangle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "edge/edge_worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

constexpr bool no_certificates = false;

struct Triangle_seen {
  std::uint64_t compared = 0;  ///< with the sweep without certificates
  int sweeps = 0, hits = 0, misses = 0, wrong_times = 0, only_blocked = 0, third_free = 0;
  int blocked = 0, edge_first = 0;  ///< p was; the edge was before
  Edge_counts counts;
};

/// p is blocked on its way: the edge must be hit exactly if a wall crosses its triangle before that.
template <int D>
void check_blocked(const Edge_world<D>& w, const Moved_end<D>& moved, const Particle<D>& q,
                   const Chain& chain, bool generic, Triangle_seen& seen) {
  const Sweep_result<D> edge = sweep_triangle<D>(w.snapshot, moved.path(), q, chain, seen.counts);
  const auto hit = w.walls.first_hit(moved.from.position, moved.to.position, q.position);
  constexpr double rounding = 0x1p-50;  // of all three times
  ++seen.blocked;
  if (edge.contact) {
    ++seen.edge_first;
    EXPECT_LE(edge.contact->time, moved.contact->time + rounding);
    if (generic) {
      EXPECT_TRUE(hit && std::abs(*hit - edge.contact->time) <= rounding) << w.world.name;
    }
  } else if (hit) {
    EXPECT_GE(*hit, moved.contact->time - rounding)
        << w.world.name << ": an edge hit before its end is missed";
  }
}

/// p arrives: the edge must be hit exactly if a wall crosses its triangle.
template <int D>
Sweep_result<D> check_arrived(const Edge_world<D>& w, const Moved_end<D>& moved, const Particle<D>& q,
                              const Chain& chain, bool generic, Triangle_seen& seen) {
  Edge_counts bare;
  const bool is_compared = seen.sweeps % 4 == 0;
  const bool is_free =
      is_compared && !sweep_triangle<D>(w.snapshot, moved.path(), q, chain, bare, no_certificates).contact;
  seen.compared += bare.event_sweeps;
  const Sweep_result<D> edge = sweep_triangle<D>(w.snapshot, moved.path(), q, chain, seen.counts);
  if (is_compared) {
    EXPECT_EQ(is_free, !edge.contact) << w.world.name << ": a certificate changes the answer";
  }
  const auto hit = w.walls.first_hit(moved.from.position, moved.to.position, q.position);
  ++seen.sweeps;
  seen.hits += hit.has_value();
  if (!edge.contact) expect_leads(w.snapshot, edge.chain, moved.to.cell, q.cell);
  if (hit && !edge.contact) {
    ++seen.misses;
    ADD_FAILURE() << w.world.name << ": missed at " << *hit;
  }
  if (!hit && edge.contact) {
    ++seen.only_blocked;
    EXPECT_FALSE(generic) << w.world.name << ": false block at " << edge.contact->time;
  }
  if (hit && edge.contact) {
    // Walls may block before one of them crosses: where two meet in the plane of the triangle, or p took a
    // side.
    constexpr double rounding = 0x1p-52;  // of both times
    const double early = *hit - edge.contact->time;
    seen.wrong_times += early < 0 || (generic && early > rounding);
    EXPECT_GE(early, 0) << w.world.name;
    if (generic) {
      EXPECT_LE(early, rounding) << w.world.name;
    }
    seen.third_free += !find_chain(w.snapshot, moved.to, q, seen.counts.walk).contact;
  }
  return edge;
}

/// Of each kind. Sweeps in 3D take four times as long.
template <int D>
constexpr std::size_t worlds_of_a_kind = D == 2 ? 20 : 16;

template <int D>
Triangle_seen sweep_triangles(bool generic) {
  Triangle_seen seen;
  const std::size_t worlds = oracle::scaled_count(worlds_of_a_kind<D> * oracle::world_kinds);
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(number, generic);
    for_each_sweep(w, 60, seen.counts.walk,
                   [&](const Moved_end<D>& moved, const Particle<D>& q, const Chain& chain) {
                     if (moved.contact) {
                       check_blocked(w, moved, q, chain, generic, seen);
                       return std::optional<Chain>();
                     }
                     const Sweep_result<D> edge = check_arrived(w, moved, q, chain, generic, seen);
                     return edge.contact ? std::nullopt : std::optional(edge.chain);
                   });
  }
  const Edge_counts& c = seen.counts;
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.sweeps << " sweeps, "
            << seen.hits << " crossed by a wall, " << seen.only_blocked << " blocked otherwise; "
            << seen.third_free << " of these with a free third side; same cell " << c.same_cell
            << ", same chain " << c.same_chain << ", events " << c.event_sweeps << "; missed " << seen.misses
            << "; p blocked " << seen.blocked << ", the edge before " << seen.edge_first << "\n";
  return seen;
}

template <int D>
void test_triangles() {
  for (const bool generic : {true, false}) {
    const Triangle_seen seen = sweep_triangles<D>(generic);
    EXPECT_EQ(seen.misses, 0);
    EXPECT_EQ(seen.wrong_times, 0);
    if (oracle::scaled_count(2) < 2) continue;  // too few to meet everything
    EXPECT_GT(seen.sweeps, D == 2 ? 15'000 : 10'000);
    EXPECT_GT(seen.compared, 2'000u);
    EXPECT_GT(seen.hits, 500);
    EXPECT_GT(seen.third_free, 40);
    EXPECT_GT(seen.blocked, 7'000);
    EXPECT_GT(seen.edge_first, 800);
    EXPECT_GT(seen.counts.event_sweeps, 3'000u);
    EXPECT_GT(seen.counts.same_cell, 1'000u);
    EXPECT_GT(seen.counts.same_chain, 3'500u);
  }
}

TEST(Triangle, NeverMissesACrossing2) { test_triangles<2>(); }
TEST(Triangle, NeverMissesACrossing3) { test_triangles<3>(); }

}  // namespace
}  // namespace cellwalk::test
