// SPDX-License-Identifier: LGPL-3.0-or-later
// Where points lie in the cells around a moving vertex, at exact times. Theory: docs/moving.md, touches.
#ifndef CELLWALK_EDGE_STAR_STAR_CLOCK_H
#define CELLWALK_EDGE_STAR_STAR_CLOCK_H

#include <cellwalk/internal/edge/moving_star.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "edge/exact/half_space.h"

namespace cellwalk::detail {

/// A time strictly between two: a double if one that is near their middle will do.
Fraction time_between(const Fraction& s, const Fraction& t);

/// Sorts times in (0,1) and adds 0 and 1.
void complete_times(std::vector<Fraction>& times);

template <int D>
class Star_clock {
 public:
  explicit Star_clock(const Moving_star<D>& star) : star_(star) {}

  /// The side of x with respect to facet i of a cell: > 0 strictly outside.
  int side(const Cell_view<D>& cell, std::size_t i, const Point<D>& x, const Fraction& time) const;
  /// True if a closed cell holds x.
  bool holds(Cell cell, const Point<D>& x, const Fraction& time) const;
  /// True if facet i does.
  /// \pre the closed cell holds x
  bool holds_in_facet(const Cell_view<D>& cell, std::size_t i, const Point<D>& x, const Fraction& time) const;

  /// Adds the times in (0,1) at which x passes from one side of a facet at the vertex to the other, in that
  /// facet.
  void add_passings(const Point<D>& x, std::vector<Fraction>& times) const;
  /// The vertex at a time, times the denominator of that.
  Ring_vector<D> vertex_at(const Fraction& time) const;

  const Moving_star<D>& star() const { return star_; }

 private:
  const Moving_star<D>& star_;
};

/// The collision of a wall at the vertex with x at a time, for reports.
/// \param weights of the points that span x
/// \pre the wall holds x then
template <int D>
Collision collision_at(const Moving_star<D>& star, std::size_t wall, const Fraction& time,
                       const Exact_point<D>& x, std::vector<Ring> weights);

extern template class Star_clock<2>;
extern template class Star_clock<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_STAR_STAR_CLOCK_H
