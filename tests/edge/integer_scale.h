// SPDX-License-Identifier: LGPL-3.0-or-later
// A unit in which points have integer coordinates: rational arithmetic is much faster on integers.
#ifndef CELLWALK_TESTS_EDGE_INTEGER_SCALE_H
#define CELLWALK_TESTS_EDGE_INTEGER_SCALE_H

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace cellwalk::test {

class Integer_scale {
 public:
  template <std::size_t D>
  void add(std::span<const std::array<double, D>> points) {
    for (const auto& p : points)
      for (const double x : p) {
        if (x == 0) continue;
        int exponent = 0;
        const auto mantissa =
            static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &exponent)), bits));
        lowest_ = std::min(lowest_, exponent - bits + std::countr_zero(mantissa));
        highest_ = std::max(highest_, exponent);
      }
  }

  /// The power of two by which all coordinates become integers; 0 if some would be too large for a double.
  int exponent() const {
    return highest_ - lowest_ < std::numeric_limits<double>::max_exponent ? -lowest_ : 0;
  }

 private:
  static constexpr int bits = std::numeric_limits<double>::digits;
  /// Powers of two: of the last digit, and above the first.
  int lowest_ = 0, highest_ = std::numeric_limits<double>::min_exponent - bits;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_INTEGER_SCALE_H
