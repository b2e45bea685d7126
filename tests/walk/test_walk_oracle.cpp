// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact walk against the oracle: no miss, no false hit, no endless walk, in any position. docs/walk.md
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

#include <iostream>

#include "walk/oracle_trial.h"

namespace cellwalk::oracle {
namespace {

constexpr std::size_t motions_in_ci = 100'000;  // ten times as many at night

template <int D>
std::vector<Walker_under_test<D>> exact_walkers() {
  return {walker<Exact, D>(Walk_strategy::certified, "certified"),
          walker<Exact, D>(Walk_strategy::exit_rule, "exit rule"),
          walker<Exact, D>(Walk_strategy::predictive_simplex, "predictive simplex"),
          walker<Lazy, D>(Walk_strategy::exit_rule, "exit rule"),
          walker<Lazy, D>(Walk_strategy::predictive_simplex, "predictive simplex")};
}

template <int D>
Tally expect_all_right(bool generic, std::uint64_t seed) {
  const std::size_t motions = scaled_count(motions_in_ci);
  const Tally tally =
      run_trial(exact_walkers<D>(), Trial_options<D>{.generic = generic, .motions = motions, .seed = seed});
  std::cout << tally.summary() << '\n';
  EXPECT_EQ(tally.motions, motions);
  EXPECT_GT(tally.walks(), 7 * motions);  // five there, and five back from where they arrive
  EXPECT_EQ(tally.wrong(), 0u) << tally.first_faults();
  EXPECT_EQ(tally.reversed_wrong, 0u) << tally.first_faults();
  // All kinds of worlds and motions took part.
  for (std::size_t n : tally.by_world) EXPECT_GT(n, motions / 20);
  for (int k = 0; k < motion_kinds; ++k)
    EXPECT_EQ(tally.by_kind[k] > motions / 20, is_generic(static_cast<Motion_kind>(k)) == generic) << k;
  EXPECT_GT(tally.wide, motions / 10);
  EXPECT_LT(tally.wide, motions / 2);
  return tally;
}

TEST(WalkOracle, Generic2) {
  const Tally t = expect_all_right<2>(true, 1'000'000);
  const std::size_t percent = t.motions / 100;
  EXPECT_GT(t.free, 20 * percent);
  EXPECT_GT(t.blocked, 20 * percent);
  EXPECT_GT(t.facet_exits, 20 * percent);
  EXPECT_GT(t.contacts_facet, 20 * percent);
  EXPECT_GT(t.reversed, 20 * percent);
  EXPECT_GE(t.most_cells, 8u);
}

TEST(WalkOracle, Generic3) {
  const Tally t = expect_all_right<3>(true, 2'000'000);
  const std::size_t percent = t.motions / 100;
  EXPECT_GT(t.free, 20 * percent);
  EXPECT_GT(t.blocked, 20 * percent);
  EXPECT_GT(t.facet_exits, 20 * percent);
  EXPECT_GT(t.contacts_facet, 20 * percent);
  EXPECT_GT(t.reversed, 20 * percent);
  EXPECT_GE(t.most_cells, 8u);
}

/// What every degenerate trial must have met, whatever the dimension.
void expect_degenerate_branches(const Tally& t) {
  const std::size_t percent = t.motions / 100;
  EXPECT_GT(t.free, 20 * percent);
  EXPECT_GT(t.blocked, 20 * percent);
  EXPECT_GT(t.either, percent / 10);
  EXPECT_GT(t.with_choice, percent / 2);
  EXPECT_GT(t.touching, 10 * percent);
  EXPECT_GT(t.within_wall, 2 * percent);
  EXPECT_GT(t.facet_exits, 10 * percent);
  EXPECT_GT(t.vertex_exits, 2 * percent);
  EXPECT_GT(t.contacts_facet, 5 * percent);
  EXPECT_GT(t.contacts_vertex, 2 * percent);
  EXPECT_GT(t.contacts_at_once, 5 * percent);
  EXPECT_GT(t.stays, 10 * percent);
  EXPECT_GT(t.reversed, 10 * percent);
  EXPECT_GT(t.arrivals_by_dimension[0], 2 * percent);
  EXPECT_GT(t.arrivals_by_dimension[1], 2 * percent);
  EXPECT_GT(t.arrivals_by_dimension[2], 2 * percent);
}

TEST(WalkOracle, Degenerate2) { expect_degenerate_branches(expect_all_right<2>(false, 3'000'000)); }

TEST(WalkOracle, Degenerate3) {
  const Tally t = expect_all_right<3>(false, 4'000'000);
  expect_degenerate_branches(t);
  const std::size_t percent = t.motions / 100;
  EXPECT_GT(t.ridge_exits, 2 * percent);
  EXPECT_GT(t.contacts_edge, 2 * percent);
  EXPECT_GT(t.arrivals_by_dimension[3], 2 * percent);
}

}  // namespace
}  // namespace cellwalk::oracle
