// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for the sides of walls on which a vertex gets furthest with all that it takes along. Theory:
// docs/sweep.md, sides.
#ifndef CELLWALK_INTERNAL_EDGE_FURTHEST_MOVE_H
#define CELLWALK_INTERNAL_EDGE_FURTHEST_MOVE_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/walk/contact.h>

#include <optional>

namespace cellwalk::detail {

/// True if other sides may help a move that has a contact on those that its vertex prefers: not if the vertex
/// is blocked then itself, since it prefers those on which it gets furthest; nor if touching is a contact,
/// since on all sides the same walls are touched.
template <int D>
bool may_pass_on_other_sides(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                             const Walk_result<D>& walked, const Contact<D>& contact, Touch touch,
                             Walk_counts& counts);

/// The contact of a move from a to b on the sides on which it gets furthest, the first of them in the order
/// of preference; none if the move is free there.
/// \param move_on (choices): the contact of the move on given sides, with an exact time; the sides that the
///        vertex takes besides are appended
/// \param choices receives the sides
template <int D, class Move_on>
std::optional<Contact<D>> furthest_move(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                                        Sides_taken& choices, const Move_on& move_on) {
  std::optional<Contact<D>> latest;
  Sides_taken tried;
  for (int tries = 0; tries < most_side_tries; ++tries) {
    const std::optional<Contact<D>> contact = move_on(tried);
    if (!contact || !latest || latest->exact_time() < contact->exact_time()) {
      choices = tried;
      latest = contact;
    }
    if (!contact) break;
    // Sides taken after the contact do not matter. That of a face may be due to an edge on the other side,
    // whenever that came there.
    const bool is_at_its_time = contact->body != Body_feature::face || contact->exact_time() != Exact_time();
    while (is_at_its_time && !tried.empty() && contact->exact_time() < time_of(snapshot, a, b, tried.back()))
      tried.pop_back();
    if (!take_next_sides(tried)) break;
  }
  return latest;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FURTHEST_MOVE_H
