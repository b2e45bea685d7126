// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the arrays of an image refer to each other as those of a snapshot do, so that nothing reads beyond
// them.
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "environment/certify/shape.h"
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
  if (blocks > Snapshot<D>::most_blocks || s.vertices_.size() > to_index(Cell::none) ||
      s.points_.size() > to_index(Cell::none) || s.cell_of_index_.size() > to_index(Cell::none))
    refuse_image("its arrays are too long");
}

template <int D>
void Environment_image<D>::check_shapes(const Snapshot<D>& s) {
  if (s.shapes_.size() > Snapshot<D>::shape_mask) refuse_image("it has too many shapes");
  check_each(s.shapes_.size(), [&](std::size_t number) {
    const Cell_shape& shape = s.shapes_[number];
    if (shape.loop_begin.front() != 0 || !std::ranges::is_sorted(shape.loop_begin) ||
        shape.loop_begin.back() != shape.loops.size())
      refuse_image("a shape is none");
    if (std::ranges::any_of(shape.loops, [&](std::uint16_t v) { return v >= shape.vertex_count; }))
      refuse_image("a shape is none");
    if (shape.facet_count() < D + 1 || check_shape<D>(shape).defect != Cell_defect::none)
      refuse_image("a shape is none");
  });
}

/// Tests the lists of unused slots and names.
template <int D>
void Environment_image<D>::check_free(const Snapshot<D>& s) {
  for (const std::uint32_t index : s.free_indices_)
    if (index >= s.cell_of_index_.size() || s.cell_of_index_[index] != to_index(Cell::none))
      refuse_image("an index in use is free");
  typename Snapshot<D>::Free_runs removed;
  std::size_t end = 0, cells = 0;
  bool are_in_turn = true;  // vertices of cells, as compiled
  for (std::uint32_t b = 0; b < s.shape_.size(); ++b) {
    if (s.shape_[b] & Snapshot<D>::continuation_bit) continue;
    const Cell_shape& shape = s.shapes_[s.shape_[b] & Snapshot<D>::shape_mask];
    if (s.is_cell(Cell{b})) {
      ++cells;
      are_in_turn &= end <= s.vertex_begin_[b];
      end = std::size_t{s.vertex_begin_[b]} + shape.vertex_count;
    } else {
      removed.emplace(Snapshot_compiler<D>::blocks_for(shape.facet_count()), b);
    }
  }
  // Cells have different indices, and those are not free.
  if (cells + s.free_indices_.size() != s.cell_of_index_.size())
    refuse_image("an index has no cell of its own");
  if (removed != s.free_blocks_) refuse_image("what was removed is not what is free");
  if (are_in_turn && s.free_vertices_.empty() && s.free_points_.empty()) return;

  std::vector<bool> vertex_in_use(s.vertices_.size()), point_in_use(s.points_.size());
  for (std::uint32_t b = 0; b < s.shape_.size(); ++b) {
    if (!s.is_cell(Cell{b})) continue;
    const std::size_t first = s.vertex_begin_[b];
    for (std::size_t v = first; v < first + s.view(Cell{b}).vertex_count(); ++v) {
      if (vertex_in_use[v]) refuse_image("two cells have the same vertices");
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
  const bool has_frame = !std::isnan(s.frame_.scale);
  check_each(s.points_.size(), [&](std::size_t p) {
    if (!is_finite(s.points_[p])) refuse_image("a point is not finite");
    // Planes are compared on the assumption that all corners of cells lie where their bounds hold.
    if (Float_point<D> mapped; has_frame && !s.frame_.map(s.points_[p], mapped))
      refuse_image("a point lies outside its frame");
  });
  check_blocks(s);
  check_links(s);
  check_free(s);
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
bool Environment_image<D>::has_same_planes(const Snapshot<D>& a, const Snapshot<D>& b, Cell cell) {
  return std::memcmp(a.blocks(cell), b.blocks(cell), a.block_count(cell) * sizeof(Plane_block<D>)) == 0;
}

template void Environment_image<2>::check(const Snapshot<2>&);
template void Environment_image<3>::check(const Snapshot<3>&);
template Snapshot<2> Environment_image<2>::certified_again(const Snapshot<2>&);
template Snapshot<3> Environment_image<3>::certified_again(const Snapshot<3>&);
template bool Environment_image<2>::has_same_planes(const Snapshot<2>&, const Snapshot<2>&, Cell);
template bool Environment_image<3>::has_same_planes(const Snapshot<3>&, const Snapshot<3>&, Cell);

}  // namespace detail

template <int D>
void check_compiled(const Environment<D>& environment) {
  using Image = detail::Environment_image<D>;
  const Snapshot<D>& snapshot = environment.snapshot();
  const Snapshot<D> again = Image::certified_again(snapshot);
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell != Cell::none && !Image::has_same_planes(snapshot, again, cell))
      throw Error(
          Error_code::not_certified,
          "cell " + std::to_string(i) +
              " has planes that are not its own: compile the environment again, by `cellwalk import`");
  }
}

template void check_compiled(const Environment<2>&);
template void check_compiled(const Environment<3>&);

}  // namespace cellwalk
