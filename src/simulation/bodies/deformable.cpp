// SPDX-License-Identifier: LGPL-3.0-or-later
// The prediction along the motion of the whole, and the bound of the energy after contacts.
#include <cellwalk/internal/simulation/deformable.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_response.h"
#include "rigid_motion.h"
#include "simulation/traces/check_motion.h"

namespace cellwalk {
namespace {

/// A body that walls give no more momentum than it gains by falling for this number of steps does not bounce.
constexpr double resting_steps = 2;

template <int D>
double energy_of(std::span<const Vector<D>> velocities) {
  double sum = 0;
  for (const Vector<D>& v : velocities) sum += 0.5 * dot(v, v);
  return sum;
}

}  // namespace

template <int D>
Deformable<D>::Deformable(Body<D> body, const Shape_material& material, const Vector<D>& velocity,
                          const Spin<D>& spin)
    : body_(std::move(body)), matching_(body_.positions(), material), targets_(body_.vertex_count()) {
  const detail::Rigid_frame<D> frame(body_.positions());
  const detail::Rigid_motion<D> motion{velocity, spin};
  for (const Point<D>& x : body_.positions()) velocities_.push_back(motion.at(frame.arm(x)));
  moved_.resize(targets_.size());
}

template <int D>
Vector<D> Deformable<D>::velocity() const {
  Vector<D> sum{};
  for (const Vector<D>& v : velocities_) sum = sum + v;
  return (1 / static_cast<double>(velocities_.size())) * sum;
}

template <int D>
double Deformable<D>::kinetic_energy() const {
  return energy_of<D>(velocities_);
}

template <int D>
double Deformable<D>::height_energy(const Vector<D>& gravity) const {
  double sum = 0;
  for (const Point<D>& x : body_.positions()) sum -= dot(gravity, x);
  return sum;
}

/// Slows the vertices down to this kinetic energy: first the motion that deforms the body, then its motion as
/// a whole.
template <int D>
void Deformable<D>::limit(double most) {
  most = std::max(0.0, most);
  const double all = kinetic_energy();
  if (all <= most) return;
  const auto positions = body_.positions();
  const detail::Rigid_frame<D> frame(positions);
  const detail::Rigid_motion<D> motion = frame.motion_of(positions, velocities_);
  double whole = 0;
  for (const Point<D>& x : positions) {
    const Vector<D> v = motion.at(frame.arm(x));
    whole += 0.5 * dot(v, v);
  }
  const double deforming = all - whole;
  const double of_whole = whole > most ? std::sqrt(most / whole) : 1;
  const double of_rest = whole < most && deforming > 0 ? std::sqrt((most - whole) / deforming) : 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector<D> v = motion.at(frame.arm(positions[i]));
    velocities_[i] = of_whole * v + of_rest * (velocities_[i] - v);
  }
  // The excess that rounding left.
  if (const double left = kinetic_energy(); left > most)
    for (Vector<D>& v : velocities_) v = (std::sqrt(most / left) * (1 - 0x1p-50)) * v;
}

/// Where the body would be without walls, and the velocities that take it there.
///
/// The motion of the whole keeps its momenta, and is followed along its arc. The rest y of the shape and its
/// velocity u, seen from the goals and from the whole, become y' = (1 - a) y + (1 - a^2) h u and u' = (y' -
/// y) / h, a being the stiffness: stable for all a and h; with a = 1 there is no deformation after a step, as
/// a tends to 0 nothing is lost.
template <int D>
void Deformable<D>::predict(double dt) {
  const double stiffness = matching_.material().stiffness, kept = 1 - stiffness * stiffness;
  const auto positions = body_.positions();
  const detail::Rigid_frame<D> here(positions);
  const detail::Rigid_motion<D> motion = here.motion_of(positions, velocities_);
  const Spin<D> momentum = here.momentum_of(positions, velocities_);
  const detail::Axis_rotation<D> turn(dt * motion.spin);
  const Point<D> centre = here.centre() + dt * motion.velocity;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Vector<D> arm = here.arm(positions[i]);
    velocities_[i] = turn(velocities_[i] - motion.at(arm));
    moved_[i] = centre + turn(arm);
  }
  detail::check_motion<D>(moved_);
  matching_.goals(moved_, targets_);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    velocities_[i] = kept * velocities_[i] + (stiffness / dt) * (targets_[i] - moved_[i]);
    targets_[i] = moved_[i] + dt * velocities_[i];
  }
  detail::check_motion<D>(targets_);
  const detail::Rigid_frame<D> there(targets_);
  const detail::Rigid_motion<D> whole{motion.velocity, there.spin_of(momentum)};
  for (std::size_t i = 0; i < targets_.size(); ++i)
    velocities_[i] = velocities_[i] + whole.at(there.arm(targets_[i]));
  detail::check_motion<D>(velocities_);
}

template <int D>
void Deformable<D>::step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts) {
  const double dt = conditions.time_step, stiffness = matching_.material().stiffness;
  const double before = kinetic_energy(), height_before = height_energy(conditions.gravity);
  for (Vector<D>& v : velocities_) v = v + dt * conditions.gravity;
  const double accelerated = kinetic_energy();
  detail::check_motion<D>(velocities_);
  if (!std::isfinite(accelerated) || !std::isfinite(height_before)) detail::refuse_motion("its energy");
  const double gained = std::max(0.0, accelerated - before);  // from gravity
  predict(dt);
  const std::vector<Contact<D>>& contacts = report.contacts;
  const std::size_t first = contacts.size();
  std::ranges::copy(body_.positions(), moved_.begin());
  body_.step(targets_, conditions.body, report, counts);

  double level = before + stored_;  // of kinetic energy, at the height before
  limit(level + gained);
  if (contacts.size() > first) {
    const double free = kinetic_energy();
    const double resting =
        resting_steps * dt * length(conditions.gravity) * static_cast<double>(moved_.size());
    for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = (1 / dt) * (body_.positions()[i] - moved_[i]);
    detail::answer_contacts<D>(body_, std::span(contacts).subspan(first),
                               {conditions.restitution, conditions.friction, resting, stiffness}, moved_,
                               velocities_);
    // Walls first take the energy away that gravity has just added: it moved nothing.
    level -= std::max(0.0, free - kinetic_energy() - gained);
  }
  level += height_before - height_energy(conditions.gravity);
  limit(level);
  stored_ = (1 - stiffness * stiffness) * std::max(0.0, level - kinetic_energy());
  detail::check_motion<D>(velocities_);
  if (!std::isfinite(stored_)) detail::refuse_motion("its energy");
}

template class Deformable<2>;
template class Deformable<3>;

}  // namespace cellwalk
