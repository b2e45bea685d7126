// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains of edges after edits, on the sides of walls on which they were. Theory: docs/bodies.md,
// registration.
#ifndef CELLWALK_INTERNAL_EDGE_CHAIN_AS_BEFORE_H
#define CELLWALK_INTERNAL_EDGE_CHAIN_AS_BEFORE_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/environment/edit_log.h>

namespace cellwalk::detail {

/// How an edge was registered before edits, with the names of today.
struct Edge_before {
  Cell start, end;
  const Chain& chain;
};

/// Whether all cells of the chain are there still, and the segment passed it.
template <int D>
bool was_chain(const Snapshot<D>& snapshot, const Edits_since& edits, const Point<D>& p, const Point<D>& q,
               const Edge_before& before, Walk_counts& counts);

/// The same as find_any_chain(), of the chains that are linked with an earlier one at each point of the
/// segment by facets that were passable then: so it passes no wall that stood before on another side.
/// \pre was_chain()
/// Cost: that of find_any_chain(); rational arithmetic for facets of the cells along the segment, unless it
/// finds the earlier chain.
template <int D>
Chain_result<D> find_chain_as_before(const Snapshot<D>& snapshot, const Edits_since& edits,
                                     const Particle<D>& p, const Particle<D>& q, const Edge_before& before,
                                     Walk_counts& counts);

#define CELLWALK_DECLARE(D)                                                                       \
  extern template bool was_chain<D>(const Snapshot<D>&, const Edits_since&, const Point<D>&,      \
                                    const Point<D>&, const Edge_before&, Walk_counts&);           \
  extern template Chain_result<D> find_chain_as_before<D>(const Snapshot<D>&, const Edits_since&, \
                                                          const Particle<D>&, const Particle<D>&, \
                                                          const Edge_before&, Walk_counts&);
CELLWALK_DECLARE(2)
CELLWALK_DECLARE(3)
#undef CELLWALK_DECLARE

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_CHAIN_AS_BEFORE_H
