// SPDX-License-Identifier: LGPL-3.0-or-later
// Order of cells along a Hilbert curve, so that neighbouring cells are close in memory. Not by CGAL's
// hilbert_sort(), which leaves the order of equal positions to the standard library: here it is the same on
// all machines.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_SPACE_FILLING_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_SPACE_FILLING_H

#include <array>
#include <cstdint>

namespace cellwalk {

/// Bits of each coordinate on the curve.
inline constexpr int curve_bits = 16;

/// The position on the Hilbert curve of a grid point (coordinates below 2^curve_bits).
/// J. Skilling, Programming the Hilbert curve, 2004: coordinates are transposed into the digits of the
/// position.
template <int D>
std::uint64_t hilbert_position(std::array<std::uint32_t, D> x) {
  constexpr std::uint32_t top = 1u << (curve_bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    const std::uint32_t low = q - 1;
    for (int i = 0; i < D; ++i) {
      if (x[i] & q) {
        x[0] ^= low;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & low;
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  }
  for (int i = 1; i < D; ++i) x[i] ^= x[i - 1];
  std::uint32_t parity = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1)
    if (x[D - 1] & q) parity ^= q - 1;
  std::uint64_t position = 0;
  for (int bit = curve_bits - 1; bit >= 0; --bit)
    for (int i = 0; i < D; ++i) position = position << 1 | ((x[i] ^ parity) >> bit & 1u);
  return position;
}

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_SPACE_FILLING_H
