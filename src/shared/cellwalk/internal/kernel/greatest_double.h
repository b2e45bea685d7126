// SPDX-License-Identifier: LGPL-3.0-or-later
// The greatest double with a property that all lesser ones have: rounding down where only a test is exact.
#ifndef CELLWALK_INTERNAL_KERNEL_GREATEST_DOUBLE_H
#define CELLWALK_INTERNAL_KERNEL_GREATEST_DOUBLE_H

#include <algorithm>
#include <bit>
#include <cstdint>

namespace cellwalk::detail {

/// \param guess near the result, for speed only
/// \param most holds(x) is not called above
/// \param holds true for 0, and for all doubles below one for which it is true
/// \return the greatest double in [0, most] for which holds() is true
/// Cost: two calls for a right guess; for others, twice the binary logarithm of the number of doubles
/// between.
/// \pre most >= 0
template <class Holds>
double greatest_double(double guess, double most, Holds holds) {
  // Doubles that are not negative have the order of their bits.
  const auto at = [](std::int64_t i) { return std::bit_cast<double>(i); };
  const std::int64_t last = std::bit_cast<std::int64_t>(most);
  std::int64_t low = std::bit_cast<std::int64_t>(guess > 0 ? std::min(guess, most) : 0.0), high = low;
  if (low == 0 || holds(at(low))) {
    for (std::int64_t step = 1;; step *= 2) {
      if (low == last) return most;
      const std::int64_t next = last - low < step ? last : low + step;
      if (!holds(at(next))) {
        high = next;
        break;
      }
      low = next;
    }
  } else {
    for (std::int64_t step = 1;; step *= 2) {
      low = high > step ? high - step : 0;
      if (low == 0 || holds(at(low))) break;
      high = low;
    }
  }
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (holds(at(middle)) ? low : high) = middle;
  }
  return at(low);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_GREATEST_DOUBLE_H
