// SPDX-License-Identifier: LGPL-3.0-or-later
// Impulses found by repeated passes over the contacts, and friction along the walls.
#include "contact_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cellwalk::detail {
namespace {

/// Contacts of one step disturb each other. They are passed over at most this number of times, and no longer
/// than speeds change by more than this share of the fastest.
constexpr int impulse_passes = 32;
constexpr double settled = 1e-9;

/// A place of the body where it met a wall: the mean of some vertices with these weights.
template <int D>
struct Place {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{};
  std::size_t count = 0;
  Vector<D> arm{}, normal{}, velocity{};  ///< velocity: before any impulse
  double squares = 0;                     ///< of the weights, added up
  double impulse = 0;                     ///< along the normal

  Vector<D> mean(std::span<const Vector<D>> of_vertices) const {
    Vector<D> sum{};
    for (std::size_t k = 0; k < count; ++k) sum = sum + weights[k] * of_vertices[vertices[k]];
    return sum;
  }
};

/// The weights of the corners of a triangle at a point, more or less: none is negative, and they add up to 1.
std::array<double, 3> weights_in(const Point<3>& x, const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Vector<3> normal = cross(b - a, c - a);
  std::array<double, 3> parts{std::max(0.0, dot(normal, cross(c - b, x - b))),
                              std::max(0.0, dot(normal, cross(a - c, x - c))),
                              std::max(0.0, dot(normal, cross(b - a, x - a)))};
  const double sum = parts[0] + parts[1] + parts[2];
  if (!(sum > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  for (double& part : parts) part /= sum;
  return parts;
}

template <int D>
Place<D> place_of(const Body<D>& body, const Contact<D>& met, const Rigid_frame<D>& frame) {
  const auto x = body.positions();
  Place<D> place;
  if (met.body == Body_feature::edge) {
    const auto [u, v] = body.edges()[met.feature];
    const Vector<D> edge = x[v] - x[u];
    const double square = dot(edge, edge);
    const double t = square > 0 ? std::clamp(dot(met.point - x[u], edge) / square, 0.0, 1.0) : 0.5;
    place.vertices = {u, v};
    place.weights = {1 - t, t};
    place.count = 2;
  } else {
    place.vertices = {met.vertex};
    place.weights = {1};
    place.count = 1;
    if constexpr (D == 3)
      if (met.body == Body_feature::face) {
        place.vertices = body.faces()[met.feature];
        const auto& [a, b, c] = place.vertices;
        place.weights = weights_in(met.point, x[a], x[b], x[c]);
        place.count = 3;
      }
  }
  for (std::size_t k = 0; k < place.count; ++k) {
    place.arm = place.arm + place.weights[k] * frame.arm(x[place.vertices[k]]);
    place.squares += place.weights[k] * place.weights[k];
  }
  place.normal = met.normal;
  return place;
}

/// The impulses so far, and their effect on the velocities.
template <int D>
class Impulses {
 public:
  Impulses(const Rigid_frame<D>& frame, double stiffness, std::size_t vertices)
      : frame_(&frame), stiffness_(stiffness), own_(vertices) {}

  Vector<D> velocity(const Place<D>& place) const {
    return place.velocity + stiffness_ * whole_.at(place.arm) + (1 - stiffness_) * place.mean(own_);
  }
  /// How fast a place gets in a direction by an impulse of 1.
  double mobility(const Place<D>& place, const Vector<D>& direction) const {
    const double whole = dot(direction, frame_->answer(place.arm, direction).at(place.arm));
    return stiffness_ * whole + (1 - stiffness_) * place.squares;
  }
  void add(const Place<D>& place, const Vector<D>& impulse) {
    const Rigid_motion<D> answer = frame_->answer(place.arm, impulse);
    whole_.velocity = whole_.velocity + answer.velocity;
    whole_.spin = whole_.spin + answer.spin;
    for (std::size_t k = 0; k < place.count; ++k) {
      Vector<D>& own = own_[place.vertices[k]];
      own = own + place.weights[k] * impulse;
    }
  }
  void apply(std::span<const Point<D>> positions, std::span<Vector<D>> velocities) const {
    for (std::size_t i = 0; i < positions.size(); ++i)
      velocities[i] =
          velocities[i] + stiffness_ * whole_.at(frame_->arm(positions[i])) + (1 - stiffness_) * own_[i];
  }

 private:
  const Rigid_frame<D>* frame_;
  double stiffness_;
  Rigid_motion<D> whole_;
  std::vector<Vector<D>> own_;
};

/// Finds impulses along the normals, none of them negative, so that no place goes into its wall.
template <int D>
void stop_at_walls(std::vector<Place<D>>& places, Impulses<D>& impulses) {
  double fastest = 0;
  for (const Place<D>& place : places) fastest = std::max(fastest, -dot(place.velocity, place.normal));
  for (int pass = 0; pass < impulse_passes; ++pass) {
    double change = 0;
    for (Place<D>& place : places) {
      const double mobility = impulses.mobility(place, place.normal);
      if (!(mobility > 0)) continue;
      const double into = -dot(impulses.velocity(place), place.normal);
      const double impulse = std::max(0.0, place.impulse + into / mobility) - place.impulse;
      place.impulse += impulse;
      impulses.add(place, impulse * place.normal);
      change = std::max(change, std::abs(impulse) * mobility);
    }
    if (!(change > settled * fastest)) break;
  }
}

/// Takes a share of the speed along the wall.
template <int D>
void rub(const Place<D>& place, double friction, Impulses<D>& impulses) {
  const Vector<D> now = impulses.velocity(place);
  const Vector<D> along = now - dot(now, place.normal) * place.normal;
  const double speed = length(along);
  if (!(speed > 0)) return;
  const Vector<D> direction = (1 / speed) * along;
  const double mobility = impulses.mobility(place, direction);
  if (mobility > 0) impulses.add(place, (-friction * speed / mobility) * direction);
}

}  // namespace

template <int D>
void answer_contacts(const Body<D>& body, std::span<const Contact<D>> contacts, const Answer& answer,
                     std::span<const Vector<D>> reached, std::span<Vector<D>> velocities) {
  if (contacts.empty()) return;
  const auto positions = body.positions();
  const Rigid_frame<D> frame(positions);
  std::vector<Place<D>> places;
  places.reserve(contacts.size());
  for (const Contact<D>& met : contacts) places.push_back(place_of<D>(body, met, frame));
  const auto see = [&](std::span<const Vector<D>> seen) {
    for (Place<D>& place : places) place.velocity = place.mean(seen);
  };
  see(velocities);
  Impulses<D> impulses(frame, answer.stiffness, positions.size());
  stop_at_walls(places, impulses);
  double sum = 0;
  for (const Place<D>& place : places) sum += place.impulse;
  const bool bounces = sum > answer.resting;
  if (!bounces) {
    std::ranges::copy(reached, velocities.begin());
    see(velocities);
    impulses = Impulses<D>(frame, answer.stiffness, positions.size());
  }
  for (const Place<D>& place : places)
    if (place.impulse > 0 && answer.friction > 0) rub(place, answer.friction, impulses);
  for (const Place<D>& place : places)
    if (bounces) impulses.add(place, (answer.restitution * place.impulse) * place.normal);
  impulses.apply(positions, velocities);
}

template void answer_contacts<2>(const Body<2>&, std::span<const Contact<2>>, const Answer&,
                                 std::span<const Vector<2>>, std::span<Vector<2>>);
template void answer_contacts<3>(const Body<3>&, std::span<const Contact<3>>, const Answer&,
                                 std::span<const Vector<3>>, std::span<Vector<3>>);

}  // namespace cellwalk::detail
