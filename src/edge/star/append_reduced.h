// SPDX-License-Identifier: LGPL-3.0-or-later
// Free reduction of words of facets. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_STAR_APPEND_REDUCED_H
#define CELLWALK_EDGE_STAR_APPEND_REDUCED_H

#include <cellwalk/edge/chain.h>

namespace cellwalk::detail {

/// Appends a facet to a word, or deletes the last one if it is the same in the other direction.
template <int D>
void append_reduced(const Snapshot<D>& snapshot, Chain& chain, Half_facet f) {
  if (!chain.empty() && snapshot.neighbour(f) == snapshot.cell_of(chain.back()) &&
      snapshot.opposite(f) == chain.back())
    chain.pop_back();
  else
    chain.push_back(f);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_STAR_APPEND_REDUCED_H
