// SPDX-License-Identifier: LGPL-3.0-or-later
// Compilation of a whole soup: order, sizes, cells, links, planes.
#include <cellwalk/kernel/error.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "compiler.h"
#include "environment/soup/parallel.h"
#include "plane_compiler.h"
#include "space_filling.h"

namespace cellwalk {
namespace {

/// Cells in the order of the Hilbert curve through their vertex means; ties in input order.
template <int D>
std::vector<std::uint32_t> curve_order(const Cell_soup<D>& soup, const Plane_frame<D>& frame) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(soup.cell_count());
  for_each_parallel(keys.size(), [&](std::size_t c) {
    const std::size_t begin = soup.facet_begin[soup.cell_begin[c]],
                      end = soup.facet_begin[soup.cell_begin[c + 1]];
    std::array<std::uint32_t, D> grid{};
    for (int k = 0; k < D; ++k) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i)
        sum += (soup.points[soup.vertices[i]][k] - frame.centre[k]) * frame.scale;
      const double mean = begin == end ? 0 : sum / static_cast<double>(end - begin);
      // If the frame maps nothing, the mean is not a number, and the order is that of the input.
      const double t = (mean + 1) / 2 * ((1 << curve_bits) - 1);
      grid[k] = t >= 0 ? static_cast<std::uint32_t>(std::min(t, double{(1 << curve_bits) - 1})) : 0;
    }
    keys[c] = {hilbert_position<D>(grid), static_cast<std::uint32_t>(c)};
  });
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace

template <int D>
Snapshot<D> Snapshot<D>::compile(const Cell_soup<D>& soup, const Gluing& gluing,
                                 std::vector<Half_facet>* slots) {
  Snapshot s;
  s.points_ = soup.points;
  s.frame_ = make_frame<D>(s.points_);
  const std::size_t cells = soup.cell_count();
  const std::vector<std::uint32_t> order = curve_order(soup, s.frame_);

  // Upper bounds of the start of each cell; a cell has at most as many vertices as loop entries.
  std::vector<std::uint32_t> first_block(cells), first_vertex(cells), vertex_count(cells);
  for_each_parallel(cells, [&](std::size_t c) {
    thread_local std::vector<std::uint32_t> distinct;
    distinct.clear();
    for (std::size_t i = soup.facet_begin[soup.cell_begin[c]]; i < soup.facet_begin[soup.cell_begin[c + 1]];
         ++i)
      if (std::find(distinct.begin(), distinct.end(), soup.vertices[i]) == distinct.end())
        distinct.push_back(soup.vertices[i]);
    vertex_count[c] = static_cast<std::uint32_t>(distinct.size());
  });
  std::size_t blocks = 0, vertices = 0;
  for (const std::uint32_t c : order) {
    first_block[c] = static_cast<std::uint32_t>(blocks);
    first_vertex[c] = static_cast<std::uint32_t>(vertices);
    const std::size_t facets = soup.cell_begin[c + 1] - soup.cell_begin[c];
    const std::size_t own_blocks = Snapshot_compiler<D>::blocks_for(facets);
    if (c == order.front()) s.uniform_blocks_ = own_blocks;
    if (own_blocks != s.uniform_blocks_) s.uniform_blocks_ = 0;
    blocks += own_blocks;
    vertices += vertex_count[c];
  }
  if (blocks > most_blocks) throw Error(Error_code::input, "more than 10^9 cells: split the environment");
  s.planes_.resize(blocks);
  s.links_.resize(4 * blocks);
  s.vertex_begin_.resize(blocks);
  s.shape_.resize(blocks);
  s.index_.resize(blocks);
  s.vertices_.resize(vertices);
  s.cell_of_index_.resize(cells);

  Snapshot_compiler<D> compiler(s);
  std::vector<Half_facet> own_slots;
  std::vector<Half_facet>& slot = slots ? *slots : own_slots;
  slot.resize(soup.facet_count());
  for_each_parallel(cells, [&](std::size_t i) {
    thread_local Canonical_cell cell;
    const std::uint32_t c = order[i];
    canonicalize(soup, s.points_, c, cell);
    compiler.write_cell(cell, first_block[c], first_vertex[c], c, soup.solid[c]);
    for (std::size_t k = 0; k < cell.facets.size(); ++k)
      slot[cell.facets[k]] = half_facet(Cell{first_block[c]}, k);
  });
  if (s.shapes_.size() > 1) compiler.number_shapes();
  std::atomic<std::size_t> uncertified{0};
  for_each_parallel(cells, [&](std::size_t i) {
    const std::uint32_t c = order[i];
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      const std::uint32_t g = gluing.opposite[f];
      if (g == no_facet)
        compiler.link_boundary(slot[f]);
      else if (f < g)
        compiler.link(slot[f], slot[g], soup.impassable[f] || soup.impassable[g]);
    }
    const std::size_t n = compiler.write_planes(Cell{first_block[c]});
    if (n) uncertified += n;
  });
  s.uncertified_planes_ = uncertified;
  return s;
}

template Snapshot<2> Snapshot<2>::compile(const Cell_soup<2>&, const Gluing&, std::vector<Half_facet>*);
template Snapshot<3> Snapshot<3>::compile(const Cell_soup<3>&, const Gluing&, std::vector<Half_facet>*);

}  // namespace cellwalk
