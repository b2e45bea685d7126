// SPDX-License-Identifier: LGPL-3.0-or-later
// The strategies of the walk, for those who repeat the paper (section II): all find the same by exact signs.
#ifndef CELLWALK_WALK_STRATEGY_H
#define CELLWALK_WALK_STRATEGY_H

#include <cellwalk/walk/walk.h>

namespace cellwalk {

/// The method that finds the exit facet of a cell.
enum class Walk_strategy {
  certified,          ///< planes with an error bound first, exact signs if they are undecided; with policies
                      ///< that use no certificates the exit rule
  exit_rule,          ///< exact signs of all facets, then of the ridges
  predictive_simplex  ///< the paper's: turn from facet to facet until the target lies in the cone of the
                      ///< aimed facet
};

/// As the other walk(), which is certified.
template <class Kernel = Exact, int D>
Walk_result<D> walk(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, Walk_strategy strategy, const Walk_options& options = {});

/// As the other move(), which is certified.
template <class Kernel = Exact, int D>
Walk_result<D> move(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, Walk_strategy strategy, const Walk_options& options = {});

}  // namespace cellwalk

#endif  // CELLWALK_WALK_STRATEGY_H
