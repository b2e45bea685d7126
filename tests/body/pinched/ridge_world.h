// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds with a ridge: walls in half-planes that end at the x axis, other ones on each piece of it.
#ifndef CELLWALK_TESTS_BODY_PINCHED_RIDGE_WORLD_H
#define CELLWALK_TESTS_BODY_PINCHED_RIDGE_WORLD_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace cellwalk::test::ridge {

using Rational = boost::multiprecision::cpp_rational;
/// Coordinates in a world: whole numbers, or fractions on edges.
template <class N>
using Xyz = std::array<N, 3>;

/// A point by the half-planes beside it: alpha times the direction of one, and beta times that of the next.
struct Place {
  int x = 0, half_plane = 0, alpha = 0, beta = 0;

  bool is_on_axis() const { return alpha == 0; }
  bool is_in_half_plane() const { return alpha > 0 && beta == 0; }
};

/// The sides of a cell: those at less and greater x, in its own half-plane and the next one counterclockwise,
/// towards the axis and away from it.
enum class Side { low, high, own, next, in, out };
constexpr std::array all_sides{Side::low, Side::high, Side::own, Side::next, Side::in, Side::out};
using Cell_side = std::pair<std::size_t, Side>;

/// The cells between neighbouring half-planes are wedges at the axis in shell 0, and what is around these in
/// shell 1. Planes across the axis part them into slabs. A wall is the side of a cell in its half-plane.
class Ridge_world {
 public:
  static constexpr int shells = 2, slab_length = 40;
  static constexpr std::array<int, shells + 1> levels{0, 4, 16};  ///< alpha + beta at the borders of shells

  /// Two walls beside each other at the axis, and few others: parts of a body may pass between these.
  explicit Ridge_world(Random& random) : slabs(3 + static_cast<int>(random.below(2))) {
    constexpr std::array<std::array<int, 2>, 16> all{{{2, 0},
                                                      {2, 1},
                                                      {2, 2},
                                                      {1, 2},
                                                      {0, 2},
                                                      {-1, 2},
                                                      {-2, 2},
                                                      {-2, 1},
                                                      {-2, 0},
                                                      {-2, -1},
                                                      {-2, -2},
                                                      {-1, -2},
                                                      {0, -2},
                                                      {1, -2},
                                                      {2, -2},
                                                      {2, -1}}};
    for (std::size_t k = random.below(3); k < all.size(); k += 1 + random.below(4))
      directions.push_back(all[k]);
    has_wall_.resize(cell_count());
    narrow_slab = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(slabs) - 2));
    narrow_sector = static_cast<int>(random.below(directions.size()));
    for (int slab = 0; slab < slabs; ++slab)
      for (int k = 0; k < sectors(); ++k) {
        const bool is_beside = slab == narrow_slab && (k == narrow_sector || k == next(narrow_sector));
        has_wall_[cell(slab, k, 0)] = is_beside || random.chance(0.1);
        has_wall_[cell(slab, k, 1)] = random.chance(0.05);
      }
  }

  static std::pair<int, int> levels_of(int shell) {
    return {levels.at(index(shell)), levels.at(index(shell + 1))};
  }
  int sectors() const { return static_cast<int>(directions.size()); }
  int next(int k) const { return (k + 1) % sectors(); }
  int before(int k) const { return (k + sectors() - 1) % sectors(); }
  std::size_t cell_count() const { return static_cast<std::size_t>(slabs * sectors() * shells); }
  std::size_t cell(int slab, int half_plane, int shell) const {
    return static_cast<std::size_t>((slab * sectors() + half_plane) * shells + shell);
  }
  bool has_wall(int slab, int half_plane, int shell) const {
    return has_wall_[cell(slab, half_plane, shell)];
  }
  /// Slab, sector and shell of a cell.
  std::array<int, 3> parts(std::size_t cell) const {
    const int c = static_cast<int>(cell);
    return {c / shells / sectors(), c / shells % sectors(), c % shells};
  }

  Xyz<int> point(const Place& p) const {
    const auto &u = directions[index(p.half_plane)], &v = directions[index(next(p.half_plane))];
    return {p.x, p.alpha * u[0] + p.beta * v[0], p.alpha * u[1] + p.beta * v[1]};
  }
  /// >= 0 on the inner side; affine.
  template <class N>
  N value(std::size_t cell, Side side, const Xyz<N>& p) const {
    const auto [slab, k, shell] = parts(cell);
    const auto &u = directions[index(k)], &v = directions[index(next(k))];
    const N own = u[0] * p[2] - u[1] * p[1], other = p[1] * v[1] - p[2] * v[0];
    const int unit = u[0] * v[1] - u[1] * v[0];  // of own + other a level
    switch (side) {
      case Side::low:
        return p[0] - slab * slab_length;
      case Side::high:
        return (slab + 1) * slab_length - p[0];
      case Side::own:
        return own;
      case Side::next:
        return other;
      case Side::in:
        return own + other - unit * levels_of(shell).first;
      case Side::out:
        return unit * levels_of(shell).second - own - other;
    }
    return 0;
  }
  template <class N>
  bool holds(std::size_t cell, const Xyz<N>& p) const {
    for (const Side side : all_sides)
      if (value(cell, side, p) < 0) return false;
    return true;
  }
  /// By cell: whether it is linked with a cell at a point of both.
  template <class N>
  std::vector<bool> linked(std::size_t cell, const Xyz<N>& p) const {
    std::vector<bool> found(cell_count());
    std::vector<std::size_t> queue{cell};
    found[cell] = true;
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (const Side side : all_sides) {
        if (!is_passable(queue[at], side) || value(queue[at], side, p) != 0) continue;
        const std::size_t other = neighbour(queue[at], side);
        if (!found[other] && holds(other, p)) queue.push_back(other), found[other] = true;
      }
    return found;
  }

  std::size_t neighbour(std::size_t cell, Side side) const;

  Environment<3> build() const;
  /// The side of a cell on which all points are that a half-facet has.
  Cell_side side_of(const Snapshot<3>& snapshot, Half_facet half) const;

  int slabs;
  std::vector<std::array<int, 2>> directions;  ///< y and z of the half-planes, counterclockwise
  int narrow_slab = 0, narrow_sector = 0;      ///< where there are walls in both half-planes

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  bool is_passable(std::size_t cell, Side side) const;

  std::vector<bool> has_wall_;  ///< by cell
};

inline bool Ridge_world::is_passable(std::size_t cell, Side side) const {
  const auto [slab, k, shell] = parts(cell);
  switch (side) {
    case Side::low:
      return slab > 0;
    case Side::high:
      return slab + 1 < slabs;
    case Side::own:
      return !has_wall(slab, k, shell);
    case Side::next:
      return !has_wall(slab, next(k), shell);
    case Side::in:
      return shell > 0;
    case Side::out:
      return shell + 1 < shells;
  }
  return false;
}

inline std::size_t Ridge_world::neighbour(std::size_t of, Side side) const {
  const auto [slab, k, shell] = parts(of);
  switch (side) {
    case Side::low:
      return cell(slab - 1, k, shell);
    case Side::high:
      return cell(slab + 1, k, shell);
    case Side::own:
      return cell(slab, before(k), shell);
    case Side::next:
      return cell(slab, next(k), shell);
    case Side::in:
      return cell(slab, k, shell - 1);
    case Side::out:
      return cell(slab, k, shell + 1);
  }
  return of;
}

inline Environment<3> Ridge_world::build() const {
  Cell_soup<3> soup;
  const int row = 1 + sectors() * shells;  // points of a plane across the axis
  const auto id = [&](int plane, int k, int shell) {
    return static_cast<std::uint32_t>(plane * row + (shell == 0 ? 0 : 1 + k * shells + shell - 1));
  };
  for (int plane = 0; plane <= slabs; ++plane) {
    soup.points.push_back({1.0 * plane * slab_length, 0, 0});
    for (const auto& [y, z] : directions)
      for (int shell = 1; shell <= shells; ++shell) {
        const int level = levels_of(shell - 1).second;
        soup.points.push_back({1.0 * plane * slab_length, 1.0 * level * y, 1.0 * level * z});
      }
  }
  for (std::size_t c = 0; c < cell_count(); ++c) {
    const auto [slab, k, shell] = parts(c);
    std::vector<std::uint32_t> low{id(slab, k, shell), id(slab, k, shell + 1), id(slab, next(k), shell + 1)};
    std::vector<Side> sides{Side::own, Side::out, Side::next};
    if (shell > 0) low.push_back(id(slab, next(k), shell)), sides.push_back(Side::in);
    std::vector<std::uint32_t> high = low;
    for (std::uint32_t& v : high) v += static_cast<std::uint32_t>(row);
    soup.add_facet(std::vector<std::uint32_t>(low.rbegin(), low.rend()), !is_passable(c, Side::low));
    soup.add_facet(high, !is_passable(c, Side::high));
    for (std::size_t m = 0; m < low.size(); ++m) {
      const std::size_t n = (m + 1) % low.size();
      soup.add_facet({low[m], low[n], high[n], high[m]}, !is_passable(c, sides[m]));
    }
    soup.end_cell();
  }
  return Environment<3>::build(soup, {.split = false});
}

inline Cell_side Ridge_world::side_of(const Snapshot<3>& snapshot, Half_facet half) const {
  const std::size_t c = snapshot.index(snapshot.cell_of(half));
  for (const Side side : all_sides) {
    bool is_on_side = true;
    for (const std::uint32_t v : snapshot.loop(half)) {
      const Point<3>& x = snapshot.point(v);
      is_on_side &= value(c, side, Xyz<double>{x[0], x[1], x[2]}) == 0;
    }
    if (is_on_side) return {c, side};
  }
  return {c, Side::low};
}

}  // namespace cellwalk::test::ridge

#endif  // CELLWALK_TESTS_BODY_PINCHED_RIDGE_WORLD_H
