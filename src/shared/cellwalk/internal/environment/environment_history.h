// SPDX-License-Identifier: LGPL-3.0-or-later
// The choices of an environment in the course of its edits that its arrays do not store. A compiled copy that
// follows it does exactly what the environment itself would have done: the same answers in the same order,
// and the same counts.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_ENVIRONMENT_HISTORY_H
#define CELLWALK_INTERNAL_ENVIRONMENT_ENVIRONMENT_HISTORY_H

#include <cellwalk/environment/environment.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace cellwalk::detail {

struct Environment_history {
  /// With which cell of each point the search for the others begins, and of further parts of pinched points.
  struct Stars {
    std::vector<Cell> first;
    std::vector<std::pair<std::uint32_t, Cell>> other_parts;

    template <class Archive>
    void archive(Archive& a) {
      a(first, other_parts);
    }
  };
  std::optional<Stars> stars;  ///< none: no vertex was moved yet
  /// Names of cells in each cluster, and for how many clusters there is room; 0: there are none yet.
  std::uint32_t cluster_size = 0;
  std::uint64_t cluster_places = 0;

  template <class Archive>
  void archive(Archive& a) {
    a(stars, cluster_size, cluster_places);
  }
};

/// Cost: a copy of a number for each point.
template <int D>
Environment_history history_of(const Environment<D>& environment);

/// \pre the environment is a compiled copy of the one with that history, and was not queried yet; nor is it
///      moved afterwards, as clusters of cells stay behind then
/// \throw Error(input) for a history that is not of this environment
template <int D>
void follow_history(Environment<D>& environment, const Environment_history& history);

extern template Environment_history history_of(const Environment<2>&);
extern template Environment_history history_of(const Environment<3>&);
extern template void follow_history(Environment<2>&, const Environment_history&);
extern template void follow_history(Environment<3>&, const Environment_history&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_ENVIRONMENT_HISTORY_H
