// SPDX-License-Identifier: LGPL-3.0-or-later
// A region free of walls that a part of a body moves in: an open box, cut by the planes of the walls about it.
// Theory: docs/bodies.md, clearance.
#ifndef CELLWALK_BODY_POOLED_REGION_H
#define CELLWALK_BODY_POOLED_REGION_H

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "clear_region.h"
#include "open_box.h"
#include "wall_plane.h"

namespace cellwalk::detail {

template <int D>
class Pooled_region {
 public:
  static constexpr std::size_t most_planes = 16;
  static constexpr bool has_wall_planes = true;

  Pooled_region(const Particle<D>& anchor, const Point<D>& low, const Point<D>& high)
      : box_(low, high), anchor_(anchor) {}

  /// A particle in it: the walk from there to any point held is free.
  const Particle<D>& anchor() const { return anchor_; }
  const Open_box<D>& box() const { return box_; }
  std::size_t plane_count() const { return planes_.size(); }

  /// False where rounding leaves doubt; along the plane of a wall there is none.
  bool holds(const Point<D>& x, Predicate_counts& counts) const {
    if (!box_.holds(x)) return false;
    return std::ranges::all_of(planes_, [&](const Wall_plane<D>& p) { return p.has_before(x, counts); });
  }
  bool holds(const Point<D>& x) const {
    Predicate_counts uncounted;
    return holds(x, uncounted);
  }

  void set_box(const Point<D>& low, const Point<D>& high) { box_ = {low, high}; }
  void cut_above(int axis, double value) { box_.cut_above(axis, value); }
  void cut_below(int axis, double value) { box_.cut_below(axis, value); }
  void cut(const Vector<D>& normal, double offset) { cut(Wall_plane<D>(Cut_plane<D>{normal, 0, offset})); }
  /// \pre plane_count() < most_planes
  void cut(const Wall_plane<D>& plane) { planes_.push_back(plane); }

  /// True if a facet lies in or behind the plane of a wall that bounds it.
  bool is_behind_walls(const Cell_view<D>& cell, std::size_t i) const {
    const auto loop = cell.loop(i);
    Predicate_counts uncounted;
    return std::ranges::any_of(planes_, [&](const Wall_plane<D>& plane) {
      return plane.corners[0] && std::ranges::all_of(loop, [&](std::uint16_t v) {
               return plane.side_of(cell.point(v), uncounted) >= 0;
             });
    });
  }

 private:
  Open_box<D> box_;
  boost::container::static_vector<Wall_plane<D>, most_planes> planes_;
  Particle<D> anchor_;
};

/// As find_clear_region().
template <int D>
std::optional<Pooled_region<D>> find_pooled_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                   const Region_request<D>& request, Region_effort& effort);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_POOLED_REGION_H
