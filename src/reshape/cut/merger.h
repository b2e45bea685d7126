// SPDX-License-Identifier: LGPL-3.0-or-later
// Two points of the walls of a gap that become one, a stitch of a suture. Theory: docs/cutting.md, sutures.
#ifndef CELLWALK_RESHAPE_CUT_MERGER_H
#define CELLWALK_RESHAPE_CUT_MERGER_H

#include <cellwalk/reshape/replacement.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reshape/replace/cell_transaction.h"
#include "reshape/toggle/toggle.h"

namespace cellwalk::detail {

/// \pre of all members: no certificates of the environment are withdrawn
template <int D>
class Merger {
 public:
  Merger(Cell_transaction<D>& transaction, Toggle<D>& toggle) : transaction_(transaction), toggle_(toggle) {}

  /// As Reshaping::merge_vertices(), for points that exist, and cells around the first of them that are
  /// simplices.
  Replacement merge_vertices(std::uint32_t point, std::uint32_t onto);

 private:
  const Snapshot<D>& snapshot() const { return transaction_.snapshot(); }
  /// A facet of a new cell, and whether it becomes passable where two facets become one.
  struct Seam {
    std::size_t cell;    ///< of the new ones
    std::uint32_t apex;  ///< the corner of it that the facet lacks
  };
  std::string add_cells(std::span<const Cell> star, std::uint32_t point, std::uint32_t onto,
                        Cell_soup<D>& soup, std::vector<Seam>& opened) const;
  bool is_sewn(Cell kept, Cell gap, std::uint32_t point, std::uint32_t onto) const;

  Cell_transaction<D>& transaction_;
  Toggle<D>& toggle_;
};

extern template class Merger<2>;
extern template class Merger<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_MERGER_H
