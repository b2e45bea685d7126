// SPDX-License-Identifier: LGPL-3.0-or-later
// The loops, shapes, links and planes of one cell, and changes of its walls that can be undone.
#include "compiler.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "plane_compiler.h"

namespace cellwalk {

template <int D>
std::uint32_t Snapshot_compiler<D>::shape_number(const Cell_shape& shape) {
  const std::lock_guard lock(shapes_mutex_);
  // Meshes have a handful of shapes, polyhedral ones up to thousands: the latest is the most likely.
  for (std::size_t i = s_.shapes_.size(); i-- > 0;)
    if (s_.shapes_[i] == shape) return static_cast<std::uint32_t>(i);
  s_.shapes_.push_back(shape);
  return static_cast<std::uint32_t>(s_.shapes_.size() - 1);
}

template <int D>
void Snapshot_compiler<D>::write_cell(const Canonical_cell& cell, std::uint32_t block, std::uint32_t vertex,
                                      std::uint32_t index, bool solid) {
  const std::size_t blocks = blocks_for(cell.shape.facet_count());
  for (std::uint32_t i = 0; i < blocks; ++i) {
    clear_block(block + i);
    s_.shape_[block + i] = Snapshot<D>::continuation_bit | i;
    s_.index_[block + i] = index;
    s_.vertex_begin_[block + i] = vertex;
  }
  s_.shape_[block] = shape_number(cell.shape) | (solid ? Snapshot<D>::solid_bit : 0);
  std::copy(cell.vertices.begin(), cell.vertices.end(), s_.vertices_.begin() + vertex);
  s_.cell_of_index_[index] = block;
}

template <int D>
void Snapshot_compiler<D>::number_shapes() {
  constexpr std::uint32_t none = Snapshot<D>::shape_mask;
  std::vector<std::uint32_t> number(s_.shapes_.size(), none);
  std::vector<Cell_shape> shapes;
  for (std::uint32_t& word : s_.shape_) {
    if (word & Snapshot<D>::continuation_bit) continue;
    const std::uint32_t before = word & none;
    if (number[before] == none) {
      number[before] = static_cast<std::uint32_t>(shapes.size());
      shapes.push_back(std::move(s_.shapes_[before]));
    }
    word = (word & ~none) | number[before];
  }
  s_.shapes_ = std::move(shapes);
}

template <int D>
void Snapshot_compiler<D>::clear_block(std::uint32_t block) {
  Plane_block<D>& planes = s_.planes_[block];
  for (Float4& n : planes.normal) n = Float4{0, 0, 0, 0};
  planes.offset = Float4{-1, -1, -1, -1};
  for (std::size_t lane = 0; lane < 4; ++lane)
    s_.links_[4 * std::size_t{block} + lane] = Snapshot<D>::link_mask;
}

template <int D>
void Snapshot_compiler<D>::remove_cell(Cell c) {
  const std::size_t blocks = s_.block_count(c);
  for (std::size_t block = to_index(c); block < to_index(c) + blocks; ++block) {
    clear_block(static_cast<std::uint32_t>(block));
    s_.planes_[block].offset = Float4{1, 1, 1, 1};
    for (std::size_t lane = 0; lane < 4; ++lane) s_.links_[4 * block + lane] |= Snapshot<D>::wall_bit;
    s_.index_[block] = to_index(Cell::none);
  }
  s_.shape_[to_index(c)] |= Snapshot<D>::removed_bit | Snapshot<D>::solid_bit;
}

template <int D>
void Snapshot_compiler<D>::withdraw(Cell c) {
  const std::size_t facets = s_.facet_count(c);
  s_.uncertified_planes_ += facets - count_uncertified(c);
  for (std::size_t i = 0; i < facets; ++i) {
    Plane_block<D>& block = s_.planes_[to_index(c) + i / 4];
    for (Float4& n : block.normal) n[i % 4] = 0;
    block.offset[i % 4] = 0;
  }
  s_.forget(c);
}

template <int D>
void Snapshot_compiler<D>::turn_loops(Cell c) {
  if constexpr (D == 3) {
    const Cell_view<3> cell = s_.view(c);
    const auto is_off_line = [&](std::span<const std::uint16_t> loop) {
      return loop.size() <= 3 ||
             !are_collinear(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]));
    };
    std::size_t facet = 0;
    while (facet < cell.facet_count() && is_off_line(cell.loop(facet))) ++facet;
    if (facet == cell.facet_count()) return;
    Cell_shape shape = *cell.shape;
    for (; facet < shape.facet_count(); ++facet) {
      const std::uint16_t begin = shape.loop_begin[facet], end = shape.loop_begin[facet + 1];
      turn_off_line(s_.points_, cell.vertices, {shape.loops.data() + begin, shape.loops.data() + end});
    }
    const std::uint32_t solid = s_.shape_[to_index(c)] & Snapshot<D>::solid_bit;
    s_.shape_[to_index(c)] = shape_number(shape) | solid;
  }
}

template <int D>
std::size_t Snapshot_compiler<D>::count_uncertified(Cell c) const {
  std::size_t uncertified = 0;
  for (std::size_t i = 0; i < s_.block_count(c); ++i) {
    // The offsets of unused lanes are not 0.
    const Plane_block<D>& block = s_.planes_[to_index(c) + i];
    Int4 all = block.offset == 0;
    for (const Float4& n : block.normal) all &= n == 0;
    uncertified += static_cast<std::size_t>(std::popcount(lane_mask(all)));
  }
  return uncertified;
}

template <int D>
std::size_t Snapshot_compiler<D>::write_planes(Cell c) {
  const Cell_view<D> cell = s_.view(c);
  std::size_t uncertified = 0;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const auto loop = cell.loop(i);
    Float_plane<D> plane;
    if constexpr (D == 2)
      plane = make_plane(s_.frame_, cell.point(loop[0]), cell.point(loop[1]));
    else
      plane = make_plane(s_.frame_, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]));
    bool certified = false;
    Plane_block<D>& block = s_.planes_[to_index(c) + i / 4];
    for (int k = 0; k < D; ++k) {
      block.normal[k][i % 4] = plane.normal[k];
      certified |= plane.normal[k] != 0;
    }
    block.offset[i % 4] = plane.offset;
    uncertified += !certified;
  }
  return uncertified;
}

template <int D>
void Snapshot_compiler<D>::link(Half_facet f, Half_facet g, bool wall) {
  const std::uint32_t bits = wall ? Snapshot<D>::wall_bit : 0;
  s_.links_[to_index(f)] = to_index(s_.cell_of(g)) | bits;
  s_.links_[to_index(g)] = to_index(s_.cell_of(f)) | bits;
}

template <int D>
void Snapshot_compiler<D>::link_boundary(Half_facet f) {
  s_.links_[to_index(f)] = Snapshot<D>::link_mask | Snapshot<D>::wall_bit;
}

template <int D>
Snapshot_compiler<D>::Wall_change::Wall_change(Snapshot<D>& snapshot, std::span<const Half_facet> closed,
                                               std::span<const Half_facet> opened, Cell turned)
    : s_(snapshot), closed_(closed), opened_(opened), turned_(turned) {
  s_.edits_.reserve_turned(2 * (closed.size() + opened.size()));
  set(closed_, true);
  turn();
  set(opened_, false);
}

template <int D>
void Snapshot_compiler<D>::Wall_change::set(std::span<const Half_facet> facets, bool wall) noexcept {
  for (const Half_facet f : facets)
    for (const Half_facet h : {f, s_.opposite(f)}) {
      std::uint32_t& word = s_.links_[to_index(h)];
      word = wall ? word | Snapshot<D>::wall_bit : word & ~Snapshot<D>::wall_bit;
      s_.forget(s_.cell_of(h));
    }
}

template <int D>
void Snapshot_compiler<D>::Wall_change::turn() noexcept {
  if (turned_ == Cell::none) return;
  s_.shape_[to_index(turned_)] ^= Snapshot<D>::solid_bit;
  s_.forget(turned_);
}

template <int D>
void Snapshot_compiler<D>::Wall_change::put_back() noexcept {
  set(opened_, true);
  turn();
  set(closed_, false);
}

template <int D>
void Snapshot_compiler<D>::Wall_change::keep() noexcept {
  is_kept_ = true;
  for (const Half_facet f : closed_) s_.edits_.note_turned(++s_.epoch_, f, s_.opposite(f));
  if (turned_ != Cell::none) ++s_.epoch_;
  for (const Half_facet f : opened_) s_.edits_.note_turned(++s_.epoch_, f, s_.opposite(f));
}

template class Snapshot_compiler<2>;
template class Snapshot_compiler<3>;

}  // namespace cellwalk
