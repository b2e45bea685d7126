// SPDX-License-Identifier: LGPL-3.0-or-later
// Deformable bodies in free flight, by shape matching. Theory: docs/deformation.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_DEFORMABLE_H
#define CELLWALK_INTERNAL_SIMULATION_DEFORMABLE_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/material.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/rigid_body.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/internal/simulation/shape_matching.h>

#include <span>
#include <vector>

namespace cellwalk {

/// A body whose vertices have equal masses and individual velocities. Its initial shape is its rest shape.
///
/// A step predicts the position of each vertex, draws it towards its goal (Shape_matching) according to the
/// stiffness, and moves it there as far as walls allow (Body::step). Velocities follow from the new
/// positions. Contacts reverse the velocity against the wall (restitution) and reduce the velocity along it
/// (friction); the stiff part of the response applies to the whole body. A body that meets a wall no faster
/// than it falls in two steps does not bounce, so bodies come to rest.
///
/// Energy is bounded. Up to rounding, energy() never exceeds its initial value, unless a wall lifts the body
/// while its shape recovers; without gravity kinetic_energy() never does. The energy absorbed by contacts is
/// lost; the energy stored in a deformation can be released, and decays with the deformation.
///
/// All state belongs to the body: bodies can be advanced in any order, or in parallel, with the same bits.
template <int D>
class Deformable {
 public:
  /// A body thrown from its current position; it rotates about its centre.
  /// \pre it has a vertex; velocity and spin are finite
  Deformable(Body<D> body, const Shape_material& material, const Vector<D>& velocity,
             const Spin<D>& spin = {});

  /// Advances by one time step. Contacts are appended.
  /// \throw Error(input) naming the first vertex whose motion is not finite, and as Body::step
  /// Cost: that of Shape_matching::goals and of Body::step.
  void step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts);

  Body<D>& body() { return body_; }
  const Body<D>& body() const { return body_; }
  /// The targets of the vertices in the last step.
  std::span<const Point<D>> targets() const { return targets_; }
  /// The velocity of the centre of the vertices.
  Vector<D> velocity() const;
  std::span<const Vector<D>> velocities() const { return velocities_; }
  /// Always false: the body has no path.
  bool has_arrived() const { return false; }

  /// The kinetic energy, for vertices of mass 1.
  double kinetic_energy() const;
  /// The kinetic and potential energy under the given gravity; the potential is 0 at the origin.
  double energy(const Vector<D>& gravity) const { return kinetic_energy() + height_energy(gravity); }

 private:
  double height_energy(const Vector<D>& gravity) const;
  void predict(double dt);
  void limit(double most);

  Body<D> body_;
  Shape_matching<D> matching_;
  std::vector<Vector<D>> velocities_;
  std::vector<Point<D>> moved_, targets_;
  /// The bound of the kinetic energy, including the energy stored in the deformation.
  double stored_ = 0;

  friend detail::State_access<D>;
};

extern template class Deformable<2>;
extern template class Deformable<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_DEFORMABLE_H
