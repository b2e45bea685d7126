// SPDX-License-Identifier: LGPL-3.0-or-later
// Lattice worlds: small complexes full of degeneracies, all of them exactly representable, for the
// oracle tests: membranes, solid and missing cells (pinched vertices and edges), cells of many shapes,
// cells with several coplanar facets, cells that share more than one facet, facets with collinear vertices.
#ifndef CELLWALK_INTERNAL_GENERATORS_LATTICE_WORLD_H
#define CELLWALK_INTERNAL_GENERATORS_LATTICE_WORLD_H

#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>

namespace cellwalk {

/// Options of a lattice world. All shares are probabilities in [0,1]; the seed determines the outcome.
template <int D>
struct Lattice_world_options {
  std::array<std::uint32_t, D> cells = Grid_options<D>::filled(4);  ///< lattice cubes along each axis
  std::uint64_t seed = 1;

  // The shapes of cells. The remaining cubes stay cubes. If a cube needs the square between it and the next
  // cube split into two triangles, the next cube has two coplanar facets there, so any mixture conforms.
  double box_share = 0;  ///< cubes that grow to a box of 2 to 8 cubes: coplanar facets, facets shared twice
  double simplex_share = 0;  ///< cubes split into 6 tetrahedra (2D: 2 triangles)
  double prism_share = 0;    ///< cubes split into 2 prisms (3D only)
  double star_share = 0;     ///< cubes split into pyramids around their centre (2D: 4 triangles)
  double merge_share = 0;    ///< rectangles of squares between the same two cells that become one facet with
                             ///< collinear vertices (3D only)

  // Obstacles.
  double membrane_share = 0;  ///< facets that are impassable
  double solid_share = 0;     ///< cells that are solid
  double removed_share = 0;   ///< missing cells: pinched vertices and edges
  /// Squares (2D: edges) of the lattice at which a slit of 1 to 3 squares along each axis begins, and half
  /// that share of the other facets. Vertices are duplicated, see open_slits(). Slits meet in corners,
  /// crosses and T's; they end in free space or at a wall.
  double slit_share = 0;

  Lattice_map<D> map{};  ///< scaled, rotated or sheared worlds
};

/// A world with all features except slits, so that no two of its points have equal coordinates.
template <int D>
Lattice_world_options<D> mixed_lattice_world(std::uint64_t seed);

/// Builds a lattice world. Cells follow the lattice's order; points are those in use. Coordinates are
/// multiples of 1/2 before the map (integers unless star_share > 0; of 1/8 inside slits). Boundary facets are
/// not marked, since they are impassable anyway.
/// \throw Error(usage) for a share outside [0,1], shares of shapes that sum to more than 1, or a map that
///        rounds
/// Cost: about 1 us a cell.
template <int D>
Cell_soup<D> lattice_world(const Lattice_world_options<D>& options);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_GENERATORS_LATTICE_WORLD_H
