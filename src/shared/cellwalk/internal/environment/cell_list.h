// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells that a flood has found, in order.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_LIST_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_LIST_H

#include <cellwalk/environment/snapshot.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace cellwalk::detail {

class Cell_list {
 public:
  void assign(Cell first) {
    cells_.assign(1, first);
    table_.clear();
  }
  std::size_t size() const { return cells_.size(); }
  Cell operator[](std::size_t i) const { return cells_[i]; }
  /// Few cells are compared one by one, many looked up in a table.
  bool contains(Cell cell) const {
    if (table_.empty()) return std::find(cells_.begin(), cells_.end(), cell) != cells_.end();
    std::size_t i = slot(cell);
    while (table_[i] != Cell::none && table_[i] != cell) i = (i + 1) & (table_.size() - 1);
    return table_[i] == cell;
  }
  void add(Cell cell) {
    cells_.push_back(cell);
    if (table_.empty() ? cells_.size() < least_in_table : 2 * cells_.size() <= table_.size()) {
      if (!table_.empty()) put(cell);
      return;
    }
    table_.assign(4 * std::bit_ceil(cells_.size()), Cell::none);
    for (const Cell c : cells_) put(c);
  }

 private:
  static constexpr std::size_t least_in_table = 32;

  void put(Cell cell) {
    std::size_t i = slot(cell);
    while (table_[i] != Cell::none) i = (i + 1) & (table_.size() - 1);
    table_[i] = cell;
  }
  std::size_t slot(Cell cell) const { return (to_index(cell) * 0x9e3779b1u >> 8) & (table_.size() - 1); }

  std::vector<Cell> cells_;
  std::vector<Cell> table_;  ///< of those, by hash
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_LIST_H
