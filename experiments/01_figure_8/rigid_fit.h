// SPDX-License-Identifier: LGPL-3.0-or-later
// The rotation of a body: what shape matching needs, in arithmetic that is the same on every machine (no
// function but the square root).
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_RIGID_FIT_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_RIGID_FIT_H

#include <cellwalk/internal/kernel/random.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>

namespace cellwalk::figure_8 {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// A point of the unit ball, uniform, never its centre.
inline Vector3 in_unit_ball(Random& random) {
  for (;;) {
    Vector3 x;
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = random.real(-1, 1);
    const double square = x.squaredNorm();
    if (square > 1e-6 && square <= 1) return x;
  }
}

/// The rotation of a quaternion of any length but zero.
inline Matrix3 rotation(double w, const Vector3& axis) {
  const double s = 2 / (w * w + axis.squaredNorm());
  Matrix3 cross;
  cross << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return Matrix3::Identity() + s * (w * cross + cross * cross);
}

/// A rotation, uniform.
inline Matrix3 random_rotation(Random& random) {
  for (;;) {
    const double w = random.real(-1, 1);
    const Vector3 axis = in_unit_ball(random);
    if (w * w + axis.squaredNorm() <= 1) return rotation(w, axis);
  }
}

/// The rotation nearest to a matrix (its polar factor, by Newton's iteration); `otherwise` where the matrix
/// is singular or turned inside out.
inline Matrix3 nearest_rotation(const Matrix3& matrix, const Matrix3& otherwise) {
  const double scale = std::sqrt(matrix.squaredNorm() / 3);
  if (!(scale > 0)) return otherwise;
  Matrix3 r = matrix / scale;
  constexpr double smallest_determinant = 1e-4;
  if (!(r.determinant() > smallest_determinant)) return otherwise;
  constexpr int iterations =
      12;  // each squares the error; eight reach rounding from the smallest determinant
  for (int i = 0; i < iterations; ++i) r = (0.5 * (r + r.inverse().transpose())).eval();
  return r;
}

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_RIGID_FIT_H
