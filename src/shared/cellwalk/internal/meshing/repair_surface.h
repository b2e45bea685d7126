// SPDX-License-Identifier: GPL-3.0-or-later
// Environments of surfaces that are open, cross themselves, or are not manifold. The interpretation of a
// surface is repaired, not its shape: its triangles become facets of a mesh of a larger box, and a region
// that they bound is free if the surface winds around it.
#ifndef CELLWALK_INTERNAL_MESHING_REPAIR_SURFACE_H
#define CELLWALK_INTERNAL_MESHING_REPAIR_SURFACE_H

#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk {

/// A change of the surface, or an observation that decides about the free space.
struct Repair_change {
  std::string step;              ///< a key such as "joined"
  std::string text;              ///< in words
  std::size_t count = 0;         ///< how many there are
  std::vector<Point<3>> places;  ///< of the first hundred
  double measured = 0;           ///< the largest distance moved, as a part of the size; 0: nothing moves
};

/// A part of the walls that is not in the file: a cap over a hole, the mouth of a lumen, or a sheet inside.
struct Repaired_part {
  std::string name;        ///< of its group: "cap_1", "mouth_1", "sheet_1"; by descending area
  std::size_t edges = 0;   ///< of its border; 0 for sheets
  std::size_t facets = 0;  ///< triangles in the result
  Point<3> centre{};
  Vector<3> normal{};  ///< the mean one, out of the free space
  double area = 0;
  double width = 0;      ///< the diameter of the disc of the same area
  double off_plane = 0;  ///< the largest distance of the border from its plane
  /// Caps: the volume between it and the cone from its centre to its border: how far the volume depends on
  /// the choice of the cap
  double doubt = 0;
};

struct Repair_report {
  std::vector<Repair_change> changes;  ///< in the order of the steps
  std::vector<Repaired_part> parts;    ///< caps, mouths, sheets
  double size = 0;                     ///< the diagonal of the surface
  double volume = 0;                   ///< of the free space
  double winding_error = 0;            ///< the largest distance of a region's winding number from an integer
  double moved = 0;       ///< the largest distance of the walls from the surface; a part of the size
  std::size_t walls = 0;  ///< triangles
  std::size_t added_points = 0;
  std::size_t out_of_bounds = 0;  ///< tetrahedra that violate the bounds of quality and size
  std::string tolerance;          ///< see Tetrahedralize_report
};

struct Repaired_surface {
  Cell_soup<3> soup;
  Soup_groups groups;  ///< the facets of each part
};

/// A point in the lumen that a closed surface surrounds as a thick wall, if it is one: its inside is the
/// material then.
/// \pre the surface is as check_surface() returns it
/// Cost: 0.1 s, 0.5 s if it is one.
std::optional<Point<3>> lumen_around(const Surface_soup& surface);

/// Fills the space that a surface encloses, or the lumen of a thick wall, with tetrahedra. Every triangle of
/// the surface that bounds the space is a wall, up to the changes reported.
/// \param surface of any polygons
/// \param options what is free, and the bounds of changes
/// \param mesh bounds of the tetrahedra, without obstacles
/// \param report of all changes
/// \throw Error(input) for a surface that is malformed, encloses nothing, leaks, crosses itself after all
///        rounds of cuts, or whose walls would move farther than allowed; with a place and a remedy
/// \throw Error(usage) for options out of range, or if there is no TetGen
/// \throw Error(not_certified) as tetrahedralize()
/// Cost: 130 us a triangle for 10^5 of them, 290 us for 10^6; two thirds are TetGen's.
Repaired_surface repair_surface(const Surface_soup& surface, const Repair_options& options,
                                const Tetrahedralize_options& mesh, Repair_report& report);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_MESHING_REPAIR_SURFACE_H
