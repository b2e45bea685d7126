// SPDX-License-Identifier: LGPL-3.0-or-later
// Body clearance: a convex region free of walls, in which a body moves without tests. Theory: docs/bodies.md,
// clearance.
#ifndef CELLWALK_BODY_REGION_CLEAR_REGION_H
#define CELLWALK_BODY_REGION_CLEAR_REGION_H

#include <cellwalk/walk/walk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "open_box.h"
#include "wall_plane.h"

namespace cellwalk::detail {

/// An open box cut by open half-spaces, without a point of a wall: the hull of points in it meets none. Edits
/// of the environment void it.
template <int D>
class Clear_region {
 public:
  static constexpr std::size_t most_planes = 16;

  Clear_region() : Clear_region({}, {}, {}) {}
  Clear_region(const Particle<D>& anchor, const Point<D>& low, const Point<D>& high)
      : box_(low, high), anchor_(anchor) {}

  /// A particle in it: the walk from there to any point held is free.
  const Particle<D>& anchor() const { return anchor_; }
  const Open_box<D>& box() const { return box_; }
  std::size_t plane_count() const { return planes_.size(); }

  /// False where rounding leaves doubt; along the plane of a wall there is none.
  bool holds(const Point<D>& x) const { return box_.holds(x) && (planes_.empty() || is_before_planes(x)); }
  /// True if it holds all of them; false if one is not finite.
  /// Cost: half a nanosecond a point where no half-space cuts the box.
  bool holds_all(std::span<const Point<D>> points) const {
    return box_.holds_all(points) && (planes_.empty() || are_before_planes(points));
  }
  /// True if they lie in all half-spaces that cut the box.
  /// \pre the box holds them
  bool are_before_planes(std::span<const Point<D>> points) const {
    for (const Wall_plane<D>& plane : planes_)
      if (!(furthest<D>(plane.normal, points) < plane.inside) && !plane.has_all_before(points)) return false;
    return true;
  }

  /// True if a point lies before the plane that was cut along last.
  bool is_before_last_plane(const Point<D>& x) const { return planes_.back().has_before(x); }

  void set_box(const Point<D>& low, const Point<D>& high) { box_ = {low, high}; }
  /// Makes it smaller: to the part below (above) a value along an axis.
  void cut_above(int axis, double value) { box_.cut_above(axis, value); }
  void cut_below(int axis, double value) { box_.cut_below(axis, value); }
  /// To the points before a plane.
  /// \pre plane_count() < most_planes
  void cut(const Wall_plane<D>& plane) {
    const std::size_t lane = planes_.size() % 2;
    if (lane == 0) pairs_.push_back({});
    for (std::size_t k = 0; k < D; ++k) pairs_.back().normal[k][lane] = plane.normal[k];
    pairs_.back().inside[lane] = plane.inside;
    planes_.push_back(plane);
  }

  /// Moves all bounds inwards, so that walls keep that distance from the hull of points in it.
  ///
  /// Where the product of a point y of the box with a normal n, as rounded, is less than `inside`, y is
  /// before the plane. If e bounds the rounding of such products, n.y < inside - e will do exactly. So it
  /// does for all y within r of x where n.x as rounded is less than inside - 2e - r|n|.
  /// \param r finite, greater than 0
  /// \pre the box is finite
  void move_inwards(double r);

  /// All that a copy has.
  template <class Archive>
  void archive(Archive& a) {
    Point<D> low, high;
    for (int k = 0; k < D; ++k) {
      low[static_cast<std::size_t>(k)] = box_.low(k);
      high[static_cast<std::size_t>(k)] = box_.high(k);
    }
    std::vector<Wall_plane<D>> planes = planes_;
    a(low, high, anchor_, planes);
    if constexpr (Archive::is_reading) {
      *this = Clear_region(anchor_, low, high);
      for (const Wall_plane<D>& plane : planes) cut(plane);
    }
  }

  /// True if a facet lies in or behind the plane of a wall that bounds it.
  bool has_behind_walls(const Cell_view<D>& cell, std::size_t i) const {
    for (const Wall_plane<D>& plane : planes_)
      if (plane.has_behind(cell, i)) return true;
    return false;
  }

 private:
  /// Two planes at once. A lane without one has every point before it.
  struct Plane_pair {
    std::array<Double2, D> normal{};
    Double2 inside{1, 1};
  };

  bool is_before_planes(const Point<D>& x) const {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Plane_pair& pair = pairs_[i];
      Double2 value = pair.normal[0] * x[0];
      for (std::size_t k = 1; k < D; ++k) value += pair.normal[k] * x[k];
      if (all_true(less(value, pair.inside))) [[likely]]
        continue;
      for (std::size_t j = 2 * i; j < std::min(2 * i + 2, planes_.size()); ++j)
        if (!planes_[j].has_before(x)) return false;
    }
    return true;
  }

  Open_box<D> box_;
  std::vector<Wall_plane<D>> planes_;
  std::vector<Plane_pair> pairs_;  ///< the same
  Particle<D> anchor_;
};

/// The points that a region is to hold, and the limits of its search.
template <int D>
struct Region_request {
  std::span<const Point<D>> positions;  ///< as many of these as possible,
  std::span<const Point<D>> targets;    ///< and of these,
  double steps_ahead = 36;              ///< and where this number of further steps of that kind would lead
  double steps_around = 4;              ///< and a margin of this number of steps on all sides
  double margin = 0;                    ///< and one more, of this length
  bool keeps_all = false;               ///< without one of the positions, there is no region
  double radius = 0;                    ///< the distance of walls from the hull of points held
  std::size_t most_planes = 6;          ///< it is cut by; at most Clear_region::most_planes
  std::size_t most_cells = 64;          ///< it may be looked for in, or clusters of cells
  /// Look for walls by clusters of cells; more than most_walls walls that the box meets are too many.
  bool by_clusters = false;
  std::size_t most_walls = 256;
};

struct Region_effort {
  std::uint64_t cells = 0;    ///< looked at, or clusters of them
  std::uint64_t walls = 0;    ///< met, where clusters are looked at
  bool is_exhausted = false;  ///< true if there were more than might be looked at
};

/// A region about a particle, by a flood of the cells that it meets: walls and cells that were not looked at
/// are cut off, if possible so that all positions and targets are kept. None if a wall comes too close to the
/// particle, the positions lie in too many cells, or the request is not finite.
/// \pre the anchor satisfies I1, and is one of the positions; as many targets as positions, or none
/// Cost: about 20 ns a cell met, 100 ns a wall.
template <int D>
std::optional<Clear_region<D>> find_clear_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                 const Region_request<D>& request, Region_effort& effort);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_CLEAR_REGION_H
