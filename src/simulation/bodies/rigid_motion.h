// SPDX-License-Identifier: LGPL-3.0-or-later
// The rigid part of the motion of a body whose vertices have mass 1 each.
#ifndef CELLWALK_SIMULATION_BODIES_RIGID_MOTION_H
#define CELLWALK_SIMULATION_BODIES_RIGID_MOTION_H

#include <cellwalk/internal/records/scene.h>
#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <span>

#include "small_matrix.h"

namespace cellwalk::detail {

inline Spin<2> moment(const Vector<2>& arm, const Vector<2>& v) { return {arm[0] * v[1] - arm[1] * v[0]}; }
inline Spin<3> moment(const Vector<3>& arm, const Vector<3>& v) { return cross(arm, v); }
inline Vector<2> turning(const Spin<2>& spin, const Vector<2>& arm) {
  return {-spin[0] * arm[1], spin[0] * arm[0]};
}
inline Vector<3> turning(const Spin<3>& spin, const Vector<3>& arm) { return cross(spin, arm); }

template <int D>
struct Rigid_motion {
  Vector<D> velocity{};  ///< of the centre
  Spin<D> spin{};
  /// At a place, given from the centre.
  Vector<D> at(const Vector<D>& arm) const { return velocity + turning(spin, arm); }
};

/// The rotation by an angle about an axis: the length and direction of a vector.
template <int D>
class Axis_rotation {
 public:
  explicit Axis_rotation(const Spin<D>& angle);
  Vector<D> operator()(const Vector<D>& v) const {
    Vector<D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = dot(matrix_[i], v);
    return result;
  }

 private:
  Matrix<D> matrix_;
};

template <>
Axis_rotation<2>::Axis_rotation(const Spin<2>& angle);
template <>
Axis_rotation<3>::Axis_rotation(const Spin<3>& angle);

/// Centre and inertia of vertices where they stand. Where these are flat, straight or one point, turns that
/// move none of them have no inertia, and nothing turns that way.
template <int D>
class Rigid_frame {
 public:
  explicit Rigid_frame(std::span<const Point<D>> positions);

  const Point<D>& centre() const { return centre_; }
  Vector<D> arm(const Point<D>& x) const { return x - centre_; }
  /// The angular momentum about the centre.
  Spin<D> momentum_of(std::span<const Point<D>> positions, std::span<const Vector<D>> velocities) const;
  /// The spin with this angular momentum.
  Spin<D> spin_of(const Spin<D>& momentum) const;
  /// The rigid motion nearest to these velocities, in the sense of energy: it has their momenta.
  Rigid_motion<D> motion_of(std::span<const Point<D>> positions, std::span<const Vector<D>> velocities) const;
  /// How the body starts to move when it is hit at a place.
  Rigid_motion<D> answer(const Vector<D>& arm, const Vector<D>& impulse) const;

 private:
  Point<D> centre_{};
  double mass_ = 0;
  Matrix<D == 2 ? 1 : 3> inverse_inertia_{};
};

extern template class Rigid_frame<2>;
extern template class Rigid_frame<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_RIGID_MOTION_H
