// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the cells of an image have their corners and neighbours as those of a snapshot have them: each facet
// between two cells is one loop, seen from both.
#include <cellwalk/internal/kernel/predicates.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "environment/certify/shape.h"
#include "environment/snapshot/compiler.h"
#include "environment/soup/parallel.h"
#include "environment_image.h"

namespace cellwalk::detail {
namespace {

/// The loops that canonicalize() gives tetrahedra, all of them.
constexpr std::array<std::array<std::uint16_t, 3>, 4> tetrahedron_loops{
    {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}};

bool is_tetrahedron(const Cell_shape& shape) {
  if (shape.vertex_count != 4 || shape.facet_count() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (!std::ranges::equal(shape.loop(i), tetrahedron_loops[i])) return false;
  return true;
}

/// True if a facet of three corners of one cell is one of another, seen from its other side. Nothing branches:
/// which of its corners comes first is hard to predict.
bool are_two_sides(const std::uint32_t* own, const std::array<std::uint16_t, 3>& own_loop,
                   const std::uint32_t* other, const std::array<std::uint16_t, 3>& other_loop) {
  const std::uint32_t a = own[own_loop[0]], b = own[own_loop[1]], c = own[own_loop[2]];
  const std::uint32_t x = other[other_loop[0]], y = other[other_loop[1]], z = other[other_loop[2]];
  const std::uint32_t first = (a ^ z) | (b ^ y) | (c ^ x), second = (a ^ y) | (b ^ x) | (c ^ z),
                      third = (a ^ x) | (b ^ z) | (c ^ y);
  return !first | !second | !third;
}

/// The same for any facets.
template <int D>
bool are_two_sides(const Cell_view<D>& own, std::size_t i, const Cell_view<D>& other, std::size_t j) {
  const auto a = own.loop(i), b = other.loop(j);
  const std::size_t n = a.size();
  if (b.size() != n) return false;
  if constexpr (D == 2)
    return own.point_index(a[0]) == other.point_index(b[1]) &&
           own.point_index(a[1]) == other.point_index(b[0]);
  std::size_t at = 0;
  while (at < n && other.point_index(b[at]) != own.point_index(a[0])) ++at;
  for (std::size_t k = 0; k < n; ++k)
    if (other.point_index(b[(at + n - k) % n]) != own.point_index(a[k])) return false;
  return true;
}

/// True if two of the corners of a cell are the same.
bool has_a_corner_twice(std::span<const std::uint32_t> v) {
  if (v.size() == 4) {
    const auto equal = [&](std::size_t i, std::size_t j) { return v[i] == v[j]; };
    return equal(0, 1) | equal(0, 2) | equal(0, 3) | equal(1, 2) | equal(1, 3) | equal(2, 3);
  }
  std::vector<std::uint32_t> sorted(v.begin(), v.end());
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) != sorted.end();
}

/// True if the first three corners of each facet do not lie on one line: all sides of the facet would be 0.
bool are_planes_spanned(const Cell_view<3>& cell) {
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (const auto loop = cell.loop(i);
        loop.size() > 3 && are_collinear(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2])))
      return false;
  return true;
}
bool are_planes_spanned(const Cell_view<2>&) { return true; }

}  // namespace

/// A cell, from its first block on: where its parts are.
template <int D>
void Environment_image<D>::check_cell(const Snapshot<D>& s, std::uint32_t block) {
  const Cell own{block};
  const Cell_shape& shape = s.shapes_[s.shape_[block] & Snapshot<D>::shape_mask];
  const std::size_t blocks = Snapshot_compiler<D>::blocks_for(shape.facet_count());
  if (blocks > s.shape_.size() - block) refuse_image("a cell goes on beyond the end");
  for (std::uint32_t i = 1; i < blocks; ++i)
    if (s.shape_[block + i] != (Snapshot<D>::continuation_bit | i))
      refuse_image("blocks of a cell are missing");
  if (s.uniform_blocks_ != 0 && s.uniform_blocks_ != blocks) refuse_image("cells differ in their blocks");
  const std::uint32_t first = s.vertex_begin_[block];
  if (first > s.vertices_.size() || shape.vertex_count > s.vertices_.size() - first)
    refuse_image("the vertices of a cell are not there");
  for (std::size_t v = first; v < first + shape.vertex_count; ++v)
    if (s.vertices_[v] >= s.points_.size()) refuse_image("a cell has a point that is not there");
  const std::uint32_t* const links = s.links(own);
  if (!s.is_cell(own)) {
    constexpr std::uint32_t wall = Snapshot<D>::link_mask | Snapshot<D>::wall_bit;
    if (std::any_of(links, links + 4 * blocks, [](std::uint32_t word) { return word != wall; }))
      refuse_image("a cell that was removed has neighbours");
    return;
  }
  if (s.index_[block] >= s.cell_of_index_.size() || s.cell_of_index_[s.index_[block]] != block)
    refuse_image("the index of a cell belongs to another one");
  if (has_a_corner_twice({s.vertices_.data() + first, shape.vertex_count}))
    refuse_image("a cell has a point twice");
  if (check_geometry<D>(s.view(own)).defect != Cell_defect::none || !are_planes_spanned(s.view(own)))
    refuse_image("a cell is not convex");
  // A walk that leaves through a lane without a facet would follow a loop that is not there.
  for (std::size_t i = shape.facet_count(); i < 4 * blocks; ++i) {
    const Plane_block<D>& block_of_lane = s.planes_[block + i / 4];
    bool is_unused = block_of_lane.offset[i % 4] == -1;
    for (const Float4& n : block_of_lane.normal) is_unused &= n[i % 4] == 0;
    if (!is_unused) refuse_image("a plane belongs to no facet");
    if (links[i] != Snapshot<D>::link_mask) refuse_image("a neighbour belongs to no facet");
  }
}

/// The facets of a cell to cells after it: each is one of the cell there, seen from its other side. Returns
/// their number, less that of its facets to cells before it.
template <int D>
std::ptrdiff_t Environment_image<D>::check_neighbours(const Snapshot<D>& s, Cell own,
                                                      const std::vector<std::uint8_t>& are_tetrahedra) {
  constexpr std::uint32_t mask = Snapshot<D>::link_mask, wall = Snapshot<D>::wall_bit;
  const std::uint32_t block = to_index(own);
  const Cell_view<D> cell = s.view(own);
  const std::uint32_t* const links = s.links(own);
  const bool is_tetrahedron = are_tetrahedra[s.shape_[block] & Snapshot<D>::shape_mask];
  std::ptrdiff_t balance = 0;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const std::uint32_t word = links[i], link = word & mask;
    if (link < block) {
      --balance;
      continue;
    }
    if (link == mask) {
      if (word != (mask | wall)) refuse_image("a facet of the boundary is no wall");
      continue;
    }
    const Cell other{link};
    if (link == block || !s.is_cell(other)) refuse_image("a neighbour is not there");
    ++balance;
    const Cell_view<D> beyond = s.view(other);
    const std::uint32_t* const back = s.links(other);
    const bool are_both = is_tetrahedron && are_tetrahedra[s.shape_[link] & Snapshot<D>::shape_mask];
    const auto is_other_side = [&](std::size_t j) {
      if ((back[j] & mask) != block) return false;
      return are_both ? are_two_sides(cell.vertices.data(), tetrahedron_loops[i], beyond.vertices.data(),
                                      tetrahedron_loops[j])
                      : are_two_sides<D>(cell, i, beyond, j);
    };
    std::size_t j = 0;
    while (j < beyond.facet_count() && !is_other_side(j)) ++j;
    if (j == beyond.facet_count()) refuse_image("a cell is not the neighbour of its neighbour");
    if ((word ^ back[j]) & ~mask) refuse_image("a facet has two sides that differ");
    const bool is_wall = word & wall, is_pair = word & Snapshot<D>::convex_pair_bit;
    if (is_wall ? is_pair : s.is_solid(own) != s.is_solid(other))
      refuse_image("a facet is passable that cannot be");
  }
  return balance;
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

/// All facets between two cells. Different ones have different other sides, since no cell has an edge twice in
/// one direction: where as many lead to cells before as to cells after, each has one.
template <int D>
void Environment_image<D>::check_links(const Snapshot<D>& s) {
  std::vector<std::uint8_t> are_tetrahedra(s.shapes_.size());
  if constexpr (D == 3) std::ranges::transform(s.shapes_, are_tetrahedra.begin(), is_tetrahedron);
  constexpr std::size_t blocks_at_once = 1024;
  const std::ptrdiff_t balance = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, s.shape_.size(), blocks_at_once), std::ptrdiff_t{0},
      [&](const auto& range, std::ptrdiff_t sum) {
        for (std::size_t b = range.begin(); b != range.end(); ++b)
          if (const Cell cell{static_cast<std::uint32_t>(b)}; s.is_cell(cell))
            sum += check_neighbours(s, cell, are_tetrahedra);
        return sum;
      },
      std::plus<>());
  if (balance != 0) refuse_image("a cell is not the neighbour of its neighbour");
}

template void Environment_image<2>::check_blocks(const Snapshot<2>&);
template void Environment_image<3>::check_blocks(const Snapshot<3>&);
template void Environment_image<2>::check_links(const Snapshot<2>&);
template void Environment_image<3>::check_links(const Snapshot<3>&);

}  // namespace cellwalk::detail
