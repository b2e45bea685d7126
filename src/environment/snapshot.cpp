// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/snapshot.h>

#include <algorithm>

#include "canonical_shape.h"
#include "snapshot_compiler.h"

namespace cellwalk {

template <int D>
Half_facet Snapshot<D>::opposite(Half_facet f) const {
  const Cell other = neighbor(f);
  if (other == Cell::none) return Half_facet::none;
  const Cell own = cell_of(f);
  const Cell_view<D> a = view(own), b = view(other);
  const auto loop = a.loop(facet_of(f));
  const std::uint32_t u = a.point_index(loop[0]), v = a.point_index(loop[1]);
  // The edge uv of one loop is the edge vu of the other; a cell has each directed edge once.
  for (std::size_t i = 0; i < b.facet_count(); ++i) {
    if (neighbor(half_facet(other, i)) != own) continue;
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
void Snapshot<D>::set_impassable(Half_facet f, bool wall) {
  const Half_facet g = opposite(f);
  if (g == Half_facet::none) return;  // the boundary stays a wall
  for (const Half_facet h : {f, g}) {
    std::uint32_t& word = links_[to_index(h)];
    word = wall ? word | wall_bit : word & ~wall_bit;
  }
  // Other facets shared by the two cells carry the same convex-pair condition.
  const Cell a = cell_of(f), b = cell_of(g);
  Snapshot_compiler<D> compiler(*this);
  for (std::size_t i = 0; i < facet_count(a); ++i)
    if (neighbor(half_facet(a, i)) == b) compiler.write_convex_pair(half_facet(a, i));
}

template <int D>
void Snapshot<D>::update_geometry(Cell c) {
  Snapshot_compiler<D> compiler(*this);
  compiler.write_planes(c);
  for (std::size_t i = 0; i < facet_count(c); ++i) compiler.write_convex_pair(half_facet(c, i));
}

template <int D>
std::vector<Cell> Snapshot<D>::replace_cells(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                             const Gluing& gluing, std::vector<Half_facet>* slots) {
  // The outer facets that the removed cells leave open: neighbours keep them, whoever comes.
  std::vector<Half_facet> open;
  std::vector<std::uint32_t> indices;
  for (const Cell c : removed) {
    indices.push_back(index(c));
    for (std::size_t i = 0; i < facet_count(c); ++i) {
      const Half_facet f = half_facet(c, i), g = opposite(f);
      if (g != Half_facet::none && std::find(removed.begin(), removed.end(), cell_of(g)) == removed.end())
        open.push_back(g);
    }
  }
  std::vector<bool> open_is_wall;
  for (const Half_facet g : open) open_is_wall.push_back(is_impassable(g));

  Snapshot_compiler<D> compiler(*this);
  for (const Cell c : removed)
    for (std::size_t i = block_count(c); i-- > 0;) {
      const std::uint32_t block = to_index(c) + static_cast<std::uint32_t>(i);
      compiler.clear_block(block);
      shape_[block] = continuation_bit;
    }

  std::vector<Cell> added;
  std::vector<Half_facet> slot(soup.facet_count());
  Canonical_cell cell;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    canonicalize(soup, points_, c, cell);
    const std::size_t blocks = Snapshot_compiler<D>::blocks_for(cell.shape.facet_count());
    if (blocks != uniform_blocks_) uniform_blocks_ = 0;
    const auto block = static_cast<std::uint32_t>(planes_.size());
    const auto vertex = static_cast<std::uint32_t>(vertices_.size());
    planes_.resize(block + blocks);
    links_.resize(4 * (block + blocks));
    vertex_begin_.resize(block + blocks);
    shape_.resize(block + blocks);
    index_.resize(block + blocks);
    vertices_.resize(vertex + cell.vertices.size());
    if (c >= indices.size()) {
      indices.push_back(static_cast<std::uint32_t>(cell_of_index_.size()));
      cell_of_index_.push_back(0);
    }
    compiler.write_cell(cell, block, vertex, indices[c], soup.solid[c]);
    for (std::size_t k = 0; k < cell.facets.size(); ++k) slot[cell.facets[k]] = half_facet(Cell{block}, k);
    added.push_back(Cell{block});
  }
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = gluing.opposite[f];
    if (g != no_facet) {
      if (f < g) compiler.link(slot[f], slot[g], soup.impassable[f] || soup.impassable[g]);
      continue;
    }
    compiler.link_boundary(slot[f]);
    const std::vector<std::uint32_t> own = loop(slot[f]);
    for (std::size_t i = 0; i < open.size(); ++i) {
      std::vector<std::uint32_t> other = loop(open[i]);
      if (!std::is_permutation(own.begin(), own.end(), other.begin(), other.end())) continue;
      compiler.link(slot[f], open[i], open_is_wall[i] || soup.impassable[f]);
      break;
    }
  }
  for (const Cell c : added) update_geometry(c);
  if (slots) *slots = std::move(slot);
  return added;
}

template <int D>
std::size_t Snapshot<D>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t n = of(planes_) + of(links_) + of(vertex_begin_) + of(shape_) + of(index_) + of(vertices_) +
                  of(cell_of_index_) + of(points_);
  for (const Cell_shape& shape : shapes_) n += sizeof shape + of(shape.loops) + of(shape.loop_begin);
  return n;
}

template class Snapshot<2>;
template class Snapshot<3>;

}  // namespace cellwalk
