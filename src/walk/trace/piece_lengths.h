// SPDX-License-Identifier: LGPL-3.0-or-later
// The lengths of the pieces of a motion from the places at which it leaves its cells, whatever these are.
#ifndef CELLWALK_WALK_TRACE_PIECE_LENGTHS_H
#define CELLWALK_WALK_TRACE_PIECE_LENGTHS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/walk.h>

#include <span>
#include <vector>

namespace cellwalk::detail {

/// The length of the piece of a motion in each cell, rounded to nearest, of two as near to the even one.
/// \param from,to the ends of the motion
/// \param exits of the cells, in order; if there is one less than there are cells, the motion ends in the
///        last
/// \param cells their number
/// \param lengths to which they are appended; a negative number for a piece that is a point
/// Cost: about 0.3 us a piece, some microseconds for one that begins or ends at a ridge or vertex.
template <int D>
void append_lengths(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& to,
                    std::span<const Cell_exit> exits, std::size_t cells, std::vector<double>& lengths);

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_PIECE_LENGTHS_H
