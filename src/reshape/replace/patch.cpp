// SPDX-License-Identifier: LGPL-3.0-or-later
#include "patch.h"

#include <cellwalk/kernel/policies.h>

#include <algorithm>
#include <map>
#include <utility>

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

/// A facet with its sense: in 3D from its lowest point on.
template <int D>
using Loop = std::array<std::uint32_t, static_cast<std::size_t>(D)>;

template <int D>
Loop<D> turned(Loop<D> loop) {
  if (D == 3) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

template <int D>
Loop<D> reversed(Loop<D> loop) {
  std::reverse(loop.begin(), loop.end());
  return turned<D>(loop);
}

template <int D>
Loop<D> loop_of(const Cell_view<D>& cell, std::size_t facet) {
  Loop<D> loop;
  for (std::size_t k = 0; k < loop.size(); ++k) loop[k] = cell.point_index(cell.loop(facet)[k]);
  return turned<D>(loop);
}

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
std::string check_patch(const Snapshot<D>& snapshot, const Patch<D>& patch, Cell_soup<D>& soup) {
  const bool is_solid = snapshot.is_solid(patch.removed.front());
  // Facets that only one cell has, or the other side of none.
  std::vector<Loop<D>> old_open, new_open;
  for (const Cell c : patch.removed)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (std::ranges::find(patch.removed, snapshot.neighbour(f)) == patch.removed.end())
        old_open.push_back(loop_of(snapshot.view(c), i));
      else if (snapshot.is_impassable(f))
        return "a wall lies between the cells";
    }
  Predicate_counts counts;
  for (const auto& cell : patch.cells) {
    if (volume_sign(counts, patch.corners(snapshot, cell)) <= 0) return "a cell would be flat or inverted";
    add_simplex(soup, cell, is_solid);
  }
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    Loop<D> loop;
    std::copy_n(soup.facet(f).begin(), loop.size(), loop.begin());
    new_open.push_back(turned<D>(loop));
  }
  std::sort(new_open.begin(), new_open.end());
  std::erase_if(new_open, [all = new_open](const auto& loop) {
    return std::ranges::binary_search(all, reversed<D>(loop));
  });
  std::sort(old_open.begin(), old_open.end());
  return old_open == new_open ? "" : "the cells would not cover the same region";
}

#define CELLWALK_INSTANTIATE(D)                                             \
  template struct Patch<D>;                                                 \
  template typename Patch<D>::Simplex corners_of(const Snapshot<D>&, Cell); \
  template std::string check_patch(const Snapshot<D>&, const Patch<D>&, Cell_soup<D>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
