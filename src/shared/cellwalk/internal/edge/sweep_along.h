// SPDX-License-Identifier: LGPL-3.0-or-later
// Sweeps of an edge along the known path of its end.
#ifndef CELLWALK_INTERNAL_EDGE_SWEEP_ALONG_H
#define CELLWALK_INTERNAL_EDGE_SWEEP_ALONG_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <optional>

namespace cellwalk {

/// Sweeps one edge of a vertex whose walk is known. Only contacts of the edge before p is blocked count; with
/// Touch::stop those of p as well. The result's p and cells are not set.
/// \param snapshot in which the edge lies
/// \param path the path of p
/// \param q the end that stands still
/// \param before the chain of the edge before the move
/// \param options the sweep
/// \param counts raised by the sweep
/// \param met the first contact of the complete sweep, if it is known: it is not looked for again
/// \pre if the path is blocked, path.visited holds the cells of the walk
template <int D>
Sweep_result<D> sweep_edge_along(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                 const Particle<D>& q, const Chain& before, const Sweep_options& options,
                                 Edge_counts& counts, const std::optional<Contact<D>>& met = {});

/// The chain of an edge that is free.
struct Free_chain {
  Chain chain;
  /// True proves that the closed swept triangle meets no wall, except possibly at the start position of the
  /// edge or in q. False is inconclusive.
  bool is_apart = false;
};

/// Tests whether the edge is free while p moves along a free path, and returns its chain after the move, or
/// none. It decides like sweep_edge_along() with Touch::pass, but does not locate a contact, which is the
/// most expensive part.
/// \param snapshot in which the edge lies
/// \param path the path of p
/// \param q the end that stands still
/// \param before the chain of the edge before the move
/// \param options the sweep and its certificates
/// \param counts raised by the sweep
/// \pre !path.blocked
/// Cost: that of the sweep; if a wall pierces the swept triangle, some twenty signs.
template <int D>
std::optional<Free_chain> free_chain(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                     const Particle<D>& q, const Chain& before, const Sweep_options& options,
                                     Edge_counts& counts);

/// The first point at which a closed wall meets the edge that sweeps a closed triangle, including its start
/// position; for a = q the first point at which a wall meets the segment ab. This is a hit in the sense of
/// traces: it depends on the geometry only, not on the side of a wall on which the edge lies.
/// \pre a lies in the closure of `start`, a free cell
/// \throw Error(usage) if there is no such cell; Error(input) for a corner that is not finite
/// Cost: as first_touch().
template <int D>
std::optional<Contact<D>> closed_meeting(const Snapshot<D>& snapshot, Cell start,
                                         const Swept_triangle<D>& triangle, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_SWEEP_ALONG_H
