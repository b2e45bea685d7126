// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that are opened and closed among residents, and cells that are filled and excavated. Theory:
// docs/cutting.md.
#ifndef CELLWALK_RESHAPE_TOGGLE_TOGGLE_H
#define CELLWALK_RESHAPE_TOGGLE_TOGGLE_H

#include <cellwalk/internal/environment/wall_editor.h>
#include <cellwalk/reshape/move.h>

#include <span>
#include <utility>
#include <vector>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// \pre of all members: no certificates of the environment are withdrawn
template <int D>
class Toggle {
 public:
  Toggle(Environment<D>& environment, Resident_groups<D>& groups, Walk_counts& counts)
      : editor_(environment), groups_(groups), counts_(counts) {}

  // As the members of Reshaping.
  Outcome open(Half_facet facet);
  Outcome close(Half_facet facet);
  Outcome excavate(Cell cell);
  Outcome fill(Cell cell);

 private:
  const Snapshot<D>& snapshot() const { return editor_.snapshot(); }
  using Rests = std::vector<std::pair<Member, Supporting_walls>>;
  Rests rests_without(std::span<const Half_facet> facets) const;
  void rest(Rests rests) noexcept;

  Wall_editor<D> editor_;
  Resident_groups<D>& groups_;
  Walk_counts& counts_;
};

extern template class Toggle<2>;
extern template class Toggle<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_TOGGLE_TOGGLE_H
