// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body by the rule of the paper: only the way of a vertex and its edges at the target decide,
// and a vertex that meets a wall stays where it is.
#ifndef CELLWALK_BODY_STEP_STEP_AT_TARGET_H
#define CELLWALK_BODY_STEP_STEP_AT_TARGET_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/sides_taken.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "body/body_state.h"
#include "chains_in_place.h"

namespace cellwalk::detail {

/// The outcome of the move of a vertex. The wall in the way is one that is touched or nearer than a radius,
/// `answer.contact`, or one that a walk met and that is not located yet.
template <int D>
struct Tried_move {
  Rejected_move<D> answer;
  std::optional<Contact<D>> met;

  /// 0 if nothing was met, 1 if the vertex moves all the same, 2 if it stays.
  int severity() const { return answer.stays() ? 2 : answer.swept_edges != 0 ? 1 : 0; }
  /// Keeps the first wall. True if there is one.
  bool keep_met(const std::optional<Contact<D>>& wall) {
    if (wall && !met && !answer.contact) met = wall;
    return wall.has_value();
  }
  bool keep_located(const std::optional<Contact<D>>& contact) {
    if (contact && !met && !answer.contact) answer.contact = contact;
    return contact.has_value();
  }
};

template <int D>
class Target_step {
 public:
  Target_step(Body_state<D>& body, const Sweep_options& sweep, Body_counts& counts)
      : body_(body), sweep_(sweep), counts_(counts) {}

  void move_each(std::span<const Point<D>> targets, bool reports_blocked, Step_report<D>& report);

 private:
  const Snapshot<D>& snapshot() const { return *body_.snapshot; }
  std::uint64_t signs() const { return counts_.edges.walk.predicates.orientations; }
  bool sweeps() const { return sweep_.sweep != Sweep::three_segments; }

  void update_is_apart();
  bool touches_wall();
  Tried_move<D> try_to_move(std::uint32_t vertex, const Point<D>& target, const Settled_move<D>& settled);
  Tried_move<D> try_on_all_sides(std::uint32_t vertex, const Point<D>& target, Particle<D>& to);
  Tried_move<D> try_on_sides(std::uint32_t vertex, const Point<D>& target, const Settled_move<D>& settled,
                             Sides_taken* choices, Particle<D>& to, bool& had_choice);
  bool meets_at_end(const Vertex_path<D>& path, std::size_t number, const Corner& corner, bool is_blocked,
                    Moved_chain<D>& moved, Tried_move<D>& tried);
  bool is_sweep_of_thick_free(std::uint32_t vertex, const Point<D>& target);
  bool is_way_close(std::uint32_t vertex, const Point<D>& target, Tried_move<D>& tried);
  void test_end_of_thick(std::uint32_t vertex, std::size_t number, const Particle<D>& to,
                         Tried_move<D>& tried);
  bool is_swept_free(const Vertex_path<D>& path, const Corner& corner, Moved_chain<D>& moved);
  const Corner& first_blocked(const Rejected_move<D>& blocked) const;
  void locate_wall(Rejected_move<D>& answer, std::optional<Contact<D>>& met, const Point<D>& target) const;
  void name_part(Rejected_move<D>& answer) const;
  Contact<D> first_contact(Rejected_move<D>& blocked, const Point<D>& target);

  Body_state<D>& body_;
  const Sweep_options& sweep_;
  Body_counts& counts_;
};

extern template class Target_step<2>;
extern template class Target_step<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_STEP_AT_TARGET_H
