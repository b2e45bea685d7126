// SPDX-License-Identifier: LGPL-3.0-or-later
// The optional meshing component. Builds without it have mesher_absent.cpp instead.
#ifndef CELLWALK_LOADING_MESHER_H
#define CELLWALK_LOADING_MESHER_H

#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk {

enum class Mesher { tetgen, mesh3 };

struct Mesher_options {
  Mesher mesher = Mesher::tetgen;
  /// TetGen: bound of circumradius to shortest edge; 0: none; not given: its default
  std::optional<double> quality{};
  /// Bound of circumradii (Mesh_3), or of volumes by that of a regular tetrahedron of this circumradius
  /// (TetGen), in units of the surface; 0: the default of Mesh_3, none for TetGen
  double cell_size = 0;
  double distance = 0;          ///< Mesh_3: maximal distance of the boundary from the surface; 0: its default
  bool keep_obstacles = false;  ///< not by Mesh_3
  /// Names of the obstacles in messages; default: "obstacle 1", ...
  std::vector<std::string> obstacle_names{};
  double time_limit = 600;  ///< seconds that TetGen or Mesh_3 may take in all, greater than 0
  /// Called at least every tenth of a second while TetGen or Mesh_3 runs. An exception that it throws ends
  /// the mesher and passes through.
  std::function<void()> on_wait{};
};

/// Cells, and the report of meshing, as text and as JSON.
template <int D>
struct Meshed {
  Cell_soup<D> soup;
  std::vector<std::string> lines;
  nlohmann::ordered_json report;
};

/// The meshers of this build.
struct Mesher_parts {
  bool meshing = false, tetgen = false;
};
Mesher_parts mesher_parts();

/// Fills the interior of a closed surface, without the obstacles.
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

#endif  // CELLWALK_LOADING_MESHER_H
