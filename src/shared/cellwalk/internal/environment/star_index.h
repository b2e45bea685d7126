// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells around a point, found in the snapshot: a frozen environment has no map.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_STAR_INDEX_H
#define CELLWALK_INTERNAL_ENVIRONMENT_STAR_INDEX_H

#include <cellwalk/environment/snapshot.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// True if a facet of a cell has a point.
template <int D>
bool has_point(const Cell_view<D>& cell, std::size_t facet, std::uint32_t point) {
  for (const std::uint16_t v : cell.loop(facet))
    if (cell.point_index(v) == point) return true;
  return false;
}

/// One cell at each point, and one more for each further part of a pinched point: cells that are joined
/// through facets that contain it. Stays valid while points move and facets are opened and closed.
template <int D>
class Star_index {
 public:
  /// Cost: about 1 us a point.
  explicit Star_index(const Snapshot<D>& snapshot);
  /// One that begins each search with the cell with which another did, see tell().
  /// \pre they are cells at these points
  Star_index(std::vector<Cell> first, std::vector<std::pair<std::uint32_t, Cell>> other_parts)
      : first_(std::move(first)), other_parts_(std::move(other_parts)) {}
  /// The cell at each point, and those of further parts.
  void tell(std::vector<Cell>& first, std::vector<std::pair<std::uint32_t, Cell>>& other_parts) const {
    first = first_;
    other_parts = other_parts_;
  }

  /// Sets `cells` to all cells that have a point, part after part; solid ones too. The order depends on the
  /// numbering of cells. They are kept for the next time.
  /// Cost: at first that of a search through these cells, later that of a copy. Memory: 4 bytes for each
  /// point, and for each cell of the stars requested.
  void find_cells(const Snapshot<D>& snapshot, std::uint32_t point, std::vector<Cell>& cells);

  /// Follows an edit that replaces cells by others that cover the same region.
  /// \param points those of the removed cells
  /// \pre the removed cells at a point are linked through facets that have it
  /// Cost: that of the cells.
  void replace(const Snapshot<D>& snapshot, std::span<const Cell> removed,
               std::span<const std::uint32_t> points, std::span<const Cell> added);

 private:
  using Part = std::pair<std::uint32_t, Cell>;
  std::vector<Part>::iterator parts_of(std::uint32_t point);
  void forget(std::uint32_t point);
  void compact();
  void append_parts(const Snapshot<D>& snapshot, std::uint32_t point, std::vector<Cell>& cells) const;

  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<Cell> first_;          ///< of each point
  std::vector<Part> other_parts_;    ///< by point
  std::vector<std::uint32_t> kept_;  ///< of each point: where its cells begin in `cells_`, or none
  /// Of points requested: the index of the point, its cells, and Cell::none.
  std::vector<Cell> cells_;
  std::size_t outdated_ = 0;  ///< entries of `cells_`
};

extern template class Star_index<2>;
extern template class Star_index<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_STAR_INDEX_H
