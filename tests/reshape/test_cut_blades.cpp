// SPDX-License-Identifier: LGPL-3.0-or-later
// What a blade may be, how far a cut is opened, and that a cut which is refused changes nothing.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "reshape/tissue_block.h"

namespace cellwalk {
namespace {

using test::blade, test::solid_parts, test::tissue;

template <int D>
std::vector<Point<D>> straight_blade(double x = 2.1) {
  if constexpr (D == 2)
    return {{x, 4}, {x, -1}};
  else
    return {{x, -1, 4}, {x, 5, 4}, {x, 5, -1}, {x, -1, -1}};
}

/// \param jitter if it is not 0, the boundary is not flat either, and edges there cannot be split exactly
template <int D>
Environment<D> block(double jitter = 0.15) {
  return tissue<D>(D == 2 ? 6 : 4, 3, jitter);
}

/// Expects that an environment refuses a cut, and stays as it is.
template <int D>
void expect_refused(Environment<D>& environment, const Blade<D>& by, const Cut_options<D>& options,
                    Error_code code, const std::string& message, const Residents<D>& residents = {}) {
  const std::uint64_t epoch = environment.snapshot().epoch();
  const std::size_t points = environment.snapshot().points().size();
  Reshaping<D> reshaping(environment, residents);
  try {
    reshaping.cut(by, options);
    FAIL() << "cut although " << message;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    EXPECT_EQ(e.what(), message);
  }
  reshaping.finish();
  EXPECT_EQ(environment.snapshot().epoch(), epoch) << message;
  EXPECT_EQ(environment.snapshot().points().size(), points) << message;
}

template <int D>
void refuse_points_that_are_not_finite() {
  auto environment = block<D>();
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t i = 0; i < straight_blade<D>().size(); ++i) {
        Blade<D> by = blade<D>(straight_blade<D>());
        by.points[i][k] = bad;
        expect_refused<D>(environment, by, {}, Error_code::input,
                          "a point of the blade is not finite: correct its coordinates");
      }
}

TEST(CutBlades, MustBeFiniteInThePlane) { refuse_points_that_are_not_finite<2>(); }
TEST(CutBlades, MustBeFiniteInSpace) { refuse_points_that_are_not_finite<3>(); }

/// Blades as long as one likes cut as short ones do, until doubles cannot tell any more which piece is near.
template <int D>
void cut_by_long_blades() {
  std::size_t split = 0;
  for (const double more : {0.0, 10.0, 1e3, 1e6, 1e7, 1e12, 1e100, 1e155, 1e200, 1e300, 1.7e308}) {
    auto environment = block<D>(0);
    Blade<D> by = blade<D>(straight_blade<D>(2.3));
    for (Point<D>& x : by.points)
      for (std::size_t k = 1; k < D; ++k) x[k] += x[k] > 0 ? more : -more;
    if (more > 1e6) {
      expect_refused<D>(environment, by, {}, Error_code::input,
                        "a point of the blade lies too far off: keep it within 2^20 times the size of the "
                        "environment");
      continue;
    }
    Reshaping<D> reshaping(environment, {});
    const Cut_report report = reshaping.cut(by);
    reshaping.finish();
    EXPECT_NO_THROW(environment.certify());
    EXPECT_EQ(report.refused(), 0u) << more;
    EXPECT_EQ(report.held, 0u) << more;
    EXPECT_GT(report.opened, 0u) << more;
    if (more == 0) split = report.split;
    EXPECT_EQ(report.split, split) << more;
    if (D == 2) {
      EXPECT_EQ(solid_parts(environment.snapshot()).size(), 2u) << more;
    }
  }
}

TEST(CutBlades, MayBeLongInThePlane) { cut_by_long_blades<2>(); }
TEST(CutBlades, MayBeLongInSpace) { cut_by_long_blades<3>(); }

/// A blade of next to no length passes at most the edge on which it lies.
TEST(CutBlades, MayBeTiny) {
  for (const double size : {1e-3, 1e-12, 1e-160, 5e-324}) {
    auto environment = tissue<2>(4, 3, 0);
    Reshaping<2> reshaping(environment, {});
    // About the edge from (0,1) to (0,2) at a quarter, where nothing is rounded but the point itself.
    const Cut_report report = reshaping.cut(blade<2>({{-size, 1.25}, {size, 1.25}}));
    EXPECT_LE(report.edges, 1u) << size;
    EXPECT_EQ(report.opened, 0u) << size;
    reshaping.finish();
    EXPECT_NO_THROW(environment.certify());
  }
}

/// All lengths by the same power of two: the same cut.
template <int D>
void cut_at_any_scale() {
  Cut_report first;
  for (const int exponent : {0, -20, 20, -90, 90, -220, 220}) {
    const double scale = std::ldexp(1.0, exponent);
    Simplex_grid_options<D> options;
    options.cells.fill(4);
    options.jitter = 0.15;
    Cell_soup<D> soup;
    if constexpr (D == 2)
      soup = triangle_grid(options);
    else
      soup = tetrahedral_grid(options);
    test::fill_below(soup, 3);
    for (Point<D>& x : soup.points) x = scale * x;
    auto environment = Environment<D>::build(std::move(soup));
    std::vector<Point<D>> points = straight_blade<D>();
    for (Point<D>& x : points) x = scale * x;
    Blade<D> by = blade<D>(points);
    by.points[0][0] += 0.3 * scale;  // in space its two triangles bend
    Reshaping<D> reshaping(environment, {});
    const Cut_report report = reshaping.cut(by, {.opening = 0.02 * scale});
    reshaping.finish();
    EXPECT_NO_THROW(environment.certify());
    if (exponent == 0) first = report;
    EXPECT_GT(report.opened, 0u);
    EXPECT_EQ(report.split, first.split) << exponent;
    EXPECT_EQ(report.facets, first.facets) << exponent;
    EXPECT_EQ(report.opened, first.opened) << exponent;
    EXPECT_EQ(report.held, first.held) << exponent;
  }
}

TEST(CutBlades, CutAtAnyScaleInThePlane) { cut_at_any_scale<2>(); }
TEST(CutBlades, CutAtAnyScaleInSpace) { cut_at_any_scale<3>(); }

/// Openings far wider than cells open as far as there is room, and far smaller ones open.
template <int D>
void open_at_any_width() {
  std::size_t opened = 0;
  for (const double opening : {0.01, 1e-9, 1.0, 50.0, 1e9, 1e100, 1.7e308}) {
    auto environment = block<D>();
    Reshaping<D> reshaping(environment, {});
    const double before = environment.certify().free_volume;
    const Cut_report report = reshaping.cut(blade<D>(straight_blade<D>()), {.opening = opening});
    reshaping.finish();
    Certificate after;
    ASSERT_NO_THROW(after = environment.certify()) << opening;
    if (opened == 0) opened = report.opened;
    EXPECT_EQ(report.opened, opened) << opening;
    EXPECT_EQ(report.held, 0u) << opening;
    EXPECT_GT(opened, 1u);
    EXPECT_GT(after.free_volume, before) << opening;
    for (const Cut_point& made : report.points)
      EXPECT_TRUE(is_finite(environment.snapshot().point(made.point)));
  }
}

TEST(CutBlades, OpenAtAnyWidthInThePlane) { open_at_any_width<2>(); }
TEST(CutBlades, OpenAtAnyWidthInSpace) { open_at_any_width<3>(); }

TEST(CutBlades, MustBeOpenedByALength) {
  auto environment = block<2>();
  for (const double opening : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_refused<2>(environment, blade<2>(straight_blade<2>()), {.opening = opening}, Error_code::input,
                      "a cut is opened by a positive length");
  Blade<2> by = blade<2>(straight_blade<2>());
  by.pieces = {{0, 1}, {1, 2}};
  expect_refused<2>(environment, by, {}, Error_code::input, "a piece of the blade names point 2 of 2");
  by.pieces = {{0, 1}, {1, 1}};
  expect_refused<2>(environment, by, {}, Error_code::input,
                    "a piece of the blade has no extent: its corners coincide or lie in line");
}

/// A particle that is not in its cell is found before anything is split, wherever it is near the blade.
template <int D>
void find_strays_first() {
  const Blade<D> by = blade<D>(straight_blade<D>(2.4));
  for (const double off : {0.05, 3.0})
    for (double height = 0.2; height < 3; height += 0.2) {
      auto environment = block<D>();
      Point<D> home;
      home.fill(0.4);
      home[D - 1] = 3.6;
      Particle<D> stray = *Locator<D>(environment.snapshot()).particle_at(home);
      stray.position.fill(2.4);
      stray.position[0] += off;
      stray.position[D - 1] = height;
      const Residents<D> residents{{}, {std::span(&stray, 1)}};
      if (off < 1) {
        expect_refused<D>(environment, by, {}, Error_code::usage,
                          "particle 0 of those listed does not lie in its cell: locate it again", residents);
      } else {
        Reshaping<D> reshaping(environment, residents);
        EXPECT_GT(reshaping.cut(by).split, 5u) << "it is not near";
      }
    }
}

TEST(CutBlades, FindStraysFirstInThePlane) { find_strays_first<2>(); }
TEST(CutBlades, FindStraysFirstInSpace) { find_strays_first<3>(); }

}  // namespace
}  // namespace cellwalk
