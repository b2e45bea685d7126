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

using test::blade, test::tissue;

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
  reshaping.close();
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

}  // namespace
}  // namespace cellwalk
