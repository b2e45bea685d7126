// SPDX-License-Identifier: LGPL-3.0-or-later
// Slides and bounces of a particle, each from a position that a walk has reached.
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/internal/edge/sweep_along.h>

#include <algorithm>
#include <span>

#include "slide.h"

namespace cellwalk {
namespace {

/// The velocity after contacts with walls, the last of them just now.
template <int D>
Vector<D> respond(const Vector<D>& v, std::span<const Vector<D>> normals, const Wall_response& response) {
  const double kept = 1 - response.friction;
  if (!(response.restitution > 0)) return kept * detail::slide<D>(v, normals);
  const Vector<D>& normal = normals.back();
  const double into = std::min(0.0, dot(v, normal));
  return kept * (v - into * normal) - (response.restitution * into) * normal;
}

}  // namespace

template <int D>
bool stop_at_contact(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                     const Contact<D>& contact, Walk_counts& counts) {
  if (contact.exact_time() == Exact_time()) return false;
  const Point<D> from = particle.position;
  Walk_options options;
  options.locates_contact = false;  // whether there is one matters, not where
  return detail::try_stops<D>(from, target, contact, [&](const Point<D>& x) {
    return x != from && move<Exact>(snapshot, particle, x, counts, options).status == Walk_status::arrived;
  });
}

template <int D>
Vector<D> advance(const Snapshot<D>& snapshot, Particle<D>& particle, Vector<D> velocity,
                  const Wall_response& response, std::vector<Contact<D>>& met, Walk_counts& counts) {
  std::vector<Vector<D>> normals;
  double passed = 0;
  Vector<D> lift{};
  for (;;) {
    const Point<D> target = particle.position + (1 - passed) * velocity + lift;
    if (!normals.empty() && !is_finite(target)) return {};  // at first move() refuses it
    const Walk_result<D> result = move<Exact>(snapshot, particle, target, counts);
    if (result.status == Walk_status::arrived) return velocity;
    Contact<D> contact = vertex_contact(snapshot, particle.position, target, *result.contact, counts);
    stop_at_contact(snapshot, particle, target, contact, counts);
    if (passed > 0) contact.set_time(Exact_time(passed + contact.time * (1 - passed)));
    met.push_back(contact);
    normals.push_back(contact.normal);
    passed = std::min(1.0, contact.time);
    velocity = respond<D>(velocity, normals, response);
    if (normals.size() >= static_cast<std::size_t>(response.most_contacts)) return velocity;
    if (!(length(velocity) > 0)) return velocity;
    lift = detail::lift<D>(particle.position, (1 - passed) * velocity, contact.normal);
  }
}

template bool stop_at_contact<2>(const Snapshot<2>&, Particle<2>&, const Point<2>&, const Contact<2>&,
                                 Walk_counts&);
template bool stop_at_contact<3>(const Snapshot<3>&, Particle<3>&, const Point<3>&, const Contact<3>&,
                                 Walk_counts&);
template Vector<2> advance<2>(const Snapshot<2>&, Particle<2>&, Vector<2>, const Wall_response&,
                              std::vector<Contact<2>>&, Walk_counts&);
template Vector<3> advance<3>(const Snapshot<3>&, Particle<3>&, Vector<3>, const Wall_response&,
                              std::vector<Contact<3>>&, Walk_counts&);

}  // namespace cellwalk
