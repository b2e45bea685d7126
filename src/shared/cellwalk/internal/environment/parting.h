// SPDX-License-Identifier: LGPL-3.0-or-later
// Certificates that boundary facets do not meet while their corners stay in balls. Theory: docs/moving.md.
//
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_PARTING_H
#define CELLWALK_INTERNAL_ENVIRONMENT_PARTING_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cellwalk::detail {

/// The closed ball in which a vertex of the boundary stays.
template <int D>
struct Zone {
  Point<D> centre{};
  double radius = 0;

  /// True proves that a point lies in the ball.
  bool contains(const Point<D>& x) const;
};

/// A vertex of the boundary.
template <int D>
struct Zoned_corner {
  std::uint32_t name = 0;
  Zone<D> zone;
};

/// A vertex that goes along a segment.
template <int D>
struct Zoned_move {
  std::uint32_t vertex = 0;
  Point<D> from{}, to{};
};

/// The largest number of corners of the facets at a vertex for which all of them are parted from another one
/// at once.
inline constexpr std::size_t most_corners = 12;

/// A radius r, not negative, that parts two sets of corners: their hulls have no more in common than the hull
/// of their common corners, wherever the vertex is on its way or within r of its end, and each other
/// corner in its zone. So is each facet whose corners are in the first set. If none is found, -1. A larger
/// radius than `enough` is not searched. Of the room between the centres of zones, each side takes at most
/// half, so that the other one finds some.
/// \param low corners of facets at the vertex that moves, itself included, whose own zone is not read; not
///        more than most_corners
/// \param high the D corners of another facet
/// \param is_one_facet if true, `low` are the D corners of one facet, and more directions are tried
/// Cost: some 50 ns, and 30 ns for each further direction.
template <int D>
double parting_radius(std::span<const Zoned_corner<D>> low, std::span<const Zoned_corner<D>> high,
                      const Zoned_move<D>& move, double enough, bool is_one_facet);

extern template struct Zone<2>;
extern template struct Zone<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_PARTING_H
