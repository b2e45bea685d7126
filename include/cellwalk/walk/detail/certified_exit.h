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

inline Float4 lane_min(Float4 a, Float4 b) {
#if defined(__SSE2__)
  return std::bit_cast<Float4>(_mm_min_ps(std::bit_cast<__m128>(a), std::bit_cast<__m128>(b)));
#else
  return a < b ? a : b;
#endif
}

/// The smallest of four lanes, in all lanes.
inline Float4 smallest(Float4 v) {
#if defined(__SSE2__)
  __m128 m = std::bit_cast<__m128>(v);
  m = _mm_min_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(2, 3, 0, 1)));
  m = _mm_min_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(1, 0, 3, 2)));
  return std::bit_cast<Float4>(m);
#else
  return broadcast(std::min(std::min(v[0], v[1]), std::min(v[2], v[3])));
#endif
}

/// 1/x to about 12 bits: good enough to choose a candidate, never to prove anything.
inline Float4 rough_inverse(Float4 x) {
#if defined(__SSE2__)
  return std::bit_cast<Float4>(_mm_rcp_ps(std::bit_cast<__m128>(x)));
#else
  return broadcast(1.0f) / x;
#endif
}

/// The exit of a cell of `blocks` blocks towards b, from the start a of the line. `starts_inside`: the line holds a
/// point of the cell strictly before any exit.
///
/// A candidate is chosen by rough times with the facet number in their last bits; the next cell can be fetched from it
/// while the proof is still under way. Nothing branches but the verdict: exits are hard to predict.
///
/// Proof. Let a, b be computed and A <= 0 < B exact values of a facet with b outside, e = plane_error, t = a/(a-b) and
/// T = A/(A-B) the time sought. With A = a+x, B = b+y, |x|, |y| <= e: t - T = (xB - Ay)/((a-b)(A-B)), and |A| + B = B-A,
/// so |t - T| <= e/|a-b|. The computed t is off by three float roundings of a value below 2, the computed bound by as
/// many of itself: time_slack covers the first, the room in plane_error the second. If the upper end of the
/// candidate's interval lies below the lower ends of all others, the line meets the candidate strictly first.
template <int D>
inline Certified_exit certified_exit(const Plane_block<D>* planes, std::size_t blocks,
                                     const Float_point<D>& y_a, const Float_point<D>& y_b,
                                     bool starts_inside) {
  constexpr float never = 4;  // later than any time
  constexpr float time_slack = 0x1p-20f;
  constexpr int number_bits = 31;  // last bits of a rough time: 4 certified_blocks - 1
  Float4 lower[certified_blocks];
  unsigned outside[certified_blocks];
  unsigned doubt = 0, leaves = 0;
  Float4 candidate = broadcast(never), first_upper = broadcast(never);
  for (std::size_t k = 0; k < blocks; ++k) {
    const Float4 b = evaluate(planes[k], y_b), a = evaluate(planes[k], y_a);
    const Int4 is_outside = b > broadcast(plane_error);
    const Float4 gap = b - a;
    const int base = static_cast<int>(4 * k);
    const Int4 numbers{base, base + 1, base + 2, base + 3};
    const Int4 keyed = (std::bit_cast<Int4>(-a * rough_inverse(gap)) & ~number_bits) | numbers;
    candidate = lane_min(candidate, is_outside ? std::bit_cast<Float4>(keyed) : broadcast(never));

    const Float4 inverse = broadcast(1.0f) / gap;
    const Float4 time = -a * inverse, width = plane_error * inverse + broadcast(time_slack);
    lower[k] = time - width;
    first_upper = lane_min(first_upper, is_outside ? time + width : broadcast(never));

    outside[k] = lane_mask(is_outside);
    leaves |= outside[k];
    doubt |= (lane_mask(b < broadcast(-plane_error)) | outside[k]) ^ 0xf;
  }
  if (doubt) return {Certified_exit::unknown, 0};
  if (!leaves) return {Certified_exit::inside, 0};
  const auto best = std::bit_cast<std::uint32_t>(smallest(candidate)[0]) & number_bits;
  const Float4 bound = smallest(first_upper);
  unsigned unproved = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const unsigned own = k == best / 4 ? 1u << best % 4 : 0;
    unproved |= (lane_mask(lower[k] <= bound) & outside[k]) ^ own;
  }
  if (!starts_inside)
    unproved |= best >= 4 * blocks || !(evaluate(planes[best / 4], y_a)[best % 4] < -plane_error);
  return {unproved ? Certified_exit::unknown : Certified_exit::leaves, best};
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_DETAIL_CERTIFIED_EXIT_H
