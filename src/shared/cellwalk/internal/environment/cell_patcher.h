// SPDX-License-Identifier: LGPL-3.0-or-later
// The replacement of some cells of an environment by others, in map, snapshot and indices alike. The
// residents of the cells are left to the caller.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_PATCHER_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_PATCHER_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/gluing.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// Glues a few cells whose points are those of a snapshot: facets with the same points. soup.points is
/// ignored.
/// \pre no facet has more than two sides, and these run against each other
template <int D>
Gluing glue_patch(const Cell_soup<D>& soup);

template <int D>
class Cell_patcher {
 public:
  explicit Cell_patcher(Environment<D>& environment) : environment_(environment) {}

  const Snapshot<D>& snapshot() const { return *environment_.snapshot_; }

  /// Fetches into the cache the parts of the map that replace() reads, while the caller does something else.
  void prefetch(std::span<const Cell> cells) const;

  /// Replaces cells by those of a soup, see Snapshot::replace_cells(), which gives them indices and names.
  /// Points that no cell has any more are removed: later new points reuse their indices. The boundary keeps
  /// its marks. Returns the new cells in order. An error changes nothing.
  /// \param added a new point of the soup, where it has snapshot().next_point()
  /// \pre the result is certified, and the removed cells at a point are linked through facets that have it
  /// \throw Error(usage) if the environment is frozen
  /// Cost: that of the cells, whatever the size of the environment.
  std::vector<Cell> replace(std::span<const Cell> removed, const Cell_soup<D>& soup, const Gluing& gluing,
                            const std::optional<Point<D>>& added = {});

 private:
  Environment<D>& environment_;
};

extern template class Cell_patcher<2>;
extern template class Cell_patcher<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_PATCHER_H
