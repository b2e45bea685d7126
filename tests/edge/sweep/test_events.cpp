// SPDX-License-Identifier: LGPL-3.0-or-later
// Events: an edge that turns round a ridge goes on, and is stopped, as one that is walked along.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "edge/edge_worlds.h"
#include "edge/sweep/events.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

using detail::Event_rule;

struct Events_seen {
  int sweeps = 0, contacts = 0, turned = 0;  ///< turned: with fewer signs than by walks
  std::uint64_t signs = 0, signs_by_walks = 0;
};

template <int D>
void expect_same(const Sweep_result<D>& a, const Sweep_result<D>& b, const std::string& world) {
  EXPECT_EQ(a.chain, b.chain) << world;
  ASSERT_EQ(a.contact.has_value(), b.contact.has_value()) << world;
  if (!a.contact) return;
  EXPECT_EQ(a.contact->exact_time(), b.contact->exact_time()) << world;
  EXPECT_EQ(a.contact->exact_time(), b.contact->exact_time()) << world;
  EXPECT_EQ(a.contact->point, b.contact->point) << world;
  for (int k = 0; k < D; ++k)
    EXPECT_EQ(std::signbit(a.contact->point[k]), std::signbit(b.contact->point[k])) << world;
  EXPECT_EQ(a.contact->normal, b.contact->normal) << world;
  EXPECT_EQ(a.contact->kind, b.contact->kind) << world;
  EXPECT_EQ(a.contact->corner, b.contact->corner) << world;
  EXPECT_EQ(a.contact->facet, b.contact->facet) << world;
  EXPECT_EQ(a.contact->cell, b.contact->cell) << world;
  EXPECT_EQ(a.contact->body, b.contact->body) << world;
}

template <int D>
void test_events(bool generic) {
  Events_seen seen;
  Walk_counts uncounted;
  const std::size_t worlds = oracle::scaled_count(8 * oracle::world_kinds);
  for (std::uint64_t number = 0; number < worlds && !testing::Test::HasFailure(); ++number) {
    Edge_world<D> w(number, generic);
    for_each_sweep(w, 60, uncounted,
                   [&](const Moved_end<D>& moved, const Particle<D>& q, const Chain& chain) {
                     Walk_counts counts, by_walks;
                     const auto path = moved.path();
                     const auto sweep = [&](Event_rule rule, Walk_counts& counted) {
                       return detail::follow_events<D>(w.snapshot, path, q, chain, counted, {}, rule);
                     };
                     const Sweep_result<D> edge = sweep(Event_rule::turns, counts);
                     expect_same(edge, sweep(Event_rule::walks, by_walks), w.world.name);
                     ++seen.sweeps;
                     seen.contacts += edge.contact.has_value();
                     seen.turned += counts.predicates.orientations < by_walks.predicates.orientations;
                     seen.signs += counts.predicates.orientations;
                     seen.signs_by_walks += by_walks.predicates.orientations;
                     return edge.contact || moved.contact ? std::nullopt : std::optional(edge.chain);
                   });
  }
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.sweeps << " sweeps, "
            << seen.contacts << " with a contact, " << seen.turned << " with fewer signs, " << seen.signs
            << " signs instead of " << seen.signs_by_walks << "\n";
  if (oracle::scaled_count(2) < 2) return;  // too few to meet everything
  EXPECT_GT(seen.sweeps, 5'000);
  EXPECT_GT(seen.contacts, 500);
  EXPECT_GT(seen.turned, 1'000);
}

TEST(Events, TurnsAndWalksAgree2) {
  test_events<2>(true);
  test_events<2>(false);
}
TEST(Events, TurnsAndWalksAgree3) {
  test_events<3>(true);
  test_events<3>(false);
}

}  // namespace
}  // namespace cellwalk::test
