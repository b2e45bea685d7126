// SPDX-License-Identifier: LGPL-3.0-or-later
// The changes by edits: the facets that were opened or closed, the cells that are new, and the names that a
// compaction gave them. Bodies that were registered before find their sides of walls by it. Theory:
// docs/bodies.md, registration.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_EDIT_LOG_H
#define CELLWALK_INTERNAL_ENVIRONMENT_EDIT_LOG_H

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {

enum class Cell : std::uint32_t;
enum class Half_facet : std::uint32_t;
template <int D>
class Snapshot;

}  // namespace cellwalk

namespace cellwalk::detail {

/// The new names of cells and half-facets after a compaction, by old name; `none` where there was none.
struct Renaming {
  std::vector<Cell> cells;
  std::vector<Half_facet> half_facets;
};

/// The edits since an epoch. Names are those of today, but for renamed().
class Edits_since {
 public:
  /// True if a cell of this name was put in place since.
  bool is_new(Cell cell) const;
  /// The cells of today that a cell was split into, by its name of that epoch; itself if it was not split,
  /// and none if it is not known. Names of cells that are gone may be among them.
  /// \pre !are_renamed()
  std::vector<Cell> parts_of(Cell cell) const;
  /// True if a facet is passable that was a wall, or the other way round.
  bool is_turned(Half_facet facet) const;
  /// True if names of that epoch are not those of today.
  bool are_renamed() const { return renaming_ || are_lost_; }
  /// The name of today; `none` if it is gone. \throw Error(usage) if the edits since are forgotten
  Cell renamed(Cell cell) const;
  Half_facet renamed(Half_facet facet) const;

 private:
  struct Part {
    std::uint32_t of;
    std::uint64_t epoch;
    std::uint32_t name;
    auto operator<=>(const Part&) const = default;
  };
  void add_parts(std::uint32_t cell, std::uint64_t epoch, std::vector<Cell>& parts) const;

  // Sorted, as all of these:
  std::vector<Part> parts_;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> new_cells_;  // with epochs
  std::vector<std::uint32_t> turned_;
  std::shared_ptr<const Renaming> renaming_;
  bool are_lost_ = false;

  friend class Edit_log;
};

/// Whether a facet was passable before edits. If the cells on both sides of it are new, whether it is.
template <int D>
bool was_passable(const Snapshot<D>& snapshot, const Edits_since& edits, Half_facet facet);

/// The last half a million changes of facets, and as many new cells, at least. Of compactions it contains the
/// last one.
class Edit_log {
 public:
  /// Makes room for some sides of facets that are noted next, which then takes no memory.
  void reserve_turned(std::size_t sides);
  /// A facet, both sides of it, was opened or closed; the epoch is the one after the edit.
  void note_turned(std::uint64_t epoch, Half_facet one, Half_facet other);
  /// \param of the cell that they are parts of, or Cell::none
  void note_new(std::uint64_t epoch, std::span<const Cell> cells, Cell of);
  void note_renamed(std::uint64_t epoch, Renaming names);

  /// The edits after an epoch.
  /// Cost: linear in the number of these edits.
  Edits_since since(std::uint64_t epoch) const;

 private:
  struct New_cell {
    std::uint64_t epoch;
    std::uint32_t name, of;  ///< the cell that it is a part of, or Cell::none
  };
  struct Turned {
    std::uint64_t epoch;
    std::uint32_t name;
  };

  std::vector<New_cell> new_cells_;  // in the order of edits, as these:
  std::vector<Turned> turned_;
  std::shared_ptr<const Renaming> renaming_;
  std::uint64_t renamed_at_ = 0, lost_at_ = 0;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_EDIT_LOG_H
