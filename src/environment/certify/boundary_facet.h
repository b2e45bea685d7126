// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets of the boundary, and exact tests of facets in their planes. Internal to certification.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_FACET_H
#define CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_FACET_H

#include <cstdint>
#include <span>
#include <vector>

#include "complex.h"

namespace cellwalk::detail {

/// The vertices of a facet, by index.
using Facet_loop = std::vector<std::uint32_t>;

template <int D>
struct Boundary_facet {
  Half_facet facet;
  Plane_points<D> plane;
  Facet_loop loop;
};

template <int D>
Facet_loop loop_of(const Cell_view<D>& cell, std::size_t facet) {
  Facet_loop loop;
  for (const std::uint16_t v : cell.loop(facet)) loop.push_back(cell.point_index(v));
  return loop;
}

/// True if a facet of a cell lies in the plane of a facet.
template <int D>
bool lies_in_plane(Predicate_counts& counts, std::span<const Point<D>> points, const Boundary_facet<D>& facet,
                   const Facet_loop& loop);

/// True if the interiors of a facet and of one in its plane have a point in common.
/// \param is_opposite whether the sides of the two are opposite, and so their directions
template <int D>
bool overlap_in_plane(Predicate_counts& counts, std::span<const Point<D>> points,
                      const Boundary_facet<D>& facet, const Facet_loop& loop, bool is_opposite);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_FACET_H
