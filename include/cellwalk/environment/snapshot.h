// SPDX-License-Identifier: LGPL-3.0-or-later
// The snapshot: an environment compiled into flat arrays for walking. See docs/architecture.md.
//
// Layout. Facets are stored in blocks of four lanes. A cell owns ceil(facets/4) consecutive blocks and is
// identified by its first one, so that facet i of cell c is half-facet 4c+i. One block of float planes is one
// cache line (3D). Blocks are in the order of a space-filling curve through the cells.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_H

#include <cellwalk/internal/environment/cell_clusters.h>
#include <cellwalk/internal/environment/edit_log.h>
#include <cellwalk/internal/environment/flat_array.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/environment/planes.h>
#include <cellwalk/internal/environment/tissue_boxes.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {

/// Facets of a cell as loops of local vertex numbers, counterclockwise seen from outside (2D: the two ends of
/// an edge, counterclockwise around the cell).
struct Cell_shape {
  std::vector<std::uint16_t> loop_begin{0};  ///< loop of facet i: [loop_begin[i], loop_begin[i+1]) of loops
  std::vector<std::uint16_t> loops;          ///< local vertex numbers
  std::uint16_t vertex_count = 0;

  std::size_t facet_count() const { return loop_begin.size() - 1; }
  std::span<const std::uint16_t> loop(std::size_t i) const {
    return {loops.data() + loop_begin[i], loops.data() + loop_begin[i + 1]};
  }
  bool operator==(const Cell_shape&) const = default;
};

/// A non-owning view of the geometry of a cell: its shape and the positions of its local vertices.
template <int D>
struct Cell_view {
  const Cell_shape* shape;
  std::span<const std::uint32_t> vertices;  ///< point index of each local vertex
  std::span<const Point<D>> points;         ///< all points

  std::size_t facet_count() const { return shape->facet_count(); }
  std::span<const std::uint16_t> loop(std::size_t i) const { return shape->loop(i); }
  std::size_t vertex_count() const { return vertices.size(); }
  const Point<D>& point(std::size_t local_vertex) const { return points[vertices[local_vertex]]; }
  std::uint32_t point_index(std::size_t local_vertex) const { return vertices[local_vertex]; }
};

struct Canonical_cell;

namespace detail {
template <int D>
class Environment_image;
}  // namespace detail

/// The name of a cell in a snapshot. It differs from the index in the input: see Snapshot::index().
enum class Cell : std::uint32_t { none = 0xffffffffu };

/// A facet of a snapshot seen from one of its cells.
enum class Half_facet : std::uint32_t { none = 0xffffffffu };

constexpr std::uint32_t to_index(Cell c) { return static_cast<std::uint32_t>(c); }
constexpr std::uint32_t to_index(Half_facet f) { return static_cast<std::uint32_t>(f); }

/// Compact tables of a cell complex for walks, with the local updates that edits need.
/// Thread safety: const members may be called from any number of threads.
template <int D>
class Snapshot {
 public:
  Snapshot() = default;

  /// Compiles a glued soup whose cells are convex and positively oriented. Each facet loop is rotated so that
  /// its first D vertices span its plane or line; a facet with collinear vertices only is kept (certification
  /// refuses it).
  /// \param slots if not null, receives the half-facet of each facet of the soup
  /// Cost: about 1 us a cell and core; O(cells) memory for the sort.
  static Snapshot compile(const Cell_soup<D>& soup, const Gluing& gluing,
                          std::vector<Half_facet>* slots = nullptr);

  // --- cells
  std::size_t cell_count() const { return cell_of_index_.size() - free_indices_.size(); }
  /// Upper bound of the indices of cells: cell_count(), plus those that replace_cells() left free.
  std::size_t cell_slots() const { return cell_of_index_.size(); }
  /// The cell with the given index in the input; Cell::none if it is free.
  /// \pre index < cell_slots()
  Cell cell(std::size_t index) const { return Cell{cell_of_index_[index]}; }
  /// True if a cell of this name exists. Edits that replace cells remove names; later edits may reuse them. A
  /// removed name behaves like a solid cell that contains no point and has only walls.
  bool is_cell(Cell c) const {
    return to_index(c) < shape_.size() && !(shape_[to_index(c)] & (continuation_bit | removed_bit));
  }
  /// The index of a cell in the input, for users.
  std::uint32_t index(Cell c) const { return index_[to_index(c)]; }
  bool is_solid(Cell c) const { return shape_[to_index(c)] & solid_bit; }
  /// The geometry of a cell, valid until the next edit.
  /// \pre is_cell(c)
  Cell_view<D> view(Cell c) const {
    assert(is_cell(c));
    const Cell_shape& shape = shapes_[shape_[to_index(c)] & shape_mask];
    return {&shape, {vertices_.data() + vertex_begin_[to_index(c)], shape.vertex_count}, points()};
  }
  std::size_t facet_count(Cell c) const { return shapes_[shape_[to_index(c)] & shape_mask].facet_count(); }

  // --- half-facets
  /// Upper bound of to_index(Half_facet): the size of an array indexed by half-facets. Some slots are unused.
  std::size_t half_facet_slots() const { return links_.size(); }
  static Half_facet half_facet(Cell c, std::size_t facet) {
    return Half_facet{4 * to_index(c) + static_cast<std::uint32_t>(facet)};
  }
  /// The cell of a half-facet.
  Cell cell_of(Half_facet f) const {
    const std::uint32_t block = to_index(f) / 4;
    const std::uint32_t word = shape_[block];
    return Cell{word & continuation_bit ? block - (word & shape_mask) : block};
  }
  /// The number of a half-facet in its cell.
  std::size_t facet_of(Half_facet f) const { return to_index(f) - 4 * to_index(cell_of(f)); }
  bool is_impassable(Half_facet f) const { return links_[to_index(f)] & wall_bit; }
  /// The impassable facets of a block of a cell, as a bit mask.
  unsigned impassable_facets(Cell c, std::size_t block) const {
    Int4 links_of_block;
    std::memcpy(&links_of_block, links(c) + 4 * block, sizeof(links_of_block));
    static_assert(wall_bit == 1u << 31, "walls are those whose links are negative");
    return lane_mask(links_of_block < 0);
  }
  /// The cell on the other side, walls included; Cell::none on the boundary.
  Cell neighbour(Half_facet f) const {
    const std::uint32_t link = links_[to_index(f)] & link_mask;
    return link == link_mask ? Cell::none : Cell{link};
  }
  /// The facets of a block of a cell beyond which another cell lies, as a bit mask.
  unsigned facets_to(Cell neighbour, Cell c, std::size_t block) const {
    Int4 links_of_block;
    std::memcpy(&links_of_block, links(c) + 4 * block, sizeof(links_of_block));
    // Lanes without a facet link to nothing.
    return lane_mask((links_of_block & static_cast<int>(link_mask)) == static_cast<int>(to_index(neighbour)));
  }
  /// The other side of the facet; Half_facet::none on the boundary.
  /// Cost: a look at the neighbour's links; where the two cells share several facets, at its points.
  Half_facet opposite(Half_facet f) const;
  /// The point indices of a half-facet, counterclockwise seen from outside its cell.
  std::vector<std::uint32_t> loop(Half_facet f) const;

  // --- points
  std::span<const Point<D>> points() const { return {points_.data(), points_.size()}; }
  const Point<D>& point(std::uint32_t index) const { return points_[index]; }
  /// False for a point that an edit removed: no cell has it, its position means nothing, and a later edit may
  /// reuse its index.
  bool is_point(std::uint32_t index) const {
    return index < points_.size() && (free_points_.empty() || !free_points_.contains(index));
  }

  // --- certificates
  /// The planes of the facets in lanes, and the box in which their error bound holds.
  const Plane_frame<D>& frame() const { return frame_; }
  const Plane_block<D>* blocks(Cell c) const { return planes_.data() + to_index(c); }
  /// Neighbours of the facets of a cell with the wall bits, four a block.
  const std::uint32_t* links(Cell c) const { return links_.data() + 4 * std::size_t{to_index(c)}; }
  /// Blocks of a cell: ceil(facets/4).
  std::size_t block_count(Cell c) const {
    return uniform_blocks_ ? uniform_blocks_ : (facet_count(c) + 3) / 4;
  }
  /// The number of blocks if it is the same for all cells, otherwise 0.
  std::size_t uniform_blocks() const { return uniform_blocks_; }
  /// Prefetches the planes of the neighbours across the first four facets, one of which the walk needs next.
  void prefetch_neighbours(Cell c) const {
    const std::uint32_t* neighbours = links(c);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t link = neighbours[i] & link_mask;
      __builtin_prefetch(planes_.data() + (link == link_mask ? to_index(c) : link));
    }
  }
  /// The number of facets whose plane could not be certified; they are always decided exactly.
  std::size_t uncertified_planes() const { return uncertified_planes_; }
  /// The walls by clusters of cells, made where they are needed.
  const detail::Cell_clusters<D>& clusters() const { return clusters_; }
  /// The places of solid cells and membranes, found where they are needed.
  const detail::Tissue_boxes<D>& tissue_boxes() const { return tissue_boxes_; }
  /// The latest edits. They are not part of a compiled environment.
  const detail::Edit_log& edits() const { return edits_; }

  // --- state
  /// The number of edits: every update below that affects walks increments it.
  std::uint64_t epoch() const { return epoch_; }
  /// The number of edits that changed cells or positions; opening and closing facets does not increment it.
  std::uint64_t geometry_epoch() const { return geometry_epoch_; }
  /// Checks that the environment was not edited since an epoch.
  /// \param known the epoch
  /// \param what_and_advice the end of the message "... was edited after `what_and_advice`"
  /// \throw Error(usage) if it was edited
  void check_epoch(std::uint64_t known, const char* what_and_advice) const {
    if (known != epoch_) [[unlikely]]
      refuse_edited(what_and_advice);
  }
  /// The same for geometry_epoch().
  void check_geometry_epoch(std::uint64_t known, const char* what_and_advice) const {
    if (known != geometry_epoch_) [[unlikely]]
      refuse_edited(what_and_advice);
  }

  // --- local updates (Environment keeps map and snapshot consistent)
  /// Marks both sides of a facet.
  void set_impassable(Half_facet f, bool wall);
  /// Moves a point; call update_geometry() for all cells that contain it.
  void move_point(std::uint32_t index, const Point<D>& position) { points_[index] = position; }
  /// The index that the next new point gets: the index of the lowest point removed, or the one after the
  /// last.
  std::uint32_t next_point() const {
    return free_points_.empty() ? static_cast<std::uint32_t>(points_.size()) : *free_points_.begin();
  }
  /// Adds a point and returns its index, next_point().
  std::uint32_t add_point(const Point<D>& position);
  /// Gives the index of a point that no cell has to later ones.
  void remove_point(std::uint32_t index) { free_points_.insert(index); }
  /// Recomputes the data of cells that depend on positions: the starting vertices of loops (the first D
  /// vertices must not be collinear) and planes. Half-facets keep their names.
  /// \param cells all cells with a moved point
  void update_geometry(std::span<const Cell> cells);
  /// Replaces the cells `removed` by the cells of `soup`, whose vertices are indices of this snapshot's
  /// points; soup.points is ignored. gluing.opposite of a half-facet is a half-facet of `soup`, or no_facet.
  /// Open half-facets are matched to the facets that the removed cells leave open; remaining ones of the
  /// latter become boundary facets.
  ///
  /// Returns the new cells in order. They take the indices of the removed cells first, then free and then new
  /// ones; remaining indices become free. Storage removed by earlier calls is reused; names removed by this
  /// call are not reused by it.
  /// \param slots if not null, receives the half-facet of each facet of `soup`
  /// \throw Error(input) as compile(), with nothing changed
  std::vector<Cell> replace_cells(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                  const Gluing& gluing, std::vector<Half_facet>* slots = nullptr);

  /// The memory of the arrays in bytes, without that of files that are mapped.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t wall_bit = 1u << 31;
  static constexpr std::uint32_t link_mask = wall_bit - 1;
  /// The number of blocks that half-facets can name.
  static constexpr std::uint32_t most_blocks = to_index(Half_facet::none) / 4;
  static constexpr std::uint32_t solid_bit = 1u << 31;
  static constexpr std::uint32_t continuation_bit = 1u << 30;
  static constexpr std::uint32_t removed_bit = 1u << 29;
  static constexpr std::uint32_t shape_mask = removed_bit - 1;

  detail::Flat_array<Plane_block<D>> planes_;        // per block
  detail::Flat_array<std::uint32_t> links_;          // per lane: neighbouring cell, wall bit
  detail::Flat_array<std::uint32_t> vertex_begin_;   // per block: start of the cell's vertices
  detail::Flat_array<std::uint32_t> shape_;          // per block: shape, or distance to the first block
  detail::Flat_array<std::uint32_t> index_;          // per block: index of the cell in the input
  detail::Flat_array<std::uint32_t> vertices_;       // point indices, cell after cell
  detail::Flat_array<std::uint32_t> cell_of_index_;  // per input cell: its first block
  std::vector<Cell_shape> shapes_;                   // few
  detail::Flat_array<Point<D>> points_;
  Plane_frame<D> frame_;
  std::size_t uncertified_planes_ = 0;
  std::size_t uniform_blocks_ = 0;  // blocks of every cell, or 0 where they differ
  std::uint64_t epoch_ = 0, geometry_epoch_ = 0;
  detail::Cell_clusters<D> clusters_;
  detail::Tissue_boxes<D> tissue_boxes_;
  detail::Edit_log edits_;
  /// Runs of slots by length and first slot. They are reused as a whole, so that a name always refers to the
  /// first block of a cell, existing or removed, and never into the middle of one.
  using Free_runs = std::set<std::pair<std::uint32_t, std::uint32_t>>;
  Free_runs free_blocks_, free_vertices_;
  std::set<std::uint32_t> free_indices_, free_points_;

  /// Forgets the boxes of many cells of which one changes.
  void forget(Cell cell) {
    clusters_.forget(cell);
    tissue_boxes_.forget(cell);
  }
  [[noreturn]] static void refuse_edited(const char* what_and_advice);
  Cell add_cell(const Canonical_cell& cell, std::uint32_t index, bool solid);

  template <int>
  friend class Snapshot_compiler;
  friend detail::Environment_image<D>;
};

extern template class Snapshot<2>;
extern template class Snapshot<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_H
