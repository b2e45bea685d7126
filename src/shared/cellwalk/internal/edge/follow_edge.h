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

/// The cell of a particle up to a time.
struct Cell_until {
  Cell cell;
  Fraction until;
};

/// A particle while the vertex moves.
template <int D>
struct Followed_vertex {
  Particle<D> before;
  std::vector<Cell_until> stays;  ///< ascending, the last one until 1 or until it is blocked; none if at 0
  Cell end = Cell::none;          ///< its cell after the move, if it is free
  std::size_t choices = 0;        ///< the most sides on which it may be at one time
  std::size_t dead_ends = 0;      ///< sides on which it is blocked before it is so on others, if at all
  std::optional<Collision> collision;  ///< if it is not free

  bool is_free() const { return end != Cell::none; }
  /// The time until which its cells are known.
  Fraction until() const { return stays.empty() ? Fraction(0) : stays.back().until; }
  /// \pre a time in (0,1) at which it changes no cell
  Cell cell_at(const Fraction& time) const {
    std::size_t k = 0;
    while (k + 1 < stays.size() && stays[k].until < time) ++k;
    return stays[k].cell;
  }
};

/// Follows a particle through all times at which its side of a wall may change, and all cells in which it may
/// be. If it may be on several sides of walls, those whose rims pass it, one of them is chosen, at each time.
/// \param choice the number of that side, modulo theirs; the first is that of the particle displaced by (e,
///        e^2, e^3), e small
/// \param to_dead_end choose among the sides on which it is blocked after a while, if there are any: as long
///        as it is not, more of its edges may be free
/// Cost: exact numbers for each facet at the vertex of the environment.
template <int D>
Followed_vertex<D> follow_vertex(const Moving_star<D>& star, const Particle<D>& p, std::size_t choice = 0,
                                 bool to_dead_end = false);

struct Followed_edge {
  std::size_t choices = 0;  ///< classes of chains that it may have after the move; 0 if it is not free
  Chain chain;              ///< if it is free
  /// Else; none if its ends are on sides that do not fit, or blocked first.
  std::optional<Collision> collision;

  bool is_free() const { return choices != 0; }
};

/// Follows an edge pq, all classes of equal chains that it may have, until the first of its ends is blocked.
/// \param p, q its ends; `end` of one that is blocked is its cell before
/// \param before its chain
/// \param choice the number of the class that it is to have, modulo theirs
/// Cost: exact numbers for each time and class.
template <int D>
Followed_edge follow_edge(const Moving_star<D>& star, const Followed_vertex<D>& p,
                          const Followed_vertex<D>& q, const Chain& before, std::size_t choice = 0);

extern template Followed_vertex<2> follow_vertex(const Moving_star<2>&, const Particle<2>&, std::size_t,
                                                 bool);
extern template Followed_vertex<3> follow_vertex(const Moving_star<3>&, const Particle<3>&, std::size_t,
                                                 bool);
extern template Followed_edge follow_edge(const Moving_star<2>&, const Followed_vertex<2>&,
                                          const Followed_vertex<2>&, const Chain&, std::size_t);
extern template Followed_edge follow_edge(const Moving_star<3>&, const Followed_vertex<3>&,
                                          const Followed_vertex<3>&, const Chain&, std::size_t);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FOLLOW_EDGE_H
