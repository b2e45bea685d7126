// SPDX-License-Identifier: LGPL-3.0-or-later
// Gaps along directions, feet of pairs of features, and the list of all directions.
#include "ring_hulls.h"

#include <algorithm>
#include <utility>

namespace cellwalk::detail {
namespace {

int sign(const Ring& x) { return static_cast<int>(CGAL::sign(x)); }

/// True if 0 <= x <= most.
bool is_between(const Ring& x, const Ring& most) { return sign(x) >= 0 && !(most < x); }

/// True if the foot of x on the line of an edge lies in the edge.
template <std::size_t D>
bool has_foot_in_edge(const std::array<Ring, D>& x, const std::array<Ring, D>& from,
                      const std::array<Ring, D>& to) {
  const auto e = difference(to, from);
  return is_between(product(difference(x, from), e), product(e, e));
}

/// True if the foot of x on the plane of a triangle of normal n lies in the triangle.
bool has_foot_in_triangle(const std::array<Ring, 3>& x,
                          const std::array<const std::array<Ring, 3>*, 3>& triangle,
                          const std::array<Ring, 3>& n) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &from = *triangle[i], &to = *triangle[(i + 1) % 3];
    if (sign(product(cross_product(difference(to, from), difference(x, from)), n)) < 0) return false;
  }
  return true;
}

}  // namespace

/// The direction of a pair, from a to b if it parts them, and the order of what it shows and r.
template <int D>
std::pair<typename Ring_hulls<D>::Corner, std::strong_ordering> Ring_hulls<D>::measure(
    const Feature_pair& pair) const {
  Corner n = direction_of<Ring, D>(hulls(), pair);
  // The ends of both hulls along n, from the first corner of b.
  const auto bounds = [&](const Corners& corners) {
    Ring low(product(n, difference(corners[0], b_[0]))), high(low);
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Ring at(product(n, difference(corners[i], b_[0])));
      if (at < low) low = at;
      if (high < at) high = at;
    }
    return std::pair(low, high);
  };
  const auto [a_low, a_high] = bounds(a_);
  const auto [b_low, b_high] = bounds(b_);
  const Ring right(b_low - a_high), left(a_low - b_high);
  const bool is_right = sign(right) > 0;
  const Ring& gap = is_right ? right : left;
  // Hulls that overlap deeply have a large square, too: the sign has to be tested.
  if (sign(gap) <= 0) return {n, std::strong_ordering::less};
  const Ring excess(Ring(gap * gap) - Ring(square_ * product(n, n)));
  if (!is_right)
    for (Ring& x : n) x = Ring(-x);
  return {n, sign(excess) <=> 0};
}

template <int D>
bool Ring_hulls<D>::has_feet(const Feature_pair& pair, const Corner& n) const {
  const auto a = [&](std::size_t i) -> const Corner& { return a_[pair.a.corners[i]]; };
  const auto b = [&](std::size_t i) -> const Corner& { return b_[pair.b.corners[i]]; };
  if constexpr (D == 3) {
    if (pair.b.size == 3) return has_foot_in_triangle(a(0), {&b(0), &b(1), &b(2)}, n);
    if (pair.a.size == 3) return has_foot_in_triangle(b(0), {&a(0), &a(1), &a(2)}, n);
    if (pair.a.size == 2 && pair.b.size == 2) {
      // The weights of the feet, times n.n, by Cramer's rule.
      const auto d = difference(a(1), a(0)), e = difference(b(1), b(0)), u = difference(b(0), a(0));
      const Ring nn(product(n, n));
      return is_between(product(cross_product(u, e), n), nn) &&
             is_between(product(cross_product(u, d), n), nn);
    }
  }
  if (pair.a.size == 2) return has_foot_in_edge(b(0), a(0), a(1));
  if (pair.b.size == 2) return has_foot_in_edge(a(0), b(0), b(1));
  return true;
}

template <int D>
bool Ring_hulls<D>::are_near(const Feature_pair& pair) const {
  const Corner n = direction_of<Ring, D>(hulls(), pair);
  const Ring nn(product(n, n));
  if (sign(nn) == 0) {
    // Two vertices in the same place; other features of direction 0 say nothing.
    return pair.a.size == 1 && pair.b.size == 1;
  }
  const Ring along(product(n, difference(b_[pair.b.corners[0]], a_[pair.a.corners[0]])));
  return Ring(along * along) < Ring(square_ * nn) && has_feet(pair, n);
}

/// Calls use() with each pair of the list, until it returns false.
template <int D>
template <class Use>
void Ring_hulls<D>::for_each_pair(Use use) const {
  bool goes_on = true;
  const auto test = [&](const Feature& a, const Feature& b) {
    const Feature_pair pair{a, b};
    if (goes_on && is_pair<D>(pair, a_.size(), b_.size())) goes_on = use(pair);
  };
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const Feature vertex = vertex_feature(i);
    for (std::size_t j = 0; j < b_.size(); ++j) test(vertex, vertex_feature(j));
    for_each_side_of_polygon(b_.size(), [&](const Feature& side) { test(vertex, side); });
  }
  for_each_edge_of_simplex(a_.size(), [&](const Feature& edge) {
    for (std::size_t j = 0; j < b_.size(); ++j) test(edge, vertex_feature(j));
    for_each_side_of_polygon(b_.size(), [&](const Feature& side) { test(edge, side); });
  });
  for_each_triangle_of_polygon(b_.size(), [&](const Feature& facet) { test(vertex_feature(0), facet); });
  for_each_facet_of_simplex(a_.size(), [&](const Feature& facet) { test(facet, vertex_feature(0)); });
}

template <int D>
bool Ring_hulls<D>::are_parted() const {
  bool found = false;
  for_each_pair([&](const Feature_pair& pair) { return !(found = parts(pair)); });
  return found;
}

/// No direction shows more than the distance.
template <int D>
std::optional<typename Ring_hulls<D>::Corner> Ring_hulls<D>::find_direction_at_distance() const {
  std::optional<Corner> found;
  for_each_pair([&](const Feature_pair& pair) {
    const auto [n, order] = measure(pair);
    if (order > 0) found.reset();
    if (order == 0) found = n;
    return order <= 0;
  });
  return found;
}

template class Ring_hulls<2>;
template class Ring_hulls<3>;

}  // namespace cellwalk::detail
