// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of extreme size, which meshers get at a size near 1: products of coordinates would leave the range
// of doubles. The factor is a power of two, so that nothing is rounded.
#ifndef CELLWALK_MESHING_FILL_SCALE_H
#define CELLWALK_MESHING_FILL_SCALE_H

#include <cellwalk/records/surface_soup.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cellwalk::detail {

/// The exponent of the largest coordinate.
inline int exponent_of(const std::vector<Surface_soup>& surfaces) {
  double largest = 0;
  for (const Surface_soup& s : surfaces)
    for (const Point<3>& p : s.points)
      for (const double x : p) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

/// The point times a power of two.
inline Point<3> scaled(Point<3> p, int exponent) {
  for (double& x : p) x = std::ldexp(x, exponent);
  return p;
}

/// The exponent of the factor that a mesher's surfaces are multiplied by: 0 unless they are of extreme size.
/// Predicates of meshers multiply up to five differences of coordinates, exactly, which takes five times the
/// exponent and five times 53 bits below it: from 2^-150 to 2^150 this fits into the range of doubles.
inline int scale_of(const std::vector<Surface_soup>& surfaces) {
  constexpr int largest_exponent = 150;
  const int exponent = exponent_of(surfaces);
  if (std::abs(exponent) <= largest_exponent) return 0;
  // Where a coordinate would lose bits, the surface stays as it is.
  for (const Surface_soup& s : surfaces)
    for (const Point<3>& p : s.points)
      if (scaled(scaled(p, -exponent), exponent) != p) return 0;
  return -exponent;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_SCALE_H
