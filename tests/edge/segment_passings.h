// SPDX-License-Identifier: LGPL-3.0-or-later
// When a segment whose end moves passes the vertices and edges of cells, in integers: for Moving_segment.
#ifndef CELLWALK_TESTS_EDGE_SEGMENT_PASSINGS_H
#define CELLWALK_TESTS_EDGE_SEGMENT_PASSINGS_H

#include <array>
#include <cstdint>
#include <vector>

#include "edge/integer_complex.h"

namespace cellwalk::oracle {

/// Where an affine function vanishes that has these values at 0 and 1, not the same.
Share root(const Big& at_0, const Big& at_1);

/// Adds where such a function vanishes within [0,1], if it has one root.
void add_root(std::vector<Share>& times, const Big& at_0, const Big& at_1);

/// Adds all times at which the segment from a + s (b - a) to q passes a vertex of a cell (2D) or an edge
/// (3D), or a vertex in the plane in which it moves. Those outside a proper triangle abq do not count; if it
/// is none, all lines through them do.
/// \param abq in integers, scaled by 2^extra_shift more than the complex
template <int D>
void add_passings(std::vector<Share>& times, const Integer_complex<D>& complex,
                  const std::vector<std::uint32_t>& cells, int extra_shift,
                  const std::array<std::array<Big, D>, 3>& abq);

extern template void add_passings<2>(std::vector<Share>&, const Integer_complex<2>&,
                                     const std::vector<std::uint32_t>&, int,
                                     const std::array<std::array<Big, 2>, 3>&);
extern template void add_passings<3>(std::vector<Share>&, const Integer_complex<3>&,
                                     const std::vector<std::uint32_t>&, int,
                                     const std::array<std::array<Big, 3>, 3>&);

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_EDGE_SEGMENT_PASSINGS_H
