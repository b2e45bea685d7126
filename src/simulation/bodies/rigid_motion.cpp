// SPDX-License-Identifier: LGPL-3.0-or-later
// Momenta, spins and axis rotations about the centre of mass.
#include "rigid_motion.h"

#include <cmath>

namespace cellwalk::detail {

template <>
Axis_rotation<2>::Axis_rotation(const Spin<2>& angle) {
  const double c = std::cos(angle[0]), s = std::sin(angle[0]);
  matrix_ = {{{c, -s}, {s, c}}};
}

/// Rodrigues' formula.
template <>
Axis_rotation<3>::Axis_rotation(const Spin<3>& angle) : matrix_(identity<3>()) {
  const double degree = length(angle);
  if (!(degree > 0)) return;
  const Vector<3> axis = (1 / degree) * angle;
  const double c = std::cos(degree), s = std::sin(degree);
  for (std::size_t i = 0; i < 3; ++i) {
    Vector<3> unit{};
    unit[i] = 1;
    const Vector<3> column = c * unit + s * cross(axis, unit) + ((1 - c) * axis[i]) * axis;
    for (std::size_t j = 0; j < 3; ++j) matrix_[j][i] = column[j];
  }
}

template <int D>
Rigid_frame<D>::Rigid_frame(std::span<const Point<D>> positions)
    : mass_(static_cast<double>(positions.size())) {
  Vector<D> sum{};
  for (const Point<D>& x : positions) sum = sum + (x - positions[0]);
  centre_ = positions[0] + (1 / mass_) * sum;
  if constexpr (D == 2) {
    double inertia = 0;
    for (const Point<D>& x : positions) inertia += dot(arm(x), arm(x));
    inverse_inertia_[0][0] = inertia > 0 ? 1 / inertia : 0;
  } else {
    Matrix<3> inertia{};
    for (const Point<D>& x : positions) {
      const Vector<3> r = arm(x);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) inertia[i][j] += (i == j ? dot(r, r) : 0) - r[i] * r[j];
    }
    inverse_inertia_ = pseudo_inverse<3>(inertia).matrix;
  }
}

template <int D>
Spin<D> Rigid_frame<D>::spin_of(const Spin<D>& momentum) const {
  Spin<D> spin{};
  for (std::size_t i = 0; i < spin.size(); ++i) spin[i] = dot(inverse_inertia_[i], momentum);
  return spin;
}

template <int D>
Spin<D> Rigid_frame<D>::momentum_of(std::span<const Point<D>> positions,
                                    std::span<const Vector<D>> velocities) const {
  Spin<D> momentum{};
  for (std::size_t i = 0; i < positions.size(); ++i)
    momentum = momentum + moment(arm(positions[i]), velocities[i]);
  return momentum;
}

template <int D>
Rigid_motion<D> Rigid_frame<D>::motion_of(std::span<const Point<D>> positions,
                                          std::span<const Vector<D>> velocities) const {
  Vector<D> sum{};
  for (const Vector<D>& v : velocities) sum = sum + v;
  return {(1 / mass_) * sum, spin_of(momentum_of(positions, velocities))};
}

template <int D>
Rigid_motion<D> Rigid_frame<D>::answer(const Vector<D>& arm, const Vector<D>& impulse) const {
  return {(1 / mass_) * impulse, spin_of(moment(arm, impulse))};
}

template class Rigid_frame<2>;
template class Rigid_frame<3>;

}  // namespace cellwalk::detail
