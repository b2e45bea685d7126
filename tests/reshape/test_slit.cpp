// SPDX-License-Identifier: LGPL-3.0-or-later
// Membranes slit along blades.
#include <cellwalk/body/body.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "grids.h"
#include "tissue_block.h"

namespace cellwalk {
namespace {

using test::add_membrane, test::blade, test::simplex_grid;

/// Whether a particle gets from one point to another on a straight line.
template <int D>
bool passes(const Environment<D>& environment, const Point<D>& from, const Point<D>& to) {
  Particle<D> particle = *Locator<D>(environment.snapshot()).particle_at(from);
  Walk_counts counts;
  return move(environment.snapshot(), particle, to, counts).status == Walk_status::arrived;
}

template <int D>
Cut_report cut(Environment<D>& environment, const Blade<D>& blade, double opening) {
  const Certificate before = environment.certify();
  Reshaping<D> reshaping(environment, {});
  const Cut_report report = reshaping.cut(blade, {.opening = opening});
  reshaping.finish();
  const Certificate after = environment.certify();
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
  EXPECT_GE(after.free_volume, before.free_volume * (1 - 1e-12));
  EXPECT_EQ(after.vertices, before.vertices + report.points.size());
  return report;
}

/// A membrane across a grid at height 2, slit at x = 2.3: a particle passes there, and nowhere else.
template <int D>
void expect_slit(Environment<D>& environment, double x, double width, double y) {
  const auto at = [&](double u, double height) {
    Point<D> p;
    p.fill(y);
    p[0] = u;
    p[D - 1] = height;
    return p;
  };
  for (int k = -3; k <= 3; ++k) {
    const double u = x + 0.3 * k * width;
    EXPECT_EQ(passes(environment, at(u, 2.6), at(u, 1.4)), std::abs(k) <= 1) << "at " << u;
  }
}

TEST(Slit, OpensAMembraneInThePlane) {
  for (const double opening : {0.001, 0.1, 0.4}) {
    auto environment = simplex_grid<2>(4);
    add_membrane(environment, 2);
    EXPECT_EQ(environment.certify().components, 2u);
    const Cut_report report = cut(environment, blade<2>({{2.31, 1}, {2.31, 3}}), opening);
    EXPECT_EQ(report.slit, 1u);
    EXPECT_EQ(report.edges, 2u);
    EXPECT_EQ(report.refused(), 0u);
    EXPECT_EQ(environment.certify().components, 1u);
    expect_slit(environment, 2.31, opening, 0.0);
  }
}

TEST(Slit, OpensAMembraneInSpace) {
  for (const double opening : {0.001, 0.1, 0.4}) {
    auto environment = simplex_grid<3>(4);
    add_membrane(environment, 2);
    // From inside the membrane to the boundary, and beyond.
    const Cut_report report =
        cut(environment, blade<3>({{2.31, 0.7, 1}, {2.31, 5, 1}, {2.31, 5, 3}, {2.31, 0.7, 3}}), opening);
    EXPECT_GT(report.slit, 10u);
    EXPECT_EQ(report.refused(), 0u);
    EXPECT_EQ(environment.certify().components, 1u);
    for (const double y : {1.53, 2.07, 2.77, 3.9}) expect_slit(environment, 2.31, opening, y);
    EXPECT_FALSE(passes<3>(environment, {2.31, 0.45, 2.6}, {2.31, 0.45, 1.4})) << "beyond the blade";
  }
}

/// The blade passes vertices, edges and diagonals of the membrane.
TEST(Slit, OpensALatticeInSpace) {
  for (const double tilt : {0.0, 1.0}) {
    auto environment = simplex_grid<3>(4);
    add_membrane(environment, 2);
    const double low = 2 - tilt, high = 2 + tilt;
    const Cut_report report =
        cut(environment, blade<3>({{low, 1, 1}, {high, 3, 1}, {high, 3, 3}, {low, 1, 3}}), 0.1);
    EXPECT_EQ(report.refused(), 0u);
    EXPECT_GT(report.slit, 4u);
    for (const double t : {0.13, 0.5, 0.71}) {
      const Point<3> x{low + t * 2 * tilt, 1 + 2 * t, 2.5};
      EXPECT_TRUE(passes<3>(environment, x, {x[0], x[1], 1.5})) << tilt << " " << t;
      for (const double off : {-0.2, 0.2})
        EXPECT_FALSE(passes<3>(environment, {x[0] + off, x[1], 2.5}, {x[0] + off, x[1], 1.5}))
            << tilt << " " << t;
    }
  }
}

TEST(Slit, FollowsABentBlade) {
  auto environment = simplex_grid<3>(6);
  add_membrane(environment, 2);
  std::vector<Point<3>> arc;
  for (int k = 0; k <= 20; ++k)
    arc.push_back({3.05 + 1.9 * std::cos(0.15 * k), 1.2 + 1.9 * std::sin(0.15 * k), 2.9});
  // In a triangle the slit runs straight: it must be wider than the blade bends there.
  const Cut_report report = cut(environment, swept_blade(arc, {0, 0, -1.7}), 0.2);
  EXPECT_EQ(report.refused(), 0u);
  std::size_t open = 0;
  for (int k = 3; k < 18; ++k) {
    const Point<3> x{3.05 + 1.9 * std::cos(0.15 * k), 1.2 + 1.9 * std::sin(0.15 * k), 2.8};
    open += passes<3>(environment, x, {x[0], x[1], 1.3});
    const Point<3> inner{3.05 + 1.5 * std::cos(0.15 * k), 1.2 + 1.5 * std::sin(0.15 * k), 2.8};
    EXPECT_FALSE(passes<3>(environment, inner, {inner[0], inner[1], 1.3})) << k;
  }
  EXPECT_EQ(open, 15u);
}

/// Where something lies, the membrane stays whole, and the report says so.
TEST(Slit, SparesMembranesAmongResidents) {
  auto environment = simplex_grid<2>(4);
  add_membrane(environment, 2);
  Particle<2> particle = *Locator<2>(environment.snapshot()).particle_at({2.4, 2.1});
  {
    Reshaping<2> reshaping(environment, {{}, {std::span(&particle, 1)}});
    const Cut_report report = reshaping.cut(blade<2>({{2.31, 1}, {2.31, 3}}), {.opening = 0.1});
    EXPECT_EQ(report.edges, 2u);
    EXPECT_EQ(report.refused(), 2u);
    EXPECT_EQ(report.slit, 0u);
    EXPECT_TRUE(report.points.empty());
  }
  EXPECT_EQ(environment.certify().components, 2u);
  particle = *Locator<2>(environment.snapshot()).particle_at({0.4, 3.1});
  Reshaping<2> reshaping(environment, {{}, {std::span(&particle, 1)}});
  EXPECT_EQ(reshaping.cut(blade<2>({{2.31, 1}, {2.31, 3}}), {.opening = 0.1}).slit, 1u);
  reshaping.finish();
  EXPECT_EQ(environment.certify().components, 1u);
  Walk_counts counts;
  EXPECT_EQ(move(environment.snapshot(), particle, Point<2>{0.5, 2.5}, counts).status, Walk_status::arrived);
}

/// A membrane that is fixed in tissue is slit, and the tissue cut, by one blade.
TEST(Slit, GoesOnInTissue) {
  auto environment = test::tissue<2>(6, 3, 0);
  for (const double y : {3.0, 4.0, 5.0, 6.0})  // an upright membrane above the tissue
    if (y < 6) {
      const std::uint32_t u = test::point_at<2>(environment, {3, y}),
                          v = test::point_at<2>(environment, {3, y + 1});
      const Snapshot<2>& s = environment.snapshot();
      for (const Cell c : environment.cells_around(u))
        for (std::size_t f = 0; f < s.facet_count(c); ++f) {
          const auto loop = s.loop(Snapshot<2>::half_facet(c, f));
          if (std::ranges::count(loop, u) + std::ranges::count(loop, v) == 2)
            environment.set_impassable(Snapshot<2>::half_facet(c, f), true);
        }
    }
  EXPECT_EQ(environment.certify().components, 2u);
  const Cut_report report = cut(environment, blade<2>({{1.2, 5.3}, {4.4, 2.2}, {4.5, 1.7}}), 0.05);
  EXPECT_GT(report.slit, 0u);
  EXPECT_GT(report.opened, 0u);
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_EQ(environment.certify().components, 1u);
}

}  // namespace
}  // namespace cellwalk
