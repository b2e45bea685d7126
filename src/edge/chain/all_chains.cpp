// SPDX-License-Identifier: LGPL-3.0-or-later
// The repeated search for a chain that equals none of those found before.
#include <cellwalk/internal/edge/all_chains.h>
#include <cellwalk/internal/walk/sides_taken.h>

#include "link.h"

namespace cellwalk::detail {

template <int D>
std::vector<Chain> all_chains(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                              Walk_counts& counts) {
  std::vector<Chain> chains;
  Sides_taken choices;
  std::vector<Half_facet> crossed;
  Walk_options options;
  options.crossed = &crossed;
  options.locates_contact = false;
  for (int tries = 0; tries < most_side_tries; ++tries) {
    crossed.clear();
    const Walk_result<D> walked = walk_on_sides(snapshot, p, q.position, counts, options, choices);
    if (walked.status == Walk_status::arrived) {
      Chain chain(crossed.begin(), crossed.end());
      if (append_link(snapshot, chain, walked.cell, q.cell, q.position, counts) == Half_facet::none)
        chains.push_back(std::move(chain));
    }
    if (!take_next_sides(choices)) break;
  }
  return chains;
}

template std::vector<Chain> all_chains(const Snapshot<2>&, const Particle<2>&, const Particle<2>&,
                                       Walk_counts&);
template std::vector<Chain> all_chains(const Snapshot<3>&, const Particle<3>&, const Particle<3>&,
                                       Walk_counts&);

}  // namespace cellwalk::detail
