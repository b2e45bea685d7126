// SPDX-License-Identifier: LGPL-3.0-or-later
// The free cells near a body as half-spaces in rational numbers, and which of them are linked at a place that
// is known by the sides of all planes on which it lies. 3D.
#ifndef CELLWALK_TESTS_BODY_REGISTRATION_NEAR_CELLS_EXACT_H
#define CELLWALK_TESTS_BODY_REGISTRATION_NEAR_CELLS_EXACT_H

#include <cellwalk/environment/snapshot.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/rational_meeting.h"

namespace cellwalk::test {

using Exact_point_3 = std::array<Fraction, 3>;

inline Exact_point_3 exact(const Point<3>& x) { return {Fraction(x[0]), Fraction(x[1]), Fraction(x[2])}; }
inline Exact_point_3 minus(const Exact_point_3& x, const Exact_point_3& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
inline Exact_point_3 cross(const Exact_point_3& x, const Exact_point_3& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
inline Fraction dot(const Exact_point_3& x, const Exact_point_3& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// x -> normal . x - offset; the first coordinate of the normal that is not 0 is 1.
struct Exact_plane {
  Exact_point_3 normal;
  Fraction offset;

  Fraction operator()(const Exact_point_3& x) const { return dot(normal, x) - offset; }
  bool operator<(const Exact_plane& other) const {
    return std::tie(normal, offset) < std::tie(other.normal, other.offset);
  }
};

/// The sides of all planes: -1, 0 or 1.
using Signs = std::vector<signed char>;

class Near_cells_exact {
 public:
  Near_cells_exact(const Snapshot<3>& snapshot, std::span<const Point<3>> of_body) {
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell cell = snapshot.cell(i);
      if (cell == Cell::none || snapshot.is_solid(cell)) continue;
      const Cell_view<3> view = snapshot.view(cell);
      Point<3> low = view.point(0), high = low;
      for (std::size_t v = 1; v < view.vertex_count(); ++v)
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], view.point(v)[k]);
          high[k] = std::max(high[k], view.point(v)[k]);
        }
      if (!is_near(low, high, of_body)) continue;
      number_[cell] = static_cast<int>(cells_.size());
      add(snapshot, cell);
      cells_.back().low = low;
      cells_.back().high = high;
    }
  }

  const std::vector<Exact_plane>& planes() const { return planes_; }
  std::size_t size() const { return cells_.size(); }
  /// -1 if it is not near.
  int number_of(Cell cell) const {
    const auto found = number_.find(cell);
    return found == number_.end() ? -1 : found->second;
  }

  /// Of these planes; 0 for others.
  Signs signs_at(const Exact_point_3& x, std::span<const std::size_t> of) const {
    Signs signs(planes_.size());
    for (const std::size_t p : of) signs[p] = static_cast<signed char>(planes_[p](x).sign());
    return signs;
  }

  /// The cells whose boxes meet that of some points: no others hold a place between them.
  std::vector<std::size_t> near(std::span<const Point<3>> points) const {
    std::vector<std::size_t> result;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (is_near(cells_[c].low, cells_[c].high, points)) result.push_back(c);
    return result;
  }
  /// The planes of cells, ascending.
  std::vector<std::size_t> planes_of(std::span<const std::size_t> cells) const {
    std::vector<std::size_t> result;
    for (const std::size_t c : cells)
      for (const Facet& facet : cells_[c].facets) {
        result.push_back(facet.plane.plane);
        for (const Side& rim : facet.rims) result.push_back(rim.plane);
      }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// Of each cell: the least one linked with it there, -1 if the place is not in it.
  /// \param of those that may hold the place; the signs of their planes are used
  std::vector<int> linked_at(const Signs& signs, std::span<const std::size_t> of) const {
    std::vector<int> least(cells_.size(), -1);
    for (const std::size_t c : of)
      if (std::ranges::all_of(cells_[c].facets, [&](const Facet& f) { return side(f.plane, signs) <= 0; }))
        least[c] = static_cast<int>(c);
    for (const std::size_t c : of)
      for (const Facet& facet : cells_[c].facets) {
        if (least[c] < 0 || facet.is_wall || !holds(facet, signs)) continue;
        const int behind = number_of(facet.neighbour);
        if (behind < 0) continue;
        const int a = least[c], b = least[static_cast<std::size_t>(behind)];
        if (b >= 0 && a != b) std::ranges::replace(least, std::max(a, b), std::min(a, b));
      }
    return least;
  }

  /// True if the place is in a closed facet of a cell that holds it.
  bool is_in(Half_facet f, Cell of, const Signs& signs) const {
    const int c = number_of(of);
    if (c < 0) return false;
    for (const Facet& facet : cells_[static_cast<std::size_t>(c)].facets)
      if (facet.half == f) return holds(facet, signs);
    return false;
  }

 private:
  struct Side {
    std::size_t plane;
    int sense;  ///< times the sign of the plane it is > 0 outside
  };
  struct Facet {
    Half_facet half;
    Side plane;
    std::vector<Side> rims;
    bool is_wall;
    Cell neighbour;
  };
  struct Near_cell {
    std::vector<Facet> facets;
    Point<3> low, high;
  };

  static int side(const Side& of, const Signs& signs) { return of.sense * signs[of.plane]; }
  static bool holds(const Facet& facet, const Signs& signs) {
    return side(facet.plane, signs) == 0 &&
           std::ranges::all_of(facet.rims, [&](const Side& rim) { return side(rim, signs) <= 0; });
  }

  /// True if a box meets that of some points.
  static bool is_near(const Point<3>& low, const Point<3>& high, std::span<const Point<3>> points) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto is_below = [&](const Point<3>& x) { return x[k] < low[k]; };
      const auto is_above = [&](const Point<3>& x) { return x[k] > high[k]; };
      if (std::ranges::all_of(points, is_below) || std::ranges::all_of(points, is_above)) return false;
    }
    return true;
  }

  /// The plane through x with this normal, which points outside.
  Side outward(Exact_point_3 normal, const Exact_point_3& x) {
    Fraction first = 0;
    for (const Fraction& n : normal)
      if (first == 0) first = n;
    for (Fraction& n : normal) n /= first;
    const Exact_plane plane{normal, dot(normal, x)};
    const auto [known, is_new] = plane_number_.try_emplace(plane, planes_.size());
    if (is_new) planes_.push_back(plane);
    return {known->second, first.sign()};
  }

  void add(const Snapshot<3>& snapshot, Cell cell) {
    Near_cell near;
    std::vector<std::vector<Exact_point_3>> loops;
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet f = Snapshot<3>::half_facet(cell, k);
      std::vector<Exact_point_3>& loop = loops.emplace_back();
      for (const std::uint32_t p : snapshot.loop(f)) loop.push_back(exact(snapshot.point(p)));
      Exact_point_3 normal{};
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const auto part = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
        for (std::size_t j = 0; j < 3; ++j) normal[j] += part[j];
      }
      near.facets.push_back(
          {f, outward(normal, loop[0]), {}, snapshot.is_impassable(f), snapshot.neighbour(f)});
    }
    // Of several facets in one plane, rims tell where each of them is.
    for (std::size_t k = 0; k < loops.size(); ++k) {
      const auto is_in_plane = [&](const Facet& other) {
        return other.plane.plane == near.facets[k].plane.plane;
      };
      if (std::ranges::count_if(near.facets, is_in_plane) < 2) continue;
      Exact_point_3 normal = planes_[near.facets[k].plane.plane].normal;
      for (Fraction& n : normal) n *= near.facets[k].plane.sense;
      for (std::size_t i = 0; i < loops[k].size(); ++i) {
        const Exact_point_3 &u = loops[k][i], &v = loops[k][i + 1 == loops[k].size() ? 0 : i + 1];
        near.facets[k].rims.push_back(outward(cross(minus(v, u), normal), u));
      }
    }
    cells_.push_back(std::move(near));
  }

  std::vector<Exact_plane> planes_;
  std::map<Exact_plane, std::size_t> plane_number_;
  std::map<Cell, int> number_;
  std::vector<Near_cell> cells_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_REGISTRATION_NEAR_CELLS_EXACT_H
