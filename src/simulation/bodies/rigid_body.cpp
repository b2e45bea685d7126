// SPDX-License-Identifier: LGPL-3.0-or-later
// The position of a guide on its path, and the steps of thrown and guided bodies.
#include <cellwalk/internal/simulation/rigid_body.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/traces/check_motion.h"

namespace cellwalk {
namespace {

double speed(const Spin<2>& spin) { return std::abs(spin[0]); }
double speed(const Spin<3>& spin) { return length(spin); }

Vector<2> turned(const Vector<2>& v, const Spin<2>& spin, double angle) {
  if (spin[0] < 0) angle = -angle;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
}

/// Rodrigues' formula.
Vector<3> turned(const Vector<3>& v, const Spin<3>& spin, double angle) {
  const Vector<3> axis = (1 / length(spin)) * spin;
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

template <int D>
double length_of(const std::vector<Point<D>>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += length(path[i] - path[i - 1]);
  return sum;
}

}  // namespace

template <int D>
Rigid_body<D>::Rigid_body(Body<D> body, const Vector<D>& velocity, const Spin<D>& spin)
    : body_(std::move(body)), velocity_(velocity), spin_(spin), targets_(body_.vertex_count()) {
  const Point<D> from = middle();
  for (const Point<D>& x : body_.positions()) shape_.push_back(x - from);
}

template <int D>
Rigid_body<D>::Rigid_body(Body<D> body, Guided_motion<D> guide, const Spin<D>& spin)
    : Rigid_body(std::move(body), Vector<D>{}, spin) {
  path_length_ = length_of<D>(guide.path);
  for (std::size_t i = 0; i < shape_.size(); ++i) shape_[i] = body_.positions()[i] - guide.path.front();
  guide_ = std::move(guide);
}

template <int D>
Point<D> Rigid_body<D>::middle() const {
  Point<D> sum{};
  for (const Point<D>& x : body_.positions()) sum = sum + x;
  return (1 / static_cast<double>(body_.vertex_count())) * sum;
}

/// Where the guide is.
template <int D>
Point<D> Rigid_body<D>::on_path() const {
  double left = travelled_;
  for (std::size_t i = 1; i < guide_->path.size(); ++i) {
    const Point<D>&from = guide_->path[i - 1], &to = guide_->path[i];
    const double piece = length(to - from);
    if (left < piece) return from + (left / piece) * (to - from);
    left -= piece;
  }
  return guide_->path.back();
}

template <int D>
void Rigid_body<D>::step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts) {
  const double dt = conditions.time_step;
  Point<D> origin;
  if (guide_) {
    travelled_ = std::min(path_length_, travelled_ + guide_->speed * dt);
    origin = on_path();
  } else {
    velocity_ = velocity_ + dt * conditions.gravity;
    origin = middle() + dt * velocity_;
  }
  angle_ += turning_ * speed(spin_) * dt;
  const bool turns = speed(spin_) > 0;
  for (std::size_t i = 0; i < shape_.size(); ++i)
    targets_[i] = origin + (turns ? turned(shape_[i], spin_, angle_) : shape_[i]);
  detail::check_motion<D>(targets_);
  const std::vector<Contact<D>>& contacts = report.contacts;
  const std::size_t first = contacts.size();
  body_.step(targets_, conditions.body, report, counts);
  if (guide_) return;
  for (std::size_t i = first; i < contacts.size(); ++i) {
    const Vector<D>& normal = contacts[i].normal;
    const double into = dot(velocity_, normal);
    if (!(into < 0)) continue;
    const Vector<D> along = velocity_ - into * normal;
    velocity_ = (1 - conditions.friction) * along - (conditions.restitution * into) * normal;
  }
  if (!is_finite(velocity_)) detail::refuse_motion("its velocity");
  if (contacts.size() > first) turning_ = -turning_;
}

template class Rigid_body<2>;
template class Rigid_body<3>;

}  // namespace cellwalk
