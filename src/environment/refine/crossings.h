// SPDX-License-Identifier: LGPL-3.0-or-later
// The points where sides of facets in a plane cross. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_CROSSINGS_H
#define CELLWALK_ENVIRONMENT_REFINE_CROSSINGS_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <span>
#include <vector>

#include "lone_facets.h"
#include "sides.h"

namespace cellwalk::detail {

/// Two coordinates in a plane, in which the loop of a facet is counterclockwise.
struct Flat_view {
  int axis;      ///< the coordinate that is dropped
  bool is_even;  ///< whether the others keep their cyclic order

  Point<2> operator()(const Point<3>& p) const {
    const double x = p[static_cast<std::size_t>((axis + 1) % 3)],
                 y = p[static_cast<std::size_t>((axis + 2) % 3)];
    return is_even ? Point<2>{x, y} : Point<2>{y, x};
  }
};
Flat_view flat_view(std::span<const Point<3>> points, const Lone_facet<3>& facet);

struct Side_crossing {
  Point<3> point;  ///< rounded down
  bool is_exact;
};

/// \pre the segments pq and rs lie in a plane, the ends of each strictly on different sides of the other one
Side_crossing crossing_of(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);

/// Adds the points where sides of the facets of a pair cross to both sides.
/// \param points receives those that are new
/// \param tolerance 0: exact. Otherwise sides that pass each other within this distance cross as well, and
///        the crossings are rounded
/// \throw Error(not_certified) if there is no tolerance, and doubles cannot represent a crossing
void add_crossings(std::vector<Point<3>>& points, std::span<const Lone_facet<3>> facets,
                   std::span<const Facet_pair> pairs, double tolerance, Sides<3>& sides);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_CROSSINGS_H
