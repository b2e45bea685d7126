// SPDX-License-Identifier: LGPL-3.0-or-later
// Writes cells into the arrays of a snapshot: all of them at compilation, some of them after an edit.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H

#include <cellwalk/environment/snapshot.h>

#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "canonical_shape.h"
#include "cell_exchange.h"

namespace cellwalk {

template <int D>
class Snapshot_compiler {
 public:
  explicit Snapshot_compiler(Snapshot<D>& snapshot) : s_(snapshot) {}

  /// Replaces cells, see Snapshot::replace_cells().
  /// \param slots receives the half-facet of each facet of the soup
  /// \throw Error(input) as compile(), with nothing changed
  std::vector<Cell> exchange(const Cell_exchange<D>& x, std::vector<Half_facet>& slots);
  /// Writes a canonical cell into the blocks from `block` on and the vertices from `vertex` on.
  void write_cell(const Canonical_cell& cell, std::uint32_t block, std::uint32_t vertex, std::uint32_t index,
                  bool solid);
  /// Numbers the shapes of all cells written in the order of the blocks, whichever thread wrote them first.
  void number_shapes();
  /// Marks a cell as removed: every point is outside of it, and all its facets are walls. Its indices stay
  /// valid.
  void remove_cell(Cell c);
  /// Rotates each loop whose first three vertices are collinear until they are not, if it has three such
  /// consecutive vertices.
  void turn_loops(Cell c);
  /// Withdraws the certificates of the planes of a cell, before its points move: all of it is decided exactly
  /// until Snapshot::update_geometry().
  void withdraw(Cell c);
  class Wall_change;
  /// Forgets boxes of many cells, which are wrong if they were found since points of a cell began to move.
  void forget(Cell c) { s_.forget(c); }
  /// Raises the epochs, as an edit of points does.
  void raise_epochs() { s_.geometry_epoch_ = ++s_.epoch_; }
  /// Goes on after the epochs and edits of the snapshot that this one takes the place of, under other names.
  void follow(const Snapshot<D>& before, detail::Renaming names) {
    s_.geometry_epoch_ = s_.epoch_ = before.epoch() + 1;
    s_.edits_ = before.edits_;
    s_.edits_.note_renamed(s_.epoch_, std::move(names));
  }
  /// Notes cells that are new since, and facets that were opened or closed, by their two sides.
  void note_edited(std::span<const Cell> added, std::span<const std::pair<Half_facet, Half_facet>> turned) {
    s_.edits_.note_new(s_.epoch_, added, Cell::none);
    for (const auto& [one, other] : turned) s_.edits_.note_turned(s_.epoch_, one, other);
  }
  /// Makes certificates of cells anew that were withdrawn. No epoch rises: it did when points moved.
  void certify_again(std::span<const Cell> cells) {
    const std::uint64_t epoch = s_.epoch_, geometry_epoch = s_.geometry_epoch_;
    s_.update_geometry(cells);
    s_.epoch_ = epoch;
    s_.geometry_epoch_ = geometry_epoch;
  }
  /// Recomputes the planes of a cell. Returns the number of those that could not be certified.
  std::size_t write_planes(Cell c);
  /// The number of current planes of a cell that certify nothing; 0 for a cell just written, which has no
  /// planes yet.
  std::size_t count_uncertified(Cell c) const;
  /// Links two half-facets; wall marks both.
  void link(Half_facet f, Half_facet g, bool wall);
  void link_boundary(Half_facet f);

  static constexpr std::size_t blocks_for(std::size_t facets) { return (facets + 3) / 4; }

 private:
  /// The number of a shape, added if new. Thread-safe.
  std::uint32_t shape_number(const Cell_shape& shape);
  /// Removes all facets and neighbours.
  void clear_block(std::uint32_t block);

  Snapshot<D>& s_;
  std::mutex shapes_mutex_;
};

/// Facets that become walls or passable, and a cell that becomes solid or free with them: tried, and then
/// kept or put back.
template <int D>
class Snapshot_compiler<D>::Wall_change {
 public:
  /// Makes the change, but for epochs and the list of edits, so that readers of the snapshot can find its
  /// consequences.
  /// \param closed passable facets, each seen from one side
  /// \param opened walls, not on the boundary, each seen from one side
  /// \param turned a solid cell that becomes free, or a free one that becomes solid; or none
  /// \throw std::bad_alloc, with nothing changed
  Wall_change(Snapshot<D>& snapshot, std::span<const Half_facet> closed, std::span<const Half_facet> opened,
              Cell turned = Cell::none);
  Wall_change(const Wall_change&) = delete;
  Wall_change& operator=(const Wall_change&) = delete;
  /// Puts all back, unless it was kept.
  ~Wall_change() {
    if (!is_kept_) put_back();
  }
  /// Keeps the change, and raises the epoch by one for each facet and the cell.
  void keep() noexcept;

 private:
  void set(std::span<const Half_facet> facets, bool wall) noexcept;
  void turn() noexcept;
  void put_back() noexcept;

  Snapshot<D>& s_;
  std::span<const Half_facet> closed_, opened_;
  Cell turned_;
  bool is_kept_ = false;
};

extern template class Snapshot_compiler<2>;
extern template class Snapshot_compiler<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H
