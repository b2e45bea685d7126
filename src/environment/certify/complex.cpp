// SPDX-License-Identifier: LGPL-3.0-or-later
// The names of cells and facets in reports, and the error of the lowest cell that fails.
#include "complex.h"

#include <cellwalk/kernel/error.h>

#include "polygon.h"

namespace cellwalk::detail {

template <int D>
Complex<D>::Complex(const Snapshot<D>& snapshot) : snapshot_(snapshot) {
  is_cell_.assign(snapshot.half_facet_slots() / 4, 0);
  first_corner_.assign(is_cell_.size(), 0);
  opposite_.assign(snapshot.half_facet_slots(), Half_facet::none);
  for (std::uint32_t b = 0; b < is_cell_.size(); ++b) {
    is_cell_[b] = snapshot.is_cell(Cell{b});
    if (!is_cell_[b]) continue;
    first_corner_[b] = static_cast<std::uint32_t>(corner_count_);
    corner_count_ += snapshot.view(Cell{b}).vertex_count();
  }
  for_each_cell([&] {
    return [&](Cell c) {
      for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
        const Half_facet f = snapshot.half_facet(c, i);
        opposite_[to_index(f)] = snapshot.opposite(f);
      }
    };
  });
}

template <>
Plane_points<3> plane_of_facet<3>(Predicate_counts& counts, const Cell_view<3>& cell, std::size_t facet) {
  const auto loop = cell.loop(facet);
  Corners corners{{0, 1, 2}, -1};
  if (loop.size() > 3) {
    Polygon<3> polygon;
    for (const std::uint16_t v : loop) polygon.push_back(cell.point(v));
    find_corners(counts, {polygon.data(), polygon.size()}, corners);
  }
  Plane_points<3> plane;
  for (std::size_t i = 0; i < 3; ++i) plane[i] = cell.point_index(loop[corners.at[i]]);
  return plane;
}

template <>
Plane_points<2> plane_of_facet<2>(Predicate_counts&, const Cell_view<2>& cell, std::size_t facet) {
  return {cell.point_index(cell.loop(facet)[0]), cell.point_index(cell.loop(facet)[1])};
}

template <int D>
std::string name(const Snapshot<D>& snapshot, Cell c) {
  return "cell " + std::to_string(snapshot.index(c));
}

template <int D>
std::string name(const Snapshot<D>& snapshot, Half_facet f) {
  std::string text = "facet (";
  for (const std::uint32_t v : snapshot.loop(f)) {
    if (text.back() != '(') text += ' ';
    text += std::to_string(v);
  }
  text += ')';
  return text;
}

template <int D>
std::string full_name(const Snapshot<D>& snapshot, Half_facet f) {
  return name(snapshot, f) + " of " + name(snapshot, snapshot.cell_of(f));
}

void refuse(const std::string& what) { throw Error(Error_code::not_certified, what); }

template class Complex<2>;
template class Complex<3>;
template std::string name(const Snapshot<2>&, Cell);
template std::string name(const Snapshot<3>&, Cell);
template std::string name(const Snapshot<2>&, Half_facet);
template std::string name(const Snapshot<3>&, Half_facet);
template std::string full_name(const Snapshot<2>&, Half_facet);
template std::string full_name(const Snapshot<3>&, Half_facet);

}  // namespace cellwalk::detail
