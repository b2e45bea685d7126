// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/error.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "canonical_shape.h"
#include "compiler.h"
#include "plane_compiler.h"

namespace cellwalk {
namespace {

/// Takes the lowest free run of a length, or the end of its array if there is none; true in the latter case.
std::pair<std::uint32_t, bool> take_run(std::set<std::pair<std::uint32_t, std::uint32_t>>& runs,
                                        std::size_t length, std::size_t end) {
  const auto run = runs.lower_bound({static_cast<std::uint32_t>(length), 0});
  if (run == runs.end() || run->first != length) return {static_cast<std::uint32_t>(end), true};
  const std::uint32_t first = run->second;
  runs.erase(run);
  return {first, false};
}

/// A set of cells, ascending.
class Cell_set {
 public:
  Cell_set(std::span<const Cell> cells, std::size_t slots) : cells_(cells.begin(), cells.end()) {
    if (!std::is_sorted(cells_.begin(), cells_.end())) std::sort(cells_.begin(), cells_.end());
    if (cells_.size() < slots / blocks_a_cell) return;
    is_in_.resize(slots);
    for (const Cell c : cells_) is_in_[to_index(c)] = true;
  }
  const std::vector<Cell>& cells() const { return cells_; }
  bool has(Cell c) const {
    return is_in_.empty() ? std::binary_search(cells_.begin(), cells_.end(), c) : is_in_[to_index(c)];
  }

 private:
  /// If there are fewer cells than one for so many blocks, they are searched; else all blocks are marked.
  static constexpr std::size_t blocks_a_cell = 4096;
  std::vector<Cell> cells_;
  std::vector<bool> is_in_;
};

/// False if a point of the cells lies outside the frame: what planes say holds in it only.
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
  const Half_facet g = opposite(f);
  if (g == Half_facet::none || is_impassable(f) == wall) return;  // the boundary stays a wall
  for (const Half_facet h : {f, g}) {
    std::uint32_t& word = links_[to_index(h)];
    word = wall ? word | wall_bit : word & ~wall_bit;
  }
  // Other facets shared by the two cells carry the same convex-pair condition.
  const Cell a = cell_of(f), b = cell_of(g);
  Snapshot_compiler<D> compiler(*this);
  for (std::size_t i = 0; i < facet_count(a); ++i)
    if (neighbour(half_facet(a, i)) == b) compiler.write_convex_pair(half_facet(a, i));
  for (const Cell c : {a, b}) forget(c);
  ++epoch_;
}

template <int D>
void Snapshot<D>::update_geometry(std::span<const Cell> cells) {
  geometry_epoch_ = ++epoch_;
  for (const Cell c : cells) forget(c);
  Snapshot_compiler<D> compiler(*this);
  // Convex pairs depend on the first vertices of loops, including those of neighbours.
  for (const Cell c : cells)
    if (!compiler.is_tetrahedron(c)) compiler.turn_loops(c);
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
  // A facet between two of the cells is written from the first of them, for both sides.
  const Cell_set changed(cells, shape_.size());
  for (const Cell c : changed.cells()) {
    const auto is_done = [&](Cell other) { return other < c && changed.has(other); };
    if constexpr (D == 3)
      if (compiler.is_tetrahedron(c)) {
        compiler.write_convex_pairs(c, is_done);
        continue;
      }
    for (std::size_t i = 0; i < facet_count(c); ++i)
      if (const Half_facet f = half_facet(c, i); !is_done(neighbour(f))) compiler.write_convex_pair(f);
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
  // All checks of the input come first.
  std::vector<Canonical_cell> cells(soup.cell_count());
  for (std::size_t c = 0; c < cells.size(); ++c) canonicalize(soup, points(), c, cells[c]);

  // The outer facets that the removed cells leave open; the neighbours keep them.
  std::vector<Half_facet> open;
  for (const Cell c : removed) {
    for (std::size_t i = 0; i < facet_count(c); ++i) {
      const Half_facet f = half_facet(c, i);
      const Cell other = neighbour(f);
      if (other != Cell::none && std::find(removed.begin(), removed.end(), other) == removed.end())
        open.push_back(opposite(f));
    }
  }
  std::vector<bool> open_is_wall;
  using Points = boost::container::small_vector<std::uint32_t, 8>;
  std::vector<Points> open_points;  // ascending
  open_is_wall.reserve(open.size());
  open_points.reserve(open.size());
  for (const Half_facet g : open) {
    open_is_wall.push_back(is_impassable(g));
    const Cell_view<D> cell = view(cell_of(g));
    Points& points = open_points.emplace_back();
    for (const std::uint16_t v : cell.loop(facet_of(g))) points.push_back(cell.point_index(v));
    std::sort(points.begin(), points.end());
    forget(cell_of(g));
  }

  // The indices of the removed cells in their order, then the lowest free ones, then new ones.
  std::vector<std::uint32_t> indices;
  indices.reserve(cells.size());
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (i < cells.size())
      indices.push_back(index(removed[i]));
    else
      free_indices_.insert(index(removed[i]));
  }
  while (indices.size() < cells.size() && !free_indices_.empty())
    indices.push_back(free_indices_.extract(free_indices_.begin()).value());
  for (auto next = static_cast<std::uint32_t>(cell_of_index_.size()); indices.size() < cells.size(); ++next)
    indices.push_back(next);

  for (const Cell c : removed) forget(c);
  Snapshot_compiler<D> compiler(*this);
  Free_runs left_blocks, left_vertices;
  for (const Cell c : removed) {
    left_blocks.emplace(block_count(c), to_index(c));
    left_vertices.emplace(view(c).vertex_count(), vertex_begin_[to_index(c)]);
    uncertified_planes_ -= compiler.count_uncertified(c);
    cell_of_index_[index(c)] = to_index(Cell::none);
    compiler.remove_cell(c);
  }

  std::vector<Cell> added;
  std::vector<Half_facet> slot(soup.facet_count());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    added.push_back(add_cell(cells[c], indices[c], soup.solid[c]));
    for (std::size_t k = 0; k < cells[c].facets.size(); ++k)
      slot[cells[c].facets[k]] = half_facet(added.back(), k);
  }
  clusters_.follow_slots(*this);
  // Not before: a name removed by this call must not be reused by it.
  free_blocks_.merge(left_blocks);
  free_vertices_.merge(left_vertices);

  for (const Half_facet g : open) compiler.link_boundary(g);  // until a new cell is linked there
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = gluing.opposite[f];
    if (g != no_facet) {
      if (f < g) compiler.link(slot[f], slot[g], soup.impassable[f] || soup.impassable[g]);
      continue;
    }
    compiler.link_boundary(slot[f]);
    Points own(soup.facet(f).begin(), soup.facet(f).end());
    std::sort(own.begin(), own.end());
    const auto at = std::find(open_points.begin(), open_points.end(), own);
    if (at == open_points.end()) continue;
    const auto i = static_cast<std::size_t>(at - open_points.begin());
    compiler.link(slot[f], open[i], open_is_wall[i] || soup.impassable[f]);
  }
  update_geometry(added);
  if (slots) *slots = std::move(slot);
  return added;
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
