// SPDX-License-Identifier: LGPL-3.0-or-later
// The test whether other sides of walls might lead a vertex further than its contact.
#include <cellwalk/internal/edge/furthest_move.h>
#include <cellwalk/internal/edge/sweep_along.h>

namespace cellwalk {

template <int D>
bool detail::may_pass_on_other_sides(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                                     const Walk_result<D>& walked, const Contact<D>& contact, Touch touch,
                                     Walk_counts& counts) {
  if (!walked.had_choice || touch == Touch::stop) return false;
  return !walked.contact ||
         contact.exact_time() < vertex_contact(snapshot, a, b, *walked.contact, counts).exact_time();
}

template bool detail::may_pass_on_other_sides(const Snapshot<2>&, const Point<2>&, const Point<2>&,
                                              const Walk_result<2>&, const Contact<2>&, Touch, Walk_counts&);
template bool detail::may_pass_on_other_sides(const Snapshot<3>&, const Point<3>&, const Point<3>&,
                                              const Walk_result<3>&, const Contact<3>&, Touch, Walk_counts&);

}  // namespace cellwalk
