// SPDX-License-Identifier: LGPL-3.0-or-later
// An edge that stands still, and the facets around a moving vertex that it meets at an exact time. Theory:
// docs/moving.md, touches.
#ifndef CELLWALK_EDGE_STAR_STAR_SEGMENT_H
#define CELLWALK_EDGE_STAR_STAR_SEGMENT_H

#include <map>
#include <optional>

#include "edge/exact/rational_segment.h"
#include "star_clock.h"

namespace cellwalk::detail {

/// The parts of an edge that do not depend on the time.
template <int D>
class Still_segment {
 public:
  Still_segment(const Moving_star<D>& star, const Point<D>& p, const Point<D>& q)
      : clock_(star), p_(p), q_(q), segment_(p, q) {}

  const Star_clock<D>& clock() const { return clock_; }
  const Moving_star<D>& star() const { return clock_.star(); }
  const Point<D>& p() const { return p_; }
  const Point<D>& q() const { return q_; }
  Exact_point<D> at(const Fraction& t) const { return segment_.at(t); }

  /// Its part in a closed facet that does not have the vertex, or in a cell.
  const std::optional<Span>& in_facet(Half_facet f) const;
  const std::optional<Span>& in_cell(Cell c) const;

 private:
  Star_clock<D> clock_;
  Point<D> p_, q_;
  Rational_segment<D> segment_;
  mutable std::map<Half_facet, std::optional<Span>> in_facets_;
  mutable std::map<Cell, std::optional<Span>> in_cells_;
};

/// The same at a time.
template <int D>
class Star_segment {
 public:
  Star_segment(const Still_segment<D>& still, const Fraction& time);

  const Still_segment<D>& still() const { return still_; }
  /// The part of the edge in a closed facet, or in a closed cell.
  std::optional<Span> in_facet(Half_facet f) const;
  std::optional<Span> in_cell(Cell c) const;
  /// The parameter at which the edge passes a border of a facet, see Span, that has the vertex; `otherwise`
  /// if all of the edge lies there.
  Fraction at_border(Half_facet f, int border, const Fraction& otherwise) const;

 private:
  Ring_vector<D> corner(const Cell_view<D>& cell, std::uint16_t v) const;
  Half_space<D> plane(const Cell_view<D>& cell, std::size_t i) const;
  Half_space<D> side_of(const Cell_view<D>& cell, std::size_t i, std::size_t k,
                        const Half_space<D>& plane) const;
  bool is_apart(const Cell_view<D>& cell, std::size_t i) const;

  const Still_segment<D>& still_;
  Fraction time_;
  // All coordinates times the denominator of the time.
  Ring_vector<D> vertex_, p_, q_;
};

extern template class Still_segment<2>;
extern template class Still_segment<3>;
extern template class Star_segment<2>;
extern template class Star_segment<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_STAR_STAR_SEGMENT_H
