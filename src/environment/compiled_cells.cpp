// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the cells of an image have their corners and neighbours as those of a snapshot have them: each
// facet between two cells is one loop, seen from both.
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <span>
#include <vector>

#include "environment/certify/shape.h"
#include "environment/snapshot/compiler.h"
#include "environment/soup/parallel.h"
#include "environment_image.h"

namespace cellwalk::detail {
namespace {

/// Blocks whose links one thread tests together.
constexpr std::uint32_t blocks_at_once = 1024;

/// The loops that canonicalize() gives tetrahedra, all of them.
constexpr std::array<std::array<std::uint16_t, 3>, 4> tetrahedron_loops{
    {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}};

bool is_tetrahedron(const Cell_shape& shape) {
  if (shape.vertex_count != 4 || shape.facet_count() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (!std::ranges::equal(shape.loop(i), tetrahedron_loops[i])) return false;
  return true;
}

/// 0 if a facet of three corners of one cell is one of another, seen from its other side. Nothing branches:
/// which of its corners comes first is hard to predict.
inline std::uint32_t differ(const std::uint32_t* own, const std::array<std::uint16_t, 3>& own_loop,
                            const std::uint32_t* other, const std::array<std::uint16_t, 3>& other_loop) {
  const std::uint32_t a = own[own_loop[0]], b = own[own_loop[1]], c = own[own_loop[2]];
  const std::uint32_t x = other[other_loop[0]], y = other[other_loop[1]], z = other[other_loop[2]];
  const std::uint32_t first = (a ^ z) | (b ^ y) | (c ^ x), second = (a ^ y) | (b ^ x) | (c ^ z),
                      third = (a ^ x) | (b ^ z) | (c ^ y);
  return std::min({first, second, third});
}

/// True if a facet of a cell is one of another, seen from its other side.
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

/// The number of the first shape of tetrahedra, which all of them share; if there is none, one that no cell
/// has.
template <int D>
std::uint32_t tetrahedron_among(const std::vector<Cell_shape>& shapes) {
  auto found = shapes.end();
  if constexpr (D == 3) found = std::ranges::find_if(shapes, is_tetrahedron);
  return static_cast<std::uint32_t>(found - shapes.begin());
}

/// True if the first three corners of each facet do not lie on one line: all sides of the facet would be 0.
bool are_planes_spanned(const Cell_view<3>& cell) {
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (const auto loop = cell.loop(i);
        loop.size() > 3 && are_collinear(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2])))
      return false;
  return true;
}

/// True if a cell is exactly convex, and the first corners of each facet span its plane.
/// \pre its coordinates are finite
bool is_convex(const Cell_view<2>& cell) { return check_geometry<2>(cell).defect == Cell_defect::none; }

bool is_convex(const Cell_view<3>& cell) {
  if (cell.vertex_count() == 4) {
    Predicate_counts counts;
    const auto loop = cell.loop(0);
    return Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]),
                              cell.point(6u - loop[0] - loop[1] - loop[2])) < 0;
  }
  return are_planes_spanned(cell) && check_geometry<3>(cell).defect == Cell_defect::none;
}

/// True if two of the corners of a cell are the same.
bool has_a_corner_twice(std::span<const std::uint32_t> v) {
  constexpr std::size_t few = 16;  // are compared with each other in less time than sorted
  if (v.size() <= few) {
    bool is_twice = false;
    for (std::size_t i = 1; i < v.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) is_twice |= v[i] == v[j];
    return is_twice;
  }
  std::vector<std::uint32_t> sorted(v.begin(), v.end());
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) != sorted.end();
}

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
  // Those of a simplex that is not flat differ.
  if (shape.vertex_count != D + 1 && has_a_corner_twice({s.vertices_.data() + first, shape.vertex_count}))
    refuse_image("a cell has a point twice");
  if (!is_convex(s.view(own))) refuse_image("a cell is not convex");
  // A walk that leaves through a lane without a facet would follow a loop that is not there.
  for (std::size_t i = shape.facet_count(); i < 4 * blocks; ++i) {
    const Plane_block<D>& block_of_lane = s.planes_[block + i / 4];
    bool is_unused = block_of_lane.offset[i % 4] == -1;
    for (const Float4& n : block_of_lane.normal) is_unused &= n[i % 4] == 0;
    if (!is_unused) refuse_image("a plane belongs to no facet");
    if (links[i] != Snapshot<D>::link_mask) refuse_image("a neighbour belongs to no facet");
  }
}

/// True if check_cell() takes a tetrahedron: the same in a few instructions. False where that needs a closer
/// look.
template <int D>
bool Environment_image<D>::is_sound_tetrahedron(const Snapshot<D>& s, std::uint32_t block) {
  if constexpr (D == 3) {
    const std::size_t first = s.vertex_begin_[block];
    if (first + 4 > s.vertices_.size() || s.uniform_blocks_ > 1) return false;
    const std::uint32_t* const v = s.vertices_.data() + first;
    if (std::max({v[0], v[1], v[2], v[3]}) >= s.points_.size()) return false;
    const Point<3>* const points = s.points_.data();
    Predicate_counts counts;
    return Exact::orientation(counts, points[v[0]], points[v[1]], points[v[2]], points[v[3]]) < 0;
  }
  return false;
}

/// A facet of a cell: it is one of the cell beyond it, seen from its other side. That one is its only other
/// side, since no cell has an edge twice in one direction.
template <int D>
void Environment_image<D>::check_facet(const Snapshot<D>& s, Cell own, std::size_t i) {
  constexpr std::uint32_t mask = Snapshot<D>::link_mask, wall = Snapshot<D>::wall_bit;
  const std::uint32_t word = s.links(own)[i], link = word & mask;
  if (link == mask) {
    if (word != (mask | wall)) refuse_image("a facet of the boundary is no wall");
    return;
  }
  const Cell other{link};
  if (other == own || !s.is_cell(other)) refuse_image("a neighbour is not there");
  const std::uint32_t back = s.links(other)[other_side(s, own, i, other)];
  if ((word ^ back) & ~mask) refuse_image("a facet has two sides that differ");
  if (!(word & wall) && s.is_solid(own) != s.is_solid(other))
    refuse_image("a facet is passable that cannot be");
}

/// True if check_facet() takes a facet of a tetrahedron to a cell before it: the same in a few instructions,
/// if that is a tetrahedron, too. False where that needs a closer look.
template <int D>
bool Environment_image<D>::is_sound_facet(const Snapshot<D>& s, std::uint32_t facet,
                                          std::uint32_t tetrahedron) {
  constexpr std::uint32_t mask = Snapshot<D>::link_mask, wall = Snapshot<D>::wall_bit,
                          solid = Snapshot<D>::solid_bit;
  const std::uint32_t block = facet / 4, i = facet % 4, word = s.links_[facet], link = word & mask;
  const std::uint32_t own_word = s.shape_[block], other_word = s.shape_[link];
  if ((other_word & ~solid) != tetrahedron) return false;
  const std::uint32_t* const back = s.links_.data() + 4 * std::size_t{link};
  // Any lane, if none leads here.
  const auto j =
      static_cast<std::size_t>(std::countr_zero(s.facets_to(Cell{block}, Cell{link}, 0) | 1u << 3));
  const std::uint32_t passable = ~word & wall;
  const std::uint32_t fault = ((back[j] & mask) ^ block) | ((word ^ back[j]) & ~mask) |
                              ((own_word ^ other_word) & solid & passable) |
                              differ(s.vertices_.data() + s.vertex_begin_[block], tetrahedron_loops[i],
                                     s.vertices_.data() + s.vertex_begin_[link], tetrahedron_loops[j]);
  return fault == 0;
}

/// The facet of a cell beyond that is facet i of a cell, seen from its other side.
template <int D>
std::size_t Environment_image<D>::other_side(const Snapshot<D>& s, Cell own, std::size_t i, Cell beyond) {
  const Cell_view<D> cell = s.view(own), other = s.view(beyond);
  for (std::size_t j = 0; j < other.facet_count(); ++j)
    if (s.neighbour(s.half_facet(beyond, j)) == own && are_two_sides<D>(cell, i, other, j)) return j;
  refuse_image("a cell is not the neighbour of its neighbour");
}

/// All blocks, and the cells by their indices.
template <int D>
void Environment_image<D>::check_blocks(const Snapshot<D>& s) {
  // Numbers of shapes are tested before they are used for neighbours.
  check_each(s.shape_.size(), [&](std::size_t b) {
    const std::uint32_t word = s.shape_[b];
    const std::uint32_t low = word & Snapshot<D>::shape_mask;
    if (!(word & Snapshot<D>::continuation_bit)) {
      if (low >= s.shapes_.size()) refuse_image("a cell has a shape that is not there");
    } else if (low == 0 || low > b || s.shape_[b - low] & Snapshot<D>::continuation_bit) {
      refuse_image("a block belongs to no cell");
    }
  });
  const std::uint32_t tetrahedron = tetrahedron_among<D>(s.shapes_);
  check_each(s.shape_.size(), [&](std::size_t b) {
    const std::uint32_t word = s.shape_[b];
    if ((word & ~Snapshot<D>::solid_bit) == tetrahedron &&
        is_sound_tetrahedron(s, static_cast<std::uint32_t>(b)))
      return;
    if (!(word & Snapshot<D>::continuation_bit)) {
      check_cell(s, static_cast<std::uint32_t>(b));
      return;
    }
    const std::size_t distance = word & Snapshot<D>::shape_mask;
    const Cell_shape& shape = s.shapes_[s.shape_[b - distance] & Snapshot<D>::shape_mask];
    if (distance >= Snapshot_compiler<D>::blocks_for(shape.facet_count()))
      refuse_image("a block belongs to no cell");
  });
  // All cells have different indices then.
  check_each(s.shape_.size(), [&](std::size_t b) {
    if (!s.is_cell(Cell{static_cast<std::uint32_t>(b)})) return;
    if (s.index_[b] >= s.cell_of_index_.size() || s.cell_of_index_[s.index_[b]] != b)
      refuse_image("the index of a cell belongs to another one");
  });
}

/// Of the cells that begin in a range of blocks, the facets on the boundary and those to cells before their
/// own. Returns the number of facets that lead to cells after their own, less that of those to cells before.
/// \pre the range has at most blocks_at_once
template <int D>
std::ptrdiff_t Environment_image<D>::check_links_of(const Snapshot<D>& s, std::uint32_t begin,
                                                    std::uint32_t end, std::uint32_t tetrahedron) {
  constexpr std::uint32_t mask = Snapshot<D>::link_mask, boundary = mask | Snapshot<D>::wall_bit;
  std::array<std::uint32_t, 4 * blocks_at_once> before;  // facets of tetrahedra that lead to cells before
  std::size_t count = 0;
  std::ptrdiff_t balance = 0;
  for (std::uint32_t block = begin; block < end; ++block) {
    const Cell cell{block};
    const std::uint32_t* const links = s.links(cell);
    if ((s.shape_[block] & ~Snapshot<D>::solid_bit) == tetrahedron) {
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t link = links[i] & mask;
        before[count] = 4 * block + i;
        count += link < block;  // without a branch, since it is as likely as not
        balance += link != mask;
        if ((link == mask && links[i] != boundary) || link == block) check_facet(s, cell, i);
      }
    } else if (s.is_cell(cell)) {
      for (std::size_t i = 0; i < s.facet_count(cell); ++i) {
        const std::uint32_t link = links[i] & mask;
        if (link == mask || link <= block) check_facet(s, cell, i);
        balance += link == mask ? 0 : link < block ? -1 : 1;
      }
    }
  }
  for (std::size_t k = 0; k < count; ++k)
    if (!is_sound_facet(s, before[k], tetrahedron)) check_facet(s, Cell{before[k] / 4}, before[k] % 4);
  return balance - 2 * static_cast<std::ptrdiff_t>(count);
}

/// All facets between two cells. Where each to a cell before its own is found there, different ones have
/// different other sides: if as many lead to cells after, these are all of them.
template <int D>
void Environment_image<D>::check_links(const Snapshot<D>& s) {
  const std::uint32_t tetrahedron = tetrahedron_among<D>(s.shapes_);
  const auto balance = [&](const tbb::blocked_range<std::uint32_t>& range, std::ptrdiff_t sum) {
    for (std::uint32_t b = range.begin(); b < range.end(); b += blocks_at_once)
      sum += check_links_of(s, b, std::min(range.end(), b + blocks_at_once), tetrahedron);
    return sum;
  };
  const tbb::blocked_range<std::uint32_t> all(0, static_cast<std::uint32_t>(s.shape_.size()), blocks_at_once);
  try {
    if (tbb::parallel_reduce(all, std::ptrdiff_t{0}, balance, std::plus<>()) == 0) return;
  } catch (const Error&) {  // that of the first cell comes next
  }
  for (std::uint32_t b = 0; b < s.shape_.size(); ++b)
    if (const Cell cell{b}; s.is_cell(cell))
      for (std::size_t i = 0; i < s.facet_count(cell); ++i) check_facet(s, cell, i);
  refuse_image("a cell is not the neighbour of its neighbour");
}

template void Environment_image<2>::check_blocks(const Snapshot<2>&);
template void Environment_image<3>::check_blocks(const Snapshot<3>&);
template void Environment_image<2>::check_links(const Snapshot<2>&);
template void Environment_image<3>::check_links(const Snapshot<3>&);

}  // namespace cellwalk::detail
