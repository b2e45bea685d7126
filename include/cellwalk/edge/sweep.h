// SPDX-License-Identifier: LGPL-3.0-or-later
// The first contact of a vertex and an edge at it during a move: a common interface to all sweeps. Paper:
// section III. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_SWEEP_H
#define CELLWALK_EDGE_SWEEP_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/walk/contact.h>

#include <optional>

namespace cellwalk {

/// The check of a moving edge.
enum class Sweep {
  /// The paper's: the path of p, then the edge at its end, or where a wall stops p. Misses obstacles that fit
  /// between.
  three_segments,
  triangle,  ///< the whole swept triangle
  faces      ///< the same, and the tetrahedra swept by body faces; a single edge has no face
};

/// The touch policy: the events that count as contacts.
enum class Touch {
  pass,  ///< a wall that blocks the motion: touching is free
  stop   ///< also a closed wall that meets the closed swept triangle off its start
};

struct Search_options;

struct Sweep_options {
  Sweep sweep = Sweep::triangle;
  Touch touch = Touch::pass;
  bool certificates = true;  ///< false: events decide all; this costs time, and changes no answer
  /// If set, edges locate their contacts by a search of the paper (<cellwalk/paper.h>), not at the first
  /// event after which the motion cannot be continued. It is read during the call only.
  const Search_options* search = nullptr;
};

/// Moves p to a target, with an edge from it to q, which stands still: free if it is on some sides of walls.
/// \param snapshot in which the edge lies
/// \param p the end that moves
/// \param target finite
/// \param q the end that stands still
/// \param before the chain of the edge before the move
/// \param options the sweep
/// \param counts raised by the sweep
/// \pre p and q satisfy I1
/// \throw Error(usage) for p or q without a cell, or in one that an edit removed, if its name is not reused,
///        and for a search of a tolerance not in (0,1]; Error(input) for a target or q that is not finite
/// Degenerate cases: all are decided, see sweep_triangle().
/// Cost: that of the walk and the sweep, and of a search.
template <int D>
Sweep_result<D> sweep_edge(const Snapshot<D>& snapshot, const Particle<D>& p, const Point<D>& target,
                           const Particle<D>& q, const Chain& before, const Sweep_options& options,
                           Edge_counts& counts);

/// The contact of a vertex whose walk from one point to another is blocked.
/// \param snapshot in which the vertex walks
/// \param from,target the ends of the motion
/// \param met the contact of that walk, whose place and normal are taken over
/// \param counts raised by the tests
/// \pre the signs of the walk were exact: the target lies outside the cell met.cell
/// Cost: some signs for each facet of the last cell, and a rational number.
template <int D>
Contact<D> vertex_contact(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& target,
                          const Contact<D>& met, Walk_counts& counts);

/// Touch::stop for a particle without edges: the first point off its start at which its motion meets a closed
/// wall or is blocked.
/// \throw Error as walk()
/// Cost: that of a walk and a flood along it, and rational arithmetic for each wall near it.
template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, const Particle<D>& p,
                                      const Point<D>& target, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_SWEEP_H
