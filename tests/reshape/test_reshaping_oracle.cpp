// SPDX-License-Identifier: LGPL-3.0-or-later
// Random moves of vertices among particles and bodies, judged one by one.
#include <cellwalk/internal/kernel/fraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "reshape/level_world.h"
#include "reshape/wall_judge.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

/// How many worlds: enough for what is looked for under a sanitizer, too.
std::size_t some_of(std::size_t worlds) { return std::max(oracle::scaled_count(worlds), worlds / 4 + 1); }

template <int D, class World, class Make>
typename test::Wall_judge<D, World>::Tally run(const char* kind, std::size_t worlds, const Make& make,
                                               Reshape_counts& counts) {
  typename test::Wall_judge<D, World>::Tally tally;
  constexpr int phases = 4, moves = 12;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    const std::unique_ptr<World> made = make(number);
    World& world = *made;
    test::Wall_judge<D, World> judge(world, tally);
    for (int phase = 0; phase < phases; ++phase) {
      {
        Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
        for (int i = 0; i < moves; ++i) {
          const std::uint32_t v = world.vertex();
          judge.judge(reshaping, v, world.target(v));
        }
        reshaping.finish();
        counts += reshaping.counts();
      }
      for (const auto& body : world.bodies) EXPECT_NO_THROW(body->validate()) << world.name();
      EXPECT_NO_THROW(world.environment.certify()) << world.name();
    }
    EXPECT_EQ(tally.wrong(), 0) << world.name();
    if (testing::Test::HasFailure()) break;
  }
  const auto& t = tally;
  std::printf(
      "%dD %s: %d moves, %d reached (%d touching, %d landed on faces), %d contacts, %d touches, %d cells, %d "
      "boundaries; missed "
      "%d, "
      "false blocks %d, wrong times %d, sides %d, ends %d\n",
      D, kind, t.moves, t.reached, t.free_touching, t.landed, t.contacts, t.touches, t.cells, t.boundaries,
      t.missed, t.false_blocks, t.wrong_times, t.wrong_sides, t.wrong_ends);
  const test::Fate_tally& f = t.fates;
  std::printf(
      "  of %d fates %d may be free; missed %d, false blocks %d, wrong times %d, wrong registrations %d; %d "
      "choices, "
      "%d undecided\n",
      f.fates, f.free_fates, f.missed, f.false_blocks, f.wrong_times, f.wrong_registrations, f.choices,
      f.undecided);
  for (const auto& [name, count] : named_counts(counts))
    std::printf("  %s %llu", std::string(name).c_str(), static_cast<unsigned long long>(count));
  std::printf("\n");
  return tally;
}

template <int D>
void expect_moves_right(bool generic, std::size_t worlds) {
  Reshape_counts counts;
  using World = test::Reshape_world<D>;
  const auto make = [&](std::uint64_t number) {
    auto world = std::make_unique<World>(number, generic);
    world->populate(12, 8);
    return world;
  };
  const auto tally = run<D, World>(generic ? "generic" : "degenerate", some_of(worlds), make, counts);
  EXPECT_EQ(tally.wrong(), 0);
  EXPECT_GT(tally.reached, tally.moves / 8);
  EXPECT_GT(tally.contacts, tally.moves / 100);
  EXPECT_GT(counts.relinked, tally.moves / 50u);
  EXPECT_LE(tally.fates.choices + tally.fates.undecided, tally.moves / 100);
  if (!generic) {
    EXPECT_GT(counts.followed, tally.moves / 5u);
    EXPECT_GT(tally.fates.free_fates, tally.moves / 4);
    EXPECT_LT(tally.fates.free_fates, tally.fates.fates * 9 / 10);
  }
}

TEST(ReshapingOracle, Generic2D) { expect_moves_right<2>(true, 60); }
TEST(ReshapingOracle, Degenerate2D) { expect_moves_right<2>(false, 60); }
TEST(ReshapingOracle, Generic3D) { expect_moves_right<3>(true, 14); }
TEST(ReshapingOracle, Level3D) {
  Reshape_counts counts;
  const auto make = [](std::uint64_t number) {
    auto world = std::make_unique<test::Level_world>(number);
    world->populate(3, 3);
    return world;
  };
  const auto tally = run<3, test::Level_world>("level", some_of(8), make, counts);
  EXPECT_EQ(tally.wrong(), 0);
  EXPECT_GT(tally.landed, static_cast<int>(oracle::scaled_count(10)));
  EXPECT_GT(counts.rested, oracle::scaled_count(50));
}
TEST(ReshapingOracle, Degenerate3D) { expect_moves_right<3>(false, 14); }

}  // namespace
}  // namespace cellwalk
