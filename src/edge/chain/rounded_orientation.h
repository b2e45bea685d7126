// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to edge: determinants in doubles, with a bound of their error, and with exact signs.
#ifndef CELLWALK_EDGE_CHAIN_ROUNDED_ORIENTATION_H
#define CELLWALK_EDGE_CHAIN_ROUNDED_ORIENTATION_H

#include <cellwalk/kernel/exact.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cellwalk::detail {

template <int D>
Vector<D> rounded_difference(const Point<D>& x, const Point<D>& y) {
  Vector<D> d;
  for (std::size_t k = 0; k < D; ++k) d[k] = x[k] - y[k];
  return d;
}

template <std::size_t D>
double largest_size(const std::array<double, D>& x) {
  double most = 0;
  for (const double c : x) most = std::max(most, std::abs(c));
  return most;
}

inline double rounded_det(const Vector<2>& x, const Vector<2>& y) { return x[0] * y[1] - x[1] * y[0]; }
inline double rounded_det(const Vector<3>& x, const Vector<3>& y, const Vector<3>& z) {
  return (x[1] * y[2] - x[2] * y[1]) * z[0] + (x[2] * y[0] - x[0] * y[2]) * z[1] +
         (x[0] * y[1] - x[1] * y[0]) * z[2];
}

/// By how much a determinant of rounded differences, of at most a size, may be in error; infinity if nothing
/// is certain.
///
/// In 3D it is a sum of six products of three differences. A term takes at most eight roundings to nearest
/// (three differences, two products, three sums), so with u = 2^-53 and all differences at most m, the error
/// is at most 6 * 8.1 u m^3 < 2^-47 m^3; in 2D it is at most 2 * 4.1 u m^2. Products below the least normal
/// double would have an error of their own.
template <int D>
double det_error(double size) {
  const double error = 0x1p-47 * (D == 3 ? size * size * size : size * size);
  return error > 0x1p-900 && error < 0x1p900 ? error : std::numeric_limits<double>::infinity();
}

/// The sign of a determinant, and bounds of its size.
struct Signed_size {
  int sign;
  double least, most;
};

/// The determinant of D points seen from p, which is their orientation after p.
/// Cost: some 50 operations, and an exact sign where they leave it open.
template <int D, class... Points>
Signed_size signed_orientation(const Point<D>& p, const Points&... x) {
  const double value = rounded_det(rounded_difference<D>(x, p)...),
               error = det_error<D>(std::max({largest_size(rounded_difference<D>(x, p))...})),
               size = std::abs(value);
  if (size > error) [[likely]]
    return {value > 0 ? 1 : -1, size - error, size + error};
  Predicate_counts uncounted;
  return {Exact::orientation(uncounted, p, x...), 0, size + error};
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_ROUNDED_ORIENTATION_H
