// SPDX-License-Identifier: LGPL-3.0-or-later
// The exit of a cell from float planes with an error bound, as far as they prove it; other signs are
// undecided.
//
// Let e be the point where the line entered the cell (a itself in the first cell). A facet G with b strictly
// inside is not met between e and b, since e is in the closed cell. A facet with b on it is met only if e
// lies on it too. Of the facets with b strictly outside, the line ab meets F at t_F = -A/(B - A), A and B the
// values at a and b. If t_F is strictly the smallest, and the line passes a point of the cell strictly before
// it (always so once a facet has been crossed, since every accepted cell holds a piece of positive length; in
// the first cell where A < 0), then the exit is a point in the relative interior of F.
#ifndef CELLWALK_INTERNAL_WALK_CERTIFIED_EXIT_H
#define CELLWALK_INTERNAL_WALK_CERTIFIED_EXIT_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/planes.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cellwalk::detail {

/// The facets of one block, as bit masks, by the certified side of a point.
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

/// The largest number of blocks that the certified exit examines; cells with more facets are decided exactly.
inline constexpr std::size_t certified_blocks = 8;

/// The exit that the planes of a cell prove.
struct Certified_exit {
  enum Verdict : std::uint8_t { inside, leaves, unknown } verdict;
  std::uint32_t facet;  ///< if it leaves: the facet whose relative interior it crosses
};

inline Float4 broadcast(float x) { return Float4{x, x, x, x}; }

/// A motion in the frame, ready for planes.
template <int D>
struct Frame_line {
  Spread_point<D> a, b, direction;

  Frame_line(const Float_point<D>& from, const Float_point<D>& to) : a(spread<D>(from)), b(spread<D>(to)) {
    for (int i = 0; i < D; ++i) direction[i] = b[i] - a[i];
  }
};

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

/// 1/x to about 12 bits, to choose a candidate; no proof uses it.
inline Float4 rough_inverse(Float4 x) {
#if defined(__SSE2__)
  return std::bit_cast<Float4>(_mm_rcp_ps(std::bit_cast<__m128>(x)));
#else
  return broadcast(1.0f) / x;
#endif
}

/// Later than any time of an exit.
inline constexpr float never = 4;

/// Intervals that contain the times at which the line meets four planes, where the target lies outside (see
/// certified_exit).
struct Times {
  Float4 lower, upper;
};

/// What the rounding of a time adds to its interval.
inline constexpr float time_slack = 0x1p-20f;

inline Times times(Float4 a, Float4 b) {
  const Float4 inverse = broadcast(1.0f) / (b - a);
  const Float4 time = -a * inverse, width = plane_error * inverse + broadcast(time_slack);
  return {time - width, time + width};
}

/// Lanes rotated left by `By`: lane i of the result is lane i+By.
template <int By>
inline Float4 turned(Float4 v) {
  return __builtin_shufflevector(v, v, By % 4, (1 + By) % 4, (2 + By) % 4, (3 + By) % 4);
}

/// The lane of four that is met first, by the outcomes of their comparisons. Bit i of the index: lane i is
/// met before lane i+1 (mod 4); bit 4+i (i < 2): before lane i+2; bit 6+i: lane i is not met, its plane faces
/// away. 0 where no lane is before all others.
inline constexpr std::array<std::uint8_t, 1024> first_lane = [] {
  std::array<std::uint8_t, 1024> table{};
  for (unsigned index = 0; index < table.size(); ++index) {
    const auto is_met = [&](unsigned i) { return !(index >> (6 + i) & 1); };
    const auto before = [&](unsigned i, unsigned j) {
      if ((i + 1) % 4 == j) return (index >> i & 1) != 0;
      if ((j + 1) % 4 == i) return !(index >> j & 1);
      return i < j ? (index >> (4 + i) & 1) != 0 : !(index >> (4 + j) & 1);
    };
    for (unsigned i = 0; i < 4; ++i) {
      bool first = is_met(i);
      for (unsigned j = 0; j < 4; ++j) first = first && (j == i || !is_met(j) || before(i, j));
      if (first) table[index] = static_cast<std::uint8_t>(i);
    }
  }
  return table;
}();

/// The lane whose plane the line from a (values `a`) in a direction (slopes `slope` of the planes along it)
/// probably meets first: the smallest -a/slope of positive slope, by cross products, since a division would
/// take longer than the rest of a crossing. Proves nothing: products are rounded.
inline std::uint32_t probably_first(Float4 a, Float4 slope) {
  const Float4 next = turned<1>(a) * slope - a * turned<1>(slope);
  const Float4 opposite = turned<2>(a) * slope - a * turned<2>(slope);
  const unsigned index = sign_mask(next) | (sign_mask(opposite) & 3u) << 4 | sign_mask(slope) << 6;
  return first_lane[index];
}

/// The exit of a cell of one block, as below.
template <int D>
inline Certified_exit certified_exit(const Plane_block<D>& planes, const Frame_line<D>& line,
                                     bool starts_inside) {
  const Float4 b = evaluate<D>(planes, line.b), a = evaluate<D>(planes, line.a);
  const std::uint32_t first = probably_first(a, slopes<D>(planes, line.direction));
  const Int4 is_outside = b > broadcast(plane_error);
  const unsigned outside = lane_mask(is_outside);
  if ((lane_mask(b < broadcast(-plane_error)) | outside) != 0xf) return {Certified_exit::unknown, 0};
  if (!outside) return {Certified_exit::inside, 0};
  const Times t = times(a, b);
  const Float4 bound = smallest(is_outside ? t.upper : broadcast(never));
  const unsigned own = 1u << first;
  unsigned unproved = (lane_mask(t.lower <= bound) & outside) ^ own;
  if (!starts_inside) unproved |= ~lane_mask(a < broadcast(-plane_error)) & own;
  return {unproved ? Certified_exit::unknown : Certified_exit::leaves, first};
}

/// The exit of a cell of `blocks` blocks towards b, from the start a of the line. `starts_inside`: the line
/// holds a point of the cell strictly before any exit.
///
/// A candidate is chosen by rough times with the facet number in their last bits; the next cell can be
/// fetched from it while the proof is still under way. Nothing branches but the verdict: exits are hard to
/// predict.
///
/// Proof. Let a, b be computed and A <= 0 < B exact values of a facet with b outside, e = plane_error, t =
/// a/(a-b) and T = A/(A-B) the time sought. With A = a+x, B = b+y, |x|, |y| <= e: t - T = (xB -
/// Ay)/((a-b)(A-B)), and |A| + B = B-A, so |t - T| <= e/|a-b|. The computed t is off by three float roundings
/// of a value below 2, the computed bound by as many of itself: time_slack covers the first, the room in
/// plane_error the second. If the upper end of the candidate's interval lies below the lower ends of all
/// others, the line meets the candidate strictly first.
template <int D>
inline Certified_exit certified_exit(const Plane_block<D>* planes, std::size_t blocks,
                                     const Frame_line<D>& line, bool starts_inside) {
  constexpr int number_bits = 31;  // last bits of a rough time: 4 certified_blocks - 1
  Float4 lower[certified_blocks];
  unsigned outside[certified_blocks];
  unsigned doubt = 0, leaves = 0;
  Float4 candidate = broadcast(never), first_upper = broadcast(never);
  for (std::size_t k = 0; k < blocks; ++k) {
    const Float4 b = evaluate<D>(planes[k], line.b), a = evaluate<D>(planes[k], line.a);
    const Int4 is_outside = b > broadcast(plane_error);
    const int base = static_cast<int>(4 * k);
    const Int4 numbers{base, base + 1, base + 2, base + 3};
    const Int4 keyed = (std::bit_cast<Int4>(-a * rough_inverse(b - a)) & ~number_bits) | numbers;
    candidate = lane_min(candidate, is_outside ? std::bit_cast<Float4>(keyed) : broadcast(never));

    const Times t = times(a, b);
    lower[k] = t.lower;
    first_upper = lane_min(first_upper, is_outside ? t.upper : broadcast(never));

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
    unproved |= best >= 4 * blocks || !(evaluate<D>(planes[best / 4], line.a)[best % 4] < -plane_error);
  return {unproved ? Certified_exit::unknown : Certified_exit::leaves, best};
}

/// The exit that the planes of a cell of any number of blocks prove.
template <int D>
Certified_exit exit_of_blocks(const Snapshot<D>& snapshot, Cell cell, const Frame_line<D>& line,
                              bool starts_inside) {
  const std::size_t blocks = snapshot.block_count(cell);
  const Plane_block<D>* planes = snapshot.blocks(cell);
  if (blocks == 2) return certified_exit<D>(planes, 2, line, starts_inside);
  if (blocks > certified_blocks) return {Certified_exit::unknown, 0};
  return certified_exit<D>(planes, blocks, line, starts_inside);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_CERTIFIED_EXIT_H
