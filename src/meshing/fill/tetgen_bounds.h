// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of quality and size that TetGen is given.
#ifndef CELLWALK_MESHING_FILL_TETGEN_BOUNDS_H
#define CELLWALK_MESHING_FILL_TETGEN_BOUNDS_H

#include <cellwalk/meshing/tetrahedralize.h>

#include <array>
#include <cstdint>

#include "tetgen_call.h"

namespace cellwalk::detail {

/// \throw Error(usage) for bounds out of range
void check_bounds(const Tetrahedralize_options& options);

/// \throw Error(usage) for a cell size that fills a volume with too many tetrahedra
/// \pre the cell size is not 0
void check_size(const Tetrahedralize_options& options, double volume);

/// True if a tetrahedron violates the bounds of quality and size, up to rounding.
bool is_out_of_bounds(const Tetgen_result& mesh, const std::array<std::uint32_t, 4>& t,
                      const Tetrahedralize_options& options);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_TETGEN_BOUNDS_H
