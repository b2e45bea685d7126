// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of cells, points and walls in the arrays, and free runs of blocks.
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/error.h>

#include <bit>
#include <cmath>
#include <string>

#include "canonical_shape.h"
#include "cell_exchange.h"
#include "compiler.h"
#include "plane_compiler.h"

namespace cellwalk {
namespace {

/// Takes the lowest free run of a length, or the end of its array if there is none; true in the latter case.
std::pair<std::uint32_t, bool> take_run(std::set<std::pair<std::uint32_t, std::uint32_t>>& runs,
                                        std::size_t length, std::size_t end) {
  // In most environments all runs have one length.
  auto run = runs.begin();
  if (run != runs.end() && run->first != length)
    run = runs.lower_bound({static_cast<std::uint32_t>(length), 0});
  if (run == runs.end() || run->first != length) return {static_cast<std::uint32_t>(end), true};
  const std::uint32_t first = run->second;
  runs.erase(run);
  return {first, false};
}

/// False if a point of the cells lies outside the frame: planes are certified in it only.
template <int D>
bool are_framed(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  Float_point<D> mapped;
  for (const Cell c : cells) {
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t v = 0; v < cell.vertex_count(); ++v)
      if (!snapshot.frame().map(cell.point(v), mapped)) return false;
  }
  return true;
}

}  // namespace

template <int D>
Half_facet Snapshot<D>::opposite(Half_facet f) const {
  const Cell other = neighbour(f);
  if (other == Cell::none) return Half_facet::none;
  const Cell own = cell_of(f);
  // Of two cells that share one facet, the links decide without a look at points.
  Half_facet only = Half_facet::none;
  bool is_only = true;
  for (std::size_t block = 0; block < block_count(other); ++block) {
    const unsigned there = facets_to(own, other, block);
    if (there == 0) continue;
    is_only &= only == Half_facet::none && (there & (there - 1)) == 0;
    only = half_facet(other, 4 * block + static_cast<std::size_t>(std::countr_zero(there)));
  }
  if (is_only) return only;
  const Cell_view<D> a = view(own), b = view(other);
  const auto loop = a.loop(facet_of(f));
  const std::uint32_t u = a.point_index(loop[0]), v = a.point_index(loop[1]);
  // The edge uv of one loop is the edge vu of the other; a cell has each directed edge once.
  for (std::size_t i = 0; i < b.facet_count(); ++i) {
    if (neighbour(half_facet(other, i)) != own) continue;
    const auto candidate = b.loop(i);
    for (std::size_t k = 0; k < candidate.size(); ++k)
      if (b.point_index(candidate[k]) == v && b.point_index(candidate[(k + 1) % candidate.size()]) == u)
        return half_facet(other, i);
  }
  return Half_facet::none;
}

template <int D>
std::vector<std::uint32_t> Snapshot<D>::loop(Half_facet f) const {
  const Cell c = cell_of(f);
  const Cell_view<D> cell = view(c);
  std::vector<std::uint32_t> result;
  for (const std::uint16_t v : cell.loop(facet_of(f))) result.push_back(cell.point_index(v));
  return result;
}

template <int D>
void Snapshot<D>::refuse_edited(const char* what_and_advice) {
  throw Error(Error_code::usage, std::string("the environment was edited after ") + what_and_advice);
}

template <int D>
void Snapshot<D>::set_impassable(Half_facet f, bool wall) {
  if (neighbour(f) == Cell::none || is_impassable(f) == wall) return;  // the boundary stays a wall
  const std::span<const Half_facet> one(&f, 1), none;
  typename Snapshot_compiler<D>::Wall_change change(*this, wall ? one : none, wall ? none : one);
  change.keep();
}

template <int D>
void Snapshot<D>::update_geometry(std::span<const Cell> cells) {
  geometry_epoch_ = ++epoch_;
  Snapshot_compiler<D> compiler(*this);
  for (const Cell c : cells) {
    forget(c);
    compiler.turn_loops(c);
  }
  if (std::isnan(frame_.scale) || are_framed<D>(*this, cells)) {
    for (const Cell c : cells) {
      uncertified_planes_ -= compiler.count_uncertified(c);
      uncertified_planes_ += compiler.write_planes(c);
    }
  } else {  // linear, but rare: frames are of powers of two
    frame_ = make_frame<D>(points());
    clusters_.clear();
    uncertified_planes_ = 0;
    for (std::uint32_t b = 0; b < shape_.size(); ++b)
      if (is_cell(Cell{b})) uncertified_planes_ += compiler.write_planes(Cell{b});
  }
}

/// Finds space for a cell, and writes all of it except its links and certificates.
template <int D>
Cell Snapshot<D>::add_cell(const Canonical_cell& cell, std::uint32_t index, bool solid) {
  const std::size_t blocks = Snapshot_compiler<D>::blocks_for(cell.shape.facet_count());
  if (blocks != uniform_blocks_) uniform_blocks_ = 0;
  const auto [block, is_new_block] = take_run(free_blocks_, blocks, planes_.size());
  const auto [vertex, is_new_vertex] = take_run(free_vertices_, cell.vertices.size(), vertices_.size());
  if (is_new_block) {
    planes_.resize(block + blocks);
    links_.resize(4 * (block + blocks));
    vertex_begin_.resize(block + blocks);
    shape_.resize(block + blocks);
    index_.resize(block + blocks);
  }
  if (is_new_vertex) vertices_.resize(vertex + cell.vertices.size());
  if (index == cell_of_index_.size()) cell_of_index_.push_back(0);
  Snapshot_compiler<D>(*this).write_cell(cell, block, vertex, index, solid);
  return Cell{block};
}

template <int D>
std::uint32_t Snapshot<D>::add_point(const Point<D>& position) {
  const std::uint32_t index = next_point();
  if (index == points_.size())
    points_.push_back(position);
  else
    points_[index] = position;
  free_points_.erase(index);
  return index;
}

template <int D>
std::vector<Cell> Snapshot<D>::replace_cells(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                             const Gluing& gluing, std::vector<Half_facet>* slots) {
  std::vector<Half_facet> own_slots;
  return Snapshot_compiler<D>(*this).exchange(Cell_exchange<D>(*this, removed, soup, gluing),
                                              slots ? *slots : own_slots);
}

template <int D>
std::size_t Snapshot<D>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t n = 0;
  for (const auto* array : {&links_, &vertex_begin_, &shape_, &index_, &vertices_, &cell_of_index_})
    n += array->own_bytes();
  n += planes_.own_bytes() + points_.own_bytes();
  for (const Cell_shape& shape : shapes_) n += sizeof shape + of(shape.loops) + of(shape.loop_begin);
  return n;
}

template class Snapshot<2>;
template class Snapshot<3>;

}  // namespace cellwalk
