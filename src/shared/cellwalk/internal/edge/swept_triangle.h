// SPDX-License-Identifier: LGPL-3.0-or-later
// The triangle that an edge sweeps, and the path of its end.
#ifndef CELLWALK_INTERNAL_EDGE_SWEPT_TRIANGLE_H
#define CELLWALK_INTERNAL_EDGE_SWEPT_TRIANGLE_H

#include <cellwalk/walk/locate.h>

#include <span>

namespace cellwalk {

/// The triangle that the edge pq sweeps while p moves from a to b and q stands still.
template <int D>
struct Swept_triangle {
  Point<D> a, b, q;
};

/// The path of p, as reported by Walk_options. The spans refer to the vectors given there, which must outlive
/// the path and stay as they are; no result of a sweep refers to them.
template <int D>
struct Vertex_path {
  Particle<D> from, to;
  std::span<const Cell> visited;
  std::span<const Half_facet> crossed;
  /// True if a wall blocked p. Then to.position is the target, and the edge is swept until p is blocked.
  bool blocked = false;
  /// True if p is known to have met no wall on its path, and to have crossed each facet in its interior.
  bool is_apart = false;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_SWEPT_TRIANGLE_H
