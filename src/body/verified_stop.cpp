// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/verified_stop.h>

#include <algorithm>
#include <cmath>

#include "slide.h"
#include "stop_candidates.h"

namespace cellwalk {
namespace {

constexpr int largest_shift = 1024;  // ulp
constexpr int shrink_steps = 20;
template <int D>
bool try_move(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
              Walk_counts& counts) {
  return is_finite(target) && move<Exact>(snapshot, particle, target, counts).status == Walk_status::arrived;
}

/// The velocity after a contact with a wall, given the normals of the walls met before in the same step.
template <int D>
Vector<D> respond(const Vector<D>& v, const Vector<D>& normal, const std::vector<Met_contact<D>>& met,
                  std::size_t first, const Wall_response& response) {
  const double into = std::min(0.0, dot(v, normal));
  const Vector<D> along = v - into * normal;
  const Vector<D> after = (1 - response.friction) * along - (response.restitution * into) * normal;
  if (response.restitution > 0) return after;
  // A slide must not lead back into a wall that was met before.
  for (std::size_t i = met.size() - 1; i-- > first;) {
    const Vector<D>& other = met[i].contact.normal;
    if (dot(after, other) >= 0) continue;
    const Vector<D> both = detail::along_both(after, normal, other);
    for (std::size_t j = first; j + 1 < met.size(); ++j)
      if (j != i && dot(both, met[j].contact.normal) < 0) return {};
    return both;
  }
  return after;
}

}  // namespace

template <int D>
bool stop_at_contact(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                     const Wall_contact<D>& contact, Walk_counts& counts) {
  const Point<D> from = particle.position;
  if (contact.time == 0) return false;
  if (try_move(snapshot, particle, contact.point, counts)) return particle.position != from;
  const double unit = detail::ulp<D>(contact.point == Point<D>{} ? from : contact.point);
  for (int shift = 1; shift <= largest_shift; shift *= 2)
    if (try_move(snapshot, particle, contact.point + (shift * unit) * contact.normal, counts)) return true;
  for (int k = shrink_steps; k >= 1; --k) {
    const double time = contact.time * (1 - std::ldexp(1.0, -k));
    if (try_move(snapshot, particle, from + time * (target - from), counts)) return particle.position != from;
  }
  return false;
}

template <int D>
Vector<D> advance(const Snapshot<D>& snapshot, Particle<D>& particle, Vector<D> velocity,
                  const Wall_response& response, std::vector<Met_contact<D>>& met, Walk_counts& counts) {
  const std::size_t first = met.size();
  double passed = 0;
  Vector<D> lift{};
  for (;;) {
    const Point<D> target = particle.position + (1 - passed) * velocity + lift;
    if (!is_finite(target)) return {};
    const Walk_result<D> result = move<Exact>(snapshot, particle, target, counts);
    if (result.status == Walk_status::arrived) return velocity;
    met.push_back({passed + result.contact->time * (1 - passed), *result.contact});
    stop_at_contact(snapshot, particle, target, *result.contact, counts);
    passed = std::min(1.0, met.back().time);
    velocity = respond(velocity, result.contact->normal, met, first, response);
    if (met.size() - first >= static_cast<std::size_t>(response.most_contacts)) return velocity;
    if (!(length(velocity) > 0)) return velocity;
    lift = detail::lift<D>(particle.position, (1 - passed) * velocity, result.contact->normal);
  }
}

template bool stop_at_contact<2>(const Snapshot<2>&, Particle<2>&, const Point<2>&, const Wall_contact<2>&,
                                 Walk_counts&);
template bool stop_at_contact<3>(const Snapshot<3>&, Particle<3>&, const Point<3>&, const Wall_contact<3>&,
                                 Walk_counts&);
template Vector<2> advance<2>(const Snapshot<2>&, Particle<2>&, Vector<2>, const Wall_response&,
                              std::vector<Met_contact<2>>&, Walk_counts&);
template Vector<3> advance<3>(const Snapshot<3>&, Particle<3>&, Vector<3>, const Wall_response&,
                              std::vector<Met_contact<3>>&, Walk_counts&);

}  // namespace cellwalk
