// SPDX-License-Identifier: GPL-3.0-or-later
// A plain interface of TetGen.
#ifndef CELLWALK_MESHING_FILL_TETGEN_CALL_H
#define CELLWALK_MESHING_FILL_TETGEN_CALL_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "feature_names.h"

namespace cellwalk::detail {

/// The tetrahedra inside the hull of the surfaces, which conform to them.
struct Tetgen_result {
  std::vector<Point<3>> points;  ///< those of the surfaces in order, then added ones
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::vector<std::array<std::int32_t, 4>> neighbours;  ///< across the facet opposite each vertex; -1 outside
  int scale = 0;  ///< the exponent by which TetGen's size was multiplied
};

/// Takes a mesh, or refuses it by an Error(not_certified).
using Accept_mesh = std::function<void(const Tetgen_result&)>;

/// Runs TetGen on surfaces that do not meet: with its own tolerance and, while it fails or makes a mesh that
/// is not accepted, with finer ones, which move nothing either.
/// \return the tolerance that was necessary: empty if TetGen's own one was right
/// \throw Error(usage) as run_helper(); Error(not_certified) if no mesh is accepted: the first reason, and
///        where the surfaces are narrowest
std::string mesh_by_tetgen(const std::vector<Surface_soup>& surfaces, const Feature_names& names,
                           const Tetrahedralize_options& options, const Accept_mesh& accept);

/// True for the error of a TetGen that did not end within its limit of time.
bool ran_out_of_time(const Error& error);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_TETGEN_CALL_H
