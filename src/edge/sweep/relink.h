// SPDX-License-Identifier: LGPL-3.0-or-later
// The continuation of an edge that moves in the plane of facets, through any of which it may change sides.
// Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_SWEEP_RELINK_H
#define CELLWALK_EDGE_SWEEP_RELINK_H

#include <cellwalk/edge/chain.h>

#include <vector>

#include "edge/exact/moving_line.h"

namespace cellwalk::detail {

/// A chain of the edge just after a time, and the time until which it remains the chain.
template <int D>
struct Relinked {
  Chain chain;
  Event_time<D> end;
};

/// A chain of the edge just after a time that starts in a cell of p and is equal to a given one at that time;
/// none if there is none. It serves triangles in the plane of facets, where the edge may change sides
/// anywhere in a facet, not only where it leaves a cell; for others the result is none. Of several chains it
/// is the one that, from p on, stays as far as possible on the side of walls in that plane on which the
/// displaced edge lies, see displaced_side().
/// \param rank how many of these to leave out, in the order of preference
/// \param found if not null, those of earlier calls for the same time and chain; others are appended, up to
///        one after the rank, so that there is one after it if they are more than rank + 1
/// \pre the chain is valid at line.time() < 1, and starts in that cell
/// Cost: some signs a facet of the cells near the triangle if the plane of none contains it; otherwise up to
/// a millisecond for each chain that was not found before, and as much for each earlier one that its search
/// meets again: exact numbers for all facets of the cells linked with the edge.
template <int D>
std::optional<Relinked<D>> relink(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start,
                                  const Particle<D>& q, const Chain& chain, std::size_t rank = 0,
                                  std::vector<Chain>* found = nullptr);

/// True if a wall near the triangle lies in its plane.
/// \pre p is in that cell before it moves
bool has_wall_in_plane(const Snapshot<3>& snapshot, const Moving_line<3>& line, Cell start);
inline bool has_wall_in_plane(const Snapshot<2>&, const Moving_line<2>&, Cell) { return false; }

extern template std::optional<Relinked<2>> relink<2>(const Snapshot<2>&, const Moving_line<2>&, Cell,
                                                     const Particle<2>&, const Chain&, std::size_t,
                                                     std::vector<Chain>*);
extern template std::optional<Relinked<3>> relink<3>(const Snapshot<3>&, const Moving_line<3>&, Cell,
                                                     const Particle<3>&, const Chain&, std::size_t,
                                                     std::vector<Chain>*);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_RELINK_H
