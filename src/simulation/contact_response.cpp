// SPDX-License-Identifier: LGPL-3.0-or-later
#include "contact_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cellwalk::detail {
namespace {

/// Contacts of one step disturb each other: so often they are gone through.
constexpr int passes = 4;

/// A place of the body where it met a wall: the mean of some vertices with these weights.
template <int D>
struct Place {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{};
  std::size_t count = 0;
  Vector<D> arm{}, normal{};
  double squares = 0;  ///< of the weights, added up
  bool has_rubbed = false;

  Vector<D> velocity(std::span<const Vector<D>> velocities) const {
    Vector<D> sum{};
    for (std::size_t k = 0; k < count; ++k) sum = sum + weights[k] * velocities[vertices[k]];
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
Place<D> place_of(const Body<D>& body, const Body_contact<D>& met, const Rigid_frame<D>& frame) {
  const auto x = body.positions();
  Place<D> place;
  if (met.contact.body == Body_feature::edge) {
    const auto [u, v] = body.edges()[met.feature];
    const Vector<D> edge = x[v] - x[u];
    const double square = dot(edge, edge);
    const double t =
        square > 0 ? std::clamp(dot(met.contact.point - x[u], edge) / square, 0.0, 1.0) : 0.5;
    place.vertices = {u, v};
    place.weights = {1 - t, t};
    place.count = 2;
  } else {
    place.vertices = {met.vertex};
    place.weights = {1};
    place.count = 1;
    if constexpr (D == 3)
      if (met.contact.body == Body_feature::face) {
        place.vertices = body.faces()[met.feature];
        const auto& [a, b, c] = place.vertices;
        place.weights = weights_in(met.contact.point, x[a], x[b], x[c]);
        place.count = 3;
      }
  }
  for (std::size_t k = 0; k < place.count; ++k) {
    place.arm = place.arm + place.weights[k] * frame.arm(x[place.vertices[k]]);
    place.squares += place.weights[k] * place.weights[k];
  }
  place.normal = met.contact.normal;
  return place;
}

/// Changes the speed of a place in a direction by `change`.
template <int D>
void push(const Place<D>& place, const Vector<D>& direction, double change, double stiffness,
          const Rigid_frame<D>& frame, std::span<const Point<D>> positions, std::span<Vector<D>> velocities) {
  const Rigid_motion<D> whole = frame.answer(place.arm, direction);
  const double mobility = stiffness * dot(direction, whole.at(place.arm)) + (1 - stiffness) * place.squares;
  if (!(mobility > 0)) return;
  const double impulse = change / mobility;
  if (stiffness > 0)
    for (std::size_t i = 0; i < positions.size(); ++i)
      velocities[i] = velocities[i] + (impulse * stiffness) * whole.at(frame.arm(positions[i]));
  for (std::size_t k = 0; k < place.count; ++k) {
    Vector<D>& v = velocities[place.vertices[k]];
    v = v + (impulse * (1 - stiffness) * place.weights[k]) * direction;
  }
}

}  // namespace

template <int D>
void answer_contacts(const Body<D>& body, std::span<const Body_contact<D>> contacts, const Answer& answer,
                     std::span<Vector<D>> velocities) {
  if (contacts.empty()) return;
  const auto positions = body.positions();
  const Rigid_frame<D> frame(positions);
  std::vector<Place<D>> places;
  places.reserve(contacts.size());
  for (const Body_contact<D>& met : contacts) places.push_back(place_of(body, met, frame));
  bool goes_on = true;
  for (int pass = 0; goes_on && pass < passes; ++pass) {
    goes_on = false;
    for (Place<D>& place : places) {
      const Vector<D> before = place.velocity(velocities);
      const double into = -dot(before, place.normal);
      if (!(into > 0)) continue;
      goes_on = true;
      const bool bounces = pass == 0 && into > answer.resting;
      push(place, place.normal, into * (1 + (bounces ? answer.restitution : 0)), answer.stiffness, frame,
           positions, velocities);
      if (place.has_rubbed || !(answer.friction > 0)) continue;
      place.has_rubbed = true;
      const Vector<D> now = place.velocity(velocities);
      const Vector<D> along = now - dot(now, place.normal) * place.normal;
      const double speed = length(along);
      if (speed > 0)
        push(place, (1 / speed) * along, -answer.friction * speed, answer.stiffness, frame, positions,
             velocities);
    }
  }
  // Between walls that answer each other for ever, the vertices that met them stop.
  for (const Place<D>& place : places) {
    const double into = -dot(place.velocity(velocities), place.normal);
    if (into > 0) push(place, place.normal, into, 0, frame, positions, velocities);
  }
}

template void answer_contacts<2>(const Body<2>&, std::span<const Body_contact<2>>, const Answer&,
                                 std::span<Vector<2>>);
template void answer_contacts<3>(const Body<3>&, std::span<const Body_contact<3>>, const Answer&,
                                 std::span<Vector<3>>);

}  // namespace cellwalk::detail
