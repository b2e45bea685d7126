// SPDX-License-Identifier: LGPL-3.0-or-later
// The families of methods. Which of them are built is in the CMakeLists.txt beside.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_FAMILIES_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_FAMILIES_H

#include <span>
#include <string>

#include "peer.h"

namespace cellwalk::figure_8 {

void add_bounds(const Grid_world& world, Peers& peers);  ///< reading and writing; a bound that knows the grid
void add_double_walks(const Grid_world& world, Peers& peers);  ///< walks in doubles: plain, and the library's
void add_double_regions(const Grid_world& world, Peers& peers);  ///< plain walks with boxes free of walls
void add_map_walk(const Grid_world& world, Peers& peers);  ///< the paper's: from dart to dart of the map
void add_cellwalk_peers(const Grid_world& world, Peers& peers);
void add_cgal_peers(const Grid_world& world, Peers& peers);
void add_embree_peers(const Grid_world& world, Peers& peers);
void add_fcl_peers(const Grid_world& world, Peers& peers);

/// A family of methods and the version of the library behind it.
struct Family {
  std::string name, version;
  Make_peers make;
};

/// All that were built, Bullet's loaded from its plug-ins.
/// \throw std::runtime_error if a plug-in cannot be loaded
std::vector<Family> families();

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_FAMILIES_H
