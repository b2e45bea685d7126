// SPDX-License-Identifier: LGPL-3.0-or-later
// Well-shaped tetrahedra that fill a smooth shape given by a function: isosurface stuffing (Labelle and
// Shewchuk 2007) with cells of one size.
#ifndef CELLWALK_INTERNAL_GENERATORS_IMPLICIT_H
#define CELLWALK_INTERNAL_GENERATORS_IMPLICIT_H

#include <cellwalk/records/cell_soup.h>

#include <functional>

namespace cellwalk {

/// A shape and the lattice from which it is cut.
struct Implicit_shape {
  /// Positive inside, negative outside, continuous; ideally the distance to the surface.
  std::function<double(const Point<3>&)> depth;
  Point<3> low{}, high{};  ///< a box that contains the shape
  double cell_size = 1;    ///< edge of the lattice's cubes; a tetrahedron has about a twelfth of a cube
  /// If not 0, the outside up to this distance is filled with solid cells: tissue around the shape. At least
  /// 1.25 cell sizes; depth is then the distance to the surface, or nearly so, that far.
  double tissue = 0;
};

/// Fills a shape with tetrahedra. Lattice points close to the surface are snapped to it; other tetrahedra
/// that it intersects are cut. The result is conforming, and all tetrahedra are exactly positive. Details
/// smaller than about two cells are lost, or leave holes. With tissue, the surface of the shape consists of
/// inner facets, and the boundary of the complex lies at the other depth.
/// \pre for equal bytes on all machines, depth gives equal values on all of them (only + - * / and sqrt)
/// \throw Error(usage) if the size is not positive, the tissue is neither 0 nor at least 1.25 cell sizes,
///        both its surfaces cut one tetrahedron of the lattice, the lattice has more than 10^9 points, or
///        the shape is empty
/// Cost: two evaluations of depth for each cube of the box, and about five for each lattice edge that the
/// surface cuts.
Cell_soup<3> fill_implicit(const Implicit_shape& shape);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_GENERATORS_IMPLICIT_H
