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

#include <bit>
#include <cmath>
#include <cstdint>

#include <cellwalk/environment/planes.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cellwalk::detail {

/// One bit a lane that is true.
inline unsigned lane_mask(Int4 lanes) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(lanes)));
#else
  return (lanes[0] & 1u) | (lanes[1] & 2u) | (lanes[2] & 4u) | (lanes[3] & 8u);
#endif
}

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

/// True if the line certainly meets facet F before facet G. a_, b_: values at the ends, each within
/// plane_error of a positive multiple (the same for both ends of a facet) of the exact one; both facets have
/// b strictly outside.
inline bool meets_first(double a_f, double b_f, double a_g, double b_g) {
  constexpr double e = plane_error;
  // t_F < t_G  <=>  (-A_F) B_G + A_G B_F < 0, A <= 0 < B. Values are at most 4 in size; products of doubles
  // are exact.
  const double difference = a_g * b_f - a_f * b_g;
  const double error = e * (std::abs(a_f) + b_g + std::abs(a_g) + b_f) + 2 * e * e;
  return difference < -error * (1 + 0x1p-40);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_DETAIL_CERTIFIED_EXIT_H
