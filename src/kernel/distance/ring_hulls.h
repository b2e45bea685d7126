// SPDX-License-Identifier: LGPL-3.0-or-later
// Two hulls in ring numbers: the stages of is_apart() that decide all that doubles leave.
#ifndef CELLWALK_KERNEL_DISTANCE_RING_HULLS_H
#define CELLWALK_KERNEL_DISTANCE_RING_HULLS_H

#include <cellwalk/internal/kernel/exact_value.h>

#include <boost/container/small_vector.hpp>

#include <compare>
#include <optional>
#include <utility>

#include "directions.h"

namespace cellwalk::detail {

template <int D>
Numbers<Ring, D> in_ring(const Point<D>& x) {
  Numbers<Ring, D> result;
  for (std::size_t k = 0; k < D; ++k) result[k] = Ring(x[k]);
  return result;
}

/// A simplex and a point, segment or convex polygon, and the distance that is in question.
template <int D>
class Ring_hulls {
 public:
  using Corner = Numbers<Ring, D>;
  using Corners = boost::container::small_vector<Corner, 8>;

  Ring_hulls(Corners a, std::span<const Point<D>> b, double r) : a_(std::move(a)), radius_(r) {
    for (const Point<D>& x : b) b_.push_back(in_ring<D>(x));
    square_ = Ring(radius_ * radius_);
  }

  /// The order of the distance that the direction of a pair shows, and of r.
  std::strong_ordering compare(const Feature_pair& pair) const { return measure(pair).second; }
  /// True if that shows that the hulls are at least r apart.
  bool parts(const Feature_pair& pair) const { return compare(pair) >= 0; }
  /// True if the feet of a pair lie in its features, and are nearer than r.
  bool are_near(const Feature_pair& pair) const;
  /// True if the hulls are at least r apart by the direction of some pair: the exact answer.
  bool are_parted() const;
  /// The direction from a to b along which the hulls are exactly r apart; none if they are farther apart, or
  /// nearer.
  std::optional<Corner> find_direction_at_distance() const;

 private:
  Hulls<Ring, D> hulls() const { return {{a_.data(), a_.size()}, {b_.data(), b_.size()}}; }
  std::pair<Corner, std::strong_ordering> measure(const Feature_pair& pair) const;
  template <class Use>
  void for_each_pair(Use use) const;
  bool has_feet(const Feature_pair& pair, const Corner& n) const;

  Corners a_, b_;
  Ring radius_, square_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_DISTANCE_RING_HULLS_H
