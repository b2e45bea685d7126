// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cellwalk::track_lengths {
namespace {

constexpr double shortest = 1, longest = 9;  // rays, in sides
constexpr int most_attempts = 1000;

struct Ends {
  Point<3> from{}, to{};
};

/// A point with its weight.
struct Term {
  double weight;
  Point<3> point;
};

/// The sum of weighted points, unless a coordinate has to be rounded.
template <std::size_t n>
std::optional<Point<3>> exact_sum(const std::array<Term, n>& terms) {
  Point<3> sum{};
  for (std::size_t k = 0; k < 3; ++k)
    for (const Term& term : terms) {
      const double product = term.weight * term.point[k], next = sum[k] + product, part = next - sum[k];
      if (std::fma(term.weight, term.point[k], -product) != 0) return {};
      if ((sum[k] - (next - part)) + (product - part) != 0) return {};
      sum[k] = next;
    }
  return sum;
}

class Ray_source {
 public:
  Ray_source(const World& world, std::uint64_t seed) : world_(world), random_(seed) {
    double most = 0;
    for (const Point<3>& p : world.snapshot().points())
      for (const double x : p) most = std::max(most, std::abs(x));
    unit_ = std::ldexp(1.0, std::ilogb(most) - 50);
  }

  Ends chord() {
    const Point<3> from = point_in(random_cell());
    return {from, beside(from, random_.real(shortest, longest))};
  }

  Ends degenerate() {
    using Make = std::optional<Ends> (Ray_source::*)();
    constexpr Make makes[] = {&Ray_source::through_vertex, &Ray_source::along_edge, &Ray_source::in_plane,
                              &Ray_source::with_ends_on_cells, &Ray_source::from_vertex_to_vertex};
    if (world_.is_lattice && random_.chance(0.5)) return on_half_integers();
    const Make make = makes[random_.below(std::size(makes))];
    for (int i = 0; i < most_attempts; ++i)
      if (const std::optional<Ends> ends = (this->*make)()) return *ends;
    return *from_vertex_to_vertex();
  }

 private:
  Cell random_cell() {
    const Snapshot<3>& snapshot = world_.snapshot();
    return snapshot.cell(random_.below(snapshot.cell_count()));
  }

  /// The corners of a cell in random order.
  std::array<Point<3>, 4> corners(Cell cell) {
    const Cell_view<3> view = world_.snapshot().view(cell);
    std::array<Point<3>, 4> all{};
    for (std::size_t i = 0; i < 4; ++i) all[i] = view.point(i);
    for (std::size_t i = 4; i > 1; --i) std::swap(all[i - 1], all[random_.below(i)]);
    return all;
  }

  Point<3> point_in(Cell cell) {
    const std::array<Point<3>, 4> corner = corners(cell);
    std::array<double, 3> cut{random_.real(), random_.real(), random_.real()};
    std::ranges::sort(cut);
    const std::array<double, 4> weight{cut[0], cut[1] - cut[0], cut[2] - cut[1], 1 - cut[2]};
    Point<3> point{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) point[k] += weight[i] * corner[i][k];
    return point;
  }

  /// A point at a distance, in sides. No functions that libraries round differently.
  Point<3> beside(const Point<3>& from, double distance) {
    for (;;) {
      const std::array<double, 3> d{random_.real(-1, 1), random_.real(-1, 1), random_.real(-1, 1)};
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (square > 1 || square < 0.01) continue;
      const double scale = distance * world_.side / std::sqrt(square);
      return {from[0] + scale * d[0], from[1] + scale * d[1], from[2] + scale * d[2]};
    }
  }

  int integer(int low, int high) {
    return low + static_cast<int>(random_.below(static_cast<std::uint64_t>(high - low + 1)));
  }

  /// From v - d to v + k d, where d is rounded so that this is often possible.
  std::optional<Ends> through_vertex() {
    const Point<3> v = corners(random_cell())[0], near = beside(v, random_.real(0.5, longest / 2));
    Point<3> d{};
    for (std::size_t k = 0; k < 3; ++k) d[k] = std::round((near[k] - v[k]) / unit_) * unit_;
    const double before = integer(1, 2), after = integer(1, 2);
    return ends(exact_sum<2>({{{1, v}, {-before, d}}}), exact_sum<2>({{{1, v}, {after, d}}}));
  }

  std::optional<Ends> along_edge() {
    const std::array<Point<3>, 4> v = corners(random_cell());
    const auto at = [&](double t) { return exact_sum<2>({{{1 - t, v[0]}, {t, v[1]}}}); };
    return ends(at(integer(-6, 0)), at(integer(1, 7)));
  }

  std::optional<Ends> in_plane() {
    const std::array<Point<3>, 4> v = corners(random_cell());
    const auto at = [&](double s, double t) {
      return exact_sum<3>({{{1 - s - t, v[0]}, {s, v[1]}, {t, v[2]}}});
    };
    const auto from = at(integer(-5, 5), integer(-5, 5)), to = at(integer(-5, 5), integer(-5, 5));
    return ends(from, to);
  }

  /// In a facet, on an edge or on a vertex.
  std::optional<Point<3>> on_boundary(Cell cell) {
    const std::array<Point<3>, 4> v = corners(cell);
    switch (random_.below(3)) {
      case 0:
        return exact_sum<3>({{{0.5, v[0]}, {0.25, v[1]}, {0.25, v[2]}}});
      case 1:
        return exact_sum<2>({{{0.5, v[0]}, {0.5, v[1]}}});
      default:
        return v[0];
    }
  }

  /// The cell at a point beside another one, if it is in free space.
  std::optional<Cell> cell_beside(const Point<3>& from) {
    const auto particle = world_.locator.particle_at(beside(from, random_.real(shortest, longest)));
    if (!particle) return {};
    return particle->cell;
  }

  std::optional<Ends> with_ends_on_cells() {
    const auto from = on_boundary(random_cell());
    if (!from) return {};
    const auto cell = cell_beside(*from);
    if (!cell) return {};
    return ends(from, random_.chance(0.5) ? on_boundary(*cell) : std::optional(point_in(*cell)));
  }

  std::optional<Ends> from_vertex_to_vertex() {
    for (;;) {
      const Point<3> from = corners(random_cell())[0];
      if (const auto cell = cell_beside(from)) return Ends{from, corners(*cell)[0]};
    }
  }

  /// Directions with small components, many of them parallel to axes, facets and edges of a lattice.
  Ends on_half_integers() {
    const Point<3> v = corners(random_cell())[0];
    Ends ray;
    for (std::size_t k = 0; k < 3; ++k) {
      ray.from[k] = v[k] + 0.5 * integer(-1, 1);
      ray.to[k] = ray.from[k] + (random_.chance(0.4) ? 0 : 0.5 * integer(-14, 14));
    }
    return ray;
  }

  static std::optional<Ends> ends(const std::optional<Point<3>>& from, const std::optional<Point<3>>& to) {
    if (!from || !to) return {};
    return Ends{*from, *to};
  }

  const World& world_;
  Random random_;
  double unit_ = 0;
};

}  // namespace

std::string_view name_of(Ray_kind kind) { return kind == Ray_kind::chords ? "chords" : "degenerate"; }

Rays draw(const World& world, Ray_kind kind, std::size_t count, std::uint64_t seed) {
  constexpr std::size_t stray =
      64;  // of so many rays one is drawn as it comes: it may leave, and meets a wall
  Ray_source source(world, seed);
  Rays rays;
  while (rays.size() < count) {
    const Ends ends = kind == Ray_kind::chords ? source.chord() : source.degenerate();
    const auto particle = world.locator.particle_at(ends.from);
    if (!particle || ends.from == ends.to) continue;
    if (rays.size() % stray != 0 && !world.locator.particle_at(ends.to)) continue;
    rays.starts.push_back(*particle);
    rays.targets.push_back(ends.to);
  }
  return rays;
}

}  // namespace cellwalk::track_lengths
