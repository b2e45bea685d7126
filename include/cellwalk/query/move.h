// SPDX-License-Identifier: LGPL-3.0-or-later
// Queries of motions of points without a known cell: the point is located, and then walked.
#ifndef CELLWALK_QUERY_MOVE_H
#define CELLWALK_QUERY_MOVE_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/query/answer.h>
#include <cellwalk/walk/locate.h>

namespace cellwalk {

/// Answers a motion from one point to another. A start on a wall with free space on several sides may belong
/// to each of them: the side on which the motion gets furthest is chosen, in ties the one with the cell of
/// lowest index. The time of a contact is exact.
/// \param snapshot of the environment
/// \param locator finds the cells of the start
/// \param from,to the ends of the motion, finite
/// \param touch the touch policy
/// \param counts raised by the query
/// \pre the locator is that of the snapshot
/// \throw Error(input) for a point that is not finite; Error(usage) as Locator::locate()
/// Cost: that of locating the start and of the walk, for each side. Thread-safe, if each thread has its own
/// counts.
template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, Touch touch, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_MOVE_H
