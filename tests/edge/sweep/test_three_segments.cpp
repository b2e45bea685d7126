// SPDX-License-Identifier: LGPL-3.0-or-later
// The certificates of an edge never say free where a wall crosses the triangle that the edge swept.
#include <cellwalk/internal/edge/three_segments.h>

#include <gtest/gtest.h>

#include <iostream>

#include "edge/edge_worlds.h"

namespace cellwalk::test {
namespace {

struct Three_segments_seen {
  int sweeps = 0, missed = 0, blocked = 0, crossed = 0;
  Edge_counts counts;
};

template <int D>
Three_segments_seen sweep(bool generic) {
  Three_segments_seen seen;
  for (std::uint64_t number = 0; number < 2 * oracle::world_kinds; ++number) {
    Edge_world<D> w(number, generic);
    for (int k = 0; k < 60; ++k) {
      Particle<D> p = w.start();
      if (p.cell == Cell::none) continue;
      const Particle<D> q = w.end(p);
      if (q.cell == Cell::none) continue;
      Chain_result<D> edge = find_chain(w.snapshot, p, q, seen.counts.walk);
      // The end is moved on and on, so that chains grow, shrink and turn.
      for (int step = 0; step < 6 && !edge.contact; ++step) {
        const Point<D> a = p.position;
        const Particle<D> from = p;
        std::vector<Half_facet> crossed;
        w.choose_kind();
        const auto walked =
            move(w.snapshot, p, w.target(p), seen.counts.walk, {Walk_strategy::certified, nullptr, &crossed});
        if (walked.status != Walk_status::arrived) continue;
        const std::uint64_t proved_before = seen.counts.same_cell + seen.counts.same_chain;
        edge = check_third_segment<D>(w.snapshot, {from, p, {}, crossed}, q, edge.chain, seen.counts);
        const bool proved = seen.counts.same_cell + seen.counts.same_chain > proved_before;
        const bool is_hit = w.walls.is_crossed(a, p.position, q.position);
        ++seen.sweeps;
        seen.blocked += edge.contact.has_value();
        seen.crossed += is_hit;
        seen.missed += is_hit && !edge.contact;
        if (proved) {
          EXPECT_FALSE(is_hit);
          EXPECT_FALSE(edge.contact);
        }
        if (!edge.contact) expect_leads(w.snapshot, edge.chain, p.cell, q.cell);
      }
    }
  }
  const Edge_counts& c = seen.counts;
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.sweeps
            << " sweeps: same cell " << c.same_cell << ", same chain " << c.same_chain << ", changed "
            << c.changed << "; blocked " << seen.blocked << ", crossed by a wall " << seen.crossed
            << ", of these missed " << seen.missed << "\n";
  EXPECT_EQ(c.edges, static_cast<std::uint64_t>(seen.sweeps));
  EXPECT_EQ(c.edges, c.same_cell + c.convex_pair + c.same_chain + c.changed);
  return seen;
}

template <int D>
void test_sweeps() {
  for (const bool generic : {true, false}) {
    const Three_segments_seen seen = sweep<D>(generic);
    EXPECT_GT(seen.sweeps, 1000);
    EXPECT_GT(seen.counts.same_cell, 100u);
    EXPECT_GT(seen.counts.same_chain, 100u);
    EXPECT_GT(seen.counts.changed, 100u);
    EXPECT_GT(seen.crossed, 50);
    EXPECT_GT(seen.missed, 0) << "what fits inside the triangle is missed: the paper's limit";
  }
}

TEST(ThreeSegments, CertificatesNeverHideACrossing2) { test_sweeps<2>(); }
TEST(ThreeSegments, CertificatesNeverHideACrossing3) { test_sweeps<3>(); }

}  // namespace
}  // namespace cellwalk::test
