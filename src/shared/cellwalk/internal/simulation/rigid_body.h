// SPDX-License-Identifier: LGPL-3.0-or-later
// Rigid bodies, thrown or guided along a path. Each vertex is drawn to its place in the rigid shape as far as
// walls allow.
#ifndef CELLWALK_INTERNAL_SIMULATION_RIGID_BODY_H
#define CELLWALK_INTERNAL_SIMULATION_RIGID_BODY_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/saved_parts.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk {

/// The dynamics common to all bodies of a scene.
template <int D>
struct Dynamics_options {
  double time_step = 0.01;
  Vector<D> gravity{};
  double restitution = 1;  ///< fraction of the normal speed that a body keeps, in [0,1]
  double friction = 0;     ///< fraction of the tangential speed that it loses, in [0,1]
  Body_options body;
};

/// A body with a rigid motion. Its shape is rigid as long as no wall is in the way; a vertex that a wall
/// holds back is drawn towards its place again in the next step.
template <int D>
class Rigid_body {
 public:
  /// A body thrown from its current position.
  Rigid_body(Body<D> body, const Vector<D>& velocity, const Spin<D>& spin);
  /// A guided body, with its origin at the first waypoint. It rotates about its origin.
  Rigid_body(Body<D> body, Guided_motion<D> guide, const Spin<D>& spin = {});

  /// Advances by one time step. The contacts, which conditions.body must request, are appended to the
  /// report. Thrown bodies bounce off the walls they meet.
  /// \throw Error(input) naming the first vertex whose motion is not finite, and as Body::step
  void step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts);

  Body<D>& body() { return body_; }
  const Body<D>& body() const { return body_; }
  /// The targets of the vertices in the last step.
  /// \pre there was one
  std::span<const Point<D>> targets() const { return targets_; }
  /// The velocity of a thrown body; zero if it is guided.
  const Vector<D>& velocity() const { return velocity_; }
  /// True if a guided body is at the end of its path, with all vertices in place.
  bool has_arrived() const {
    return guide_ && travelled_ >= path_length_ && std::ranges::equal(body_.positions(), targets_);
  }

 private:
  Point<D> middle() const;
  Point<D> on_path() const;

  Body<D> body_;
  std::vector<Vector<D>> shape_;  ///< from the centre of the vertices
  Vector<D> velocity_{};
  Spin<D> spin_{};
  double angle_ = 0;    ///< total rotation about the axis of the spin
  double turning_ = 1;  ///< 1 or -1: the sense of rotation
  std::optional<Guided_motion<D>> guide_;
  double travelled_ = 0, path_length_ = 0;
  std::vector<Point<D>> targets_;

  friend detail::State_access<D>;
};

extern template class Rigid_body<2>;
extern template class Rigid_body<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_RIGID_BODY_H
