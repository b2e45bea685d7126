// SPDX-License-Identifier: LGPL-3.0-or-later
// The optional meshing component. Builds without it have mesher_absent.cpp instead.
#ifndef CELLWALK_INTERNAL_LOADING_MESHER_H
#define CELLWALK_INTERNAL_LOADING_MESHER_H

#include <cellwalk/loading/environment_file.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cellwalk {

/// Cells, and the report of meshing, as text and as JSON.
template <int D>
struct Meshed {
  Cell_soup<D> soup;
  std::vector<std::string> lines;
  nlohmann::ordered_json report;
  std::vector<std::string> repairs{};  ///< of an imperfect surface, as lines
  nlohmann::ordered_json repaired{};   ///< the same for programs
  Soup_groups groups{};                ///< caps, mouths and sheets
};

/// The meshers of this build.
struct Mesher_parts {
  bool meshing = false, tetgen = false;
};
Mesher_parts mesher_parts();

/// The name of an option that has an effect only where a surface is repaired, if it is not at its default.
const char* option_of_repair(const Repair_options& options);

/// Fills the interior of a closed surface, without the obstacles. A surface that is not closed and manifold,
/// or that TetGen fails with, is repaired if it has no obstacles.
/// \throw Error as the meshers; Error(usage) for options of the other mesher, and in a build without them
Meshed<3> mesh_surface(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                       const Mesher_options& options);

/// Surrounds cells by solid ones, see surround_by_tissue(), with the quality of the options. The report is
/// about the tissue only.
/// \throw Error as surround_by_tissue(); Error(usage) in a build without TetGen
Meshed<3> add_tissue(Cell_soup<3> cells, double thickness, const Mesher_options& options);

/// Triangulates a planar domain.
/// \throw Error as triangulate(); Error(usage) in a build without meshing
Meshed<2> mesh_domain(const Planar_domain& domain, const Mesher_options& options);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_LOADING_MESHER_H
