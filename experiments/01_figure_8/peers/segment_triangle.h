// SPDX-License-Identifier: LGPL-3.0-or-later
// The four segments of a move against triangles in floating point.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_SEGMENT_TRIANGLE_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_SEGMENT_TRIANGLE_H

#include <array>
#include <cstddef>

#include "common/peers/wall_triangle.h"
#include "peer.h"

namespace cellwalk::figure_8 {

using experiments::rounded;
using experiments::Vector_of;
using experiments::Wall_triangle;

/// Bits 0 to 3 of a vertex against candidate triangles, given by `triangle(i)`.
template <class Real, class Triangle, class Counter>
inline unsigned vertex_against(std::size_t count, const Triangle& triangle, std::size_t v,
                               const Point<3>* positions, const Point<3>& target, Counter& counter) {
  using Vec = Vector_of<Real>;
  const Vec from = rounded<Real>(positions[v]), to = rounded<Real>(target);
  unsigned bits = 0;
  counter.triangle_tests(4 * count);
  for (std::size_t i = 0; i < count && !bits; ++i) {
    const Wall_triangle<Real>& wall = triangle(i);
    if (wall.side(from) * wall.side(to) <= 0 && wall.is_on_line(from, to)) bits = 1;
  }
  const Vec p = bits ? from : to;
  std::array<Vec, trace_edges> ends;
  for (std::size_t k = 0; k < trace_edges; ++k) ends[k] = rounded<Real>(positions[trace_neighbour(v, k)]);
  for (std::size_t i = 0; i < count; ++i) {
    const Wall_triangle<Real>& wall = triangle(i);
    const Real side = wall.side(p);
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (side * wall.side(ends[k]) <= 0 && wall.is_on_line(p, ends[k])) bits |= 2u << k;
  }
  return bits;
}

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_SEGMENT_TRIANGLE_H
