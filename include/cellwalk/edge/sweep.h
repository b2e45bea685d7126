// SPDX-License-Identifier: LGPL-3.0-or-later
// Is the move of a vertex with an edge at it free, and if not, where is the first contact? One interface to all sweeps and
// searches. Paper: section III. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_SWEEP_H
#define CELLWALK_EDGE_SWEEP_H

#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/triangle.h>

#include <optional>

namespace cellwalk {

/// What is checked of a moving edge.
enum class Sweep {
  /// The way of p, then the edge where that ends, or where a wall stops p: the paper's; misses obstacles that fit between.
  three_segments,
  triangle,  ///< the whole swept triangle
  faces      ///< that, and what body faces sweep; a single edge has none
};

/// What counts as a contact.
enum class Touch {
  pass,  ///< a wall that cannot be passed: touching is free
  stop   ///< also a closed wall that meets the closed swept triangle off its start
};

/// How a contact is located, once it is known that there is one.
enum class Contact_search {
  exact,       ///< the first event at which the motion cannot go on
  dichotomic,  ///< bisection of complete sweeps: the longest motion found free, within a bound
  /// The paper's bisection: only a temporary particle walks along the edge, each time from where p is then. The edge is free at
  /// the time found and blocked within a bound after it; but what it met and left before that is not seen, so the time may be late.
  dichotomic_segment,
  exhaustive  ///< the first of the obstacle vertices (2D) or edges (3D) of the cells met that lie in the swept triangle
};

/// The cells whose obstacles an exhaustive search looks at.
enum class Search_cells {
  flooded,   ///< those that the swept triangle meets: complete
  traversed  ///< those that the edge passes at its end: the paper's
};

struct Sweep_options {
  Sweep sweep = Sweep::triangle;
  Touch touch = Touch::pass;
  Contact_search search = Contact_search::exact;
  Search_cells cells = Search_cells::flooded;
  /// Of an exhaustive search: obstacles that signs find outside of the swept triangle, above the edge at its end, are not
  /// computed with. Without this all of the cells are, for the same answer.
  bool below = true;
  Edge_certificates certificates{};
  double tolerance = 0x1p-20;  ///< of dichotomic searches: length of the last interval of time, in (0,1]
};

template <int D>
struct Sweep_result {
  std::optional<Contact<D>> contact;  ///< none: the move is free
  Particle<D> p;                      ///< after the move, or where it was
  Chain chain;                        ///< of the edge then
  std::uint32_t cells = 0;            ///< visited by p
};

/// Moves p to a target, with an edge from it to q, which stands still.
/// \pre p and q satisfy I1, `before` is the chain of the edge, the target is finite, options.tolerance lies in (0,1]
/// \throw Error(usage) for p or q in a cell that an edit removed, if no other has its name yet
/// Degenerate cases: all are decided, see sweep_triangle(). Cost: that of the walk and the sweep; then of the search:
/// exact: included; dichotomic: log2(1/tolerance) sweeps; dichotomic_segment: as many walks of p and of the edge;
/// exhaustive: some rational arithmetic for each wall of the cells.
template <int D>
Sweep_result<D> sweep_edge(const Snapshot<D>& snapshot, const Particle<D>& p, const Point<D>& target,
                           const Particle<D>& q, const Chain& before, const Sweep_options& options,
                           Edge_counts& counts);

/// The same for one edge of a vertex whose walk is known: a contact of the edge, before p is blocked if it is. The result's
/// p and cells are not set. Touch::stop counts what p touches as well.
template <int D>
Sweep_result<D> sweep_edge_along(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                                 const Chain& before, const Sweep_options& options, Edge_counts& counts);

/// The chain of an edge that is free.
struct Free_chain {
  Chain chain;
  /// Proved on the way: the closed swept triangle meets no wall, but perhaps on the edge where it started or in q. False proves
  /// nothing.
  bool is_apart = false;
};

/// Only whether the edge is free while p goes a way on which nothing blocks it: its chain then, or none. Decides as
/// sweep_edge_along() does, Touch::pass, but locates no contact, which costs more than all else.
/// \pre !way.blocked
/// Cost: that of the sweep; where a wall pierces the swept triangle, some twenty signs to see that.
template <int D>
std::optional<Free_chain> free_chain(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                                     const Chain& before, const Sweep_options& options, Edge_counts& counts);

/// The contact of a vertex that goes from one point to another and is blocked, as its walk reported.
/// Cost: some signs for each facet of the last cell, and a rational number.
template <int D>
Contact<D> vertex_contact(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& target,
                          const Wall_contact<D>& met, Walk_counts& counts);

/// Touch::stop for a particle without edges: the first point off its start at which its motion meets a closed wall, or where it
/// is blocked.
/// Cost: that of a walk and a flood along it, and rational arithmetic for each wall near it.
template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, const Particle<D>& p,
                                      const Point<D>& target, Edge_counts& counts);

/// The first point at which a closed wall meets the edge that sweeps a closed triangle, the edge where it starts included; for
/// a = q that at which one meets the segment ab. What a trace counts as a hit: geometry alone, on whichever side of a wall the edge is.
/// \pre a lies in the closure of `start`, a free cell
/// Cost: as first_touch().
template <int D>
std::optional<Contact<D>> closed_meeting(const Snapshot<D>& snapshot, Cell start,
                                         const Swept_triangle<D>& triangle, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_SWEEP_H
