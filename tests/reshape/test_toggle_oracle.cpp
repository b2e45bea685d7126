// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that open and close, and cells that are filled and excavated, among bodies, judged at length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "reshape/closing_judge.h"
#include "reshape/toggle_world.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <int D>
std::vector<bool> with_faces(const test::Toggle_world<D>& world) {
  std::vector<bool> result;
  for (const auto& body : world.bodies) result.push_back(!body->faces().empty());
  return result;
}

struct Growth_tally {
  int opened = 0, excavated = 0, kept = 0;
};

template <int D>
void toggle_somewhere(test::Toggle_world<D>& world, Reshaping<D>& reshaping, test::Closing_tally& tally,
                      Growth_tally& growth) {
  const Snapshot<D>& snapshot = world.snapshot;
  const Cell cell = world.cell();
  const Half_facet f = Snapshot<D>::half_facet(cell, world.random.below(D + 1));
  const Cell other = snapshot.neighbour(f);
  const bool is_cell = world.random.chance(0.4);
  const Cell subject = is_cell && other != Cell::none && world.random.chance(0.5) ? other : cell;
  if (is_cell ? snapshot.is_solid(subject) : snapshot.is_impassable(f)) {
    const bool is_possible =
        is_cell || (other != Cell::none && snapshot.is_solid(other) == snapshot.is_solid(cell));
    const Change_result result = is_cell ? reshaping.excavate(subject) : reshaping.open(f);
    ASSERT_EQ(result.is_made, is_possible);
    ASSERT_EQ(result.reason.empty(), is_possible);
    ASSERT_TRUE(result.held_by.empty());
    ++(!is_possible ? growth.kept : is_cell ? growth.excavated : growth.opened);
    if (is_possible) {
      ASSERT_FALSE(is_cell ? snapshot.is_solid(subject) : snapshot.is_impassable(f));
    }
    return;
  }
  if (!is_cell && snapshot.is_solid(cell)) return;
  std::vector<Half_facet> closed;
  for (std::size_t k = 0; k <= D; ++k) {
    const Half_facet g = is_cell ? Snapshot<D>::half_facet(subject, k) : f;
    if (!snapshot.is_impassable(g)) closed.insert(closed.end(), {g, snapshot.opposite(g)});
    if (!is_cell) break;
  }
  test::Closing_judge<D> judge(snapshot, world.bodies, world.particles, closed,
                               is_cell ? subject : Cell::none, with_faces(world));
  const Change_result result = is_cell ? reshaping.fill(subject) : reshaping.close(f);
  judge.judge(result, world.bodies, world.particles, tally);
  ASSERT_EQ(result.reason.empty(), result.is_made);
  for (const Half_facet g : closed) ASSERT_EQ(snapshot.is_impassable(g), result.is_made);
  if (is_cell) {
    ASSERT_EQ(snapshot.is_solid(subject), result.is_made);
  }
}

template <int D>
void expect_all_right(bool generic, std::size_t worlds) {
  test::Closing_tally tally;
  Growth_tally growth;
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
        ASSERT_NO_FATAL_FAILURE(toggle_somewhere<D>(world, reshaping, tally, growth));
        ASSERT_EQ(tally.wrong(), 0) << tally.missed << " missed, " << tally.false_blocks << " false blocks, "
                                    << tally.wrong_registrations << " registrations, " << tally.wrong_holders
                                    << " holders" << tally.last;
      }
      reshaping.close();
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

TEST(ToggleOracle, Generic2D) { expect_all_right<2>(true, 30); }
TEST(ToggleOracle, Degenerate2D) { expect_all_right<2>(false, 30); }
TEST(ToggleOracle, Generic3D) { expect_all_right<3>(true, 10); }
TEST(ToggleOracle, Degenerate3D) { expect_all_right<3>(false, 10); }

}  // namespace
}  // namespace cellwalk
