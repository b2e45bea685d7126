// SPDX-License-Identifier: LGPL-3.0-or-later
// Random cells of a grid that do not touch each other.
#ifndef CELLWALK_GENERATORS_APART_H
#define CELLWALK_GENERATORS_APART_H

#include <cellwalk/internal/kernel/random.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// The most cells of a grid that can lie apart: one in two along each axis.
template <int D>
std::uint64_t most_cells_apart(const std::array<std::uint32_t, D>& cells);

/// Indices of `count` cells no two of which share a vertex, ascending.
/// \pre count <= most_cells_apart(cells)
template <int D>
std::vector<std::uint32_t> cells_apart(const std::array<std::uint32_t, D>& cells, std::uint64_t count,
                                       Random& random);

}  // namespace cellwalk::detail

#endif  // CELLWALK_GENERATORS_APART_H
