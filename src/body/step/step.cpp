// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body: its vertices one after the other, stopped at walls and led along them.
#include <cellwalk/internal/body/stop_candidates.h>

#include <algorithm>

#include "body/shape/body_faces.h"
#include "slide.h"
#include "vertex_move.h"

namespace cellwalk::detail {
namespace {

/// Moves a vertex to a verified position just before a contact, if there is one.
template <int D>
bool stop(Body_state<D>& body, std::uint32_t vertex, const Point<D>& target, const Contact<D>& met,
          const Sweep_options& options, Body_counts& counts) {
  if (met.exact_time() == Exact_time()) return false;
  const Point<D> from = body.positions[vertex];
  Sweep_options tried = options;
  tried.search = nullptr;  // whether there is a contact matters, not where
  return try_stops<D>(from, target, met, [&](const Point<D>& x) {
    if (x == from) return false;
    ++counts.stop_tries;
    return !try_move(body, body.scratch, vertex, x, tried, counts, true);
  });
}

}  // namespace

template <int D>
void move_each(Body_state<D>& body, std::span<const Point<D>> targets, const Body_options& options,
               std::vector<Contact<D>>& contacts, Body_counts& counts) {
  // It may throw: not after some vertices have moved.
  if constexpr (D == 3)
    if (options.sweep.sweep == Sweep::faces) take_up_faces(body, counts);
  for (std::uint32_t v = 0; v < targets.size(); ++v)
    if (!body.try_move_in_region(v, targets[v], counts))
      move_along_walls(body, v, targets[v], options, contacts, counts);
}

template <int D>
void move_along_walls(Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                      const Body_options& options, std::vector<Contact<D>>& contacts, Body_counts& counts) {
  std::vector<Vector<D>> normals;
  Point<D> next = target;
  for (int met = 0; met < std::max(1, options.most_contacts); ++met) {
    const auto contact = try_move(body, body.scratch, vertex, next, options.sweep, counts);
    if (!contact) return;
    ++counts.contacts;
    contacts.push_back(*contact);
    if (options.rule == Step_rule::reject) {
      ++counts.held;
      return;
    }
    counts.held += !stop(body, vertex, next, *contact, options.sweep, counts);
    normals.push_back(contact->normal);
    const Point<D>& position = body.positions[vertex];
    const Vector<D> left = slide<D>(target - position, normals);
    if (!(length(left) > 0)) return;
    next = position + left + lift<D>(position, left, normals.back());
    if (!is_finite(next)) return;
  }
}

template void move_along_walls(Body_state<2>&, std::uint32_t, const Point<2>&, const Body_options&,
                               std::vector<Contact<2>>&, Body_counts&);
template void move_along_walls(Body_state<3>&, std::uint32_t, const Point<3>&, const Body_options&,
                               std::vector<Contact<3>>&, Body_counts&);
template void move_each(Body_state<2>&, std::span<const Point<2>>, const Body_options&,
                        std::vector<Contact<2>>&, Body_counts&);
template void move_each(Body_state<3>&, std::span<const Point<3>>, const Body_options&,
                        std::vector<Contact<3>>&, Body_counts&);

}  // namespace cellwalk::detail
