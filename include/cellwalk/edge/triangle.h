// SPDX-License-Identifier: LGPL-3.0-or-later
// The complete sweep of a body edge: its chain is carried along while one end moves. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_TRIANGLE_H
#define CELLWALK_EDGE_TRIANGLE_H

#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/flood.h>

#include <cstdint>
#include <optional>
#include <span>

namespace cellwalk {

/// A walk of p, as Walk_options report it.
template <int D>
struct Way {
  Particle<D> from, to;
  std::span<const Cell> visited;
  std::span<const Half_facet> crossed;
  /// True if a wall blocked p: to.position is then where it was going, and the edge is swept until p is blocked.
  bool blocked = false;
  /// True if it is known that p met no wall on its way, and passed each facet strictly inside.
  bool is_apart = false;
};

/// What becomes of an edge that is swept.
template <int D>
struct Sweep_result {
  std::optional<Contact<D>> contact;  ///< none: the move is free
  Chain chain;                        ///< of the edge after the move
  // Of sweep_edge() only:
  Particle<D> p{};          ///< after the move, or where it was
  std::uint32_t cells = 0;  ///< visited by p
};

/// Sweeps the edge pq while p goes its way and q stands still. Returns the chain of the edge afterwards, or the first contact:
/// its normal is that of the wall.
///
/// Tried in this order: the ends share a cell; the edge passes its old chain still; no wall meets the swept triangle; the
/// events, one by one, exactly. Touching a wall is no contact. If p is blocked, a contact is one of the edge before
/// that time (at that time, p's own comes first), and the chain returned is the last one.
/// \pre `before` is the chain of the edge before the move
/// Degenerate cases: all positions of facets, ridges and vertices against the swept triangle. Where it is a segment (p moves in
/// the line of the edge), a contact can only be with a wall in that line of which p takes the other side.
/// Cost: a few ns to some hundred ns for the certificates; about a microsecond an event and ten a contact in general position,
/// up to a millisecond where the triangle lies in planes of facets, for what only edges that touch or hit a wall get to.
template <int D>
Sweep_result<D> sweep_triangle(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                               const Chain& before, Edge_counts& counts,
                               const Edge_certificates& certificates = {});

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_TRIANGLE_H
