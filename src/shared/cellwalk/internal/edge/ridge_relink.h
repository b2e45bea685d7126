// SPDX-License-Identifier: LGPL-3.0-or-later
// A chain led round the ridges that its edge passes on the way. Theory: docs/sweep.md, relinking at ridges.
#ifndef CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H
#define CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/certain_line.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// The corners of the facets of a word, one after the other, in two runs.
template <int D>
struct Word_corners {
  std::span<const Facet_corners<D>> first, second;

  /// Those of the next facet.
  std::span<const Facet_corners<D>> front() const {
    const std::span<const Facet_corners<D>>& run = first.empty() ? second : first;
    std::size_t parts = 1;
    while (run[parts - 1].continues) ++parts;
    return run.first(parts);
  }
  void drop_front() {
    std::span<const Facet_corners<D>>& run = first.empty() ? second : first;
    run = run.subspan(front().size());
  }
};

/// Leads a word round ridges until a line certainly passes it: runs of facets that have but one ridge beyond
/// the line, the same in all, are exchanged for those on the other side of the ridge. Then the edge is free
/// on its way, and the new word is its chain.
/// \param line leads from the moved end to the other one, or backwards, so that it should pass the facets
///        outwards
/// \param ends the first end of the edge and the second, in the frame
/// \param word the facets seen from the cells on the side of the first end of the edge
/// \param corners those of the word
/// \param chain set to the new word, `its_corners` to those of its facets
/// False is inconclusive.
/// Cost: some 40 operations on lanes a facet of the word, and reading the corners of those exchanged.
template <int D>
bool relink_at_ridges(const Snapshot<D>& snapshot, const Certain_line<D>& line,
                      const std::array<Spread_point<D>, 2>& ends, std::span<const Half_facet> word,
                      Word_corners<D> corners, Chain& chain, std::vector<Facet_corners<D>>& its_corners);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H
