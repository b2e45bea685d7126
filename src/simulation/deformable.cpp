// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/simulation/deformable.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_response.h"
#include "rigid_motion.h"

namespace cellwalk {
namespace {

/// A vertex that falls for so many steps, and not longer, does not bounce.
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
  predicted_.resize(targets_.size());
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

/// Slows the vertices down to this kinetic energy: first what deforms the body, then its motion as a whole.
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
  // What rounding left over.
  if (const double left = kinetic_energy(); left > most)
    for (Vector<D>& v : velocities_) v = (std::sqrt(most / left) * (1 - 0x1p-50)) * v;
}

template <int D>
void Deformable<D>::step(const Flight_conditions<D>& conditions, std::vector<Body_contact<D>>& contacts,
                         Body_counts& counts) {
  const double dt = conditions.time_step, stiffness = matching_.material().stiffness;
  const auto positions = body_.positions();
  const double before = kinetic_energy(), height_before = height_energy(conditions.gravity);
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    velocities_[i] = velocities_[i] + dt * conditions.gravity;
    predicted_[i] = positions[i] + dt * velocities_[i];
  }
  const bool is_predicted = std::ranges::all_of(predicted_, is_finite<D>);
  if (is_predicted) {
    matching_.goals(predicted_, targets_);
    for (std::size_t i = 0; i < targets_.size(); ++i)
      targets_[i] = predicted_[i] + stiffness * (targets_[i] - predicted_[i]);
  }
  if (!is_predicted || !std::ranges::all_of(targets_, is_finite<D>)) {
    std::ranges::fill(velocities_, Vector<D>{});
    stored_ = 0;
    return;
  }
  const double gained = std::max(0.0, kinetic_energy() - before);  // from gravity
  for (std::size_t i = 0; i < targets_.size(); ++i)
    velocities_[i] = (1 / dt) * (targets_[i] - positions[i]);

  const std::size_t first = contacts.size();
  body_.step(targets_, conditions.body, contacts, counts);

  double level = before + stored_;  // of kinetic energy, at the height before
  limit(level + gained);
  if (contacts.size() > first) {
    const double free = kinetic_energy();
    const double resting = resting_steps * dt * length(conditions.gravity);
    detail::answer_contacts<D>(body_, std::span(contacts).subspan(first),
                               {conditions.restitution, conditions.friction, resting, stiffness}, velocities_);
    // Walls take away first what gravity has just added: it moved nothing.
    level -= std::max(0.0, free - kinetic_energy() - gained);
  }
  level += height_before - height_energy(conditions.gravity);
  limit(level);
  stored_ = (1 - stiffness) * std::max(0.0, level - kinetic_energy());
}

template class Deformable<2>;
template class Deformable<3>;

}  // namespace cellwalk
