// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles that walls at a moving vertex touch, followed by definition. Theory: docs/moving.md,
// touches.
#ifndef CELLWALK_INTERNAL_EDGE_FOLLOWED_STAR_H
#define CELLWALK_INTERNAL_EDGE_FOLLOWED_STAR_H

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
  std::vector<Stay> stays;  ///< ascending, the last one until 1
  Cell end = Cell::none;    ///< after the move

  /// \pre a time in (0,1) at which it changes no cell
  Cell at(const Fraction& time) const {
    std::size_t k = 0;
    while (k + 1 < stays.size() && stays[k].until < time) ++k;
    return stays[k].cell;
  }
};

struct Followed_vertex {
  bool is_free = false;
  Cells_of_vertex cells;            ///< if it is free
  std::optional<Star_block> block;  ///< else
};

/// Follows a particle through all times at which its side of a wall may change, and all cells in which it may
/// be. Of several in which it may end, that in which it is now is taken, else the first one found.
/// Cost: some ten us, in exact numbers.
template <int D>
Followed_vertex follow_vertex(const Moving_star<D>& star, const Particle<D>& p);

extern template Followed_vertex follow_vertex<2>(const Moving_star<2>&, const Particle<2>&);
extern template Followed_vertex follow_vertex<3>(const Moving_star<3>&, const Particle<3>&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FOLLOWED_STAR_H
