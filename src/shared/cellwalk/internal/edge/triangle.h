// SPDX-License-Identifier: LGPL-3.0-or-later
// The complete sweep of a body edge: its chain is followed while one end moves. Theory: docs/sweep.md. Paper:
// section III, which checks three segments of the triangle.
#ifndef CELLWALK_INTERNAL_EDGE_TRIANGLE_H
#define CELLWALK_INTERNAL_EDGE_TRIANGLE_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk {

/// Sweeps the edge pq while p moves along its path and q stands still. Returns the chain of the edge after
/// the move, or the first contact: its normal is that of the wall.
///
/// The certificates are tried in this order: the ends share a cell; the edge still crosses its old chain;
/// that can be led round ridges; then the events are followed exactly. Touching a wall is no contact. If p is
/// blocked, only contacts of the edge before that time count (at equal times p's own comes first), and the
/// returned chain is the last one.
/// \param path the path of p
/// \param before the chain of the edge before the move
/// Degenerate cases: all positions of facets, ridges and vertices relative to the swept triangle. If it is a
/// segment (p moves in the line of the edge), a contact is only possible with a wall in that line that p
/// passes on the other side.
/// Cost: a few ns to some hundred ns for the certificates; about a microsecond an event and ten a contact in
/// general position; up to a millisecond if the triangle lies in planes of facets, which only concerns edges
/// that touch or hit a wall.
template <int D>
Sweep_result<D> sweep_triangle(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                               const Chain& before, Edge_counts& counts, bool has_certificates = true);

namespace detail {

/// The chains that an edge may have after its sweep, no two of them equal, in the order in which it prefers
/// their sides.
/// \param before the chain of the edge before the move
/// \pre !path.blocked
/// Cost: that of following the events for each combination of sides; of more than 256 the first ones.
template <int D>
std::vector<Chain> all_swept_chains(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                    const Particle<D>& q, const Chain& before, Walk_counts& counts);

}  // namespace detail

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_TRIANGLE_H
