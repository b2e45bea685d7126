// SPDX-License-Identifier: LGPL-3.0-or-later
// Four doubles or eight floats at a time, with fused products: compiled for processors that have them, and
// called on those only. All code but the entry is local to this file.
#include <immintrin.h>

#include "lane_functions.h"

namespace cellwalk::detail {
namespace {

struct Fused_lanes {
  using Vector = double __attribute__((vector_size(32)));
  static constexpr unsigned long width = 4;

  static Vector all(double x) { return Vector{x, x, x, x}; }
  static Vector load(const double* from) { return Vector(_mm256_loadu_pd(from)); }
  static void store(double* to, Vector x) { _mm256_storeu_pd(to, __m256d(x)); }
  /// a b - product, where the product is that of doubles: exact.
  static Vector product_error(Vector a, Vector b, Vector product) {
    return Vector(_mm256_fmsub_pd(__m256d(a), __m256d(b), __m256d(product)));
  }
  static Vector multiply_add(Vector a, Vector b, Vector c) {
    return Vector(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
  }
  static Vector square_root(Vector x) { return Vector(_mm256_sqrt_pd(__m256d(x))); }
  static Vector magnitude(Vector x) { return Vector(_mm256_andnot_pd(_mm256_set1_pd(-0.0), __m256d(x))); }
  static void transpose(const double* r0, const double* r1, const double* r2, const double* r3,
                        Vector* columns) {
    const __m256d a = _mm256_load_pd(r0), b = _mm256_load_pd(r1), c = _mm256_load_pd(r2),
                  d = _mm256_load_pd(r3);
    const __m256d ab_02 = _mm256_unpacklo_pd(a, b), ab_13 = _mm256_unpackhi_pd(a, b);
    const __m256d cd_02 = _mm256_unpacklo_pd(c, d), cd_13 = _mm256_unpackhi_pd(c, d);
    columns[0] = Vector(_mm256_permute2f128_pd(ab_02, cd_02, 0x20));
    columns[1] = Vector(_mm256_permute2f128_pd(ab_13, cd_13, 0x20));
    columns[2] = Vector(_mm256_permute2f128_pd(ab_02, cd_02, 0x31));
    columns[3] = Vector(_mm256_permute2f128_pd(ab_13, cd_13, 0x31));
  }
  static void load(const Lane_plane* planes, const unsigned* of_lane, unsigned long stride, Vector* high,
                   Vector* low) {
    const Lane_plane &a = planes[of_lane[0]], &b = planes[of_lane[stride]], &c = planes[of_lane[2 * stride]],
                     &d = planes[of_lane[3 * stride]];
    transpose(a.high, b.high, c.high, d.high, high);
    transpose(a.low, b.low, c.low, d.low, low);
  }
  /// The last lane of `before`, then the others of x.
  static Vector shift(Vector before, Vector x) {
    const __m256d middle = _mm256_permute2f128_pd(__m256d(before), __m256d(x), 0x21);
    return Vector(_mm256_shuffle_pd(middle, __m256d(x), 0x5));
  }
  /// Stores lengths, known by a low part and an error, that are positive and rounded to nearest, and 0 for
  /// others.
  /// \return how many of the first `count` are
  static unsigned store_certain(double* to, Vector length, Vector low, Vector error, unsigned long count) {
    const Vector above = length + (low + error), below = length + (low - error);
    const auto certain = (above == length) & (below == length) & (length > all(0));
    store(to, Vector(_mm256_and_pd(__m256d(certain), __m256d(length))));
    const unsigned bits = static_cast<unsigned>(_mm256_movemask_pd(__m256d(certain)));
    return static_cast<unsigned>(__builtin_popcount(count < width ? bits & ((1u << count) - 1) : bits));
  }
};

/// Four planes of each of two cells.
struct Fused_cells {
  using Floats = float __attribute__((vector_size(32)));
  using Bits = int __attribute__((vector_size(32)));
  static constexpr unsigned cells = 2;

  static Floats all_floats(float x) { return Floats{x, x, x, x, x, x, x, x}; }
  static Floats load_floats(const float* from) { return Floats(_mm256_load_ps(from)); }
  template <unsigned D>
  static void load_planes(const float* const blocks[2], Floats plane[D + 1]) {
    for (unsigned k = 0; k <= D; ++k) {
      const __m128 low = _mm_load_ps(blocks[0] + 4 * k), high = _mm_load_ps(blocks[1] + 4 * k);
      plane[k] = Floats(_mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1));
    }
  }
  static Floats multiply_add(Floats a, Floats b, Floats c) {
    return Floats(_mm256_fmadd_ps(__m256(a), __m256(b), __m256(c)));
  }
  static Bits is_above(Floats a, Floats b) { return a > b; }
  static Bits is_at_most(Floats a, Floats b) { return a <= b; }
  static Floats choose(Bits condition, Floats a, Floats b) {
    return Floats(_mm256_blendv_ps(__m256(b), __m256(a), __m256(condition)));
  }
  /// The least of the four values of each cell, in all of its lanes.
  static Floats least_of_four(Floats x) {
    const __m256 half = _mm256_min_ps(__m256(x), _mm256_permute_ps(__m256(x), _MM_SHUFFLE(2, 3, 0, 1)));
    return Floats(_mm256_min_ps(half, _mm256_permute_ps(half, _MM_SHUFFLE(1, 0, 3, 2))));
  }
  static void set_cell(Bits& lanes, unsigned cell, bool to) {
    for (unsigned i = 0; i < 4; ++i) lanes[4 * cell + i] = to ? -1 : 0;
  }
  static unsigned mask(Bits lanes) { return static_cast<unsigned>(_mm256_movemask_ps(__m256(lanes))); }
  /// The bits by which Exit_lanes has exits, of all cells.
  static unsigned exits(Bits first, Bits decided) {
    const __m256i words = _mm256_packs_epi32(__m256i(first), __m256i(decided));
    return static_cast<unsigned>(_mm256_movemask_epi8(_mm256_packs_epi16(words, words)));
  }
  static unsigned exit(unsigned exits, unsigned cell) { return exits >> 16 * cell & 0xff; }
};

}  // namespace

const Lane_functions fused_lane_functions{&set_directions_in_lanes<Fused_lanes>, &place_in_lanes<Fused_lanes>,
                                          &measure_in_lanes<Fused_lanes>, &walk_in_lanes<Fused_cells, 2>,
                                          &walk_in_lanes<Fused_cells, 3>};

}  // namespace cellwalk::detail
