// SPDX-License-Identifier: LGPL-3.0-or-later
// The star index and the layout of clusters, read from one environment and given to another.
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/environment_history.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <memory>

#include "environment_image.h"

namespace cellwalk::detail {

template <int D>
Environment_history Environment_image<D>::history(const Environment<D>& environment) {
  Environment_history history;
  if (environment.stars_) {
    history.stars.emplace();
    environment.stars_->tell(history.stars->first, history.stars->other_parts);
  }
  environment.snapshot_->clusters_.tell(history.cluster_size, history.cluster_places);
  return history;
}

template <int D>
void Environment_image<D>::follow(Environment<D>& environment, const Environment_history& history) {
  const Snapshot<D>& snapshot = *environment.snapshot_;
  const auto is_good = [&](Cell cell) { return cell == Cell::none || snapshot.is_cell(cell); };
  if (history.stars) {
    const auto& [first, other_parts] = *history.stars;
    bool fits = first.size() <= snapshot.points().size() && std::ranges::all_of(first, is_good);
    for (const auto& [point, cell] : other_parts)
      fits = fits && point < first.size() && snapshot.is_cell(cell);
    if (!fits)
      throw Error(Error_code::input, "the history of an environment is damaged: it is not of this one");
    environment.stars_ = std::make_unique<Star_index<D>>(first, other_parts);
  }
  if (history.cluster_size != 0 &&
      !environment.snapshot_->clusters_.lay_out(snapshot, history.cluster_size, history.cluster_places))
    throw Error(Error_code::input, "the history of an environment is damaged: it is not of this one");
}

template <int D>
Environment_history history_of(const Environment<D>& environment) {
  return Environment_image<D>::history(environment);
}

template <int D>
void follow_history(Environment<D>& environment, const Environment_history& history) {
  Environment_image<D>::follow(environment, history);
}

template Environment_history history_of(const Environment<2>&);
template Environment_history history_of(const Environment<3>&);
template void follow_history(Environment<2>&, const Environment_history&);
template void follow_history(Environment<3>&, const Environment_history&);

}  // namespace cellwalk::detail
