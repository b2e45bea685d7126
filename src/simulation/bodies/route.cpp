// SPDX-License-Identifier: LGPL-3.0-or-later
// The shortest way through centres of cells, shortened by walks in a straight line.
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/simulation/route.h>

#include "cheapest_way.h"

namespace cellwalk {
namespace {

template <int D>
Half_facet between(const Snapshot<D>& snapshot, Cell a, Cell b) {
  for (std::size_t i = 0; i < snapshot.facet_count(a); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(a, i);
    if (snapshot.neighbour(f) == b && !snapshot.is_impassable(f)) return f;
  }
  return Half_facet::none;
}

}  // namespace

template <int D>
std::vector<Point<D>> detail::points_of_way(const Snapshot<D>& snapshot, const std::vector<Cell>& way) {
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < way.size(); ++i) {
    points.push_back(centroid(snapshot, way[i]));
    if (i + 1 < way.size()) points.push_back(centroid(snapshot, between(snapshot, way[i], way[i + 1])));
  }
  return points;
}

template <int D>
std::vector<Point<D>> find_route(const Snapshot<D>& snapshot, const Particle<D>& from, const Particle<D>& to,
                                 Walk_counts& counts) {
  const auto distance = [&](Cell a, Cell b) { return length(centroid(snapshot, b) - centroid(snapshot, a)); };
  const std::vector<Cell> way =
      detail::cheapest_way(snapshot, {{from.cell, 0.0}}, {{to.cell, 0.0}}, distance);
  if (way.empty()) return {};
  std::vector<Point<D>> points = detail::points_of_way(snapshot, way);
  points.push_back(to.position);

  std::vector<Point<D>> route{from.position};
  Particle<D> here = from;
  std::size_t next = 0;
  while (next < points.size()) {
    // The furthest point in sight, by doubling and then halving the stride.
    const auto in_sight = [&](std::size_t i) {
      return walk<Exact>(snapshot, here, points[i], counts).status == Walk_status::arrived;
    };
    std::size_t reach = next, stride = 1;
    while (reach + stride < points.size() && in_sight(reach + stride)) reach += stride, stride *= 2;
    for (; stride > 0; stride /= 2)
      if (reach + stride < points.size() && in_sight(reach + stride)) reach += stride;
    // A rounded centre of a sliver may lie just outside its cell; the walk from there starts at the last good
    // place.
    move<Exact>(snapshot, here, points[reach], counts);
    if (points[reach] != route.back()) route.push_back(points[reach]);
    next = reach + 1;
  }
  return route;
}

template std::vector<Point<2>> detail::points_of_way(const Snapshot<2>&, const std::vector<Cell>&);
template std::vector<Point<3>> detail::points_of_way(const Snapshot<3>&, const std::vector<Cell>&);
template std::vector<Point<2>> find_route<2>(const Snapshot<2>&, const Particle<2>&, const Particle<2>&,
                                             Walk_counts&);
template std::vector<Point<3>> find_route<3>(const Snapshot<3>&, const Particle<3>&, const Particle<3>&,
                                             Walk_counts&);

}  // namespace cellwalk
