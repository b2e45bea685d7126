// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges whose end moves in their line: the triangle that they sweep is a segment. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_IN_LINE_H
#define CELLWALK_EDGE_IN_LINE_H

#include <cellwalk/edge/triangle.h>

#include "rational_segment.h"

namespace cellwalk::detail {

/// When p leaves a cell on its way from a to b: it passes the plane of the first facet that has its target outside.
/// \pre some facet has
template <int D>
Rational exit_time(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, Walk_counts& counts);

/// A contact of an edge with a wall at x: the time is rounded to nearest, and then down.
template <int D>
Wall_contact<D> edge_contact(const Snapshot<D>& snapshot, const Rational& time, Half_facet wall,
                             const Rational_point<D>& x);

/// sweep_triangle() where a, b and q lie on one line. The edge gets longer and is free; or shorter, and then p must stay on
/// the side of each wall in that line on which the edge lies.
template <int D>
Chain_result<D> sweep_in_line(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                              const Chain& before, Edge_counts& counts);

#define CELLWALK_DECLARE(D)                                                                               \
  extern template Rational exit_time<D>(const Cell_view<D>&, const Point<D>&, const Point<D>&,            \
                                        Walk_counts&);                                                    \
  extern template Wall_contact<D> edge_contact<D>(const Snapshot<D>&, const Rational&, Half_facet,        \
                                                  const Rational_point<D>&);                              \
  extern template Chain_result<D> sweep_in_line<D>(const Snapshot<D>&, const Way<D>&, const Particle<D>&, \
                                                   const Chain&, Edge_counts&);

CELLWALK_DECLARE(2)
CELLWALK_DECLARE(3)

#undef CELLWALK_DECLARE

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_IN_LINE_H
