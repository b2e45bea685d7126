// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of an edge in general position: it passes its chain in the interiors of facets, until it meets
// one ridge, round which it goes on or stops. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_SWEEP_STRICT_PASSAGE_H
#define CELLWALK_EDGE_SWEEP_STRICT_PASSAGE_H

#include <cellwalk/edge/chain.h>

#include <cstddef>
#include <optional>

#include "edge/chain/ridge.h"
#include "edge/exact/moving_line.h"

namespace cellwalk::detail {

/// The passage of an edge through the interiors of the facets of a chain.
template <int D>
struct Strict_passage {
  /// The first later time at which p comes to the plane of one of the facets, or the edge to the line of one
  /// of their ridges; none before 1.
  std::optional<Event_time<D>> end;
  std::size_t place = 0;       ///< of that facet in the chain, the first one
  std::optional<Ridge> ridge;  ///< if this alone happens then: the edge passes its inside
};

/// None if the edge does not pass all facets of a chain in their interiors just after line.time(), or if
/// there are none and q lies in a facet. Otherwise no other chain is valid then, and the triangle lies in the
/// plane of no facet of the cells passed.
/// \param from the place of the first facet that is examined
/// \pre the chain begins in a cell of p just after that time, and the edge passes the facets before `from`
/// Cost: two signs for each facet and each of its ridges.
template <int D>
std::optional<Strict_passage<D>> pass_strictly(const Snapshot<D>& snapshot, const Moving_line<D>& line,
                                               const Chain& chain, const Particle<D>& q,
                                               std::size_t from = 0);

/// Replaces the facets of a chain at a ridge by those on the other way round it, up to the first wall, which
/// is then the last facet. False if cells do not share their points there.
/// \param place of the first facet at the ridge
/// \param turned the chain then
template <int D>
bool turn_round(const Snapshot<D>& snapshot, const Chain& chain, std::size_t place, const Ridge& ridge,
                Chain& turned);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_STRICT_PASSAGE_H
