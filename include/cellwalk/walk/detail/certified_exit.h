// SPDX-License-Identifier: LGPL-3.0-or-later
// The exit of a cell from float planes with an error bound: what they prove is taken, the rest is left in
// doubt.
//
// Let e be the point where the line entered the cell (a itself in the first cell). A facet G with b strictly
// inside is not met between e and b, since e is in the closed cell. A facet with b on it is met only if e
// lies on it too. Of the facets with b strictly outside, the line ab meets F at t_F = -A/(B - A), A and B the
// values at a and b. If t_F is strictly the smallest, and the line passes a point of the cell strictly before
// it (always so once a facet has been crossed, since every accepted cell holds a piece of positive length; in
// the first cell where A < 0), then the exit is a point in the relative interior of F.
#ifndef CELLWALK_WALK_DETAIL_CERTIFIED_EXIT_H
#define CELLWALK_WALK_DETAIL_CERTIFIED_EXIT_H

#include <cellwalk/environment/planes.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cellwalk::detail {

/// Facets (bits) of one block by the certified side of a point.
struct Block_sides {
  Float4 value;
  unsigned inside;   ///< strictly inside for certain
  unsigned outside;  ///< strictly outside for certain
};

template <int D>
inline Block_sides classify(const Plane_block<D>& block, const Float_point<D>& y) {
  const Float4 value = evaluate(block, y);
  return {value, lane_mask(value < -plane_error), lane_mask(value > plane_error)};
}

/// Largest number of blocks that the certified exit looks at; cells with more facets are decided exactly.
inline constexpr std::size_t certified_blocks = 8;

/// What the planes of a cell prove.
struct Certified_exit {
  enum Verdict : std::uint8_t { inside, leaves, unknown } verdict;
  std::uint32_t facet;  ///< if it leaves: the facet through whose relative interior it does
};

inline Float4 broadcast(float x) { return Float4{x, x, x, x}; }

/// The smallest of four lanes.
inline float smallest(Float4 v) {
#if defined(__SSE2__)
  __m128 m = std::bit_cast<__m128>(v);
  m = _mm_min_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(2, 3, 0, 1)));
  m = _mm_min_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(1, 0, 3, 2)));
  return _mm_cvtss_f32(m);
#else
  return std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
#endif
}

/// Lanes of the facets that a line, meeting its candidate with values best_a and best_b, certainly meets later.
///
/// With A <= 0 < B exact and the same positive factor at both ends of a facet, t_F < t_G is A_G B_F - A_F B_G < 0. The
/// computed values are off by at most e = plane_error, so the difference by e (|A_F| + B_G + |A_G| + B_F) + 2 e e,
/// plus three float roundings of the two products; the roundings of the bound itself are in the factor 1 + 2^-10.
inline unsigned certainly_later(Float4 a, Float4 b, float best_a, float best_b) {
  constexpr float e = plane_error * (1 + 0x1p-10f), rounding = 4 * 0x1p-24f;
  const Float4 zero{};
  const Float4 left = a * best_b, right = b * best_a;
  const Float4 size_a = a < zero ? -a : a, size_left = left < zero ? -left : left;
  const Float4 size_right = right < zero ? -right : right;
  const Float4 error =
      e * (size_a + b + (std::abs(best_a) + best_b + 2 * e)) + rounding * (size_left + size_right);
  return lane_mask(left - right < -error);
}

/// The exit of a cell of `blocks` blocks towards b, from the start a of the line. `starts_inside`: the line holds a
/// point of the cell strictly before any exit. Branches as little as it can: exits are hard to predict.
template <int D>
inline Certified_exit certified_exit(const Plane_block<D>* planes, std::size_t blocks,
                                     const Float_point<D>& y_a, const Float_point<D>& y_b,
                                     bool starts_inside) {
  constexpr float never = 4;  // later than any time
  Float4 values_a[certified_blocks], values_b[certified_blocks];
  Int4 outside[certified_blocks];
  unsigned doubt = 0, leaves = 0;
  Float4 earliest = broadcast(never);
  for (std::size_t k = 0; k < blocks; ++k) {
    const Float4 b = evaluate(planes[k], y_b), a = evaluate(planes[k], y_a);
    values_a[k] = a;
    values_b[k] = b;
    outside[k] = b > broadcast(plane_error);
    const unsigned mask = lane_mask(outside[k]);
    doubt |= (lane_mask(b < broadcast(-plane_error)) | mask) ^ 0xf;
    leaves |= mask;
    const Float4 time = outside[k] ? a / (a - b) : broadcast(never);
    earliest = time < earliest ? time : earliest;
  }
  if (doubt) return {Certified_exit::unknown, 0};
  if (!leaves) return {Certified_exit::inside, 0};
  const float first = smallest(earliest);
  std::size_t best = 4 * blocks;
  for (std::size_t k = blocks; k-- > 0;) {
    const Float4 time = values_a[k] / (values_a[k] - values_b[k]);
    const unsigned mask = lane_mask(outside[k] & (time == broadcast(first)));
    if (mask) best = 4 * k + static_cast<std::size_t>(std::countr_zero(mask));
  }
  if (best == 4 * blocks) return {Certified_exit::unknown, 0};
  const float best_a = values_a[best / 4][best % 4], best_b = values_b[best / 4][best % 4];
  unsigned sooner = !starts_inside && !(best_a < -plane_error);
  for (std::size_t k = 0; k < blocks; ++k) {
    const unsigned own = k == best / 4 ? 1u << best % 4 : 0;
    sooner |= lane_mask(outside[k]) & ~(certainly_later(values_a[k], values_b[k], best_a, best_b) | own);
  }
  return {sooner ? Certified_exit::unknown : Certified_exit::leaves, static_cast<std::uint32_t>(best)};
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_DETAIL_CERTIFIED_EXIT_H
