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
std::optional<Chain> check(const Edge_world<D>& w, const Moved_end<D>& moved, const Particle<D>& q,
                           const Chain& chain, Three_segments_seen& seen) {
  const std::uint64_t proved_before = seen.counts.same_cell + seen.counts.same_chain;
  const Chain_result<D> edge =
      check_third_segment<D>(w.snapshot, {moved.from, moved.to, {}, moved.crossed}, q, chain, seen.counts);
  const bool proved = seen.counts.same_cell + seen.counts.same_chain > proved_before;
  const bool is_hit = w.walls.is_crossed(moved.from.position, moved.to.position, q.position);
  ++seen.sweeps;
  seen.blocked += edge.contact.has_value();
  seen.crossed += is_hit;
  seen.missed += is_hit && !edge.contact;
  if (proved) {
    EXPECT_FALSE(is_hit);
    EXPECT_FALSE(edge.contact);
  }
  if (edge.contact) return std::nullopt;
  expect_leads(w.snapshot, edge.chain, moved.to.cell, q.cell);
  return edge.chain;
}

template <int D>
Three_segments_seen sweep(bool generic) {
  Three_segments_seen seen;
  for (std::uint64_t number = 0; number < 2 * oracle::world_kinds; ++number) {
    Edge_world<D> w(number, generic);
    for_each_sweep(
        w, 60, seen.counts.walk,
        [&](const Moved_end<D>& moved, const Particle<D>& q, const Chain& chain) -> std::optional<Chain> {
          return moved.contact ? std::nullopt : check(w, moved, q, chain, seen);
        });
  }
  const Edge_counts& c = seen.counts;
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.sweeps
            << " sweeps: same cell " << c.same_cell << ", same chain " << c.same_chain << ", changed "
            << c.changed << "; blocked " << seen.blocked << ", crossed by a wall " << seen.crossed
            << ", of these missed " << seen.missed << "\n";
  EXPECT_EQ(c.edges, static_cast<std::uint64_t>(seen.sweeps));
  EXPECT_EQ(c.edges, c.same_cell + c.same_chain + c.changed);
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
