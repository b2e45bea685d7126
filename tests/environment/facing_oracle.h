// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary facets that overlap in a plane, by brute force in rationals.
#ifndef CELLWALK_TESTS_ENVIRONMENT_FACING_ORACLE_H
#define CELLWALK_TESTS_ENVIRONMENT_FACING_ORACLE_H

#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::test {

/// The cells of each pair of facets that no other cell shares, of two free cells, with opposite sides, in one
/// plane, and with interiors that have a point in common. In each pair and of all pairs, ascending.
/// \pre facets are planar convex polygons
template <int D>
std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<D>& soup);

extern template std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<2>&);
extern template std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<3>&);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_FACING_ORACLE_H
