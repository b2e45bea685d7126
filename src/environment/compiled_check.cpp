// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the arrays of an image refer to each other as those of a snapshot do, so that nothing reads beyond
// them.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "environment/snapshot/compiler.h"
#include "environment/soup/parallel.h"
#include "environment_image.h"

namespace cellwalk {
namespace detail {

template <int D>
void Environment_image<D>::check_sizes(const Snapshot<D>& s) {
  const std::size_t blocks = s.planes_.size();
  if (s.links_.size() != 4 * blocks || s.vertex_begin_.size() != blocks || s.shape_.size() != blocks ||
      s.index_.size() != blocks)
    refuse_image("its arrays differ in length");
  if (blocks >= Snapshot<D>::link_mask || s.vertices_.size() > to_index(Cell::none) ||
      s.points_.size() > to_index(Cell::none) || s.cell_of_index_.size() > to_index(Cell::none))
    refuse_image("its arrays are too long");
}

template <int D>
void Environment_image<D>::check_shapes(const Snapshot<D>& s) {
  if (s.shapes_.size() > Snapshot<D>::shape_mask) refuse_image("it has too many shapes");
  for (const Cell_shape& shape : s.shapes_) {
    if (shape.loop_begin.front() != 0 || shape.facet_count() < D + 1) refuse_image("a shape is none");
    for (std::size_t i = 0; i < shape.facet_count(); ++i)
      if (shape.loop_begin[i] > shape.loop_begin[i + 1] || shape.loop_begin[i + 1] > shape.loops.size() ||
          shape.loop_begin[i + 1] - shape.loop_begin[i] < D)
        refuse_image("a shape is none");
    for (const std::uint16_t vertex : shape.loops)
      if (vertex >= shape.vertex_count) refuse_image("a shape is none");
  }
}

/// A cell, from its first block on.
template <int D>
void Environment_image<D>::check_cell(const Snapshot<D>& s, std::uint32_t block) {
  const Cell own{block};
  const std::uint32_t number = s.shape_[block] & Snapshot<D>::shape_mask;
  if (number >= s.shapes_.size()) refuse_image("a cell has a shape that is not there");
  const Cell_shape& shape = s.shapes_[number];
  const std::size_t blocks = Snapshot_compiler<D>::blocks_for(shape.facet_count());
  if (blocks > s.shape_.size() - block) refuse_image("a cell goes on beyond the end");
  for (std::uint32_t i = 1; i < blocks; ++i)
    if (s.shape_[block + i] != (Snapshot<D>::continuation_bit | i))
      refuse_image("blocks of a cell are missing");
  const std::uint32_t first = s.vertex_begin_[block];
  if (first > s.vertices_.size() || shape.vertex_count > s.vertices_.size() - first)
    refuse_image("the vertices of a cell are not there");
  if (!s.is_cell(own)) {
    for (std::size_t i = 4 * std::size_t{block}; i < 4 * (block + blocks); ++i)
      if (s.links_[i] != (Snapshot<D>::link_mask | Snapshot<D>::wall_bit))
        refuse_image("a cell that was removed has neighbours");
    return;
  }
  if (s.uniform_blocks_ != 0 && s.uniform_blocks_ != blocks) refuse_image("cells differ in their blocks");
  if (s.index_[block] >= s.cell_of_index_.size() || s.cell_of_index_[s.index_[block]] != block)
    refuse_image("the index of a cell belongs to another one");
  for (std::size_t v = first; v < first + shape.vertex_count; ++v)
    if (s.vertices_[v] >= s.points_.size()) refuse_image("a cell has a point that is not there");
  // A walk that leaves through a lane without a facet would follow a loop that is not there.
  for (std::size_t i = shape.facet_count(); i < 4 * blocks; ++i) {
    const Plane_block<D>& block_of_lane = s.planes_[block + i / 4];
    bool is_unused = block_of_lane.offset[i % 4] == -1;
    for (const Float4& n : block_of_lane.normal) is_unused &= n[i % 4] == 0;
    if (!is_unused) refuse_image("a plane belongs to no facet");
  }
  for (std::size_t i = 0; i < 4 * blocks; ++i) {
    const std::uint32_t word = s.links_[4 * std::size_t{block} + i];
    const std::uint32_t link = word & Snapshot<D>::link_mask;
    if (link == Snapshot<D>::link_mask) {
      if (i < shape.facet_count() && !(word & Snapshot<D>::wall_bit))
        refuse_image("a facet of the boundary is no wall");
      continue;
    }
    if (i >= shape.facet_count() || !s.is_cell(Cell{link})) refuse_image("a neighbour is not there");
    const std::size_t lanes = 4 * ((s.facet_count(Cell{link}) + 3) / 4);
    const std::uint32_t* const back = s.links(Cell{link});
    if (lanes > s.links_.size() - 4 * std::size_t{link} ||
        std::none_of(back, back + lanes,
                     [&](std::uint32_t w) { return (w & Snapshot<D>::link_mask) == block; }))
      refuse_image("a cell is not the neighbour of its neighbour");
  }
}

/// All blocks, and the cells by their indices.
template <int D>
void Environment_image<D>::check_blocks(const Snapshot<D>& s) {
  // Numbers of shapes are tested before they are used for neighbours.
  for_each_parallel(s.shape_.size(), [&](std::size_t b) {
    const std::uint32_t word = s.shape_[b];
    const std::uint32_t low = word & Snapshot<D>::shape_mask;
    if (!(word & Snapshot<D>::continuation_bit)) {
      if (low >= s.shapes_.size()) refuse_image("a cell has a shape that is not there");
    } else if (low == 0 || low > b || s.shape_[b - low] & Snapshot<D>::continuation_bit) {
      refuse_image("a block belongs to no cell");
    }
  });
  for_each_parallel(s.shape_.size(), [&](std::size_t b) {
    const std::uint32_t word = s.shape_[b];
    if (!(word & Snapshot<D>::continuation_bit)) {
      check_cell(s, static_cast<std::uint32_t>(b));
      return;
    }
    const std::size_t distance = word & Snapshot<D>::shape_mask;
    const Cell_shape& shape = s.shapes_[s.shape_[b - distance] & Snapshot<D>::shape_mask];
    if (distance >= Snapshot_compiler<D>::blocks_for(shape.facet_count()))
      refuse_image("a block belongs to no cell");
  });
  for_each_parallel(s.cell_of_index_.size(), [&](std::size_t i) {
    const std::uint32_t block = s.cell_of_index_[i];
    if (block == to_index(Cell::none)) {
      if (!s.free_indices_.contains(static_cast<std::uint32_t>(i))) refuse_image("an index has no cell");
    } else if (!s.is_cell(Cell{block}) || s.index_[block] != i) {
      refuse_image("an index has another cell");
    }
  });
}

/// What edits left unused.
template <int D>
void Environment_image<D>::check_free(const Snapshot<D>& s) {
  for (const std::uint32_t index : s.free_indices_)
    if (index >= s.cell_of_index_.size() || s.cell_of_index_[index] != to_index(Cell::none))
      refuse_image("an index in use is free");
  typename Snapshot<D>::Free_runs removed;
  for (std::uint32_t b = 0; b < s.shape_.size(); ++b)
    if (s.shape_[b] & Snapshot<D>::removed_bit && !(s.shape_[b] & Snapshot<D>::continuation_bit))
      removed.emplace(Snapshot_compiler<D>::blocks_for(s.facet_count(Cell{b})), b);
  if (removed != s.free_blocks_) refuse_image("what was removed is not what is free");
  if (s.free_vertices_.empty() && s.free_points_.empty()) return;

  std::vector<bool> vertex_in_use(s.vertices_.size()), point_in_use(s.points_.size());
  for (std::uint32_t b = 0; b < s.shape_.size(); ++b) {
    if (!s.is_cell(Cell{b})) continue;
    const std::size_t first = s.vertex_begin_[b];
    for (std::size_t v = first; v < first + s.view(Cell{b}).vertex_count(); ++v) {
      vertex_in_use[v] = true;
      point_in_use[s.vertices_[v]] = true;
    }
  }
  for (const auto& [length, first] : s.free_vertices_) {
    if (first > s.vertices_.size() || length > s.vertices_.size() - first)
      refuse_image("what is free goes on beyond the end");
    for (std::size_t v = first; v < first + std::size_t{length}; ++v) {
      if (vertex_in_use[v]) refuse_image("vertices in use are free");
      vertex_in_use[v] = true;
    }
  }
  for (const std::uint32_t point : s.free_points_)
    if (point >= s.points_.size() || point_in_use[point]) refuse_image("a point in use is free");
}

/// The bound of the error of planes holds in frames as make_frame() gives them: scaled by a power of two.
template <int D>
void Environment_image<D>::check_frame(const Snapshot<D>& s) {
  if (!is_finite(s.frame_.centre)) refuse_image("its frame is none");
  if (std::isnan(s.frame_.scale)) return;  // it maps nothing
  int exponent = 0;
  constexpr int largest = 400;
  if (std::frexp(s.frame_.scale, &exponent) != 0.5 || std::abs(exponent) > largest)
    refuse_image("its frame is none");
}

template <int D>
void Environment_image<D>::check(const Snapshot<D>& s) {
  check_frame(s);
  check_sizes(s);
  check_shapes(s);
  check_blocks(s);
  check_free(s);
  const bool has_frame = !std::isnan(s.frame_.scale);
  for_each_parallel(s.points_.size(), [&](std::size_t p) {
    if (!is_finite(s.points_[p])) refuse_image("a point is not finite");
    // Planes are compared on the assumption that all corners of cells lie where their bounds hold.
    if (Float_point<D> mapped; has_frame && !s.frame_.map(s.points_[p], mapped))
      refuse_image("a point lies outside its frame");
  });
}

template <int D>
Snapshot<D> Environment_image<D>::certified_again(const Snapshot<D>& snapshot) {
  Snapshot<D> again = snapshot;
  std::vector<Cell> cells;
  for (std::uint32_t b = 0; b < again.shape_.size(); ++b)
    if (again.is_cell(Cell{b})) cells.push_back(Cell{b});
  Snapshot_compiler<D>(again).certify_again(cells);
  return again;
}

template <int D>
bool Environment_image<D>::has_same_certificates(const Snapshot<D>& a, const Snapshot<D>& b, Cell cell) {
  const std::size_t blocks = a.block_count(cell);
  return std::memcmp(a.blocks(cell), b.blocks(cell), blocks * sizeof(Plane_block<D>)) == 0 &&
         std::memcmp(a.links(cell), b.links(cell), 4 * blocks * sizeof(std::uint32_t)) == 0;
}

template void Environment_image<2>::check(const Snapshot<2>&);
template void Environment_image<3>::check(const Snapshot<3>&);
template Snapshot<2> Environment_image<2>::certified_again(const Snapshot<2>&);
template Snapshot<3> Environment_image<3>::certified_again(const Snapshot<3>&);
template bool Environment_image<2>::has_same_certificates(const Snapshot<2>&, const Snapshot<2>&, Cell);
template bool Environment_image<3>::has_same_certificates(const Snapshot<3>&, const Snapshot<3>&, Cell);

}  // namespace detail

template <int D>
void check_compiled(const Environment<D>& environment) {
  using Image = detail::Environment_image<D>;
  const Snapshot<D>& snapshot = environment.snapshot();
  const Snapshot<D> again = Image::certified_again(snapshot);
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell != Cell::none && !Image::has_same_certificates(snapshot, again, cell))
      throw Error(
          Error_code::not_certified,
          "cell " + std::to_string(i) +
              " has planes that are not its own: compile the environment again, by `cellwalk import`");
  }
}

template void check_compiled(const Environment<2>&);
template void check_compiled(const Environment<3>&);

}  // namespace cellwalk
