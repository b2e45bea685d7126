// SPDX-License-Identifier: LGPL-3.0-or-later
// The advance of the rod, the waypoints of its tip, and the turn of its base.
#include <cellwalk/internal/simulation/rod.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rod_shape.h"
#include "simulation/traces/check_motion.h"

namespace cellwalk {
namespace {

/// In spacings: the base is held back if a link is longer than it should be by the first length, or if the
/// rod has been pushed together by the second one.
constexpr double most_stretched = 0.5, most_compressed = 1;
/// In steps of the advance: a rod that was pushed together may come out this fast.
constexpr double fastest = 2;
constexpr double radians = std::numbers::pi / 180;

/// The angle from one vector to another about an axis.
double angle_about(const Vector<3>& axis, const Vector<3>& from, const Vector<3>& to) {
  return std::atan2(dot(axis, cross(from, to)), dot(from, to) - dot(from, axis) * dot(to, axis));
}

}  // namespace

template <int D>
Body_soup<D> Rod<D>::at_entry(const Catheter<D>& catheter) {
  Body_soup<D> soup;
  soup.points.assign(catheter.particles, catheter.path.front());
  for (std::uint32_t i = 0; i + 1 < catheter.particles; ++i) soup.edges.push_back({i, i + 1});
  if (catheter.radius > 0) soup.radii = {catheter.radius};
  return soup;
}

template <int D>
Rod<D>::Rod(const Snapshot<D>& snapshot, Body<D> body, const Catheter<D>& catheter,
            std::vector<Point<D>> waypoints)
    : snapshot_(&snapshot), body_(std::move(body)), catheter_(catheter), waypoints_(std::move(waypoints)) {
  Vector<D> first{};
  first[0] = 1;
  direction_ = normalized(waypoints_[1] - waypoints_[0], first);
  heading_ = direction_;
}

template <int D>
detail::Rod_state<D> Rod<D>::state() const {
  return {waypoints_.front(), direction_, catheter_.spacing, inside_};
}

/// How much of the rod lies between the entry and a vertex, as it is bent now.
template <int D>
double Rod<D>::along(std::size_t vertex) const {
  const auto x = body_.positions();
  double sum = 0;
  for (std::size_t i = vertex; i + 1 < x.size(); ++i) sum += length(x[i] - x[i + 1]);
  return sum + length(x.back() - waypoints_.front());
}

template <int D>
bool Rod<D>::is_held() const {
  const auto x = body_.positions();
  const double most = (1 + most_stretched) * catheter_.spacing;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    if (length(x[i] - x[i + 1]) > most) return true;
  return inside_ - along(0) > most_compressed * catheter_.spacing;
}

/// The length of the path, and what is left of it: to the next waypoint, the tip has to go as far as it is
/// from it.
template <int D>
std::pair<double, double> Rod<D>::whole_and_left() const {
  double whole = 0, left = has_arrived() ? 0 : length(waypoints_[next_] - tip());
  for (std::size_t i = 1; i < waypoints_.size(); ++i) {
    const double piece = length(waypoints_[i] - waypoints_[i - 1]);
    whole += piece;
    if (i > next_) left += piece;
  }
  return {whole, left};
}

template <int D>
double Rod<D>::travelled() const {
  const auto [whole, left] = whole_and_left();
  return std::max(0.0, 1 - left / whole);
}

template <int D>
std::size_t Rod<D>::steps_left() const {
  return static_cast<std::size_t>(std::ceil(whole_and_left().second / catheter_.advance));
}

template <int D>
bool Rod<D>::sees(const Point<D>& x, Body_counts& counts) {
  body_.refresh(counts);
  return walk<Exact>(*snapshot_, body_.particles()[0], x, counts.edges.walk).status == Walk_status::arrived;
}

/// Walls may keep the tip off a waypoint. It counts as passed if the tip is within a spacing of it, or nearer
/// to the next one than it is and has that in sight. A tip that is not bent towards waypoints passes them
/// when it comes beside them, the last one only if it is in sight.
template <int D>
void Rod<D>::pass_waypoints(Body_counts& counts) {
  for (; next_ < waypoints_.size(); ++next_) {
    const Point<D>& aim = waypoints_[next_];
    if (length(aim - tip()) <= catheter_.spacing) continue;
    const bool is_last = next_ + 1 == waypoints_.size();
    const Point<D>& after = is_last ? aim : waypoints_[next_ + 1];
    if (catheter_.steering != Steering::tip) {
      const bool is_past = dot(tip() - aim, after - waypoints_[next_ - 1]) >= 0;
      if (!is_past || (is_last && !sees(aim, counts))) return;
    } else if (is_last || !(length(after - tip()) < length(after - aim)) || !sees(after, counts)) {
      return;
    }
  }
}

/// Chooses where the tip goes, and turns the base.
template <int D>
void Rod<D>::aim() {
  const Vector<D> end = state().tangent(body_.positions(), 0);
  heading_ = end;
  if (catheter_.steering == Steering::none) {
    twist_ += catheter_.twist;
    return;
  }
  if (next_ == waypoints_.size()) return;
  if (catheter_.steering == Steering::tip) {
    heading_ = normalized(waypoints_[next_] - tip(), end);
    return;
  }
  // The curve as it is seen from where it begins.
  const auto x = body_.positions();
  const auto across = detail::curve_directions<D>(state(), twist_ * radians, x);
  const auto bends = static_cast<std::size_t>(catheter_.tip_length / catheter_.spacing);
  const std::size_t begin = std::min({bends, across.size() - 1, x.size() - 1});
  const Vector<D> axis = state().tangent(x, begin), towards = waypoints_[next_] - x[begin];
  double turn = 0;
  if constexpr (D == 3) {
    turn = angle_about(axis, across[begin], towards) / radians;
  } else {
    // In the plane a curve is turned over, by half a turn.
    const Vector<2> left{-axis[1], axis[0]};
    turn = (dot(left, towards) >= 0 ? 0 : 180) - twist_;
  }
  twist_ += std::clamp(turn, -catheter_.twist, catheter_.twist);
}

template <int D>
detail::Natural_bend<D> Rod<D>::bend() const {
  detail::Natural_bend<D> bend;
  bend.stiffness = catheter_.stiffness;
  bend.length = catheter_.tip_length;
  bend.angle_of_tip = catheter_.tip_angle * radians;
  bend.twist = twist_ * radians;
  bend.holds_tip = catheter_.steering == Steering::tip;
  return bend;
}

template <int D>
void Rod<D>::step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts) {
  pass_waypoints(counts);
  const detail::Rod_state<D> before = state();
  const double twist_before = twist_ * radians;
  aim();
  if (is_held())
    ++waited_;
  else if (!has_arrived() || catheter_.steering == Steering::none)
    inside_ = std::min(full_length(), inside_ + catheter_.advance);
  const auto x = body_.positions();
  targets_.assign(x.begin(), x.end());
  detail::push_along<D>(state(), heading_, fastest * catheter_.advance, targets_);
  if (catheter_.steering != Steering::tip)
    detail::bend_tip<D>(before, twist_before, x, state(), bend(), targets_);
  detail::relax<D>(state(), bend(), targets_);
  detail::check_motion<D>(targets_);
  body_.step(targets_, conditions.body, report, counts);
}

template class Rod<2>;
template class Rod<3>;

}  // namespace cellwalk
