// SPDX-License-Identifier: LGPL-3.0-or-later
// The kinds of worlds and motions of the experiment.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_WORLDS_KINDS_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_WORLDS_KINDS_H

#include <array>
#include <cstdint>
#include <utility>

#include "walk/oracle_worlds.h"

namespace cellwalk::degenerate_worlds {

enum class World_kind {
  lattice,         ///< cubes, some of them solid
  coplanar_walls,  ///< boxes of several cubes: cells with several facets in one plane, facets shared twice
  membranes,       ///< walls with free space on both sides
  pinched,         ///< missing cells: vertices and edges whose cells are not all joined through facets
  collinear,       ///< facets with vertices inside their edges (2D: cells with several edges on one line)
  simplices        ///< cubes cut into simplices, pyramids and prisms
};
inline constexpr std::array<const char*, 6> world_names{"lattice", "coplanar_walls", "membranes",
                                                        "pinched", "collinear",      "simplices"};

/// Where the lattice lies: along the axes with integer coordinates, where even floats compute exactly; or
/// turned, each coordinate with 20 (3D) or 26 (2D) binary places.
inline constexpr std::array<const char*, 2> placement_names{"integer", "turned"};

/// Families of motions, made by the source of the oracle's tests.
inline constexpr std::array<std::pair<const char*, oracle::Motion_kind>, 9> motion_families{
    {{"along_edges", oracle::Motion_kind::along_edge},
     {"in_wall_planes", oracle::Motion_kind::in_wall_plane},
     {"through_vertices", oracle::Motion_kind::through_vertex},
     {"through_edges", oracle::Motion_kind::through_edge},
     {"through_facets", oracle::Motion_kind::through_facet},
     {"to_vertices", oracle::Motion_kind::to_vertex},
     {"to_edges", oracle::Motion_kind::to_edge},
     {"to_facets", oracle::Motion_kind::to_facet},
     {"to_walls", oracle::Motion_kind::to_wall}}};

template <int D>
Cell_soup<D> make_soup(World_kind kind, bool is_turned, std::uint64_t seed);

}  // namespace cellwalk::degenerate_worlds

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_WORLDS_KINDS_H
