// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of vertices judged at length, in worlds where bodies move and walls are edited in between.
#include <cellwalk/internal/kernel/fraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include "reshape/restless_world.h"
#include "reshape/wall_judge.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <int D>
using Judge = test::Wall_judge<D, test::Restless_world<D>>;

/// Judges moves, and that asking first gives the same answer.
template <int D>
void judge_phase(test::Restless_world<D>& world, typename Judge<D>::Tally& tally, Reshape_counts& counts) {
  constexpr int moves = 12;
  Judge<D> judge(world, tally);
  Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
  for (int i = 0; i < moves; ++i) {
    const std::uint32_t v = world.vertex();
    const Point<D> target = world.target(v);
    // This also registers what bodies left to whoever asks first.
    reshaping.test_move(v, target);
    judge.judge(reshaping, v, target);
  }
  reshaping.finish();
  counts += reshaping.counts();
}

template <int D>
struct Seen {
  typename Judge<D>::Tally tally;
  Reshape_counts counts;
  std::uint64_t worlds = 0, edits = 0, in_region = 0, dropped = 0;

  void print(const char* kind) const {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    const auto& t = tally;
    const test::Fate_tally& f = t.fates;
    std::printf(
        "%dD %s, %llu worlds: %d moves, %d reached (%d touching, %d landed on faces), %d contacts, %d "
        "touches, "
        "%d cells, %d boundaries; missed %d, false blocks %d, wrong times %d, sides %d, ends %d, tunnels "
        "%d\n",
        D, kind, number(worlds), t.moves, t.reached, t.free_touching, t.landed, t.contacts, t.touches,
        t.cells, t.boundaries, t.missed, t.false_blocks, t.wrong_times, t.wrong_sides, t.wrong_ends,
        t.tunnels);
    std::printf(
        "  of %d fates %d may be free; missed %d, false blocks %d, wrong times %d, wrong registrations %d; "
        "%d "
        "choices, %d undecided; %llu edits, %llu moves of bodies in regions, %llu bodies dropped\n",
        f.fates, f.free_fates, f.missed, f.false_blocks, f.wrong_times, f.wrong_registrations, f.choices,
        f.undecided, number(edits), number(in_region), number(dropped));
    std::fflush(stdout);
  }
};

template <int D>
void expect_restless_right(bool generic, std::size_t worlds) {
  Seen<D> seen;
  auto& tally = seen.tally;
  const char* const kind = generic ? "generic" : "degenerate";
  constexpr int phases = 5;
  // Enough for all kinds of worlds under a sanitizer, too.
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 4 + 1),
                    printed_every = D == 2 ? 1000 : 100;
  for (; seen.worlds < count && tally.wrong() == 0; ++seen.worlds) {
    // Others than those of tests without edits.
    test::Restless_world<D> world(1000 + seen.worlds, generic);
    world.populate(D == 2 ? 10 : 6, D == 2 ? 8 : 6);
    for (int phase = 0; phase < phases; ++phase) {
      SCOPED_TRACE(world.name() + ", phase " + std::to_string(phase));
      judge_phase<D>(world, tally, seen.counts);
      Body_counts uncounted;
      for (const auto& body : world.bodies) {
        body->refresh(uncounted);
        ASSERT_NO_THROW(body->validate());
      }
      ASSERT_NO_THROW(world.environment.certify());
      ASSERT_EQ(tally.wrong(), 0);
      if (phase % 2 == 0) world.step_bodies();
      if (phase % 2 == 1) world.edit();
    }
    seen.edits += world.edits;
    seen.in_region += world.in_region;
    seen.dropped += world.dropped;
    if (seen.worlds % printed_every == printed_every - 1) seen.print(kind);
  }
  seen.print(kind);
  EXPECT_GT(tally.reached, tally.moves / 4);
  EXPECT_GT(tally.contacts, tally.moves / 50);
  EXPECT_GT(seen.edits, count / 2);
  EXPECT_GT(seen.in_region, count / 10);
  EXPECT_LT(seen.dropped, count / 2);
  EXPECT_LE(tally.fates.choices + tally.fates.undecided, tally.moves / 100);
}

TEST(RestlessOracle, Generic2D) { expect_restless_right<2>(true, 50); }
TEST(RestlessOracle, Degenerate2D) { expect_restless_right<2>(false, 50); }
TEST(RestlessOracle, Generic3D) { expect_restless_right<3>(true, 10); }
TEST(RestlessOracle, Degenerate3D) { expect_restless_right<3>(false, 10); }

}  // namespace
}  // namespace cellwalk
