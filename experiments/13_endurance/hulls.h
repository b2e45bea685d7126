// SPDX-License-Identifier: LGPL-3.0-or-later
// Directions that may part a triangle and a wall, in numbers of any type.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_HULLS_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_HULLS_H

#include <array>
#include <cstddef>
#include <utility>

namespace cellwalk::endurance {

template <class N, int D>
using Tuple = std::array<N, static_cast<std::size_t>(D)>;

template <class N, std::size_t D>
std::array<N, D> minus(const std::array<N, D>& a, const std::array<N, D>& b) {
  std::array<N, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}
template <class N, std::size_t D>
N product(const std::array<N, D>& a, const std::array<N, D>& b) {
  N r = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) r += a[i] * b[i];
  return r;
}
template <class N>
std::array<N, 3> across(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class N>
std::array<N, 2> across(const std::array<N, 2>& a) {
  return {-a[1], a[0]};
}

/// A direction, and the square of a length of which its rounding error is a small part: that of the terms
/// that were summed up, where each difference of corners counts as if it was 2^4 longer (2^8 is that
/// squared).
template <class N, int D>
struct Direction {
  Tuple<N, D> n{};
  N square_of_terms{};
};

/// A triangle and a wall: a segment (2D), or a triangle or a quadrangle with parallel sides.
template <class N, int D>
struct Hulls {
  std::array<Tuple<N, D>, 3> triangle;
  std::array<Tuple<N, D>, 4> wall;
  std::size_t size = 0;  ///< corners of the wall

  std::size_t edges_of_wall() const { return D == 2 ? 1 : size; }
  std::size_t direction_count() const {
    return D == 2 ? 4 + 3 * size : 2 + 3 * size + 3 * edges_of_wall() + 3 * size + 3 * edges_of_wall();
  }

  /// Number k of the list; those that decide most often come first.
  Direction<N, D> direction(std::size_t k) const {
    const auto edge = [](const auto& corners, std::size_t count, std::size_t i) {
      return minus(corners[(i + 1) % count], corners[i]);
    };
    if constexpr (D == 2) {
      if (k < 4) {
        const Tuple<N, D> e = k == 0 ? edge(wall, 2, 0) : edge(triangle, 3, k - 1);
        return {across(e), longer(e)};
      }
      return difference(k - 4);
    } else {
      const std::size_t edges = edges_of_wall();
      if (k == 0) return crossed(edge(wall, size, 0), edge(wall, size, 1));
      if (k == 1) return crossed(edge(triangle, 3, 0), edge(triangle, 3, 1));
      k -= 2;
      if (k < 3 * size) return difference(k);
      k -= 3 * size;
      if (k < 3 * edges) return crossed(edge(triangle, 3, k / edges), edge(wall, size, k % edges));
      k -= 3 * edges;
      if (k < 3 * size) return beside(minus(wall[k / 3], triangle[k % 3]), edge(triangle, 3, k % 3));
      k -= 3 * size;
      return beside(minus(wall[k % edges], triangle[k / edges]), edge(wall, size, k % edges));
    }
  }

  /// The gap between the hulls along n, or against it: at most 0 if their shadows meet.
  N gap(const Tuple<N, D>& n) const {
    N low_a = product(n, triangle[0]), high_a = low_a, low_b = product(n, wall[0]), high_b = low_b;
    for (std::size_t i = 1; i < 3; ++i) widen(product(n, triangle[i]), low_a, high_a);
    for (std::size_t i = 1; i < size; ++i) widen(product(n, wall[i]), low_b, high_b);
    const N up = low_b - high_a, down = low_a - high_b;
    return up < down ? down : up;
  }

 private:
  static N longer(const Tuple<N, D>& x) { return product(x, x) + N(256); }
  static void widen(const N& x, N& low, N& high) {
    if (x < low) low = x;
    if (high < x) high = x;
  }
  Direction<N, D> difference(std::size_t k) const {
    const Tuple<N, D> n = minus(wall[k / 3], triangle[k % 3]);
    return {n, longer(n)};
  }
  static Direction<N, D> crossed(const Tuple<N, D>& e, const Tuple<N, D>& f) {
    return {across(e, f), longer(e) * longer(f)};
  }
  /// The part of u across e.
  static Direction<N, D> beside(const Tuple<N, D>& u, const Tuple<N, D>& e) {
    const N ee = product(e, e), ue = product(u, e);
    Tuple<N, D> n;
    for (std::size_t i = 0; i < D; ++i) n[i] = ee * u[i] - ue * e[i];
    return {n, longer(e) * longer(e) * longer(u)};
  }
};

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_HULLS_H
