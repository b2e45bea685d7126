// SPDX-License-Identifier: LGPL-3.0-or-later
// A body as plain data: vertices, the edges between them, and faces if it has a surface.
#ifndef CELLWALK_RECORDS_BODY_SOUP_H
#define CELLWALK_RECORDS_BODY_SOUP_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// A body before it is placed in an environment. It may be open or closed, manifold or not, of one part or of
/// several. Vertices without edges and vertices with equal coordinates are allowed. `make_body` establishes
/// the properties of edges and faces below.
template <int D>
struct Body_soup {
  std::vector<Point<D>> points;                     ///< in the units of the environment
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< u < v; in ascending order, without repetition
  /// Triangles, each side of which is an edge; no two with the same three corners. 2D bodies have none.
  std::vector<std::array<std::uint32_t, 3>> faces;
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_BODY_SOUP_H
