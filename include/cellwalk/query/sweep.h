// SPDX-License-Identifier: LGPL-3.0-or-later
// Questions about motions of edges that were in no cell before: located, linked, then swept.
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

/// Answers a motion of an edge. Outside: an end is not in free space, or the edge crosses a wall before it moves. An edge alone has no
/// face: Sweep::faces is Sweep::triangle.
///
/// An end that stands on a wall with free space on several sides belongs to any of them: of the sides between which the
/// edge has a chain, those are taken with which the motion gets furthest by exact times, the cell of p of lowest index
/// first, then that of q. What is searched otherwise, is searched there.
/// \pre the locator is that of the snapshot; all points are finite; options.tolerance lies in (0,1]
/// Cost: that of locating two points, finding a chain and sweep_edge(), for each pair of sides. May be called from many threads,
/// each with its counts.
template <int D>
Answer<D> answer_sweep(const Snapshot<D>& snapshot, const Locator<D>& locator, const Edge_motion<D>& motion,
                       const Sweep_options& options, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_SWEEP_H
