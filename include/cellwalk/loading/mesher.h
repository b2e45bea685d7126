// SPDX-License-Identifier: LGPL-3.0-or-later
// The optional meshing component, chosen at run time. Builds without it have mesher_absent.cpp instead.
#ifndef CELLWALK_LOADING_MESHER_H
#define CELLWALK_LOADING_MESHER_H

#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cellwalk {

enum class Mesher { tetgen, mesh3 };

struct Mesher_options {
  Mesher mesher = Mesher::tetgen;
  double quality = 0;    ///< TetGen: radius-edge ratio; 0: as few tetrahedra as possible
  double cell_size = 0;  ///< Mesh_3: units of the surface; 0: its default
  double distance = 0;   ///< Mesh_3: how far the boundary may leave the surface; 0: its default
  bool keep_obstacles = false;
  std::vector<std::string>
      obstacle_names{};  ///< what messages call the obstacles; left out: "obstacle 1", ...
};

/// Cells, and what was done to get them: lines for people, and JSON.
template <int D>
struct Meshed {
  Cell_soup<D> soup;
  std::vector<std::string> lines;
  nlohmann::ordered_json report;
};

/// What this build has.
struct Mesher_parts {
  bool meshing = false, tetgen = false;
};
Mesher_parts mesher_parts();

/// The inside of a closed surface, less the obstacles.
/// \throw Error as the meshers do; Error(usage) in a build without them
Meshed<3> mesh_surface(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                       const Mesher_options& options);

/// A planar domain as triangles. \throw Error as triangulate does; Error(usage) in a build without meshing
Meshed<2> mesh_domain(const Planar_domain& domain, const Mesher_options& options);

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_MESHER_H
