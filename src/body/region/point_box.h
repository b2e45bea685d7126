// SPDX-License-Identifier: LGPL-3.0-or-later
// The box of many points.
#ifndef CELLWALK_BODY_REGION_POINT_BOX_H
#define CELLWALK_BODY_REGION_POINT_BOX_H

#include <cellwalk/internal/kernel/box.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cellwalk::detail {

/// Two numbers at once.
using Double2 = double __attribute__((vector_size(16)));

inline Double2 load(const double* x) {
#if defined(__SSE2__)
  return _mm_loadu_pd(x);
#else
  return Double2{x[0], x[1]};
#endif
}
/// \pre x lies at a multiple of 16 bytes
inline Double2 load_aligned(const double* x) {
#if defined(__SSE2__)
  return _mm_load_pd(x);
#else
  return load(x);
#endif
}
inline Double2 lane_min(Double2 a, Double2 b) {
#if defined(__SSE2__)
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}
inline Double2 lane_max(Double2 a, Double2 b) {
#if defined(__SSE2__)
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}
/// Of each lane, whether it is true.
#if defined(__SSE2__)
using Truth2 = __m128d;
#else
using Truth2 = std::int64_t __attribute__((vector_size(16)));
#endif

inline Truth2 less(Double2 a, Double2 b) {
#if defined(__SSE2__)
  return _mm_cmplt_pd(a, b);
#else
  return a < b;
#endif
}
/// True for NaNs as well.
inline Truth2 not_at_most(Double2 a, Double2 b) {
#if defined(__SSE2__)
  return _mm_cmpnle_pd(a, b);
#else
  return ~(a <= b);
#endif
}
/// Whether neither is a NaN.
inline Truth2 ordered(Double2 a, Double2 b) {
#if defined(__SSE2__)
  return _mm_cmpord_pd(a, b);
#else
  return (a == a) & (b == b);
#endif
}
inline Truth2 both(Truth2 a, Truth2 b) {
#if defined(__SSE2__)
  return _mm_and_pd(a, b);
#else
  return a & b;
#endif
}
inline bool all_true(Truth2 lanes) {
#if defined(__SSE2__)
  return _mm_movemask_pd(lanes) == 3;
#else
  return (lanes[0] & lanes[1]) != 0;
#endif
}

/// Bounds of points two by two, as the coordinates of two points lie: lane i is of coordinate i mod D.
template <int D>
struct Pair_bounds {
  Double2 low[D], high[D];
  /// Of all numbers: a NaN that bounds may have lost is in them, where sums of others may be NaNs as well.
  Double2 sum[D];

  /// \pre there are points, an even number
  explicit Pair_bounds(std::span<const Point<D>> points) {
    const double *x = points.front().data(), *end = x + D * points.size();
    for (int k = 0; k < D; ++k) low[k] = high[k] = sum[k] = load(x + 2 * k);
    while ((x += 2 * D) != end)
      for (int k = 0; k < D; ++k) {
        const Double2 pair = load(x + 2 * k);
        low[k] = lane_min(low[k], pair);
        high[k] = lane_max(high[k], pair);
        sum[k] += pair;
      }
  }
  /// False if one of the numbers is a NaN.
  Truth2 are_numbers() const {
    Double2 others = sum[0];
    for (int k = 1; k < D - 1; ++k) others += sum[k];
    return ordered(others, sum[D - 1]);
  }
};

/// True if all coordinates are finite.
/// Cost: about half a nanosecond a point, unless they are so large that their sum is not.
template <int D>
bool are_finite(std::span<const Point<D>> points) {
  if (points.size() % 2 != 0 && !is_finite(points.back())) return false;
  if (points.size() < 2) return true;
  const double* x = points.front().data();
  Double2 sum[D];
  for (int k = 0; k < D; ++k) sum[k] = load(x + 2 * k);
  for (std::size_t pairs = points.size() / 2; --pairs > 0;) {
    x += 2 * D;
    for (int k = 0; k < D; ++k) sum[k] += load(x + 2 * k);
  }
  for (int k = 1; k < D; ++k) sum[0] += sum[k];
  const Double2 zero = sum[0] - sum[0];
  if (all_true(ordered(zero, zero))) [[likely]]
    return true;
  return std::ranges::all_of(points, is_finite<static_cast<std::size_t>(D)>);
}

/// The largest scalar product of a vector with points, each rounded as by dot(). -inf if there are none.
/// \pre they are finite
template <int D>
double furthest(const Vector<D>& normal, std::span<const Point<D>> points) {
  double most = -std::numeric_limits<double>::infinity();
  std::size_t i = 0;
#if defined(__SSE2__)
  if constexpr (D == 3) {
    // Two points at a time, of which x0 y0, z0 x1 and y1 z1 lie side by side.
    const __m128d xy = _mm_setr_pd(normal[0], normal[1]), zx = _mm_setr_pd(normal[2], normal[0]),
                  yz = _mm_setr_pd(normal[1], normal[2]);
    __m128d both = _mm_set1_pd(most);
    for (; i + 2 <= points.size(); i += 2) {
      const double* x = points[i].data();
      const __m128d a = _mm_mul_pd(xy, load(x)), b = _mm_mul_pd(zx, load(x + 2)),
                    c = _mm_mul_pd(yz, load(x + 4));
      const __m128d sum = _mm_add_pd(_mm_shuffle_pd(a, b, 2), _mm_shuffle_pd(a, c, 1));
      both = _mm_max_pd(both, _mm_add_pd(sum, _mm_shuffle_pd(b, c, 2)));
    }
    most = std::max(both[0], both[1]);
  }
#endif
  for (; i < points.size(); ++i) most = std::max(most, dot(normal, points[i]));
  return most;
}

/// The box of points that lie anywhere, in two pairs of lanes: the first two coordinates, and the last two.
template <int D>
class Pair_box {
 public:
  explicit Pair_box(const Point<D>& x)
      : low_{load(x.data()), load(x.data() + D - 2)}, high_{low_[0], low_[1]} {}
  /// \pre no NaNs
  void extend(const Point<D>& x) {
    const Double2 pairs[2] = {load(x.data()), load(x.data() + D - 2)};
    for (int i = 0; i < 2; ++i) {
      low_[i] = lane_min(low_[i], pairs[i]);
      high_[i] = lane_max(high_[i], pairs[i]);
    }
  }
  Box<D> box() const {
    Box<D> box;
    for (std::size_t k = 0; k < D; ++k) {
      const std::size_t pair = k / 2, lane = pair == 0 ? k : 1;
      box.low[k] = low_[pair][lane];
      box.high[k] = high_[pair][lane];
    }
    return box;
  }

 private:
  Double2 low_[2], high_[2];
};

/// \pre the points are finite
template <int D>
Box<D> box_of(std::span<const Point<D>> points) {
  Box<D> box;
  if (points.size() >= 2) {
    const Pair_bounds<D> bounds(points.first(points.size() - points.size() % 2));
    for (std::size_t k = 0; k < D; ++k) {
      box.low[k] = std::min(bounds.low[k / 2][k % 2], bounds.low[(k + D) / 2][(k + D) % 2]);
      box.high[k] = std::max(bounds.high[k / 2][k % 2], bounds.high[(k + D) / 2][(k + D) % 2]);
    }
  }
  if (points.size() % 2 != 0) box.extend(points.back());
  return box;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_POINT_BOX_H
