// SPDX-License-Identifier: LGPL-3.0-or-later
// Facet planes in lanes of four, in single precision, with a static error bound: the cheapest certificate for
// the side of a point.
//
// Frame. Points are mapped to y = scale (x - centre), scale a power of two, so that the environment lies in
// [-1,1]^D.
//
// Bound. Let g be the exact plane function of a facet, positive outside, scaled by some factor > 0 (only its
// sign matters). The compiler of the snapshot proves for every stored plane (n,d) that |n.y + d - g(y)| <= 3u
// for all y in [-1,1]^D, with u = 2^-24, |n| <= 1 + 2u and |d| <= sqrt(D) + 4u; a plane for which it cannot
// is stored as n = d = 0. Evaluation rounds y to float (u/2 a coordinate, plus 2^-53 for the mapping), and
// n.y + d with D+1 roundings on each path, at most 4u (|n|_1 + |d|) (1 + 2^-20). With |n|_1 <= sqrt(3) the
// total is u (3 + sqrt(3)/2 + 8 sqrt(3)) (1 + 2^-19) < 18u. plane_error = 20u leaves room for underflow
// (below 2^-120).
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_PLANES_H
#define CELLWALK_INTERNAL_ENVIRONMENT_PLANES_H

#include <array>
#include <bit>
#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <cellwalk/kernel/point.h>

namespace cellwalk {

/// Absolute error of an evaluated plane, in units of the frame.
inline constexpr float plane_error = 20 * 0x1p-24f;

/// Lanes of single precision; a compiler vector, so that baseline x86-64 and NEON evaluate four planes at
/// once.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

/// A point of the frame in single precision.
template <int D>
using Float_point = std::array<float, static_cast<std::size_t>(D)>;

/// Four planes: the signed distances of y are normal[0] y[0] + .. + offset. Unused lanes have normal 0 and
/// offset -1, so that no point is outside them. Those of a removed cell have offset 1, so that every point
/// is.
template <int D>
struct alignas(D == 3 ? 64 : 16) Plane_block {
  std::array<Float4, D> normal;
  Float4 offset;
};

/// The map into the unit box.
template <int D>
struct Plane_frame {
  Point<D> centre{};
  double scale = 1;

  /// Maps a point; returns false if it lies outside the box, where the bound does not hold.
  bool map(const Point<D>& x, Float_point<D>& y) const {
    bool inside = true;
    for (int i = 0; i < D; ++i) {
      const double t = (x[i] - centre[i]) * scale;
      inside &= std::abs(t) <= 1.0;
      y[i] = static_cast<float>(t);
    }
    return inside;
  }
};

/// The larger value of each lane.
/// \pre no NaNs
inline Float4 lane_max(Float4 a, Float4 b) {
#if defined(__SSE2__)
  return std::bit_cast<Float4>(_mm_max_ps(std::bit_cast<__m128>(a), std::bit_cast<__m128>(b)));
#else
  return a > b ? a : b;
#endif
}

/// A bit mask of the lanes that are true.
inline unsigned lane_mask(Int4 lanes) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(lanes)));
#else
  return (lanes[0] & 1u) | (lanes[1] & 2u) | (lanes[2] & 4u) | (lanes[3] & 8u);
#endif
}

/// A bit mask of the lanes whose sign is negative, including -0.
inline unsigned sign_mask(Float4 lanes) { return lane_mask(std::bit_cast<Int4>(lanes) < 0); }

/// A point of the frame with each coordinate in all lanes, for repeated evaluation.
template <int D>
using Spread_point = std::array<Float4, static_cast<std::size_t>(D)>;

template <int D>
inline Spread_point<D> spread(const Float_point<D>& y) {
  Spread_point<D> lanes;
  for (int i = 0; i < D; ++i) lanes[i] = Float4{y[i], y[i], y[i], y[i]};
  return lanes;
}

/// The signed distances of y from four planes, each within plane_error of a positive multiple of the exact
/// one.
template <int D>
inline Float4 evaluate(const Plane_block<D>& block, const Spread_point<D>& y) {
  // Two short chains instead of a long one.
  const Float4 r = block.normal[D - 1] * y[D - 1] + block.offset;
  if constexpr (D == 3) return (block.normal[0] * y[0] + block.normal[1] * y[1]) + r;
  return block.normal[0] * y[0] + r;
}

template <int D>
inline Float4 evaluate(const Plane_block<D>& block, const Float_point<D>& y) {
  return evaluate<D>(block, spread<D>(y));
}

/// The derivatives of four signed distances along a direction, rounded.
template <int D>
inline Float4 slopes(const Plane_block<D>& block, const Spread_point<D>& direction) {
  const Float4 r = block.normal[0] * direction[0] + block.normal[1] * direction[1];
  if constexpr (D == 3) return r + block.normal[2] * direction[2];
  return r;
}

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_PLANES_H
