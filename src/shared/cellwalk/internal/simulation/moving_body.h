// SPDX-License-Identifier: LGPL-3.0-or-later
// A body of a world, with any kind of motion.
#ifndef CELLWALK_INTERNAL_SIMULATION_MOVING_BODY_H
#define CELLWALK_INTERNAL_SIMULATION_MOVING_BODY_H

#include <cellwalk/internal/simulation/deformable.h>
#include <cellwalk/internal/simulation/rigid_body.h>
#include <cellwalk/internal/simulation/rod.h>

#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk {

/// A rigid body (thrown or guided), a deformable body, or a catheter, with a common interface.
template <int D>
class Moving_body {
 public:
  Moving_body(Rigid_body<D> flight) : kind_(std::move(flight)) {}
  Moving_body(Deformable<D> deformable) : kind_(std::move(deformable)) {}
  Moving_body(Rod<D> rod) : kind_(std::move(rod)) {}

  /// Advances by one time step. The contacts, which conditions.body must request, are appended to the
  /// report.
  /// \throw Error(input) naming the first vertex whose motion is not finite, and as Body::step
  void step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts) {
    std::visit([&](auto& moving) { moving.step(conditions, report, counts); }, kind_);
  }

  Body<D>& body() {
    return std::visit([](auto& moving) -> Body<D>& { return moving.body(); }, kind_);
  }
  const Body<D>& body() const {
    return std::visit([](const auto& moving) -> const Body<D>& { return moving.body(); }, kind_);
  }
  /// The targets of the vertices in the last step.
  std::span<const Point<D>> targets() const {
    return std::visit([](const auto& moving) { return moving.targets(); }, kind_);
  }
  /// The velocity of the centre of a thrown body; zero for others.
  Vector<D> velocity() const {
    return std::visit([](const auto& moving) -> Vector<D> { return moving.velocity(); }, kind_);
  }
  /// True for a body at the end of its path.
  bool has_arrived() const {
    return std::visit([](const auto& moving) { return moving.has_arrived(); }, kind_);
  }
  /// Calls use() with the body as its own kind.
  template <class Use>
  decltype(auto) visit(const Use& use) const {
    return std::visit(use, kind_);
  }
  /// The body as a given kind; null if it is of another kind.
  template <class Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&kind_);
  }

 private:
  std::variant<Rigid_body<D>, Deformable<D>, Rod<D>> kind_;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_MOVING_BODY_H
