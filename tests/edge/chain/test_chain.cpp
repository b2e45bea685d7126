// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/chain.h>

#include <gtest/gtest.h>

#include "edge/edge_worlds.h"
#include "edge/rational_sweep.h"

namespace cellwalk::test {
namespace {

struct Chain_seen {
  int edges = 0, blocked = 0, other_sides = 0, passed = 0, unproved = 0, refuted = 0;
};

/// Chains lead from one end to the other, there and back, and what is proved passed is passed.
template <int D>
Chain_seen check_chains(bool generic) {
  Chain_seen seen;
  Walk_counts counts;
  for (std::uint64_t number = 0; number < 3 * oracle::world_kinds; ++number) {
    Edge_world<D> w(number, generic);
    for (int k = 0; k < 150; ++k) {
      const Particle<D> p = w.start();
      if (p.cell == Cell::none) continue;
      const Particle<D> q = w.end(p);
      if (q.cell == Cell::none) continue;
      const Chain_result<D> found = find_chain(w.snapshot, p, q, counts);
      ++seen.edges;
      if (found.contact) {
        ++seen.blocked;
        seen.other_sides += found.contact->time == 1 && found.contact->point == q.position;
        EXPECT_TRUE(w.snapshot.is_impassable(found.contact->facet));
        EXPECT_TRUE(found.chain.empty());
        continue;
      }
      expect_leads(w.snapshot, found.chain, p.cell, q.cell);
      const Chain back = reversed(w.snapshot, found.chain);
      expect_leads(w.snapshot, back, q.cell, p.cell);
      EXPECT_EQ(reversed(w.snapshot, back), found.chain);
      // By this edge, and by another from the same end.
      const Particle<D> other = w.end(p);
      for (const Point<D>& end : {q.position, other.position}) {
        std::vector<std::vector<Point<D>>> facets;
        for (const Half_facet f : found.chain) facets.push_back(polygon(w.snapshot, f));
        const bool proved = passes(w.snapshot, found.chain, p.position, end, counts);
        const bool is_passed = meets_in_order(p.position, end, facets);
        if (proved) {
          EXPECT_TRUE(is_passed);
        }
        if (generic && end == q.position) {
          EXPECT_TRUE(proved);
        }
        seen.passed += proved && !facets.empty();
        seen.unproved += !proved && is_passed;
        seen.refuted += !is_passed;
      }
    }
  }
  return seen;
}

template <int D>
void test_chains() {
  const Chain_seen generic = check_chains<D>(true), degenerate = check_chains<D>(false);
  EXPECT_GT(generic.edges, 1000);
  EXPECT_GT(generic.passed, 300);
  EXPECT_GT(generic.refuted, 300);
  EXPECT_EQ(generic.unproved, 0);
  EXPECT_GT(degenerate.edges, 1000);
  EXPECT_GT(degenerate.blocked, 200);
  EXPECT_GT(degenerate.other_sides, 10) << "membranes";
  EXPECT_GT(degenerate.passed, 300);
}

TEST(Chain, LeadsFromEndToEndAndIsPassedWhereThatIsProved2) { test_chains<2>(); }
TEST(Chain, LeadsFromEndToEndAndIsPassedWhereThatIsProved3) { test_chains<3>(); }

/// A row of unit cubes along x.
Snapshot<3> row(std::uint32_t n) {
  Cell_soup<3> soup;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (const Point<3>& p : {Point<3>{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}})
      soup.points.push_back({static_cast<double>(i), p[1], p[2]});
  for (std::uint32_t i = 0; i < 4 * n; i += 4)
    add_hexahedron(soup, {i, i + 4, i + 5, i + 1, i + 3, i + 7, i + 6, i + 2});
  return Snapshot<3>::compile(soup, glue(soup));
}

TEST(Chain, IsReducedWhereTheEndWalksAlongIt) {
  const Snapshot<3> snapshot = row(4);
  const Locator<3> locator(snapshot);
  Walk_counts counts;
  Particle<3> p = locator.particle_at({0.5, 0.5, 0.5}).value();
  const Particle<3> q = locator.particle_at({3.5, 0.25, 0.5}).value();
  Chain chain = find_chain(snapshot, p, q, counts).chain;
  ASSERT_EQ(chain.size(), 3u);
  const auto walk_to = [&](const Point<3>& target) {
    std::vector<Half_facet> crossed;
    ASSERT_EQ(move(snapshot, p, target, counts, {nullptr, &crossed}).status, Walk_status::arrived);
    prepend_crossed_facets(snapshot, chain, crossed);
    expect_leads(snapshot, chain, p.cell, q.cell);
    EXPECT_TRUE(passes(snapshot, chain, p.position, q.position, counts));
  };
  walk_to({2.5, 0.75, 0.5});
  EXPECT_EQ(chain.size(), 1u);
  walk_to({3.25, 0.5, 0.5});
  EXPECT_EQ(chain.size(), 0u);
  walk_to({1.5, 0.5, 0.75});
  EXPECT_EQ(chain.size(), 2u);
}

}  // namespace
}  // namespace cellwalk::test
