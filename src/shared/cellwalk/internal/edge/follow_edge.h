// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles and edges that walls at a moving vertex touch, followed by definition. Theory: docs/moving.md,
// touches.
#ifndef CELLWALK_INTERNAL_EDGE_FOLLOW_EDGE_H
#define CELLWALK_INTERNAL_EDGE_FOLLOW_EDGE_H

#include <cellwalk/internal/edge/moving_star.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace cellwalk::detail {

/// The wall at the vertex that blocks its move.
struct Star_block {
  std::size_t wall;
  Swept_hit hit;
};

/// The cells of a particle while the vertex moves.
struct Cells_of_vertex {
  struct Stay {
    Cell cell;
    Fraction until;
  };
  std::vector<Stay> stays;  ///< ascending, the last one until 1 or until it is blocked; none if at 0
  Cell end = Cell::none;    ///< after the move, if it is free

  /// \pre a time in (0,1) at which it changes no cell
  Cell at(const Fraction& time) const {
    std::size_t k = 0;
    while (k + 1 < stays.size() && stays[k].until < time) ++k;
    return stays[k].cell;
  }
};

struct Followed_vertex {
  bool is_free = false;
  std::size_t choices = 0;    ///< the most sides on which it may be at one time
  std::size_t dead_ends = 0;  ///< sides on which it is blocked before it is so on others, if at all
  Cells_of_vertex cells;
  std::optional<Star_block> block;  ///< if it is not free
};

/// Follows a particle through all times at which its side of a wall may change, and all cells in which it may
/// be. If it may be on several sides of walls, those whose rims pass it, one of them is chosen, at each time.
/// \param choice the number of that side, modulo theirs; the first is that of the particle displaced by (e,
///        e^2, e^3), e small
/// \param to_dead_end choose among the sides on which it is blocked after a while, if there are any: as long
///        as it is not, more of its edges may be free
/// Cost: exact numbers for each facet at the vertex of the environment.
template <int D>
Followed_vertex follow_vertex(const Moving_star<D>& star, const Particle<D>& p, std::size_t choice = 0,
                              bool to_dead_end = false);

/// An end of an edge.
template <int D>
struct Followed_end {
  Particle<D> before, now;
  Cells_of_vertex cells;  ///< in between
};

struct Followed_edge {
  bool is_free = false;
  std::size_t choices = 0;          ///< if it is free: classes of chains that it may have after the move
  Chain chain;                      ///< if it is free
  std::optional<Star_block> block;  ///< else; none if its ends are on sides that do not fit, or blocked first
};

/// Follows an edge pq, all classes of equal chains that it may have, until the first of its ends is blocked.
/// \param before its chain
/// \param choice the number of the class that it is to have, modulo theirs
/// Cost: exact numbers for each time and class.
template <int D>
Followed_edge follow_edge(const Moving_star<D>& star, const Followed_end<D>& p, const Followed_end<D>& q,
                          const Chain& before, std::size_t choice = 0);

extern template Followed_vertex follow_vertex<2>(const Moving_star<2>&, const Particle<2>&, std::size_t,
                                                 bool);
extern template Followed_vertex follow_vertex<3>(const Moving_star<3>&, const Particle<3>&, std::size_t,
                                                 bool);
extern template Followed_edge follow_edge<2>(const Moving_star<2>&, const Followed_end<2>&,
                                             const Followed_end<2>&, const Chain&, std::size_t);
extern template Followed_edge follow_edge<3>(const Moving_star<3>&, const Followed_end<3>&,
                                             const Followed_end<3>&, const Chain&, std::size_t);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FOLLOW_EDGE_H
