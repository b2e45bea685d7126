// SPDX-License-Identifier: LGPL-3.0-or-later
// Queries of motions of edges without a known chain: the ends are located, a chain is found, and then the
// edge is swept.
// Paper: section III.
#ifndef CELLWALK_QUERY_SWEEP_H
#define CELLWALK_QUERY_SWEEP_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/query/answer.h>
#include <cellwalk/walk/locate.h>

namespace cellwalk {

/// A motion of an edge: its end p moves to a target while its end q stands still.
template <int D>
struct Edge_motion {
  Point<D> p, target, q;
};

/// Answers a motion of an edge. The status is `outside` if an end is not in free space, or if the edge
/// crosses a wall before it moves. Sweep::faces is the same as Sweep::triangle, since an edge has no faces.
///
/// An end on a wall with free space on several sides may belong to each of them, and the edge may pass walls
/// in its line on several sides. Those are chosen with which the motion gets furthest, by exact times; in
/// ties those with the lowest index of the cell of p, then of the cell of q.
/// \param snapshot of the environment
/// \param locator finds the cells of both ends
/// \param motion of finite points
/// \param options the sweep
/// \param counts raised by the query
/// \pre the locator is that of the snapshot
/// \throw Error(input) for a point that is not finite; Error(usage) as Locator::locate(), and for a search of
///        a tolerance not in (0,1]
/// Cost: that of locating two points, finding a chain and sweep_edge(), for each combination of sides.
/// Thread-safe, if each thread has its own counts.
template <int D>
Answer<D> answer_sweep(const Snapshot<D>& snapshot, const Locator<D>& locator, const Edge_motion<D>& motion,
                       const Sweep_options& options, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_SWEEP_H
