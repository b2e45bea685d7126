// SPDX-License-Identifier: LGPL-3.0-or-later
// Orientations in numbers of twice the precision of a double, with bounds of their errors.
#ifndef CELLWALK_KERNEL_TWOFOLD_ORIENTATION_H
#define CELLWALK_KERNEL_TWOFOLD_ORIENTATION_H

#include <cellwalk/internal/kernel/twofold.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace cellwalk::detail {

template <int D>
using Twofold_vector = std::array<Twofold, static_cast<std::size_t>(D)>;

/// The differences x - y, which are exact.
template <int D>
Twofold_vector<D> differences(const Point<D>& x, const Point<D>& y) {
  Twofold_vector<D> d;
  for (std::size_t i = 0; i < D; ++i) d[i] = exact_difference(x[i], y[i]);
  return d;
}

/// Between these, products of three differences and of their low parts neither overflow nor lose a bit to
/// underflow that matters: the largest of them is 2^-450 at least, and a term that underflows 2^-900 at most.
inline constexpr double least_difference = 0x1p-150, largest_difference = 0x1p150;

template <int D>
bool are_in_range(const Twofold_vector<D>& d) {
  bool are = true;
  for (const Twofold& x : d) {
    const double size = std::abs(x.high);
    are &= size == 0 || (size > least_difference && size < largest_difference);
  }
  return are;
}

/// The normal of a line or plane, with the sums of the sizes of the terms of each component.
template <int D>
struct Twofold_normal {
  Twofold_vector<D> value;
  std::array<double, static_cast<std::size_t>(D)> size;
  bool is_in_range;
};

inline Twofold_normal<2> normal_of(const std::array<Point<2>, 2>& line) {
  const Twofold_vector<2> d = differences<2>(line[1], line[0]);
  return {{-d[1], d[0]}, {std::abs(d[1].high), std::abs(d[0].high)}, are_in_range<2>(d)};
}

inline Twofold_normal<3> normal_of(const std::array<Point<3>, 3>& plane) {
  const Twofold_vector<3> d = differences<3>(plane[1], plane[0]), e = differences<3>(plane[2], plane[0]);
  Twofold_normal<3> normal;
  normal.is_in_range = are_in_range<3>(d) && are_in_range<3>(e);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    normal.value[i] = d[j] * e[k] - d[k] * e[j];
    normal.size[i] = std::abs(d[j].high * e[k].high) + std::abs(d[k].high * e[j].high);
  }
  return normal;
}

/// The errors of an orientation are less than this share of the sum of the sizes of its terms. In 3D a term
/// has two products and three sums, hence at most 2 * 7 + 3 * 3 = 23 units, in 2D 7 + 3; the rest covers
/// terms of higher order and that the sizes are computed in doubles.
inline constexpr double orientation_share = 32 * twofold_unit;

template <int D>
std::optional<Bounded_twofold> orientation(const Twofold_normal<D>& normal, const Point<D>& origin,
                                           const Point<D>& x) {
  const Twofold_vector<D> d = differences<D>(x, origin);
  if (!are_in_range<D>(d)) return {};
  Twofold value = normal.value[0] * d[0];
  double size = normal.size[0] * std::abs(d[0].high);
  for (std::size_t i = 1; i < D; ++i) {
    value = value + normal.value[i] * d[i];
    size += normal.size[i] * std::abs(d[i].high);
  }
  return Bounded_twofold{value, orientation_share * size};
}

/// Terms of a sum that is computed as if in three times the precision of a double: a pass that changes the
/// terms, but not their sum, leaves little in all but the last of them (Ogita, Rump and Oishi, "Accurate sum
/// and dot product", SIAM Journal on Scientific Computing 26(6), 2005).
class Exact_terms {
 public:
  /// Adds the product of three differences, each the sum of two parts.
  void add(const Twofold& x, const Twofold& y, const Twofold& z) {
    for (const double a : {x.high, x.low})
      for (const double b : {y.high, y.low})
        for (const double c : {z.high, z.low}) add(a, b, c);
  }
  /// With n terms at most, n = 192, and u = 2^-53, the pass makes the sum S of the sizes of all terms but the
  /// last at most nu times its old value, as each is the error of a sum of some of them. Then the terms are
  /// added in numbers of twice the precision, each with an error below 4u^2 times a sum so far: the bound is
  /// ample for 4nu^2 (|sum| + 2S), where 8n^2 u^3 < 2^-140.
  Bounded_twofold sum() {
    double size = 0;
    for (std::size_t i = 0; i < count_; ++i) size += std::abs(terms_[i]);
    for (std::size_t i = 1; i < count_; ++i) {
      const Twofold exact = exact_sum(terms_[i], terms_[i - 1]);
      terms_[i] = exact.high;
      terms_[i - 1] = exact.low;
    }
    Twofold sum;
    for (std::size_t i = 0; i < count_; ++i) sum = sum + Twofold{terms_[i], 0};
    return {sum, 0x1p-90 * std::abs(sum.high) + 0x1p-128 * size};
  }

 private:
  void add(double a, double b, double c) {
    if (a == 0 || b == 0 || c == 0) return;
    const Twofold product = exact_product(a, b);
    for (const double part : {product.high, product.low}) {
      if (part == 0) continue;
      const Twofold terms = exact_product(part, c);
      terms_[count_++] = terms.high;
      terms_[count_++] = terms.low;
    }
  }

  std::array<double, 6 * 8 * 4> terms_;
  std::size_t count_ = 0;
};

/// Low parts of differences whose products do not underflow.
template <int D>
bool are_low_parts_in_range(const Twofold_vector<D>& d) {
  return std::all_of(d.begin(), d.end(),
                     [](const Twofold& x) { return x.low == 0 || std::abs(x.low) > 0x1p-250; });
}

/// The orientation of a point close to a plane, with a much smaller error. None if it is out of range.
template <int D>
std::optional<Bounded_twofold> sharp_orientation(
    const std::array<Point<D>, static_cast<std::size_t>(D)>& plane, const Point<D>& x) {
  const Twofold_vector<D> d = differences<D>(plane[1], plane[0]), e = differences<D>(plane[D - 1], plane[0]),
                          f = differences<D>(x, plane[0]);
  for (const Twofold_vector<D>* v : {&d, &e, &f})
    if (!are_in_range<D>(*v) || !are_low_parts_in_range<D>(*v)) return {};
  Exact_terms terms;
  if constexpr (D == 2) {
    terms.add(d[0], f[1], {1, 0});
    terms.add(-d[1], f[0], {1, 0});
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      terms.add(d[j], e[k], f[i]);
      terms.add(-d[k], e[j], f[i]);
    }
  }
  return terms.sum();
}

/// The sign of an orientation where its error leaves no doubt; 0 where it does, and where the orientation
/// is 0.
template <int D>
int twofold_sign(const std::array<Point<D>, static_cast<std::size_t>(D)>& plane, const Point<D>& x) {
  const Twofold_normal<D> normal = normal_of(plane);
  if (!normal.is_in_range) return 0;
  const auto found = orientation<D>(normal, plane[0], x);
  // Twice the bound, as the value is compared by its high part.
  if (!found || !(std::abs(found->value.high) > 2 * found->error)) return 0;
  return found->value.high > 0 ? 1 : -1;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_TWOFOLD_ORIENTATION_H
