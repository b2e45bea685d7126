// SPDX-License-Identifier: LGPL-3.0-or-later
#include "compiler.h"

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/policies.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "plane_compiler.h"

namespace cellwalk {
namespace {

/// The side of x with respect to facet i of a cell: > 0 strictly outside.
int side(const Cell_view<2>& cell, std::size_t i, const Point<2>& x) {
  Predicate_counts counts;
  const auto loop = cell.loop(i);
  return -Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), x);
}

int side(const Cell_view<3>& cell, std::size_t i, const Point<3>& x) {
  Predicate_counts counts;
  const auto loop = cell.loop(i);
  return Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]), x);
}

/// The facet of a cell other than `facet` with the ridge from point u to point v in the loop of `facet` (2D:
/// with the vertex u); facet_count() if there is none.
template <int D>
std::size_t across_ridge(const Cell_view<D>& cell, std::size_t facet, std::uint32_t u, std::uint32_t v) {
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    if (i == facet) continue;
    const auto loop = cell.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if constexpr (D == 2) {
        if (cell.point_index(loop[k]) == u) return i;
      } else {
        const std::uint16_t next = loop[k + 1 == loop.size() ? 0 : k + 1];
        if (cell.point_index(loop[k]) == v && cell.point_index(next) == u) return i;
      }
    }
  }
  return cell.facet_count();
}

/// True if facet j of a cell, which has the ridge uv (2D: the vertex u) in common with facet i, lies in its
/// plane.
template <int D>
bool lies_in_plane(const Cell_view<D>& cell, std::size_t i, std::size_t j, std::uint32_t u, std::uint32_t v) {
  const auto loop = cell.loop(j);
  return std::all_of(loop.begin(), loop.end(), [&](std::uint16_t w) {
    const std::uint32_t point = cell.point_index(w);
    return point == u || (D == 3 && point == v) || side(cell, i, cell.point(w)) == 0;
  });
}

}  // namespace

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
  constexpr std::uint32_t bit = Snapshot<D>::convex_pair_bit;
  const std::size_t facets = s_.facet_count(c);
  s_.uncertified_planes_ += facets - count_uncertified(c);
  for (std::size_t i = 0; i < facets; ++i) {
    Plane_block<D>& block = s_.planes_[to_index(c) + i / 4];
    for (Float4& n : block.normal) n[i % 4] = 0;
    block.offset[i % 4] = 0;
    std::uint32_t& link = s_.links_[4 * std::size_t{to_index(c)} + i];
    const Cell other = s_.neighbour(s_.half_facet(c, i));
    if (!(link & bit)) continue;
    link &= ~bit;
    for (std::size_t k = 0; k < s_.facet_count(other); ++k)
      if (s_.neighbour(s_.half_facet(other, k)) == c) s_.links_[4 * std::size_t{to_index(other)} + k] &= ~bit;
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
bool Snapshot_compiler<D>::is_convex(Cell a, std::size_t facet, Cell b) const requires(D == 3) {
  if (s_.is_impassable(Snapshot<D>::half_facet(a, facet))) return false;
  // The vertex of b that is not one of a: all others occur twice, but that of a that is not one of b.
  const Cell_view<D> va = s_.view(a);
  std::uint32_t apex =
      va.vertices[static_cast<std::size_t>(6 - va.loop(facet)[0] - va.loop(facet)[1] - va.loop(facet)[2])];
  for (const std::uint32_t v : va.vertices) apex ^= v;
  for (const std::uint32_t v : s_.view(b).vertices) apex ^= v;
  // It may lie in the plane of another facet of a: no slit can be there, as that is not the plane of `facet`.
  Float_point<D> y{};
  Float4 outside{};  // unknown
  if (s_.frame_.map(s_.points_[apex], y)) outside = evaluate<D>(s_.planes_[to_index(a)], y);
  outside[facet] = -1;
  for (int i = 0; i < 4; ++i)
    if (outside[i] > plane_error) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (!(outside[i] < -plane_error) && side(va, i, s_.points_[apex]) > 0) return false;
  return true;
}

template <int D>
bool Snapshot_compiler<D>::is_convex_pair(Half_facet f) const {
  const Half_facet opposite = s_.opposite(f);
  if (opposite == Half_facet::none) return false;
  const Cell a = s_.cell_of(f), b = s_.cell_of(opposite);
  const Cell_view<D> va = s_.view(a), vb = s_.view(b);
  for (std::size_t i = 0; i < va.facet_count(); ++i) {
    const Half_facet shared = s_.half_facet(a, i);
    if (s_.neighbour(shared) != b) continue;
    if (s_.is_impassable(shared)) return false;
    const std::size_t j = s_.facet_of(s_.opposite(shared));
    const auto loop = va.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t u = va.point_index(loop[k]), v = va.point_index(loop[(k + 1) % loop.size()]);
      const std::size_t ga = across_ridge(va, i, u, v), gb = across_ridge(vb, j, D == 2 ? u : v, u);
      if (ga == va.facet_count() || gb == vb.facet_count()) return false;
      // A ridge between two shared facets lies inside the union.
      if (s_.neighbour(s_.half_facet(a, ga)) == b &&
          s_.opposite(s_.half_facet(a, ga)) == s_.half_facet(b, gb))
        continue;
      bool in_one_plane = true;
      for (const std::uint16_t w : vb.loop(gb)) {
        // The ridge itself lies in both facets: exact zeros that need not be computed.
        const std::uint32_t point = vb.point_index(w);
        if (point == u || (D == 3 && point == v)) continue;
        const int s = side(va, ga, vb.point(w));
        if (s > 0) return false;
        in_one_plane &= s == 0;
      }
      // If that plane is also that of the shared facet, both cells continue in it without being glued: a
      // slit.
      if (in_one_plane && lies_in_plane(va, i, ga, u, v)) return false;
    }
  }
  return true;
}

template <int D>
void Snapshot_compiler<D>::write_convex_pair(Half_facet f) {
  constexpr std::uint32_t bit = Snapshot<D>::convex_pair_bit;
  const Half_facet opposite = s_.opposite(f);
  if (opposite == Half_facet::none) return;
  const bool is_pair = is_convex_pair(f);
  for (const Half_facet h : {f, opposite}) {
    std::uint32_t& word = s_.links_[to_index(h)];
    word = is_pair ? word | bit : word & ~bit;
  }
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
  try {
    for (const Half_facet f : closed_) set(f, true);
    if (turned_ != Cell::none) turn(turned_);
    for (const Half_facet f : opened_) set(f, false);
  } catch (...) {  // exact numbers take memory
    put_back();
    throw;
  }
}

template <int D>
void Snapshot_compiler<D>::Wall_change::set(Half_facet f, bool wall) {
  const Cell a = s_.cell_of(f), b = s_.neighbour(f);
  const std::size_t first = before_.size();
  // All facets that two cells share carry the same convex-pair condition.
  for (std::size_t i = 0; i < s_.facet_count(a); ++i) {
    const Half_facet own = s_.half_facet(a, i);
    if (s_.neighbour(own) != b) continue;
    for (const Half_facet h : {own, s_.opposite(own)}) before_.push_back({h, s_.links_[to_index(h)]});
  }
  for (const Half_facet h : {f, s_.opposite(f)}) {
    std::uint32_t& word = s_.links_[to_index(h)];
    word = wall ? word | Snapshot<D>::wall_bit : word & ~Snapshot<D>::wall_bit;
  }
  const bool is_pair = !wall && Snapshot_compiler(s_).is_convex_pair(f);
  for (std::size_t k = first; k < before_.size(); ++k) {
    std::uint32_t& word = s_.links_[to_index(before_[k].facet)];
    constexpr std::uint32_t bit = Snapshot<D>::convex_pair_bit;
    word = is_pair ? word | bit : word & ~bit;
  }
  for (const Cell c : {a, b}) s_.forget(c);
}

template <int D>
void Snapshot_compiler<D>::Wall_change::turn(Cell c) noexcept {
  s_.shape_[to_index(c)] ^= Snapshot<D>::solid_bit;
  s_.forget(c);
  is_turned_ = !is_turned_;
}

template <int D>
void Snapshot_compiler<D>::Wall_change::put_back() noexcept {
  for (auto link = before_.rbegin(); link != before_.rend(); ++link) {
    s_.links_[to_index(link->facet)] = link->word;
    s_.forget(s_.cell_of(link->facet));
  }
  if (is_turned_) turn(turned_);
}

template <int D>
void Snapshot_compiler<D>::Wall_change::keep() noexcept {
  is_kept_ = true;
  for (const Half_facet f : closed_) s_.edits_.note_turned(++s_.epoch_, f, s_.opposite(f));
  if (is_turned_) ++s_.epoch_;
  for (const Half_facet f : opened_) s_.edits_.note_turned(++s_.epoch_, f, s_.opposite(f));
}

template class Snapshot_compiler<2>;
template class Snapshot_compiler<3>;

}  // namespace cellwalk
