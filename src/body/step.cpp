// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body: its vertices one after the other, stopped at walls and led along them.
#include <cellwalk/body/body.h>

#include <algorithm>

#include "slide.h"
#include "stop_candidates.h"

namespace cellwalk {
/// Moves vertex by vertex; what edges sweep counts.
template <int D>
void Body<D>::move_each(std::span<const Point<D>> targets, const Body_options& options,
                        std::vector<Body_contact<D>>& contacts, Body_counts& counts) {
  std::vector<Vector<D>> normals;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (moves_in_region(v, targets[v], counts)) continue;
    Point<D> target = targets[v];
    normals.clear();
    for (int met = 0; met < std::max(1, options.most_contacts); ++met) {
      const auto contact = try_move(v, target, options.sweep, counts);
      if (!contact) break;
      ++counts.contacts;
      contacts.push_back(*contact);
      if (options.policy == Contact_policy::reject) {
        ++counts.held;
        break;
      }
      counts.held += !stop(v, target, *contact, options.sweep, counts);
      normals.push_back(contact->contact.normal);
      const Vector<D> left = detail::slide<D>(targets[v] - positions_[v], normals);
      if (!(length(left) > 0)) break;
      target = positions_[v] + left + detail::lift<D>(positions_[v], left, normals.back());
      if (!is_finite(target)) break;
    }
  }
}

template <int D>
bool Body<D>::stop(std::uint32_t vertex, const Point<D>& target, const Body_contact<D>& met,
                   const Sweep_options& options, Body_counts& counts) {
  if (met.contact.time == Exact_time()) return false;
  const Point<D> from = positions_[vertex];
  Sweep_options tried = options;
  tried.search = Contact_search::exact;  // whether there is a contact matters, not where
  return detail::try_stops<D>(from, target, met.contact, [&](const Point<D>& x) {
    if (x == from) return false;
    ++counts.stop_tries;
    return !try_move(vertex, x, tried, counts, true);
  });
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template void Body<D>::move_each(std::span<const Point<D>>, const Body_options&,                          \
                                   std::vector<Body_contact<D>>&, Body_counts&);                            \
  template bool Body<D>::stop(std::uint32_t, const Point<D>&, const Body_contact<D>&, const Sweep_options&, \
                              Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
