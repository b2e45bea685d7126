// SPDX-License-Identifier: LGPL-3.0-or-later
// The shape of a cell of one facet.
#ifndef CELLWALK_TESTS_EDGE_FACET_SHAPE_H
#define CELLWALK_TESTS_EDGE_FACET_SHAPE_H

#include <cellwalk/environment/snapshot.h>

#include <cstddef>
#include <cstdint>
#include <numeric>

namespace cellwalk::test {

/// A facet whose loop has its vertices in order.
inline Cell_shape facet_shape(std::size_t corners) {
  Cell_shape shape;
  shape.vertex_count = static_cast<std::uint16_t>(corners);
  shape.loops.resize(corners);
  std::iota(shape.loops.begin(), shape.loops.end(), std::uint16_t{0});
  shape.loop_begin.push_back(shape.vertex_count);
  return shape;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FACET_SHAPE_H
