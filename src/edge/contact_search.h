// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's two searches for the contact of an edge that is known to have one. Paper: section III.
#ifndef CELLWALK_EDGE_CONTACT_SEARCH_H
#define CELLWALK_EDGE_CONTACT_SEARCH_H

#include <cellwalk/edge/sweep.h>

namespace cellwalk::detail {

/// Bisects the time: the sweep until the result's time is free, and blocked no later than `tolerance` after it. The normal is
/// that at the vertex of the last intersected dart: the mean of the walls round it.
/// \pre the complete sweep has a contact
template <int D>
Contact<D> dichotomic_search(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                             const Chain& before, double tolerance, Edge_counts& counts);

/// The paper's bisection: walks of a temporary particle along the edge, each from p(s), rounded, to which p is walked from the
/// last s that was free. The edge is free at the result's time, and blocked no later than `tolerance` after it; it may have been
/// blocked before, unseen. None, if the edge is free at the end, or at all times tried before a wall stops p. The normal is that at
/// the vertex nearest to where the last walk was blocked.
template <int D>
std::optional<Contact<D>> segment_search(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                                         double tolerance, Edge_counts& counts);

/// Where an exhaustive search looks, see Sweep_options.
struct Search_limits {
  Search_cells cells = Search_cells::flooded;
  bool below = true;
};

/// The first of the obstacle vertices (2D) or edges (3D) that meet the closed swept triangle off its start: the one of
/// smallest angle at q. Those of the cells that the triangle meets, or that [p,q] passes at the end.
/// None, if these cells have no such obstacle; an obstacle that is merely touched counts.
template <int D>
std::optional<Contact<D>> exhaustive_search(const Snapshot<D>& snapshot, const Way<D>& way,
                                            const Particle<D>& q, const Search_limits& limits,
                                            Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONTACT_SEARCH_H
