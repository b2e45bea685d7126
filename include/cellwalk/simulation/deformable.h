// SPDX-License-Identifier: LGPL-3.0-or-later
// Deformable bodies in free flight: shape matching draws the vertices together, walls hold them back.
#ifndef CELLWALK_SIMULATION_DEFORMABLE_H
#define CELLWALK_SIMULATION_DEFORMABLE_H

#include <cellwalk/body/body.h>
#include <cellwalk/records/material.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/flight.h>
#include <cellwalk/simulation/shape_matching.h>

#include <span>
#include <vector>

namespace cellwalk {

/// A body whose vertices have velocities of their own, all of the same mass. What it is when it is made is its rest shape.
///
/// A step predicts where each vertex would be, draws it towards its goal (Shape_matching) as far as the material is stiff,
/// and moves it there as far as walls allow (Body::step). Velocities come from the positions so found; contacts turn the part
/// against the wall round (restitution) and take from the part along it (friction), of the whole body as far as it is stiff.
/// A body that meets a wall no faster than it falls in two steps does not bounce, so that bodies come to rest.
///
/// Energy is bounded. energy() never rises above what it was at the start, but for rounding, as long as walls do not lift the
/// body while it finds back to its shape; kinetic_energy() without gravity never does. What a contact takes away is gone; what
/// a deformation stores can come back, and fades by the stiffness in each step as deformations do.
///
/// All state belongs to the body: bodies can be advanced in any order, or at once, with the same bits.
template <int D>
class Deformable {
 public:
  /// A body thrown from where it stands; it turns about its middle. \pre it has a vertex; velocity and spin are finite
  Deformable(Body<D> body, const Shape_material& material, const Vector<D>& velocity,
             const Spin<D>& spin = {});

  /// Advances by one time step. Contacts are appended. A body whose motion is not finite stays where it is, and loses its
  /// velocity. Cost: that of Shape_matching::goals and of Body::step.
  void step(const Flight_conditions<D>& conditions, Step_report<D>& report, Body_counts& counts);

  Body<D>& body() { return body_; }
  const Body<D>& body() const { return body_; }
  /// Where the vertices went in the last step, walls or not.
  std::span<const Point<D>> targets() const { return targets_; }
  /// Of the middle of the vertices.
  Vector<D> velocity() const;
  std::span<const Vector<D>> velocities() const { return velocities_; }
  /// It has no path.
  bool has_arrived() const { return false; }

  /// Of vertices of mass 1.
  double kinetic_energy() const;
  /// Kinetic and potential energy under this gravity; the potential is 0 at the origin.
  double energy(const Vector<D>& gravity) const { return kinetic_energy() + height_energy(gravity); }

 private:
  double height_energy(const Vector<D>& gravity) const;
  bool predict(double dt);
  void limit(double most);

  Body<D> body_;
  Shape_matching<D> matching_;
  std::vector<Vector<D>> velocities_;
  std::vector<Point<D>> moved_, targets_;
  /// Kinetic energy may come back up to here: from what is stored in the deformation.
  double stored_ = 0;
};

extern template class Deformable<2>;
extern template class Deformable<3>;

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_DEFORMABLE_H
