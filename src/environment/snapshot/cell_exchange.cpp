// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of new cells, their names, and their links with the cells that stay.
#include "cell_exchange.h"

#include <cellwalk/internal/environment/facet_table.h>

#include <algorithm>
#include <utility>

#include "compiler.h"

namespace cellwalk {

template <int D>
Cell_exchange<D>::Cell_exchange(const Snapshot<D>& snapshot, std::span<const Cell> cells_removed,
                                const Cell_soup<D>& cells, const Gluing& gluing_of_cells)
    : removed(cells_removed),
      soup(cells),
      gluing(gluing_of_cells),
      outside(cells.facet_count(), Half_facet::none) {
  boost::container::small_vector<std::uint32_t, 128> points, begin{0};
  for (const Cell c : removed)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet own = Snapshot<D>::half_facet(c, i);
      const Cell other = snapshot.neighbour(own);
      if (other == Cell::none || std::ranges::find(removed, other) != removed.end()) continue;
      left_open.push_back(snapshot.opposite(own));
      const Cell_view<D> view = snapshot.view(c);
      for (const std::uint16_t v : view.loop(i)) points.push_back(view.point_index(v));
      begin.push_back(static_cast<std::uint32_t>(points.size()));
    }
  const auto loop_of = [&](std::uint32_t n) {
    return std::span<const std::uint32_t>(points.data() + begin[n], points.data() + begin[n + 1]);
  };
  detail::Facet_table table(left_open.size());
  for (std::uint32_t n = 0; n < left_open.size(); ++n) table.enter(n, loop_of);
  for (std::size_t f = 0; f < cells.facet_count(); ++f) {
    if (gluing.opposite[f] != no_facet) continue;
    const std::uint32_t n = table.find(cells.facet(f), loop_of);
    if (n != no_facet) outside[f] = std::exchange(left_open[n], Half_facet::none);
  }
  left_open.erase(std::remove(left_open.begin(), left_open.end(), Half_facet::none), left_open.end());
}

template <int D>
std::vector<Cell> Snapshot_compiler<D>::exchange(const Cell_exchange<D>& x, std::vector<Half_facet>& slots) {
  const Cell_soup<D>& soup = x.soup;
  const std::size_t count = soup.cell_count();
  // All checks of the input come first.
  thread_local Canonical_cell canonical;
  for (std::size_t c = 0; c < count; ++c) check_size(soup, c);

  // The indices of the removed cells in their order, then the lowest free ones, then new ones.
  boost::container::small_vector<std::uint32_t, 32> indices;
  for (std::size_t i = 0; i < x.removed.size(); ++i) {
    if (i < count)
      indices.push_back(s_.index(x.removed[i]));
    else
      s_.free_indices_.insert(s_.index(x.removed[i]));
  }
  while (indices.size() < count && !s_.free_indices_.empty())
    indices.push_back(s_.free_indices_.extract(s_.free_indices_.begin()).value());
  for (auto next = static_cast<std::uint32_t>(s_.cell_of_index_.size()); indices.size() < count; ++next)
    indices.push_back(next);

  for (const Half_facet f : x.outside)
    if (f != Half_facet::none) s_.forget(s_.cell_of(f));
  for (const Half_facet f : x.left_open) s_.forget(s_.cell_of(f));
  boost::container::small_vector<typename Snapshot<D>::Free_runs::value_type, 32> left_blocks, left_vertices;
  for (const Cell c : x.removed) {
    s_.forget(c);
    left_blocks.emplace_back(s_.block_count(c), to_index(c));
    left_vertices.emplace_back(s_.view(c).vertex_count(), s_.vertex_begin_[to_index(c)]);
    s_.uncertified_planes_ -= count_uncertified(c);
    s_.cell_of_index_[s_.index(c)] = to_index(Cell::none);
    remove_cell(c);
  }

  std::vector<Cell> added;
  added.reserve(count);
  slots.resize(soup.facet_count());
  for (std::size_t c = 0; c < count; ++c) {
    canonicalize(soup, s_.points(), c, canonical);
    added.push_back(s_.add_cell(canonical, indices[c], soup.solid[c]));
    for (std::size_t k = 0; k < canonical.facets.size(); ++k)
      slots[canonical.facets[k]] = Snapshot<D>::half_facet(added.back(), k);
  }
  s_.clusters_.follow_slots(s_);
  // Not before: a name removed by this call must not be reused by it.
  s_.free_blocks_.insert(left_blocks.begin(), left_blocks.end());
  s_.free_vertices_.insert(left_vertices.begin(), left_vertices.end());

  boost::container::small_vector<Half_facet, 16> closed;  // of cells that stay
  const auto close = [&](Half_facet f) {
    if (!s_.is_impassable(f)) closed.push_back(f);
  };
  for (const Half_facet f : x.left_open) {
    close(f);
    link_boundary(f);
  }
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = x.gluing.opposite[f];
    const Half_facet out = x.outside[f];
    if (g != no_facet) {
      if (f < g) link(slots[f], slots[g], soup.impassable[f] || soup.impassable[g]);
    } else if (out != Half_facet::none) {
      if (soup.impassable[f]) close(out);
      link(slots[f], out, s_.is_impassable(out) || soup.impassable[f]);
    } else {
      link_boundary(slots[f]);
    }
  }
  s_.update_geometry(added);
  s_.edits_.note_new(s_.epoch_, added, x.removed.size() == 1 ? x.removed[0] : Cell::none);
  for (const Half_facet f : closed) s_.edits_.note_turned(s_.epoch_, f, Half_facet::none);
  return added;
}

#define CELLWALK_INSTANTIATE(D)                                                      \
  template struct Cell_exchange<D>;                                                  \
  template std::vector<Cell> Snapshot_compiler<D>::exchange(const Cell_exchange<D>&, \
                                                            std::vector<Half_facet>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
