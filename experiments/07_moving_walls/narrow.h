// SPDX-License-Identifier: LGPL-3.0-or-later
// Does a wall pass through an edge while one of its corners moves? In floating point, and by exact signs.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_NARROW_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_NARROW_H

#include <cellwalk/internal/kernel/swept_simplex.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace cellwalk::moving_walls {

/// A wall of which one corner moves. Its corners are counterclockwise seen from free space, first the one
/// that moves.
struct Moving_wall {
  Point<3> from, to;
  std::array<Point<3>, 2> still;
};
using Edge = std::array<Point<3>, 2>;

enum class Arithmetic : std::uint8_t { single, twice, exact };
inline constexpr std::array arithmetics{Arithmetic::single, Arithmetic::twice, Arithmetic::exact};
constexpr std::string_view name_of(Arithmetic a) {
  return a == Arithmetic::exact ? "exact" : a == Arithmetic::twice ? "double" : "float";
}

/// The edge, clipped by the four planes of the tetrahedron that the wall sweeps, in floating point: true if
/// something of it is left inside. Coordinates are rounded first.
template <class Real>
bool passes_rounded(const Moving_wall& wall, const Edge& edge) {
  using Vector = std::array<Real, 3>;
  const auto rounded = [](const Point<3>& x) {
    return Vector{static_cast<Real>(x[0]), static_cast<Real>(x[1]), static_cast<Real>(x[2])};
  };
  const auto volume = [](const std::array<Vector, 4>& k) {
    Vector u, v, w;
    for (std::size_t i = 0; i < 3; ++i)
      u[i] = k[1][i] - k[0][i], v[i] = k[2][i] - k[0][i], w[i] = k[3][i] - k[0][i];
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
           w[2] * (u[0] * v[1] - u[1] * v[0]);
  };
  const std::array<Vector, 4> corners{rounded(wall.from), rounded(wall.to), rounded(wall.still[0]),
                                      rounded(wall.still[1])};
  const Vector p = rounded(edge[0]), q = rounded(edge[1]);
  const Real sense = volume(corners);
  if (sense == 0) return false;
  Real enters = 0, leaves = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vector, 4> replaced = corners;
    replaced[i] = p;
    const Real at_p = sense > 0 ? volume(replaced) : -volume(replaced);
    replaced[i] = q;
    const Real at_q = sense > 0 ? volume(replaced) : -volume(replaced);
    if (at_p <= 0 && at_q <= 0) return false;
    if (at_p < 0) enters = std::max(enters, at_p / (at_p - at_q));
    if (at_q < 0) leaves = std::min(leaves, at_p / (at_p - at_q));
  }
  return enters < leaves;
}

/// By exact signs, as Reshaping uses them. What the wall only touches is decided by its side: free space is
/// on one side of these walls.
/// \pre from != to
bool passes_exactly(const Moving_wall& wall, const Edge& edge, Predicate_counts& counts);

bool passes(Arithmetic arithmetic, const Moving_wall& wall, const Edge& edge, Predicate_counts& counts);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_NARROW_H
