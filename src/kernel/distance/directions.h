// SPDX-License-Identifier: LGPL-3.0-or-later
// The directions of which one parts two hulls, if any does: those of pairs of features, in doubles or ring
// numbers.
#ifndef CELLWALK_KERNEL_DISTANCE_DIRECTIONS_H
#define CELLWALK_KERNEL_DISTANCE_DIRECTIONS_H

#include <cellwalk/internal/kernel/distance.h>

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace cellwalk::detail {

/// Coordinates in any ring.
template <class N, int D>
using Numbers = std::array<N, static_cast<std::size_t>(D)>;

template <class N, std::size_t D>
std::array<N, D> difference(const std::array<N, D>& a, const std::array<N, D>& b) {
  std::array<N, D> result;
  for (std::size_t k = 0; k < D; ++k) result[k] = N(a[k] - b[k]);
  return result;
}

template <class N, std::size_t D>
N product(const std::array<N, D>& a, const std::array<N, D>& b) {
  N sum(a[0] * b[0]);
  for (std::size_t k = 1; k < D; ++k) sum = N(sum + a[k] * b[k]);
  return sum;
}

template <class N>
std::array<N, 3> cross_product(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {N(a[1] * b[2] - a[2] * b[1]), N(a[2] * b[0] - a[0] * b[2]), N(a[0] * b[1] - a[1] * b[0])};
}

/// x u - y v.
template <class N, std::size_t D>
std::array<N, D> combined(const N& x, const std::array<N, D>& u, const N& y, const std::array<N, D>& v) {
  std::array<N, D> result;
  for (std::size_t k = 0; k < D; ++k) result[k] = N(x * u[k] - y * v[k]);
  return result;
}

/// The part of u that is normal to e, times e.e; in 2D any normal of e.
template <class N>
std::array<N, 2> normal_part(const std::array<N, 2>&, const std::array<N, 2>& e) {
  return {N(-e[1]), e[0]};
}
template <class N>
std::array<N, 3> normal_part(const std::array<N, 3>& u, const std::array<N, 3>& e) {
  return combined(product(e, e), u, product(u, e), e);
}

/// The points of two hulls in any ring.
template <class N, int D>
struct Hulls {
  std::span<const Numbers<N, D>> a, b;
};

/// The direction of a pair of features; it is normal to both, and may point either way unless both are
/// vertices. The vector is 0 if the features are degenerate, or parallel edges.
template <class N, int D>
Numbers<N, D> direction_of(const Hulls<N, D>& hulls, const Feature_pair& pair) {
  const auto a = [&](std::size_t i) -> const Numbers<N, D>& { return hulls.a[pair.a.corners[i]]; };
  const auto b = [&](std::size_t i) -> const Numbers<N, D>& { return hulls.b[pair.b.corners[i]]; };
  if constexpr (D == 3) {
    if (pair.a.size == 3) return cross_product(difference(a(1), a(0)), difference(a(2), a(0)));
    if (pair.b.size == 3) return cross_product(difference(b(1), b(0)), difference(b(2), b(0)));
    if (pair.a.size == 2 && pair.b.size == 2)
      return cross_product(difference(a(1), a(0)), difference(b(1), b(0)));
  }
  if (pair.a.size == 2) return normal_part(difference(b(0), a(0)), difference(a(1), a(0)));
  if (pair.b.size == 2) return normal_part(difference(b(0), a(0)), difference(b(1), b(0)));
  return difference(b(0), a(0));
}

/// True for a pair of features of hulls with so many corners whose direction is of the list: together they
/// have the dimension D - 1 at most.
template <int D>
bool is_pair(const Feature_pair& pair, std::size_t corners_of_a, std::size_t corners_of_b) {
  if (pair.a.size == 0 || pair.b.size == 0 || pair.a.size + pair.b.size > D + 1) return false;
  for (std::size_t i = 0; i < pair.a.size; ++i)
    if (pair.a.corners[i] >= corners_of_a) return false;
  for (std::size_t i = 0; i < pair.b.size; ++i)
    if (pair.b.corners[i] >= corners_of_b) return false;
  return true;
}

/// The edges of a simplex: all pairs of its corners.
template <class Use>
void for_each_edge_of_simplex(std::size_t corners, Use use) {
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t j = i + 1; j < corners; ++j) use(edge_feature(i, j));
}
/// The sides of a convex polygon, of which a segment has one and a point none.
template <class Use>
void for_each_side_of_polygon(std::size_t corners, Use use) {
  if (corners == 2) use(edge_feature(0, 1));
  if (corners < 3) return;
  for (std::size_t i = 0; i < corners; ++i) use(edge_feature(i, i + 1 == corners ? 0 : i + 1));
}
/// The facets of a simplex in 3D: all triples of its corners.
template <class Use>
void for_each_facet_of_simplex(std::size_t corners, Use use) {
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t j = i + 1; j < corners; ++j)
      for (std::size_t k = j + 1; k < corners; ++k) use(facet_feature(i, j, k));
}
/// The triangles from the first corner of a convex polygon, which fill it; some may have no area.
template <class Use>
void for_each_triangle_of_polygon(std::size_t corners, Use use) {
  for (std::size_t i = 1; i + 1 < corners; ++i) use(facet_feature(0, i, i + 1));
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_DISTANCE_DIRECTIONS_H
