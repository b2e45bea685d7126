// SPDX-License-Identifier: LGPL-3.0-or-later
// The inside of a smooth shape given by a function, as well-shaped tetrahedra: isosurface stuffing (Labelle and
// Shewchuk 2007) with cells of one size.
#ifndef CELLWALK_ENVIRONMENT_GENERATE_IMPLICIT_H
#define CELLWALK_ENVIRONMENT_GENERATE_IMPLICIT_H

#include <cellwalk/records/cell_soup.h>

#include <functional>

namespace cellwalk {

/// A shape and the lattice it is cut from.
struct Implicit_shape {
  /// Positive inside, negative outside, continuous; ideally the distance to the surface.
  std::function<double(const Point<3>&)> depth;
  Point<3> low{}, high{};  ///< a box that holds the shape
  double cell_size = 1;    ///< edge of the lattice's cubes; a tetrahedron has about a twelfth of a cube
};

/// Fills a shape with tetrahedra. Lattice points close to the surface are moved onto it, the other tetrahedra that it
/// cuts are cut; all are exactly positive and conform. Details below about two cells are lost, or leave holes.
/// \pre depth gives the same values on every machine (no more than + - * / and sqrt), if the bytes are to be the same
/// \throw Error(usage) if the size is not positive, the lattice has more than 10^9 points, or the shape is empty
/// Cost: two evaluations of depth for each cube of the box, and about five for each lattice edge that the surface cuts.
Cell_soup<3> fill_implicit(const Implicit_shape& shape);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_GENERATE_IMPLICIT_H
