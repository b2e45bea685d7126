// SPDX-License-Identifier: LGPL-3.0-or-later
// A vertex of the environment that moves while particles and edges stand still: the particles and edges that
// its walls meet, and their cells and chains afterwards. Theory: docs/moving.md.
#ifndef CELLWALK_INTERNAL_EDGE_MOVING_STAR_H
#define CELLWALK_INTERNAL_EDGE_MOVING_STAR_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/kernel/swept_simplex.h>
#include <cellwalk/walk/walk.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// A wall at the vertex that moves.
template <int D>
struct Moving_wall {
  Half_facet facet;  ///< on the side to which it moves, if that is free
  Swept_simplex<D> swept;
};

/// How the walls meet a set.
struct Star_meeting {
  Encounter meeting = Encounter::apart;  ///< hit if one wall hits it, else touch if one touches it
  bool touches = false;                  ///< a wall touches it, whether another one hits it or not
  bool leaves = false;                   ///< of a touch: all walls that touch it leave it at once
  std::optional<Collision> collision;    ///< if one hits it: the first, if that was to be located
};

/// The cells around a vertex, all simplices, while it moves. The snapshot has the vertex where it goes, and
/// certifies nothing of these cells.
template <int D>
class Moving_star {
 public:
  /// \param from where the vertex was
  /// \param cells all cells that have the vertex, as names or in any order
  Moving_star(const Snapshot<D>& snapshot, std::uint32_t vertex, const Point<D>& from,
              std::span<const Cell> cells, Walk_counts& counts);

  const Snapshot<D>& snapshot() const { return snapshot_; }
  Walk_counts& counts() const { return counts_; }
  std::uint32_t vertex() const { return vertex_; }
  const Point<D>& from() const { return from_; }
  const Point<D>& to() const { return snapshot_.point(vertex_); }
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<Moving_wall<D>>& walls() const { return walls_; }
  /// The number of a wall that has the vertex, seen from a side with free space.
  std::size_t wall_of(Half_facet facet) const;
  /// The box of all that the walls sweep; empty if there are none.
  const Box<D>& box() const { return box_; }
  /// True for a cell that has the vertex.
  bool has(Cell cell) const;
  /// True for a facet that has it.
  bool has(Half_facet facet) const;

  /// How the walls meet a point, a segment or a triangle.
  /// \param locates if false, the collision is left out
  /// Cost: that of Swept_simplex::meet() a wall, and some 20 us a wall that hits it and is located.
  Star_meeting meet(std::span<const Point<D>> feature, bool locates) const;
  /// The collision of a wall with a set that it hits, as Swept_simplex::first_hit().
  Collision first_hit(std::size_t wall, std::span<const Point<D>> feature) const;

  /// True if a particle still lies in its cell: then it did so all the time, and met no wall.
  bool keeps_cell(const Particle<D>& p) const;
  /// True proves that an edge whose ends kept their cells is free and keeps its chain.
  /// \param facets the facets of its chain that have the vertex
  bool keeps_facets(const Chain& facets, const Point<D>& p, const Point<D>& q) const;
  /// The same just after the vertex began to move.
  bool keeps_cell_at_start(const Particle<D>& p) const;
  bool keeps_chain_at_start(const Chain& chain, const Point<D>& p, const Point<D>& q) const;
  /// The particle in a cell that holds it now, on the same side of all walls.
  /// \pre its cell has the vertex; it keeps its cell, or no wall touches it after the vertex began to move,
  ///      and it keeps its cell at the start
  Particle<D> registered(const Particle<D>& p) const;
  /// The particle in a cell that holds it now.
  Particle<D> registered_in(Cell cell, const Particle<D>& p) const;
  /// The chain of an edge.
  /// \pre no wall touches it after the vertex began to move, and it keeps its chain at the start
  /// \param before the chain before, from the cell `first` of p
  /// \param p, q the ends as registered() gives them
  Chain relinked(const Chain& before, Cell first, const Particle<D>& p, const Particle<D>& q) const;

 private:
  void add_wall(Half_facet facet, const Point<D>& from);
  int side_at_start(const Cell_view<D>& cell, std::size_t i, const Point<D>& x) const;
  int along_at_start(const Cell_view<D>& cell, std::size_t i, std::size_t k, const Point<D>& p,
                     const Point<D>& q) const;

  const Snapshot<D>& snapshot_;
  std::uint32_t vertex_;
  Point<D> from_;
  std::vector<Cell> cells_;  ///< ascending
  /// A hash table of them. The facets that have the vertex are found when they are needed.
  struct Slot {
    Cell cell = Cell::none;
    std::uint32_t known = 0, moving = 0;  ///< a bit for each of the first facets
  };
  Slot& slot_of(Cell cell) const;
  mutable std::vector<Slot> slots_;
  std::vector<Moving_wall<D>> walls_;
  Box<D> box_;
  Walk_counts& counts_;
};

extern template class Moving_star<2>;
extern template class Moving_star<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_MOVING_STAR_H
