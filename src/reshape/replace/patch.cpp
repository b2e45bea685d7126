// SPDX-License-Identifier: LGPL-3.0-or-later
// The signs of the new cells, and the comparison of their border with that of the old ones.
#include "patch.h"

#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/facet_table.h>
#include <cellwalk/kernel/exact.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <span>

namespace cellwalk::detail {
namespace {

int volume_sign(Predicate_counts& counts, const Corners_of_simplex<2>& x) {
  return Exact::orientation(counts, x[0], x[1], x[2]);
}

int volume_sign(Predicate_counts& counts, const Corners_of_simplex<3>& x) {
  return Exact::orientation(counts, x[0], x[1], x[2], x[3]);
}

void add_simplex(Cell_soup<2>& soup, const Patch<2>::Simplex& x, bool is_solid) {
  for (std::size_t k = 0; k < 3; ++k) soup.add_facet({x[k], x[(k + 1) % 3]});
  soup.end_cell(is_solid);
}

void add_simplex(Cell_soup<3>& soup, const Patch<3>::Simplex& x, bool is_solid) {
  soup.add_facet({x[0], x[2], x[1]});
  soup.add_facet({x[0], x[1], x[3]});
  soup.add_facet({x[1], x[2], x[3]});
  soup.add_facet({x[2], x[0], x[3]});
  soup.end_cell(is_solid);
}

using Loop = std::span<const std::uint32_t>;

/// True if two facets with the same points turn the same way.
bool are_alike(Loop a, Loop b) {
  if (a.size() == 2) return a[0] == b[0];
  const auto at = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  return a[1] == b[at == 2 ? 0 : at + 1];
}

/// The facets between simplices and all others.
template <int D>
class Border {
 public:
  /// False if a wall lies between two of the cells.
  bool add(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
    for (const Cell c : cells)
      for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        if (std::ranges::find(cells, snapshot.neighbour(f)) == cells.end())
          add(snapshot.view(c), i);
        else if (snapshot.is_impassable(f))
          return false;
      }
    return true;
  }

  /// True if other simplices have the same facets to all others, with the same sense, and each facet between
  /// two of them turns one way in the one and the other way in the other.
  bool is_that_of(const Cell_soup<D>& soup, const Gluing& gluing) const {
    Facet_table table(count());
    for (std::uint32_t n = 0; n < count(); ++n) table.enter(n, loops());
    boost::container::small_vector<bool, 64> is_left(count(), true);
    std::size_t left = count();
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
      const std::uint32_t g = gluing.opposite[f];
      if (g != no_facet) {
        // Of more than two facets with the same points, some is not that opposite to its opposite.
        if (gluing.opposite[g] != f || are_alike(soup.facet(f), soup.facet(g))) return false;
        continue;
      }
      const std::uint32_t n = table.find(soup.facet(f), loops());
      if (n == no_facet || !is_left[n] || !are_alike(soup.facet(f), loops()(n))) return false;
      is_left[n] = false;
      --left;
    }
    return left == 0;
  }

 private:
  void add(const Cell_view<D>& cell, std::size_t facet) {
    for (const std::uint16_t v : cell.loop(facet)) points_.push_back(cell.point_index(v));
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size() / D); }
  auto loops() const {
    return [this](std::uint32_t n) { return Loop(points_.data() + D * n, D); };
  }

  boost::container::small_vector<std::uint32_t, 128> points_;
};

}  // namespace

template <int D>
Corners_of_simplex<D> Patch<D>::corners(const Snapshot<D>& snapshot, const Simplex& cell) const {
  Corners_of_simplex<D> x;
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = added && cell[k] == snapshot.next_point() ? *added : snapshot.point(cell[k]);
  return x;
}

template <int D>
typename Patch<D>::Simplex corners_of(const Snapshot<D>& snapshot, Cell cell) {
  const Cell_view<D> view = snapshot.view(cell);
  const auto loop = view.loop(0);
  std::size_t apex = D * (D + 1) / 2;
  for (const std::uint16_t v : loop) apex -= v;
  if constexpr (D == 2)
    return {view.point_index(loop[0]), view.point_index(loop[1]), view.point_index(apex)};
  else
    return {view.point_index(loop[1]), view.point_index(loop[0]), view.point_index(loop[2]),
            view.point_index(apex)};
}

template <int D>
std::string check_patch(const Snapshot<D>& snapshot, const Patch<D>& patch, Cell_soup<D>& soup,
                        Gluing& gluing) {
  const bool is_solid = snapshot.is_solid(patch.removed.front());
  Border<D> border;
  if (!patch.covers && !border.add(snapshot, patch.removed)) return "a wall lies between the cells";
  Predicate_counts counts;
  constexpr std::size_t facets = D + 1;
  soup.cell_begin.reserve(patch.cells.size() + 1);
  soup.facet_begin.reserve(facets * patch.cells.size() + 1);
  soup.vertices.reserve(facets * D * patch.cells.size());
  soup.impassable.reserve(facets * patch.cells.size());
  soup.solid.reserve(patch.cells.size());
  for (const auto& cell : patch.cells) {
    if (volume_sign(counts, patch.corners(snapshot, cell)) <= 0) return "a cell would be flat or inverted";
    add_simplex(soup, cell, is_solid);
  }
  gluing = glue_patch(soup);
  return patch.covers || border.is_that_of(soup, gluing) ? "" : "the cells would not cover the same region";
}

#define CELLWALK_INSTANTIATE(D)                                             \
  template struct Patch<D>;                                                 \
  template typename Patch<D>::Simplex corners_of(const Snapshot<D>&, Cell); \
  template std::string check_patch(const Snapshot<D>&, const Patch<D>&, Cell_soup<D>&, Gluing&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
