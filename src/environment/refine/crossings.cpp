// SPDX-License-Identifier: LGPL-3.0-or-later
// Crossings by signs in a plane; their coordinates from views along all axes.
#include "crossings.h"

#include <cellwalk/internal/environment/box_grid.h>
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "environment/certify/polygon.h"
#include "environment/soup/describe_place.h"
#include "overlay.h"

namespace cellwalk::detail {
namespace {

/// A side of one facet of a pair and a side of the other.
struct Two_sides {
  std::uint32_t p, q, r, s;
};

class Crossings {
 public:
  Crossings(std::vector<Point<3>>& points, std::span<const Lone_facet<3>> facets, double tolerance,
            Sides<3>& sides)
      : points_(points), tolerance_(tolerance), sides_(sides) {
    if (tolerance_ == 0) return;
    for (const Lone_facet<3>& facet : facets)
      for (const std::uint32_t v : facet.loop) known_.set(v, {points[v], points[v]});
  }

  void add(const Lone_facet<3>& f, const Lone_facet<3>& g) {
    const Flat_view view = flat_view(points_, f);
    const auto at = [&](std::uint32_t v) { return view(points_[v]); };
    const Signs_in_plane signs{tolerance_};
    const auto parts = [&](std::uint32_t u, std::uint32_t v, std::uint32_t x, std::uint32_t y) {
      return signs.turn(at(u), at(v), at(x)) * signs.turn(at(u), at(v), at(y)) < 0;
    };
    for (std::size_t i = 0; i < f.loop.size(); ++i)
      for (std::size_t j = 0; j < g.loop.size(); ++j) {
        const Two_sides two{f.loop[i], f.loop[(i + 1) % f.loop.size()], g.loop[j],
                            g.loop[(j + 1) % g.loop.size()]};
        const auto [p, q, r, s] = two;
        const bool have_common_end = p == r || p == s || q == r || q == s;
        if (have_common_end || !parts(p, q, r, s) || !parts(r, s, p, q)) continue;
        const std::uint32_t x = tolerance_ == 0 ? exact_crossing(two, f.cell, g.cell)
                                                : crossing_near({at(p), at(q), {at(r), at(s)}}, two);
        sides_.add(p, q, x);
        sides_.add(r, s, x);
      }
  }

 private:
  std::uint32_t exact_crossing(const Two_sides& two, std::uint32_t cell, std::uint32_t other) {
    const Side_crossing crossing =
        crossing_of(points_[two.p], points_[two.q], points_[two.r], points_[two.s]);
    if (!crossing.is_exact)
      throw Error(Error_code::not_certified,
                  "cells " + std::to_string(cell) + " and " + std::to_string(other) +
                      ": their facets cross at about " + describe_place(crossing.point) +
                      ", which no coordinates give exactly: cut them there, or give --conform 1e-9");
    return point_at(crossing.point);
  }

  std::uint32_t crossing_near(const Crossing<2>& crossing, const Two_sides& two) {
    const Point<3> x = point_on<3>(points_[two.p], points_[two.q], crossing_time(crossing));
    const Vector<3> margin = with_all_coordinates<3>(tolerance_);
    std::vector<std::uint32_t> near;
    known_.find({x - margin, x + margin}, near);
    if (!near.empty()) return *std::min_element(near.begin(), near.end());
    const std::uint32_t v = point_at(x);
    known_.set(v, {x, x});
    return v;
  }

  std::uint32_t point_at(const Point<3>& x) {
    if (indices_.empty())
      for (std::uint32_t v = 0; v < points_.size(); ++v) indices_.try_emplace(points_[v], v);
    const auto [at, is_new] = indices_.try_emplace(x, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(x);
    return at->second;
  }

  std::vector<Point<3>>& points_;
  double tolerance_;
  Sides<3>& sides_;
  Box_grid<3> known_;                          ///< vertices and crossings, if there is a tolerance
  std::map<Point<3>, std::uint32_t> indices_;  ///< of points, the lowest in each place
};

}  // namespace

Flat_view flat_view(std::span<const Point<3>> points, const Lone_facet<3>& facet) {
  if (facet.is_sound) {
    Predicate_counts counts;
    const Point<3>&p = points[facet.plane[0]], &q = points[facet.plane[1]], &r = points[facet.plane[2]];
    const int axis = projection_axis(counts, p, q, r);
    return {axis, turn(counts, p, q, r, axis) > 0};
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(facet.normal[i]) > std::abs(facet.normal[axis])) axis = i;
  return {static_cast<int>(axis), facet.normal[axis] > 0};
}

Side_crossing crossing_of(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  // A coordinate that no view shows is the same for all of them.
  Side_crossing crossing{p, true};
  Predicate_counts counts;
  for (int axis = 0; axis < 3; ++axis) {
    if (turn(counts, p, r, s, axis) * turn(counts, q, r, s, axis) >= 0) continue;
    const Point_bounds<2> bounds =
        bounds_at(Crossing<2>{drop(p, axis), drop(q, axis), {drop(r, axis), drop(s, axis)}});
    for (std::size_t k = 0; k < 2; ++k) {
      crossing.point[(static_cast<std::size_t>(axis) + 1 + k) % 3] = bounds.below[k] + 0.0;  // no -0
      crossing.is_exact = crossing.is_exact && bounds.below[k] == bounds.above[k];
    }
  }
  return crossing;
}

void add_crossings(std::vector<Point<3>>& points, std::span<const Lone_facet<3>> facets,
                   std::span<const Facet_pair> pairs, double tolerance, Sides<3>& sides) {
  Crossings crossings(points, facets, tolerance, sides);
  for (const auto& [i, j] : pairs) crossings.add(facets[i], facets[j]);
}

}  // namespace cellwalk::detail
