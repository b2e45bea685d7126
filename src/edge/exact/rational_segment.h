// SPDX-License-Identifier: LGPL-3.0-or-later
// A segment with a rational end and its exact intersections with facets, for chains in planes of facets.
#ifndef CELLWALK_EDGE_EXACT_RATIONAL_SEGMENT_H
#define CELLWALK_EDGE_EXACT_RATIONAL_SEGMENT_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <cstddef>
#include <optional>

#include "half_space.h"

namespace cellwalk::detail {

/// Closed interval of parameters.
struct Span {
  Fraction low, high;
  /// The half-spaces of a facet (its plane from both sides, then its sides) at whose borders the span begins
  /// and ends; -1 if it does so at an end of the segment.
  int low_border = -1, high_border = -1;
};

/// Keeps the part of a span in which an affine function is not negative, given by its values at p and q,
/// which may have a common positive factor. Returns false if nothing is left.
bool clip(Span& span, const Ring& at_p, const Ring& at_q, int border);

/// The segment from p (parameter 0) to q (parameter 1).
template <int D>
class Rational_segment {
 public:
  Rational_segment(const Point<D>& p, const Point<D>& q) : p_{exact<D>(p)}, q_(exact<D>(q)) {}
  /// The edge that sweeps a triangle, at a time.
  Rational_segment(const Swept_triangle<D>& triangle, const Fraction& time)
      : p_(Rational_segment(triangle.a, triangle.b).at(time)), q_(exact<D>(triangle.q)) {}

  Exact_point<D> at(const Fraction& t) const;
  /// Parameters of the points in closed facet i of a cell.
  std::optional<Span> in_facet(const Cell_view<D>& cell, std::size_t i) const;
  /// The parameter at the border of a half-space of facet i, see Span; 1 if all of it, or its end, lies
  /// there.
  Fraction at_border(const Cell_view<D>& cell, std::size_t i, int border) const;
  /// The parameter of the intersection with the plane of facet i.
  /// \pre there is one
  Fraction in_plane(const Cell_view<D>& cell, std::size_t i) const;

 private:
  bool clip(Span& span, const Half_space<D>& h, int border) const;

  Exact_point<D> p_;
  Ring_vector<D> q_;
};

/// The lowest vertex, edge or facet of closed facet i of a cell that contains x, a point of the facet.
template <int D>
Facet_feature lowest_feature(const Cell_view<D>& cell, std::size_t i, const Exact_point<D>& x);

extern template class Rational_segment<2>;
extern template class Rational_segment<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXACT_RATIONAL_SEGMENT_H
