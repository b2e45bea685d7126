// SPDX-License-Identifier: LGPL-3.0-or-later
// Which half-facets of a cell soup are the two sides of one facet.
#ifndef CELLWALK_ENVIRONMENT_GLUING_H
#define CELLWALK_ENVIRONMENT_GLUING_H

#include <cstdint>
#include <vector>

#include <cellwalk/records/cell_soup.h>

namespace cellwalk {

inline constexpr std::uint32_t no_facet = 0xffffffffu;

/// opposite[f] is the half-facet of the neighbouring cell with the same vertices in opposite order, or
/// no_facet on the boundary. An involution without fixed points elsewhere.
struct Gluing {
  std::vector<std::uint32_t> opposite;
};

/// Matches the half-facets of a soup by their vertex sets.
/// \pre every vertex index is smaller than soup.points.size()
/// \throw Error(input) where a vertex index is out of range, a loop has fewer than D vertices or a vertex
/// twice \throw Error(not_certified) where three or more cells share a facet, two cells lie on the same side
/// of one
///        (same order of the loop), or two facets share all vertices in different cyclic order; names the
///        cells
/// Cost: linear (hashing); about 0.3 us a half-facet.
template <int D>
Gluing glue(const Cell_soup<D>& soup);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_GLUING_H
