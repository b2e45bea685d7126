// SPDX-License-Identifier: LGPL-3.0-or-later
// The stages of is_apart() in doubles: each proves something, or leaves it to the next.
//
// Bounds. Operations are rounded once, to nearest; u = 2^-53. Let o be the first corner of b, and M the
// extent: the largest size of a rounded coordinate of x - o over all corners x.
//
// A direction n parts the hulls if they are more than r apart along it. n is scaled to v = fl(k n), k = fl((1
// - 2^-50) / fl(sqrt(fl(n.n)))): fl(n.n) has a relative error below 3.1u, so |v| <= (1 - 8u)(1 + 4.7u) < 1.
// In fl(v.(x
// - o)) each term is rounded four times, so it is off by less than 4.01u |x - o| < 7uM. The gap of the hulls
// is off by less than 7uM for each of them and 3.5uM for their difference; the subtraction of the bound costs
// another 3.5uM: in all 21uM < 2^-48 M. For 2^-400 < M < 2^400 and 2^-900 < n.n < 2^900 nothing overflows,
// and what underflows is covered by the rest.
//
// A point of a simplex of differences of corners is such a difference, too, and so a proof that the hulls are
// nearer than r if its length is less. Weights are as rounded, not negative, of sum 1 with that of the first
// corner. Each coordinate of a difference w is off by 4uM (two corners, and their difference, of size 2M); of
// a difference of two of them, by another 4uM, times the weights, whose sum is at most 1; the products and
// the sums add less than 14uM. So the point is off by 26uM in each coordinate, by 46uM in all, and with the
// rounding of its length by less than 2^-46 M = 128uM.
//
// The nearest points of features are combinations of corners likewise, and off by less.
#ifndef CELLWALK_KERNEL_DISTANCE_FILTER_H
#define CELLWALK_KERNEL_DISTANCE_FILTER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "directions.h"

namespace cellwalk::detail {

/// a - b >= r, exactly: rounding is monotone, so the rounded difference decides unless it equals r; then the
/// sign of its error does.
inline bool differ_by(double a, double b, double r) {
  const double d = a - b;
  if (d != r) return d > r;
  const double part = a - d;
  return (a - (d + part)) + (part - b) >= 0;
}

/// A direction n as v, see above; none if the bounds do not hold for it.
template <int D>
std::optional<Vector<D>> scaled_direction(const Vector<D>& n) {
  const double squared = dot(n, n);
  if (!(squared > 0x1p-900 && squared < 0x1p900)) return {};
  return ((1 - 0x1p-50) / std::sqrt(squared)) * n;
}

/// Two hulls in doubles. They are referred to.
template <int D>
class Filter {
 public:
  Filter(std::span<const Point<D>> a, std::span<const Point<D>> b, double r) : a_(a), b_(b), r_(r) {
    for (const Point<D>& x : a) extend(x);
    for (const Point<D>& x : b) extend(x);
  }

  /// True proves that the boxes are at least r apart along an axis, and nothing less.
  bool boxes_part() const {
    for (std::size_t k = 0; k < D; ++k) {
      double a_low = a_[0][k], a_high = a_low, b_low = b_[0][k], b_high = b_low;
      for (const Point<D>& x : a_) a_low = std::min(a_low, x[k]), a_high = std::max(a_high, x[k]);
      for (const Point<D>& x : b_) b_low = std::min(b_low, x[k]), b_high = std::max(b_high, x[k]);
      if (differ_by(b_low, a_high, r_) || differ_by(a_low, b_high, r_)) return true;
    }
    return false;
  }

  double radius() const { return r_; }
  /// False if the bounds of this class do not hold.
  bool is_in_range() const { return extent_ > 0x1p-400 && extent_ < 0x1p400; }

  /// A lower bound of the distance, by a direction, either way: it is negative where the direction shows
  /// nothing.
  /// \pre is_in_range()
  double gap(const Vector<D>& n) const {
    const std::optional<Vector<D>> direction = scaled_direction<D>(n);
    if (!direction) return -1;
    const Vector<D>& v = *direction;
    double a_low = dot(v, a_[0] - b_[0]), a_high = a_low, b_low = 0, b_high = 0;
    for (std::size_t i = 1; i < a_.size(); ++i) {
      const double at = dot(v, a_[i] - b_[0]);
      a_low = std::min(a_low, at), a_high = std::max(a_high, at);
    }
    for (std::size_t i = 1; i < b_.size(); ++i) {
      const double at = dot(v, b_[i] - b_[0]);
      b_low = std::min(b_low, at), b_high = std::max(b_high, at);
    }
    return std::max(b_low - a_high, a_low - b_high) - 0x1p-48 * extent_;
  }
  double gap(const Feature_pair& pair) const { return gap(direction_of<double, D>({a_, b_}, pair)); }

  /// True proves that the hulls are more than r apart along a direction.
  /// \pre is_in_range()
  bool parts(const Vector<D>& n) const { return gap(n) > r_; }

  /// True proves that two points are nearer than r.
  /// \pre is_in_range(); the points are as above
  bool are_near(double distance) const { return distance + 0x1p-46 * extent_ < r_; }

  /// True if a lower bound of the distance is near that of two points: it is good to some roundings.
  bool is_tight(double bound, double distance) const { return distance - bound < 0x1p-42 * extent_; }

 private:
  void extend(const Point<D>& x) {
    for (std::size_t k = 0; k < D; ++k) extent_ = std::max(extent_, std::abs(x[k] - b_[0][k]));
  }

  std::span<const Point<D>> a_, b_;
  double r_, extent_ = 0;
};

/// Nearest points relative to the first corner of b, and how far apart they are.
template <int D>
struct Relative_nearest {
  Feature_pair features;
  Point<D> on_a{}, on_b{};
  double distance = 0;
};

/// The nearest points of all pairs of features in doubles. The weights are not negative and have the sum 1.
template <int D>
Relative_nearest<D> nearest_features(std::span<const Point<D>> a, std::span<const Point<D>> b);

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_DISTANCE_FILTER_H
