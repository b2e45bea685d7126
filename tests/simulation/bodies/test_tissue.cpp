// SPDX-License-Identifier: LGPL-3.0-or-later
// Solid cells as elastic tissue: what it keeps, and what it yields to.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "simulation/tissue_lab.h"

namespace cellwalk {
namespace {

using test::Tissue_lab;

template <int D>
void rest() {
  Tissue_lab<D> lab({});
  const auto before = lab.points();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(lab.step(), 0u);
  EXPECT_EQ(lab.points(), before);
  EXPECT_NEAR(lab.tissue.largest_stretch(), 1, 1e-12);
}

TEST(Tissue, AtRestNothingMoves) {
  rest<2>();
  rest<3>();
}

template <int D>
void hold() {
  Scene_box<D> box;
  box.lower.fill(0);
  box.upper.fill(test::block_side);
  box.upper[0] = 2.5;
  Tissue_lab<D> lab({.tension = 0.4}, {}, {}, {box});
  const auto before = lab.points();
  lab.steps(10);
  std::size_t held = 0, moved = 0;
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    const Point<D>&x = before[v], &now = lab.environment.snapshot().point(v);
    bool stays = x[0] <= 2.5;
    for (const double c : x) stays |= c == 0 || c == test::block_side;
    if (stays) {
      EXPECT_EQ(now, x) << v;
      ++held;
    } else {
      moved += length(now - x) > 0.02;
    }
  }
  EXPECT_GT(held, 20u);
  EXPECT_GT(moved, D == 2 ? 5u : 20u);
}

TEST(Tissue, TheBoundaryAndFixedPartsStay) {
  hold<2>();
  hold<3>();
}

/// A vertex of the wall that was pulled out goes back, and all others with it.
template <int D>
void go_back() {
  Tissue_lab<D> lab({.compliance = 0, .damping = 1});
  const std::uint32_t v = lab.on_wall();
  const double start = lab.height_of(v);
  lab.move(v, 0.3);
  lab.steps(1);
  EXPECT_LT(lab.height_of(v), start + 0.15);
  lab.steps(60);
  EXPECT_NEAR(lab.height_of(v), start, 0.01);
}

TEST(Tissue, ReturnsToItsShape) {
  go_back<2>();
  go_back<3>();
}

/// Points between free cells above the wall follow it.
template <int D>
void take_along() {
  Tissue_lab<D> lab({.compliance = 1e12, .incompressible = 0, .damping = 1});
  const std::uint32_t v = lab.on_wall();
  Point<D> above = lab.environment.snapshot().point(v);
  above[D - 1] += 1;
  std::uint32_t follower = 0;
  for (std::uint32_t u = 1; u < lab.points().size(); ++u)
    if (length(lab.points()[u] - above) < length(lab.points()[follower] - above)) follower = u;
  const double start = lab.height_of(follower);
  lab.move(v, 0.3);
  lab.steps(1);
  const double up = lab.height_of(follower) - start;
  EXPECT_GT(up, 0.01) << "as the mean of what is around it";
  EXPECT_LT(up, 0.3);
  lab.move(v, -0.3);
  lab.steps(20);
  EXPECT_NEAR(lab.height_of(follower), start, 0.001);
}

TEST(Tissue, TakesPointsBetweenFreeCellsAlong) {
  take_along<2>();
  take_along<3>();
}

/// The more compliant, the less of the way is undone in a step; in the limit none.
template <int D>
void comply() {
  double last = -1;
  for (const double compliance : {0.0, 0.3, 3.0, 1e12}) {
    Tissue_lab<D> lab({.compliance = compliance, .incompressible = 0, .damping = 1});
    const std::uint32_t v = lab.on_wall();
    const double start = lab.height_of(v);
    lab.move(v, 0.3);
    lab.steps(1);
    const double left = (lab.height_of(v) - start) / 0.3;
    EXPECT_GT(left, last + 0.02) << compliance;
    last = left;
  }
  EXPECT_NEAR(last, 1, 1e-6);
}

TEST(Tissue, IsTheSofterTheMoreCompliant) {
  comply<2>();
  comply<3>();
}

/// Under tension a surface that is free on one side sinks; what keeps its volume sinks far less.
template <int D>
void keep_volume() {
  double lost[2];
  for (const int keeps : {0, 1}) {
    Tissue_lab<D> lab({.compliance = 2, .incompressible = keeps * 1.0, .tension = 0.4, .sweeps = 20});
    const double before = lab.solid_volume();
    lab.steps(15);
    lost[keeps] = std::abs(before - lab.solid_volume()) / before;
  }
  EXPECT_GT(lost[0], 0.05);
  EXPECT_LT(lost[1], 0.05 * lost[0]);
}

TEST(Tissue, KeepsItsVolume) {
  keep_volume<2>();
  keep_volume<3>();
}

TEST(Tissue, EdgesAreLongerByTheTension) {
  EXPECT_NEAR(Tissue_lab<3>({.tension = 0.5}).tissue.largest_stretch(), 2, 1e-12);
  EXPECT_NEAR(Tissue_lab<2>({.tension = 0.2}).tissue.largest_stretch(), 1.25, 1e-12);
}

/// Without damping what is let go swings through its place; with all of it, it does not.
TEST(Tissue, SwingsUnlessDamped) {
  for (const double damping : {0.0, 1.0}) {
    Tissue_lab<2> lab({.compliance = 2, .incompressible = 0, .damping = damping});
    const std::uint32_t v = lab.on_wall();
    const double start = lab.height_of(v);
    lab.move(v, 0.3);
    double lowest = 1;
    for (int i = 0; i < 20; ++i) {
      lab.steps(1);
      lowest = std::min(lowest, lab.height_of(v) - start);
    }
    EXPECT_EQ(lowest < -0.02, damping == 0) << lowest;
  }
}

template <int D>
double deepest_press(double yield) {
  const auto [scene, rod] = test::rod_into_tissue<D>();
  Tissue_lab<D> lab({.damping = 1, .yield = yield}, scene, {rod}, {}, 0);
  const std::uint32_t v = lab.on_wall();
  double lowest = 3;
  for (int i = 0; i < 9; ++i) {
    lab.steps(1);
    lab.world.validate();
    lowest = std::min(lowest, lab.height_of(v));
  }
  for (int i = 0; i < 60; ++i) lab.step();
  EXPECT_NEAR(lab.height_of(v), 3, 0.02) << "it has come back";
  return 3 - lowest;
}

TEST(Tissue, YieldsToBodiesAndComesBack) {
  EXPECT_GT(deepest_press<2>(1), 0.02);
  EXPECT_GT(deepest_press<3>(1), 0.02);
  EXPECT_EQ(deepest_press<2>(0), 0);
  EXPECT_EQ(deepest_press<3>(0), 0);
}

TEST(Tissue, MaterialsThatAreNoneAreRefused) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto environment = test::tissue_block<2>();
  const std::vector<std::pair<Tissue_material, std::string>> bad{
      {{.compliance = -0.1}, "the compliance"},
      {{.compliance = nan}, "the compliance"},
      {{.compliance = infinite}, "the compliance"},
      {{.incompressible = 1.5}, "\"incompressible\""},
      {{.incompressible = nan}, "\"incompressible\""},
      {{.tension = 1}, "the tension"},
      {{.tension = -0.1}, "the tension"},
      {{.tension = nan}, "the tension"},
      {{.damping = 2}, "the damping"},
      {{.damping = nan}, "the damping"},
      {{.yield = -1}, "the yield"},
      {{.yield = nan}, "the yield"},
      {{.sweeps = 0}, "the sweeps"}};
  for (const auto& [material, named] : bad) {
    try {
      Tissue<2>(environment.snapshot(), material, {});
      ADD_FAILURE() << "accepted: " << named;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::usage);
      EXPECT_TRUE(std::string(e.what()).starts_with("tissue: ")) << e.what();
      EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
    }
  }
}

TEST(Tissue, IsMadeOfSolidSimplices) {
  const auto refused = [](const auto& environment, const char* text) {
    try {
      Tissue<2>(environment.snapshot(), {}, {});
      ADD_FAILURE() << "accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::input);
      EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
    }
  };
  refused(test::tissue_block<2>(0, -1), "there is no solid cell");
  Grid_options<2> squares;
  squares.cells.fill(3);
  squares.solid_cells = {4};
  refused(Environment<2>::build(square_grid(squares)), "is not a simplex");
}

}  // namespace
}  // namespace cellwalk
