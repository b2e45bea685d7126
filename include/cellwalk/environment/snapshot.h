// SPDX-License-Identifier: LGPL-3.0-or-later
// The snapshot: an environment compiled into flat arrays for walking. See docs/architecture.md.
//
// Layout. Facets are stored in blocks of four lanes. A cell owns ceil(facets/4) consecutive blocks and is
// named by its first one, so that facet i of cell c is half-facet 4c+i. One block of float planes is one
// cache line (3D). Blocks lie in the order of a space-filling curve through the cells.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_H

#include <cellwalk/environment/cell_shape.h>
#include <cellwalk/environment/gluing.h>
#include <cellwalk/environment/planes.h>
#include <cellwalk/records/cell_soup.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace cellwalk {

/// A cell of a snapshot. Not the index of the input: see Snapshot::index().
enum class Cell : std::uint32_t { none = 0xffffffffu };

/// A facet of a snapshot seen from one of its cells.
enum class Half_facet : std::uint32_t { none = 0xffffffffu };

constexpr std::uint32_t to_index(Cell c) { return static_cast<std::uint32_t>(c); }
constexpr std::uint32_t to_index(Half_facet f) { return static_cast<std::uint32_t>(f); }

/// Compact read-only tables of a cell complex, with the few local updates that editing needs.
/// Thread safety: const members may be called from any number of threads.
template <int D>
class Snapshot {
 public:
  Snapshot() = default;

  /// Compiles a glued soup whose cells are convex and positively oriented. In each facet loop the first D
  /// vertices not on one line are found; a facet whose vertices all lie on one line is kept (certification
  /// refuses it). Cost: about 1 us a cell and core; O(cells) memory for the sort. `slots`, if given, receives
  /// the half-facet of each facet of the soup.
  static Snapshot compile(const Cell_soup<D>& soup, const Gluing& gluing,
                          std::vector<Half_facet>* slots = nullptr);

  // --- cells
  std::size_t cell_count() const { return cell_of_index_.size(); }
  /// The cell with the given index of the input.
  Cell cell(std::size_t index) const { return Cell{cell_of_index_[index]}; }
  /// The index of a cell in the input: what users see.
  std::uint32_t index(Cell c) const { return index_[to_index(c)]; }
  bool is_solid(Cell c) const { return shape_[to_index(c)] & solid_bit; }
  Cell_view<D> view(Cell c) const {
    const Cell_shape& shape = shapes_[shape_[to_index(c)] & shape_mask];
    return {&shape, {vertices_.data() + vertex_begin_[to_index(c)], shape.vertex_count}, points_};
  }
  std::size_t facet_count(Cell c) const { return shapes_[shape_[to_index(c)] & shape_mask].facet_count(); }

  // --- half-facets
  /// Upper bound of to_index(Half_facet): the size of an array indexed by half-facets. Some slots are unused.
  std::size_t half_facet_slots() const { return links_.size(); }
  static Half_facet half_facet(Cell c, std::size_t facet) {
    return Half_facet{4 * to_index(c) + static_cast<std::uint32_t>(facet)};
  }
  /// The cell that a half-facet belongs to.
  Cell cell_of(Half_facet f) const {
    const std::uint32_t block = to_index(f) / 4;
    const std::uint32_t word = shape_[block];
    return Cell{word & continuation_bit ? block - (word & shape_mask) : block};
  }
  /// The number of a half-facet in its cell.
  std::size_t facet_of(Half_facet f) const { return to_index(f) - 4 * to_index(cell_of(f)); }
  bool is_impassable(Half_facet f) const { return links_[to_index(f)] & wall_bit; }
  /// The impassable facets (bits) of a block of a cell.
  unsigned impassable_facets(Cell c, std::size_t block) const {
    Int4 links_of_block;
    std::memcpy(&links_of_block, links(c) + 4 * block, sizeof(links_of_block));
    static_assert(wall_bit == 1u << 31, "walls are those whose links are negative");
    return lane_mask(links_of_block < 0);
  }
  /// True if the union of the two cells is convex, every facet they share is passable, and they meet in nothing but these facets:
  /// no slit lies between them.
  bool is_convex_pair(Half_facet f) const { return links_[to_index(f)] & convex_pair_bit; }
  /// The cell on the other side, walls included; Cell::none on the boundary.
  Cell neighbor(Half_facet f) const {
    const std::uint32_t link = links_[to_index(f)] & link_mask;
    return link == link_mask ? Cell::none : Cell{link};
  }
  /// The facet that all segments between two cells pass: they are a convex pair, and share no other facet.
  /// Half_facet::none if there is no such facet. Seen from the first cell. Cost: a look at the links of its facets.
  Half_facet convex_passage(Cell from, Cell to) const {
    Half_facet passage = Half_facet::none;
    for (std::size_t b = 0; b < block_count(from); ++b) {
      Int4 block;
      std::memcpy(&block, links(from) + 4 * b, sizeof(block));
      // Lanes without a facet link to nothing.
      const unsigned there =
          lane_mask((block & static_cast<int>(link_mask)) == static_cast<int>(to_index(to)));
      if (there == 0) continue;
      if (passage != Half_facet::none || (there & (there - 1)) != 0) return Half_facet::none;
      passage = half_facet(from, 4 * b + static_cast<std::size_t>(std::countr_zero(there)));
    }
    return passage != Half_facet::none && is_convex_pair(passage) ? passage : Half_facet::none;
  }
  /// The other side of the facet; Half_facet::none on the boundary. Cost: a search over the neighbour's
  /// facets.
  Half_facet opposite(Half_facet f) const;
  /// Point indices of facet `facet` of cell c, counterclockwise seen from outside.
  std::vector<std::uint32_t> loop(Half_facet f) const;

  // --- points
  std::span<const Point<D>> points() const { return points_; }
  const Point<D>& point(std::uint32_t index) const { return points_[index]; }

  // --- certificates
  /// The planes of the facets in lanes, and the box in which their error bound holds.
  const Plane_frame<D>& frame() const { return frame_; }
  const Plane_block<D>* blocks(Cell c) const { return planes_.data() + to_index(c); }
  /// Neighbours of the facets of a cell with the wall and convex-pair bits, four a block.
  const std::uint32_t* links(Cell c) const { return links_.data() + 4 * std::size_t{to_index(c)}; }
  /// Blocks of a cell: ceil(facets/4).
  std::size_t block_count(Cell c) const {
    return uniform_blocks_ ? uniform_blocks_ : (facet_count(c) + 3) / 4;
  }
  /// Blocks of every cell, or 0 where they differ.
  std::size_t uniform_blocks() const { return uniform_blocks_; }
  /// Asks for the planes of the neighbours across the first four facets: the walk needs one of them next.
  void prefetch_neighbors(Cell c) const {
    const std::uint32_t* neighbors = links(c);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t link = neighbors[i] & link_mask;
      __builtin_prefetch(planes_.data() + (link == link_mask ? to_index(c) : link));
    }
  }
  /// Facets whose plane could not be certified (they are always decided exactly).
  std::size_t uncertified_planes() const { return uncertified_planes_; }

  // --- local updates (Environment keeps them in step with the map)
  /// Marks both sides of a facet; convex-pair bits of the two cells follow.
  void set_impassable(Half_facet f, bool wall);
  /// Moves a point; call update_geometry for every cell that has it.
  void move_point(std::uint32_t index, const Point<D>& position) { points_[index] = position; }
  /// Appends a point and returns its index.
  std::uint32_t add_point(const Point<D>& position) {
    points_.push_back(position);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  /// Recomputes planes and convex-pair bits of a cell whose points moved.
  void update_geometry(Cell c);
  /// Replaces cells by others: `removed` cells go, the cells of `soup` come (its vertices are indices of
  /// this snapshot's points; soup.points is not looked at). gluing.opposite of a half-facet is a half-facet
  /// of `soup`, or no_facet; those left open are matched to the facets that the removed cells leave open.
  /// Returns the new cells in order: they take the indices of the removed ones first, then new ones. `slots`,
  /// if given, receives the half-facet of each facet of `soup`. \pre at least as many cells come as go
  std::vector<Cell> replace_cells(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                  const Gluing& gluing, std::vector<Half_facet>* slots = nullptr);

  /// Bytes held by the arrays.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t wall_bit = 1u << 31;
  static constexpr std::uint32_t convex_pair_bit = 1u << 30;
  static constexpr std::uint32_t link_mask = convex_pair_bit - 1;
  static constexpr std::uint32_t solid_bit = 1u << 31;
  static constexpr std::uint32_t continuation_bit = 1u << 30;
  static constexpr std::uint32_t shape_mask = continuation_bit - 1;

  std::vector<Plane_block<D>> planes_;        // per block
  std::vector<std::uint32_t> links_;          // per lane: neighbouring cell, wall and convex-pair bits
  std::vector<std::uint32_t> vertex_begin_;   // per block: start of the cell's vertices
  std::vector<std::uint32_t> shape_;          // per block: shape of the cell, or distance to its first block
  std::vector<std::uint32_t> index_;          // per block: index of the cell in the input
  std::vector<std::uint32_t> vertices_;       // point indices, cell after cell
  std::vector<std::uint32_t> cell_of_index_;  // per input cell: its first block
  std::vector<Cell_shape> shapes_;            // few
  std::vector<Point<D>> points_;
  Plane_frame<D> frame_;
  std::size_t uncertified_planes_ = 0;
  std::size_t uniform_blocks_ = 0;  // blocks of every cell, or 0 where they differ

  template <int>
  friend class Snapshot_compiler;
};

extern template class Snapshot<2>;
extern template class Snapshot<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_H
