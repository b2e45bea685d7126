// SPDX-License-Identifier: GPL-3.0-or-later
// A plain interface of TetGen.
#ifndef CELLWALK_MESHING_TETGEN_CALL_H
#define CELLWALK_MESHING_TETGEN_CALL_H

#include <cellwalk/meshing/tetrahedralize.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// The tetrahedra inside the hull of the surfaces, which conform to them.
struct Tetgen_result {
  std::vector<Point<3>> points;  ///< those of the surfaces in order, then added ones
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::vector<std::array<std::int32_t, 4>> neighbours;  ///< across the facet opposite each vertex; -1 outside
};

/// Runs TetGen on surfaces that do not meet.
/// \throw Error(usage) if the library was built without TetGen; Error(not_certified) if TetGen fails
Tetgen_result call_tetgen(const std::vector<Surface_soup>& surfaces, const Tetrahedralize_options& options);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_TETGEN_CALL_H
