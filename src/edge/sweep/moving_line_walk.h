// SPDX-License-Identifier: LGPL-3.0-or-later
// The walk of a temporary particle along S(s+), the edge just after an event. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_SWEEP_MOVING_LINE_WALK_H
#define CELLWALK_EDGE_SWEEP_MOVING_LINE_WALK_H

#include "edge/chain/link.h"
#include "edge/exact/moving_line.h"

namespace cellwalk::detail {

/// Walks from p(s+) to q along paths that the rule of the walk allows (several only in planes of facets),
/// until one leads to the side of q and is accepted. There may be as many paths as there are sides of all
/// walls in such a plane; after some dead ends the walk gives up, and relink() decides.
template <int D, class Accept>
class Moving_line_walk {
 public:
  Moving_line_walk(const Snapshot<D>& snapshot, const Moving_line<D>& line, const Particle<D>& q,
                   Accept accept)
      : snapshot_(snapshot), line_(line), q_(q), accept_(accept) {}

  /// Continues from a cell; true once a path is accepted.
  bool from(Cell c) {
    if (dead_ends_ >= most_dead_ends) return false;
    const Cell_view<D> cell = snapshot_.view(c);
    Walk_counts& counts = line_.counts();
    note_plane(cell);
    bool outside = false;
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (side<Exact>(cell, i, q_.position, counts) <= 0) continue;
      outside = true;
      const Exit exit = exit_through(cell, i, line_);
      if (exit.kind == Exit::none) continue;
      return exit.kind == Exit::facet ? pass(Snapshot<D>::half_facet(c, i)) : pass_star(c, exit);
    }
    return !outside && arrive(c);
  }

  const Chain& chain() const { return chain_; }
  /// True if a visited cell has a facet in the plane of the triangle.
  bool is_in_plane() const { return in_plane_; }
  /// The first wall that blocked a path.
  Half_facet wall() const { return wall_; }

 private:
  /// All facets count, also those after the exit: their order must not show.
  void note_plane(const Cell_view<D>& cell) {
    if constexpr (D == 3)
      for (std::size_t i = 0; i < cell.facet_count() && !in_plane_; ++i)
        in_plane_ = line_.holds_triangle(cell, i);
  }

  bool pass(Half_facet f) {
    if (snapshot_.is_impassable(f)) return block(f);
    chain_.push_back(f);
    if (from(snapshot_.neighbour(f))) return true;
    chain_.pop_back();
    return false;
  }

  bool pass_star(Cell c, const Exit& exit) {
    const Star_search<Exact, D> star(snapshot_, c, exit.u, exit.v, line_.triangle().a, q_.position,
                                     line_.counts());
    for (const auto& candidate : star.candidates()) {
      const std::size_t before = chain_.size();
      for (const Half_facet f : star.path(candidate)) chain_.push_back(f);
      if (from(star.cell(candidate))) return true;
      chain_.resize(before);
    }
    return block(star.wall());
  }

  bool arrive(Cell c) {
    const std::size_t before = chain_.size();
    const Half_facet wall = append_link(snapshot_, chain_, c, q_.cell, q_.position, line_.counts());
    if (wall != Half_facet::none) return block(wall);
    if (accept_(chain_)) return true;
    ++dead_ends_;
    chain_.resize(before);
    return false;
  }

  bool block(Half_facet wall) {
    ++dead_ends_;
    if (wall_ == Half_facet::none) wall_ = wall;
    return false;
  }

  static constexpr int most_dead_ends = 8;  ///< this number of walks costs as much as relinking

  const Snapshot<D>& snapshot_;
  const Moving_line<D>& line_;
  const Particle<D>& q_;
  Accept accept_;
  Chain chain_;
  Half_facet wall_ = Half_facet::none;
  int dead_ends_ = 0;
  bool in_plane_ = false;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_MOVING_LINE_WALK_H
