// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body by the rule of the paper: only the way of a vertex and its edges where that ends decide,
// and what meets a wall stays where it is.
#ifndef CELLWALK_BODY_STEP_AT_TARGET_H
#define CELLWALK_BODY_STEP_AT_TARGET_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "body_state.h"

namespace cellwalk::detail {

template <int D>
class Target_step {
 public:
  Target_step(Body_state<D>& body, const Sweep_options& sweep, Body_counts& counts)
      : body_(body), sweep_(sweep), counts_(counts) {}

  void move_each(std::span<const Point<D>> targets, Reported reported, Step_report<D>& report);

 private:
  const Snapshot<D>& snapshot() const { return *body_.snapshot; }
  std::uint64_t signs() const { return counts_.edges.walk.predicates.orientations; }

  void find_out_if_apart();
  bool touches_wall();
  bool try_certified_move(std::uint32_t vertex, const Point<D>& target);
  Rejected_move<D> try_to_move(std::uint32_t vertex, const Point<D>& target);
  bool is_certified_free(const Particle<D>& p, const Particle<D>& q);
  bool is_certified_free(const Particle<D>& from, const Particle<D>& to, const Particle<D>& q);
  bool refresh_certified_chain(const Particle<D>& from, const Particle<D>& to, const Corner& corner);
  bool meets_at_end(const Vertex_path<D>& path, const Corner& corner, Rejected_move<D>& answer);
  bool sweep_meets_at_end(const Vertex_path<D>& path, std::size_t number, const Corner& corner,
                          Moved_chain& moved, Rejected_move<D>& answer);
  const Corner& first_blocked(const Rejected_move<D>& blocked) const;
  void locate_wall(Rejected_move<D>& blocked, const Point<D>& target) const;
  Body_contact<D> first_contact(const Rejected_move<D>& blocked, const Point<D>& target);

  Body_state<D>& body_;
  const Sweep_options& sweep_;
  Body_counts& counts_;
};

extern template class Target_step<2>;
extern template class Target_step<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_AT_TARGET_H
