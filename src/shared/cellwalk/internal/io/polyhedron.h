// SPDX-License-Identifier: LGPL-3.0-or-later
// The orientation of the facets of one polyhedron, which files and arrays may give in any orientation.
#ifndef CELLWALK_INTERNAL_IO_POLYHEDRON_H
#define CELLWALK_INTERNAL_IO_POLYHEDRON_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::io {

/// Reverses loops so that every edge is used once in each direction, and the volume (rounded) is positive.
/// Loops that already agree with each other, or cannot be made to, are left unchanged; certification decides
/// about them. Returns true if a loop was reversed.
bool turn_alike(std::vector<std::vector<std::uint32_t>>& loops, const std::vector<Point<3>>& points);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_POLYHEDRON_H
