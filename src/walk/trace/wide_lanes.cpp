// SPDX-License-Identifier: LGPL-3.0-or-later
// Eight doubles or sixteen floats at a time: compiled for processors that have them, and called on those
// only. All code but the entry is local to this file.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"  // of registers that GCC's own header leaves undefined
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#include "lane_functions.h"

namespace cellwalk::detail {
namespace {

struct Wide_lanes {
  using Vector = double __attribute__((vector_size(64)));
  static constexpr unsigned long width = 8;

  static Vector all(double x) { return Vector(_mm512_set1_pd(x)); }
  static Vector load(const double* from) { return Vector(_mm512_loadu_pd(from)); }
  static void store(double* to, Vector x) { _mm512_storeu_pd(to, __m512d(x)); }
  /// a b - product, where the product is that of doubles: exact.
  static Vector product_error(Vector a, Vector b, Vector product) {
    return Vector(_mm512_fmsub_pd(__m512d(a), __m512d(b), __m512d(product)));
  }
  static Vector multiply_add(Vector a, Vector b, Vector c) {
    return Vector(_mm512_fmadd_pd(__m512d(a), __m512d(b), __m512d(c)));
  }
  static Vector square_root(Vector x) { return Vector(_mm512_sqrt_pd(__m512d(x))); }
  static Vector magnitude(Vector x) { return Vector(_mm512_abs_pd(__m512d(x))); }
  /// Each plane is a row of eight: its high parts, then its low parts.
  static void load(const Lane_plane* planes, const unsigned* of_lane, unsigned long stride, Vector* high,
                   Vector* low) {
    const double* plane[8];
    for (unsigned long i = 0; i < 8; ++i) plane[i] = planes[of_lane[i * stride]].high;
    transpose(plane, high);
    for (const double*& p : plane) p += 4;
    transpose(plane, low);
  }
  /// Four components of eight rows.
  static void transpose(const double* const rows[8], Vector columns[4]) {
    const auto two = [&](int first, int second) {
      return _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_load_pd(rows[first])), 0xf0,
                                         _mm256_load_pd(rows[second]));
    };
    const __m512d a = two(0, 2), b = two(1, 3), c = two(4, 6), d = two(5, 7);
    const __m512d ab_02 = _mm512_unpacklo_pd(a, b), ab_13 = _mm512_unpackhi_pd(a, b);
    const __m512d cd_02 = _mm512_unpacklo_pd(c, d), cd_13 = _mm512_unpackhi_pd(c, d);
    columns[0] = Vector(_mm512_shuffle_f64x2(ab_02, cd_02, 0x88));
    columns[1] = Vector(_mm512_shuffle_f64x2(ab_13, cd_13, 0x88));
    columns[2] = Vector(_mm512_shuffle_f64x2(ab_02, cd_02, 0xdd));
    columns[3] = Vector(_mm512_shuffle_f64x2(ab_13, cd_13, 0xdd));
  }
  /// The last lane of `before`, then the others of x.
  static Vector shift(Vector before, Vector x) {
    return Vector(_mm512_castsi512_pd(
        _mm512_alignr_epi64(_mm512_castpd_si512(__m512d(x)), _mm512_castpd_si512(__m512d(before)), 7)));
  }
  /// Stores lengths, known by a low part and an error, that are positive and rounded to nearest, and 0 for
  /// others.
  /// \return how many of the first `count` are
  static unsigned store_certain(double* to, Vector length, Vector low, Vector error, unsigned long count) {
    const __m512d above = __m512d(length + (low + error)), below = __m512d(length + (low - error));
    const unsigned certain = _mm512_cmp_pd_mask(above, __m512d(length), _CMP_EQ_OQ) &
                             _mm512_cmp_pd_mask(below, __m512d(length), _CMP_EQ_OQ) &
                             _mm512_cmp_pd_mask(__m512d(length), _mm512_setzero_pd(), _CMP_GT_OQ);
    _mm512_storeu_pd(to, _mm512_maskz_mov_pd(static_cast<__mmask8>(certain), __m512d(length)));
    const unsigned counted = count < width ? certain & ((1u << count) - 1) : certain;
    return static_cast<unsigned>(__builtin_popcount(counted));
  }
};

/// Four planes of each of four cells.
struct Wide_cells {
  using Floats = float __attribute__((vector_size(64)));
  using Bits = unsigned;
  static constexpr unsigned cells = 4;

  static Floats all_floats(float x) { return Floats(_mm512_set1_ps(x)); }
  static Floats load_floats(const float* from) { return Floats(_mm512_load_ps(from)); }
  template <unsigned D>
  static void load_planes(const float* const blocks[4], Floats plane[D + 1]) {
    for (unsigned k = 0; k <= D; ++k) {
      __m512 row = _mm512_castps128_ps512(_mm_load_ps(blocks[0] + 4 * k));
      row = _mm512_insertf32x4(row, _mm_load_ps(blocks[1] + 4 * k), 1);
      row = _mm512_insertf32x4(row, _mm_load_ps(blocks[2] + 4 * k), 2);
      plane[k] = Floats(_mm512_insertf32x4(row, _mm_load_ps(blocks[3] + 4 * k), 3));
    }
  }
  static Floats multiply_add(Floats a, Floats b, Floats c) {
    return Floats(_mm512_fmadd_ps(__m512(a), __m512(b), __m512(c)));
  }
  static Bits is_above(Floats a, Floats b) { return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_GT_OQ); }
  static Bits is_at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LE_OQ); }
  static Floats choose(Bits condition, Floats a, Floats b) {
    return Floats(_mm512_mask_blend_ps(static_cast<__mmask16>(condition), __m512(b), __m512(a)));
  }
  /// The least of the four values of each cell, in all of its lanes.
  static Floats least_of_four(Floats x) {
    const __m512 half = _mm512_min_ps(__m512(x), _mm512_permute_ps(__m512(x), _MM_SHUFFLE(2, 3, 0, 1)));
    return Floats(_mm512_min_ps(half, _mm512_permute_ps(half, _MM_SHUFFLE(1, 0, 3, 2))));
  }
  static unsigned mask(Bits lanes) { return lanes; }
  static void set_cell(Bits& lanes, unsigned cell, bool to) {
    lanes = (lanes & ~(0xfu << 4 * cell)) | (to ? 0xfu << 4 * cell : 0);
  }
  /// The bits by which Exit_lanes has exits, of all cells.
  static unsigned exits(Bits first, Bits decided) {
    return _pdep_u32(first, 0x0f0f0f0f) | _pdep_u32(decided, 0xf0f0f0f0);
  }
  static unsigned exit(unsigned exits, unsigned cell) { return exits >> 8 * cell & 0xff; }
};

}  // namespace

const Lane_functions wide_lane_functions{&set_directions_in_lanes<Wide_lanes>, &place_in_lanes<Wide_lanes>,
                                         &measure_in_lanes<Wide_lanes>, &walk_in_lanes<Wide_cells, 2>,
                                         &walk_in_lanes<Wide_cells, 3>};

}  // namespace cellwalk::detail
