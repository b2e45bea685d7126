// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's two searches for the contact of an edge that is known to have one. Paper: section III.
#ifndef CELLWALK_EDGE_CONTACT_CONTACT_SEARCH_H
#define CELLWALK_EDGE_CONTACT_CONTACT_SEARCH_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <functional>
#include <optional>
#include <span>

namespace cellwalk::detail {

/// The complete sweep of an edge to the end, or until a time.
template <int D>
using Sweep_until = std::function<Sweep_result<D>(std::optional<double> until)>;

/// Bisects the time: the sweep is free until the result's time, and blocked no later than `tolerance` after
/// it. The normal is that at the vertex of the last intersected dart: the mean of the walls around it.
/// \pre the sweep to the end has a contact
template <int D>
Contact<D> dichotomic_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                             const Sweep_until<D>& sweep_until, double tolerance, Edge_counts& counts);

/// The paper's bisection by walks of a temporary particle along the edge, each from p(s), rounded, to which p
/// is walked from the last s that was free. The edge is free at the result's time, and blocked no later than
/// `tolerance` after it; it may have been blocked before. None if the edge is free at the end, or at all
/// times tried before a wall stops p. The normal is that at the vertex nearest to the end of the last blocked
/// walk.
template <int D>
std::optional<Contact<D>> segment_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                         const Particle<D>& q, double tolerance, Edge_counts& counts);

/// The cells that the edge crosses at its end, as in the paper's search.
template <int D>
Flooded traversed_cells(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                        Edge_counts& counts);

/// All cells that the triangle meets.
template <int D>
Flooded flooded_cells(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                      Edge_counts& counts);

/// The first of the obstacle vertices (2D) or edges (3D) of these cells that meet the closed swept triangle
/// off its start: the one of smallest angle at q. With `below`, obstacles that signs find outside the
/// triangle are skipped, which does not change the answer. None if the cells have no such obstacle; an
/// obstacle that is only touched counts.
template <int D>
std::optional<Contact<D>> exhaustive_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                            const Particle<D>& q, std::span<const Cell> cells, bool below,
                                            Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_CONTACT_SEARCH_H
