// SPDX-License-Identifier: LGPL-3.0-or-later
// Signs and sizes of orientations in doubles: the exact ones lie within their bounds, at all sizes.
#include <cellwalk/internal/kernel/exact_value.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "edge/chain/rounded_orientation.h"

namespace cellwalk::test {
namespace {

/// True if a value lies in [least, most]; most may be infinite.
bool is_within(const Ring& value, double least, double most) {
  return value >= Ring(least) && (std::isinf(most) || value <= Ring(most));
}

struct Sizes_seen {
  int signs = 0, zeros = 0, by_exact_signs = 0;
  double largest_error = 0;  ///< in units of the bound
};

template <int D>
void compare(const std::array<Point<D>, D + 1>& x, Sizes_seen& seen) {
  const auto [size, exact] = std::apply(
      [](const auto& p, const auto&... rest) {
        return std::pair(detail::signed_orientation<D>(p, rest...), Exact_value::orientation(p, rest...));
      },
      x);
  ++seen.signs;
  ASSERT_EQ(size.sign, static_cast<int>(CGAL::sign(exact)));
  const Ring magnitude = size.sign < 0 ? Ring(-exact) : exact;
  ASSERT_TRUE(is_within(magnitude, size.least, size.most)) << size.least << " " << size.most;
  seen.zeros += size.sign == 0;
  seen.by_exact_signs += size.sign != 0 && size.least == 0;
  if (size.least == 0) return;
  const double error = (size.most - size.least) / 2, middle = size.least + error;
  seen.largest_error =
      std::max(seen.largest_error, std::abs(CGAL::to_double(Ring(magnitude - Ring(middle)))) / error);
}

template <int D>
Sizes_seen compare_all() {
  Sizes_seen seen;
  Random random(17);
  for (int k = 0; k < 60'000; ++k) {
    std::array<Point<D>, D + 1> x;
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(600)) - 300);
    const int kind = k % 3;  // anywhere, all nearly in one line or plane, on a lattice
    for (Point<D>& p : x)
      for (double& c : p) c = kind == 2 ? static_cast<double>(random.below(4)) : random.real(-1, 1);
    if (kind == 1) {
      x[D] = x[0];
      for (std::size_t i = 1; i < D; ++i) {
        const double share = random.real(-1, 1);
        for (std::size_t c = 0; c < D; ++c) x[D][c] += share * (x[i][c] - x[0][c]);
      }
    }
    for (Point<D>& p : x)
      for (double& c : p) c *= scale;
    compare<D>(x, seen);
  }
  return seen;
}

template <int D>
void test_bounds() {
  const Sizes_seen seen = compare_all<D>();
  EXPECT_GT(seen.zeros, 500);
  EXPECT_GT(seen.by_exact_signs, 500);
  EXPECT_LE(seen.largest_error, 1);
  EXPECT_GT(seen.largest_error, 0.02) << "the bound says something";
}

TEST(RoundedOrientation, IsWithinItsBounds2) { test_bounds<2>(); }
TEST(RoundedOrientation, IsWithinItsBounds3) { test_bounds<3>(); }

}  // namespace
}  // namespace cellwalk::test
