// SPDX-License-Identifier: LGPL-3.0-or-later
// The neighbours of a double, by its bits: std::nextafter() is a call of a library, for each bound of a box.
#ifndef CELLWALK_INTERNAL_KERNEL_NEXT_DOUBLE_H
#define CELLWALK_INTERNAL_KERNEL_NEXT_DOUBLE_H

#include <bit>
#include <cstdint>
#include <limits>

namespace cellwalk::detail {

/// The least double above x; infinity if x is.
/// \pre x is a number
inline double next_above(double x) {
  if (x == std::numeric_limits<double>::infinity()) return x;
  const auto bits = std::bit_cast<std::int64_t>(x + 0.0);  // of 0, not of -0
  return std::bit_cast<double>(bits < 0 ? bits - 1 : bits + 1);
}

/// The greatest double below x; -infinity if x is.
/// \pre x is a number
inline double next_below(double x) { return -next_above(-x); }

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_NEXT_DOUBLE_H
