// SPDX-License-Identifier: LGPL-3.0-or-later
// The tests of facets and cells by their centroids.
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/records/scene_shape.h>

namespace cellwalk {

using detail::is_in_front;
using detail::is_in_shape;

template <int D>
Point<D> centroid(const Snapshot<D>& snapshot, Half_facet facet) {
  const Cell own = snapshot.cell_of(facet);
  const Cell_view<D> cell = snapshot.view(own);
  Vector<D> sum{};
  const auto loop = cell.loop(snapshot.facet_of(facet));
  for (const std::uint16_t v : loop) sum = sum + (cell.point(v) - Point<D>{});
  return Point<D>{} + (1.0 / static_cast<double>(loop.size())) * sum;
}

template <int D>
Point<D> centroid(const Snapshot<D>& snapshot, Cell cell) {
  const Cell_view<D> view = snapshot.view(cell);
  Vector<D> sum{};
  for (std::size_t v = 0; v < view.vertex_count(); ++v) sum = sum + (view.point(v) - Point<D>{});
  return Point<D>{} + (1.0 / static_cast<double>(view.vertex_count())) * sum;
}

template <int D>
Selection<D> select(const Snapshot<D>& snapshot, const Environment_part<D>& part) {
  Selection<D> result;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    const Point<D> mean = centroid(snapshot, cell);
    const bool is_front = part.plane && is_in_front(*part.plane, mean);
    if (is_in_shape(part, mean) && (!part.plane || is_front)) result.cells.push_back(cell);
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const Cell other = snapshot.neighbour(facet);
      if (other == Cell::none || snapshot.index(other) < i) continue;
      if (!is_in_shape(part, centroid(snapshot, facet))) continue;
      if (part.plane && is_front == is_in_front(*part.plane, centroid(snapshot, other))) continue;
      result.facets.push_back(facet);
    }
  }
  return result;
}

template Selection<2> select(const Snapshot<2>&, const Environment_part<2>&);
template Selection<3> select(const Snapshot<3>&, const Environment_part<3>&);
template Point<2> centroid(const Snapshot<2>&, Half_facet);
template Point<3> centroid(const Snapshot<3>&, Half_facet);
template Point<2> centroid(const Snapshot<2>&, Cell);
template Point<3> centroid(const Snapshot<3>&, Cell);

}  // namespace cellwalk
