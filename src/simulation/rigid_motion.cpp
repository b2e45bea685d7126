// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rigid_motion.h"

namespace cellwalk::detail {

template <int D>
Rigid_frame<D>::Rigid_frame(std::span<const Point<D>> positions) : mass_(static_cast<double>(positions.size())) {
  Vector<D> sum{};
  for (const Point<D>& x : positions) sum = sum + (x - positions[0]);
  center_ = positions[0] + (1 / mass_) * sum;
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
Rigid_motion<D> Rigid_frame<D>::motion_of(std::span<const Point<D>> positions,
                                          std::span<const Vector<D>> velocities) const {
  Vector<D> sum{};
  Spin<D> momentum{};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sum = sum + velocities[i];
    momentum = momentum + moment(arm(positions[i]), velocities[i]);
  }
  return {(1 / mass_) * sum, spin_of(momentum)};
}

template <int D>
Rigid_motion<D> Rigid_frame<D>::answer(const Vector<D>& arm, const Vector<D>& impulse) const {
  return {(1 / mass_) * impulse, spin_of(moment(arm, impulse))};
}

template class Rigid_frame<2>;
template class Rigid_frame<3>;

}  // namespace cellwalk::detail
