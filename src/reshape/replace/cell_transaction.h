// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells that are replaced by others, with everything that lies in them. Theory: docs/cutting.md, replacing
// cells.
#ifndef CELLWALK_RESHAPE_REPLACE_CELL_TRANSACTION_H
#define CELLWALK_RESHAPE_REPLACE_CELL_TRANSACTION_H

#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/reshape/move.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "relinker.h"
#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// open() the groups near, then note() or leave(), then replace(). Kept for its memory.
/// \pre of replace() and exchange(): no certificates of the environment are withdrawn
template <int D>
class Cell_transaction {
 public:
  Cell_transaction(Environment<D>& environment, Resident_groups<D>& groups, Reshape_counts& counts);

  Environment<D>& environment() const { return environment_; }
  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }
  Resident_groups<D>& groups() const { return groups_; }
  Walk_counts& walk_counts() const { return counts_.walk; }
  /// The free ones of some cells.
  std::vector<Cell> free_of(std::span<const Cell> cells) const;

  /// Fetches into the cache the data that replace() reads.
  void prefetch(std::span<const Cell> cells) const { patcher_.prefetch(cells); }
  /// Opens the groups near cells, so that nothing in them is overlooked.
  /// \throw Error(usage) for a particle that does not lie in its cell
  void open(std::span<const Cell> cells);
  /// Notes the residents of cells, to be registered in those that replace them. See Relinker::note().
  void note(std::span<const Cell> cells) { relinker_.note(cells); }
  /// True if a face that is kept rests on the walls of the noted cells.
  bool has_rests() const { return relinker_.has_rests(); }

  /// Cells to come whose walls are not where they were.
  struct Moved_walls {
    const Cell_soup<D>& soup;
    std::optional<Point<D>> added;  ///< as that of replace()
  };
  /// Registers all that lies in free cells in other cells, and returns nothing; or the residents that must be
  /// in these, sorted, and nothing has changed.
  /// \param moved if not null, no face may lie near these cells either, and nothing that has a radius nearer
  ///        than that to these walls
  std::vector<Resident> leave(std::span<const Cell> free, const Moved_walls* moved = nullptr);

  /// Replaces cells, and registers the noted residents in those of the new ones that are given, all or free.
  /// Returns the new cells.
  /// \param finish called with them; until it returns, is_broken()
  enum class Into : std::uint8_t { all, free };
  std::vector<Cell> replace(std::span<const Cell> removed, const Cell_soup<D>& soup, const Gluing& gluing,
                            const std::optional<Point<D>>& added, Into into,
                            const std::function<void(std::span<const Cell>)>& finish = {});
  /// Replaces cells in which nothing lies.
  std::vector<Cell> exchange(std::span<const Cell> removed, const Cell_soup<D>& soup, const Point<D>& added) {
    return patcher_.replace(removed, soup, glue_patch(soup), added);
  }
  /// True once something had no place in the new cells: then bodies must not go on.
  bool is_broken() const { return is_broken_; }

 private:
  void add_holders(std::span<const Cell> free, const Moved_walls& moved,
                   std::vector<Resident>& holders) const;

  Environment<D>& environment_;
  Resident_groups<D>& groups_;
  Reshape_counts& counts_;
  Cell_patcher<D> patcher_;
  Relinker<D> relinker_;
  bool is_broken_ = false;
};

extern template class Cell_transaction<2>;
extern template class Cell_transaction<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_CELL_TRANSACTION_H
