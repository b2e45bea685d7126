// SPDX-License-Identifier: LGPL-3.0-or-later
#include "patch.h"

#include <cellwalk/kernel/policies.h>

#include <algorithm>
#include <compare>
#include <span>
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

/// A facet of a simplex with its sense.
template <int D>
struct Oriented_facet {
  std::array<std::uint32_t, static_cast<std::size_t>(D)> points;  ///< ascending
  bool is_odd = false;                                            ///< an odd permutation of them is the loop

  explicit Oriented_facet(std::span<const std::uint32_t> loop) {
    std::copy_n(loop.begin(), points.size(), points.begin());
    const auto order = [&](std::size_t i, std::size_t j) {
      if (points[i] <= points[j]) return;
      std::swap(points[i], points[j]);
      is_odd = !is_odd;
    };
    order(0, 1);
    if constexpr (D == 3) {
      order(1, 2);
      order(0, 1);
    }
  }
  auto operator<=>(const Oriented_facet&) const = default;
};

template <int D>
Oriented_facet<D> facet_of(const Cell_view<D>& cell, std::size_t facet) {
  std::array<std::uint32_t, static_cast<std::size_t>(D)> loop;
  for (std::size_t k = 0; k < loop.size(); ++k) loop[k] = cell.point_index(cell.loop(facet)[k]);
  return Oriented_facet<D>(loop);
}

/// Takes pairs of facets out that have the same points and run against each other.
template <int D>
void remove_pairs(std::vector<Oriented_facet<D>>& sorted) {
  auto kept = sorted.begin();
  for (auto f = sorted.begin(); f != sorted.end(); ++f) {
    const auto next = f + 1;
    if (next != sorted.end() && next->points == f->points && next->is_odd != f->is_odd)
      f = next;
    else
      *kept++ = *f;
  }
  sorted.erase(kept, sorted.end());
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
  std::vector<Oriented_facet<D>> old_open, new_open;
  for (const Cell c : patch.removed)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (std::ranges::find(patch.removed, snapshot.neighbour(f)) == patch.removed.end())
        old_open.push_back(facet_of(snapshot.view(c), i));
      else if (snapshot.is_impassable(f))
        return "a wall lies between the cells";
    }
  Predicate_counts counts;
  constexpr std::size_t facets = D + 1;
  soup.cell_begin.reserve(patch.cells.size() + 1);
  soup.facet_begin.reserve(facets * patch.cells.size() + 1);
  soup.vertices.reserve(facets * D * patch.cells.size());
  soup.impassable.reserve(facets * patch.cells.size());
  for (const auto& cell : patch.cells) {
    if (volume_sign(counts, patch.corners(snapshot, cell)) <= 0) return "a cell would be flat or inverted";
    add_simplex(soup, cell, is_solid);
  }
  new_open.reserve(soup.facet_count());
  for (std::size_t f = 0; f < soup.facet_count(); ++f) new_open.emplace_back(soup.facet(f));
  std::sort(new_open.begin(), new_open.end());
  remove_pairs(new_open);
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
