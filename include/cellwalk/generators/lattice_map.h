// SPDX-License-Identifier: LGPL-3.0-or-later
// The placement of an integer lattice by generators, such that lattice planes stay exactly planar.
#ifndef CELLWALK_GENERATORS_LATTICE_MAP_H
#define CELLWALK_GENERATORS_LATTICE_MAP_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>

namespace cellwalk {

/// The affine map k -> origin + sum of k[i] * columns[i] of lattice points. The default is the identity.
template <int D>
struct Lattice_map {
  std::array<Vector<D>, D> columns = identity();
  Point<D> origin{};

  static constexpr std::array<Vector<D>, D> identity() {
    std::array<Vector<D>, D> c{};
    for (int i = 0; i < D; ++i) c[i][i] = 1;
    return c;
  }

  /// The image of a lattice point; each coordinate is summed from the origin in the order of the columns.
  Point<D> operator()(const Point<D>& k) const {
    Point<D> p = origin;
    for (int i = 0; i < D; ++i)
      for (int row = 0; row < D; ++row) p[row] += k[i] * columns[i][row];
    return p;
  }
};

/// Every axis times `scale`.
template <int D>
Lattice_map<D> scaled(double scale);

/// A rotation times 3 `scale` (3D: columns (1,2,2), (2,-2,1), (2,1,-2)) or times 5 `scale` (2D: columns
/// (3,4), (-4,3)). No lattice plane is parallel to an axis plane, and lattice points have integer images for
/// scale 1.
template <int D>
Lattice_map<D> rotated(double scale = 1);

/// A shear times `scale`: axis 0 is unchanged, every further axis i is sheared along axis i-1 by half a cell.
template <int D>
Lattice_map<D> sheared(double scale = 1);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_LATTICE_MAP_H
