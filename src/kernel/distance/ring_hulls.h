// SPDX-License-Identifier: LGPL-3.0-or-later
// Two hulls in ring numbers: the stages of is_apart() that decide all that doubles leave.
#ifndef CELLWALK_KERNEL_DISTANCE_RING_HULLS_H
#define CELLWALK_KERNEL_DISTANCE_RING_HULLS_H

#include <cellwalk/internal/kernel/exact_value.h>

#include <boost/container/small_vector.hpp>

#include <optional>

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

  /// True if the direction of a pair shows that the hulls are at least r apart.
  bool parts(const Feature_pair& pair) const;
  /// True if the feet of a pair lie in its features, and are nearer than r.
  bool are_near(const Feature_pair& pair) const;
  /// A pair by whose direction the hulls are at least r apart; none if they are nearer.
  std::optional<Feature_pair> find_parting() const;

 private:
  Hulls<Ring, D> hulls() const { return {{a_.data(), a_.size()}, {b_.data(), b_.size()}}; }
  bool has_feet(const Feature_pair& pair, const Corner& n) const;

  Corners a_, b_;
  Ring radius_, square_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_DISTANCE_RING_HULLS_H
