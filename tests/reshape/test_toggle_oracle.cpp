// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that open and close, and cells that are filled and excavated, among bodies, judged at length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "reshape/toggle_world.h"
#include "reshape/toggling.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <int D>
void expect_toggles_right(bool generic, std::size_t worlds) {
  test::Closing_tally tally;
  test::Growth_tally growth;
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 4 + 1);
  for (std::size_t n = 0; n < count; ++n) {
    SCOPED_TRACE("world " + std::to_string(n));
    test::Toggle_world<D> world(n, generic);
    world.populate(6, 6);
    for (int phase = 0; phase < 4; ++phase) {
      // All is registered where the oracle looks.
      Body_counts uncounted;
      for (const auto& body : world.bodies) body->leave_region(uncounted);
      Reshaping<D> reshaping(world.environment, world.residents());
      for (int k = 0; k < 10; ++k) {
        SCOPED_TRACE("phase " + std::to_string(phase) + ", change " + std::to_string(k));
        ASSERT_NO_FATAL_FAILURE(test::toggle_somewhere<D>(world, reshaping, tally, growth));
        ASSERT_EQ(tally.wrong(), 0) << tally.missed << " missed, " << tally.false_blocks << " false blocks, "
                                    << tally.wrong_registrations << " registrations, " << tally.wrong_holders
                                    << " holders" << tally.last;
      }
      reshaping.finish();
      ASSERT_NO_THROW(world.environment.certify());
      for (const auto& body : world.bodies) ASSERT_NO_THROW(body->validate());
      world.step_bodies();
    }
  }
  std::printf(
      "%dD %s: %d closed or filled (%d made, %d refused: %d by choices, %d by faces, of which %d undecided), "
      "%d "
      "opened, %d excavated, %d must stay\n",
      D, generic ? "generic" : "degenerate", tally.changes, tally.made, tally.refused, tally.by_choice,
      tally.by_faces, tally.undecided, growth.opened, growth.excavated, growth.kept);
  EXPECT_GT(tally.made, tally.changes / 10);
  EXPECT_GT(tally.refused, tally.changes / 10);
  EXPECT_GT(growth.opened + growth.excavated, tally.changes / 20);
}

TEST(ToggleOracle, Generic2D) { expect_toggles_right<2>(true, 30); }
TEST(ToggleOracle, Degenerate2D) { expect_toggles_right<2>(false, 30); }
TEST(ToggleOracle, Generic3D) { expect_toggles_right<3>(true, 10); }
TEST(ToggleOracle, Degenerate3D) { expect_toggles_right<3>(false, 10); }

}  // namespace
}  // namespace cellwalk
