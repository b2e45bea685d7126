// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge, where the answer is known by hand, and against itself.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include "wall_judge.h"

namespace cellwalk::ablation {
namespace {

/// A triangle from x = 1 on, in the plane z = 0.
experiments::Wall_mesh half_plane() { return {{{1, -50, 0}, {50, 0, 0}, {1, 50, 0}}, {{0, 1, 2}}}; }

TEST(WallJudge, TellsWhereAnEdgeThatTurnsPassesTheRim) {
  const Wall_judge judge(half_plane());
  // A vertical edge at x = 0 that comes in by its middle.
  const Point<3> low{0, 0.1, -1}, high{0, 0.1, 1};
  const auto moved = [&](double x) { return Moving_edge{low, {x, 0.1, -1}, high, {x, 0.1, 1}}; };
  EXPECT_EQ(judge.judge(moved(0.9)), Verdict::free);
  EXPECT_EQ(judge.judge(moved(1.1)), Verdict::blocked);
  // Its lower end turns below the wall, and its upper one goes back: in the plane z = 0 it does not move.
  EXPECT_EQ(judge.judge({low, {2, 0.1, -1}, high, {-2, 0.1, 1}}), Verdict::free);
  // One end after the other passes the rim.
  EXPECT_EQ(judge.judge({low, {2.5, 0.1, -1}, high, high}), Verdict::blocked);
  EXPECT_EQ(judge.judge({low, low, high, {2.5, 0.1, 1}}), Verdict::blocked);
}

TEST(WallJudge, FindsWhatIsPassedThereAndBack) {
  // The edge passes the plane of the wall at x = low + 2.4 s (1 - s), as both ends of it move along x and z.
  const Wall_judge judge(half_plane());
  const auto moved = [](double low) {
    return Moving_edge{{low - 0.15, 0, -1}, {low + 1.35, 0, -9}, {low + 1.35, 0, 9}, {low - 0.15, 0, 1}};
  };
  for (const double low : {0.25, 0.40625}) {
    const Moving_edge edge = moved(low);
    EXPECT_EQ(judge.judge_segment(edge.a, edge.c), Verdict::free);
    EXPECT_EQ(judge.judge_segment(edge.b, edge.d), Verdict::free);
    EXPECT_EQ(judge.judge(edge), low < 0.4 ? Verdict::free : Verdict::blocked);
  }
  EXPECT_EQ(judge.judge({{0.25, 0, -1}, {1.75, 0, -9}, {1.75, 0, 9}, {0.25, 0, 1}}), Verdict::undecided)
      << "touches the rim at s = 1/2 and goes back";
}

TEST(WallJudge, AgreesWithManyPositionsInBetween) {
  Random random(5);
  const auto point = [&random](double size) {
    return Point<3>{random.real(-size, size), random.real(-size, size), random.real(-size, size)};
  };
  int blocked = 0, free = 0, only_between = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Wall_judge judge(experiments::Wall_mesh{{point(1), point(1), point(1)}, {{0, 1, 2}}});
    const Moving_edge e{point(2), point(2), point(2), point(2)};
    if (judge.judge_segment(e.a, e.c) == Verdict::blocked) continue;
    bool is_met = false;
    constexpr int steps = 64;
    for (int i = 1; i <= steps && !is_met; ++i) {
      const double s = double(i) / steps;
      is_met = judge.judge_segment(e.a + s * (e.b - e.a), e.c + s * (e.d - e.c)) == Verdict::blocked;
    }
    const Verdict verdict = judge.judge(e);
    ASSERT_NE(verdict, Verdict::undecided);
    if (is_met) {
      EXPECT_EQ(verdict, Verdict::blocked) << trial;
    }
    blocked += verdict == Verdict::blocked;
    free += verdict == Verdict::free;
    only_between += verdict == Verdict::blocked && !is_met;
  }
  EXPECT_GT(blocked, 150);
  EXPECT_GT(free, 1500);
  // What is passed between two of the positions is rare.
  EXPECT_LT(only_between, blocked / 10);
}

}  // namespace
}  // namespace cellwalk::ablation
