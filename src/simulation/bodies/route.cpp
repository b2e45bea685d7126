// SPDX-License-Identifier: LGPL-3.0-or-later
// The shortest way through centres of cells, shortened by walks in a straight line.
#include <cellwalk/internal/simulation/route.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>

namespace cellwalk {
namespace {

/// The mean of a cell's vertices: inside, up to rounding, since the cell is convex.
template <int D>
Point<D> centre(const Snapshot<D>& snapshot, Cell c) {
  const Cell_view<D> view = snapshot.view(c);
  Point<D> sum{};
  for (std::size_t i = 0; i < view.vertex_count(); ++i) sum = sum + view.point(i);
  return (1.0 / static_cast<double>(view.vertex_count())) * sum;
}

/// Cells from `from` to `to`, both included, by the shortest way through centres; empty if there is none.
template <int D>
std::vector<Cell> shortest_way(const Snapshot<D>& snapshot, Cell from, Cell to) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> distance(snapshot.cell_slots(), never);
  std::vector<Cell> before(snapshot.cell_slots(), Cell::none);
  // By distance, then by index: the way does not depend on the order of the snapshot.
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[snapshot.index(from)] = 0;
  open.emplace(0.0, snapshot.index(from));
  while (!open.empty()) {
    const auto [d, index] = open.top();
    open.pop();
    if (d > distance[index]) continue;
    const Cell c = snapshot.cell(index);
    if (c == to) break;
    const Point<D> here = centre(snapshot, c);
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const Cell next = snapshot.neighbour(f);
      if (next == Cell::none || snapshot.is_impassable(f)) continue;
      const double through = d + length(centre(snapshot, next) - here);
      const std::uint32_t n = snapshot.index(next);
      if (!(through < distance[n])) continue;
      distance[n] = through;
      before[n] = c;
      open.emplace(through, n);
    }
  }
  if (distance[snapshot.index(to)] == never) return {};
  std::vector<Cell> way{to};
  while (way.back() != from) way.push_back(before[snapshot.index(way.back())]);
  std::reverse(way.begin(), way.end());
  return way;
}

/// The mean of a facet's vertices.
template <int D>
Point<D> facet_centre(const Snapshot<D>& snapshot, Half_facet f) {
  Point<D> sum{};
  const auto loop = snapshot.loop(f);
  for (const std::uint32_t p : loop) sum = sum + snapshot.point(p);
  return (1.0 / static_cast<double>(loop.size())) * sum;
}

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
std::vector<Point<D>> find_route(const Snapshot<D>& snapshot, const Particle<D>& from, const Particle<D>& to,
                                 Walk_counts& counts) {
  const std::vector<Cell> way = shortest_way(snapshot, from.cell, to.cell);
  if (way.empty()) return {};
  // Through every cell's centre and the centre of the facet to the next: each piece lies in one convex cell.
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < way.size(); ++i) {
    points.push_back(centre(snapshot, way[i]));
    if (i + 1 < way.size()) points.push_back(facet_centre(snapshot, between(snapshot, way[i], way[i + 1])));
  }
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

template std::vector<Point<2>> find_route<2>(const Snapshot<2>&, const Particle<2>&, const Particle<2>&,
                                             Walk_counts&);
template std::vector<Point<3>> find_route<3>(const Snapshot<3>&, const Particle<3>&, const Particle<3>&,
                                             Walk_counts&);

}  // namespace cellwalk
