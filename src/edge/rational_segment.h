// SPDX-License-Identifier: LGPL-3.0-or-later
// A segment with a rational end, and where it meets facets, in rationals: for chains that lie in planes of facets.
#ifndef CELLWALK_EDGE_RATIONAL_SEGMENT_H
#define CELLWALK_EDGE_RATIONAL_SEGMENT_H

#include <cellwalk/walk/detail/signs.h>

#include <cstddef>
#include <optional>

#include "half_space.h"

namespace cellwalk::detail {

/// Closed interval of parameters.
struct Span {
  Rational low, high;
};

/// The segment from p (parameter 0) to q (parameter 1).
template <int D>
class Rational_segment {
 public:
  Rational_segment(const Rational_point<D>& p, const Rational_point<D>& q) : p_(p), q_(q) {}

  Rational_point<D> at(const Rational& t) const {
    Rational_point<D> x;
    for (int i = 0; i < D; ++i) x[i] = p_[i] + t * (q_[i] - p_[i]);
    return x;
  }
  /// Parameters of the points in closed facet i of a cell.
  std::optional<Span> in_facet(const Cell_view<D>& cell, std::size_t i) const;

 private:
  Rational_point<D> p_, q_;
};

/// The lowest vertex, edge or facet of closed facet i of a cell that holds x, a point of it.
template <int D>
Facet_feature lowest_feature(const Cell_view<D>& cell, std::size_t i, const Rational_point<D>& x);

extern template class Rational_segment<2>;
extern template class Rational_segment<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_RATIONAL_SEGMENT_H
