// SPDX-License-Identifier: LGPL-3.0-or-later
// The neighbours of doubles against those of the standard library.
#include <cellwalk/internal/kernel/next_double.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace cellwalk {
namespace {

TEST(NextDouble, IsThatOfTheStandardLibrary) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> numbers{
      0, 1, Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(), 1 - 0x1p-53, 2 - 0x1p-52};
  Random random(5);
  for (int i = 0; i < 10'000; ++i) {
    const std::uint64_t bits = static_cast<std::uint64_t>(random.below(std::size_t{1} << 32)) << 32 |
                               random.below(std::size_t{1} << 32);
    if (const auto x = std::bit_cast<double>(bits); !std::isnan(x)) numbers.push_back(x);
  }
  for (const double size : numbers)
    for (const double x : {size, -size}) {
      EXPECT_EQ(detail::next_above(x), std::nextafter(x, Limits::infinity())) << x;
      EXPECT_EQ(detail::next_below(x), std::nextafter(x, -Limits::infinity())) << x;
    }
}

}  // namespace
}  // namespace cellwalk
