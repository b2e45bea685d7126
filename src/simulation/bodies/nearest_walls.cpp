// SPDX-License-Identifier: LGPL-3.0-or-later
// Distances from segments and triangles, and a search in the boxes that are near enough.
#include "nearest_walls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace cellwalk::detail {
namespace {

constexpr std::uint32_t most_in_leaf = 4;

template <std::size_t D>
std::array<double, D> nearest_of(const std::array<double, D>& x, const std::array<double, D>& a,
                                 const std::array<double, D>& b) {
  const auto along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(x - a, along) / square, 0.0, 1.0) : 0;
  return a + t * along;
}

Point<2> nearest_of(const Point<2>& x, const std::array<Point<2>, 2>& segment) {
  return nearest_of(x, segment[0], segment[1]);
}

/// Over the triangle, the foot of the perpendicular; otherwise the nearest point of a side.
Point<3> nearest_of(const Point<3>& x, const std::array<Point<3>, 3>& t) {
  const Vector<3> n = cross(t[1] - t[0], t[2] - t[0]);
  const double square = dot(n, n);
  bool is_over = square > 0;
  for (std::size_t i = 0; i < 3 && is_over; ++i)
    is_over = dot(cross(t[(i + 1) % 3] - t[i], x - t[i]), n) >= 0;
  if (is_over) return x - (dot(x - t[0], n) / square) * n;
  Point<3> best = nearest_of(x, t[2], t[0]);
  for (std::size_t i = 0; i < 2; ++i) {
    const Point<3> other = nearest_of(x, t[i], t[i + 1]);
    if (length(other - x) < length(best - x)) best = other;
  }
  return best;
}

template <int D>
Box<D> box_around(const std::array<Point<D>, static_cast<std::size_t>(D)>& simplex) {
  Box<D> box;
  for (const Point<D>& corner : simplex) box.extend(corner);
  return box;
}

template <int D>
double distance_of(const Point<D>& x, const Box<D>& box) {
  Vector<D> off{};
  for (std::size_t k = 0; k < D; ++k) off[k] = std::max({0.0, box.low[k] - x[k], x[k] - box.high[k]});
  return length(off);
}

}  // namespace

template <int D>
Nearest_walls<D>::Nearest_walls(const Snapshot<D>& snapshot, const std::set<Half_facet>& left_out) {
  Box<D> all;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || snapshot.is_solid(c)) continue;
    for (const std::uint32_t p : snapshot.view(c).vertices) all.extend(snapshot.point(p));
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      if (!snapshot.is_impassable(f) && snapshot.neighbour(f) != Cell::none) continue;
      const Half_facet other = snapshot.opposite(f);
      if (!left_out.contains(f) && (other == Half_facet::none || !left_out.contains(other))) add(snapshot, f);
    }
  }
  size_ = length(all.high - all.low);
  if (!simplices_.empty()) divide(0, static_cast<std::uint32_t>(simplices_.size()));
}

/// Makes the node of some simplices and those below it. Returns its number.
template <int D>
std::uint32_t Nearest_walls<D>::divide(std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node{{}, begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i) node.box.extend(box_around<D>(simplices_[i]));
  nodes_.push_back(node);
  if (end - begin <= most_in_leaf) return number;
  const Vector<D> sizes = node.box.high - node.box.low;
  const std::ptrdiff_t axis = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  const auto place = [axis](const Simplex& s) {
    double sum = 0;
    for (const Point<D>& corner : s) sum += corner[static_cast<std::size_t>(axis)];
    return sum;
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(simplices_.begin() + begin, simplices_.begin() + middle, simplices_.begin() + end,
                   [&](const Simplex& a, const Simplex& b) { return place(a) < place(b); });
  divide(begin, middle);
  const std::uint32_t second = divide(middle, end);
  nodes_[number].second = second;
  return number;
}

/// Facets are convex: a fan covers them.
template <int D>
void Nearest_walls<D>::add(const Snapshot<D>& snapshot, Half_facet wall) {
  const std::vector<std::uint32_t> loop = snapshot.loop(wall);
  for (std::size_t i = 1; i + (D - 2) < loop.size(); ++i) {
    Simplex simplex;
    simplex[0] = snapshot.point(loop[0]);
    for (std::size_t k = 1; k < D; ++k) simplex[k] = snapshot.point(loop[i + k - 1]);
    simplices_.push_back(simplex);
  }
}

template <int D>
Near_wall<D> Nearest_walls<D>::nearest(const Point<D>& x) {
  if (simplices_.empty()) return {x, size_};
  Near_wall<D> best{{}, std::numeric_limits<double>::infinity()};
  const auto look_at = [&](std::uint32_t i) {
    const Point<D> point = nearest_of(x, simplices_[i]);
    const double distance = length(point - x);
    // Of walls at the same distance, one that does not depend on the order.
    if (distance > best.distance || (distance == best.distance && !(point < best.point))) return;
    best = {point, distance};
    last_ = i;
  };
  look_at(last_);
  open_ = {0};
  while (!open_.empty()) {
    const std::uint32_t number = open_.back();
    const Node& node = nodes_[number];
    open_.pop_back();
    if (distance_of<D>(x, node.box) > best.distance) continue;
    if (node.second == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) look_at(i);
      continue;
    }
    // The nearer one is looked at first.
    std::array<std::uint32_t, 2> below{node.second, number + 1};
    if (distance_of<D>(x, nodes_[below[0]].box) < distance_of<D>(x, nodes_[below[1]].box))
      std::swap(below[0], below[1]);
    open_.insert(open_.end(), below.begin(), below.end());
  }
  return best;
}

template class Nearest_walls<2>;
template class Nearest_walls<3>;

}  // namespace cellwalk::detail
