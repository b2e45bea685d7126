// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for a region free of walls, of any kind: a flood of the cells that its box meets. Theory:
// docs/bodies.md, clearance.
#ifndef CELLWALK_BODY_REGION_REGION_SEARCH_H
#define CELLWALK_BODY_REGION_REGION_SEARCH_H

#include <cellwalk/internal/environment/cell_list.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "clear_region.h"
#include "cut_plane.h"
#include "met_walls.h"
#include "wall_plane.h"

namespace cellwalk::detail {

/// The number of steps from the body at which a cut of the box will do; nearer to it, a half-space is tried.
constexpr double enough_steps = 4;
/// How often a direction is turned to part two sets of points.
constexpr int most_turns = 6;
/// Half the extent of the frame, and a margin for rounding.
constexpr double frame_and_more = 1 + 0x1p-20;
/// The number of blocks whose cells are looked at in one go.
constexpr std::size_t blocks_at_once = 16;

template <int D>
class Region_search {
 public:
  /// \param found scratch space
  Region_search(const Snapshot<D>& snapshot, const Particle<D>& anchor, const Region_request<D>& request,
                Region_effort& effort, Cell_list& found)
      : snapshot_(snapshot),
        request_(request),
        effort_(effort),
        kept_(box_of<D>(request.positions)),
        wanted_(kept_),
        positions_(request.positions),
        targets_(request.targets),
        region_(anchor, kept_.low, kept_.high),
        found_(found) {
    const Box<D> targets = box_of<D>(request.targets);
    if (!request.targets.empty()) wanted_.extend(targets);
    double step = 0;
    Vector<D> up{}, down{};
    for (std::size_t k = 0; k < D && !request.targets.empty(); ++k) {
      up[k] = targets.high[k] - kept_.high[k];
      down[k] = kept_.low[k] - targets.low[k];
      step = std::max({step, std::abs(up[k]), std::abs(down[k])});
    }
    enough_ = enough_steps * step + 0.5 * request.margin;
    Point<D> low, high;
    for (std::size_t k = 0; k < D; ++k) {
      const double around = request.steps_around * step + request.margin;
      low[k] = wanted_.low[k] - request.steps_ahead * std::max(0.0, down[k]) - around;
      high[k] = wanted_.high[k] + request.steps_ahead * std::max(0.0, up[k]) + around;
      sizes_[k] = std::max(std::abs(low[k]), std::abs(high[k]));
    }
    region_.set_box(low, high);
  }

  /// As find(), by a flood of clusters: the nearest walls are cut off first.
  bool find_by_clusters() {
    if (!is_finite(sizes_)) return false;
    thread_local std::vector<Met_wall<D>> walls;
    Frame_box<D> reach(snapshot_.frame(), box());
    const Frame_box<D> kept(snapshot_.frame(), kept_);
    const auto cut_at_once = [this](Half_facet wall) { return cut_off(wall); };
    if (!find_met_walls(snapshot_, region_.anchor().cell, reach, kept, request_, effort_, walls, cut_at_once))
      return false;
    std::ranges::sort(walls, {}, &Met_wall<D>::gap);
    for (const Met_wall<D>& wall : walls) {
      if (!is_mapped_) reach = Frame_box<D>(snapshot_.frame(), box());
      is_mapped_ = true;
      // Most are beyond the planes that were cut off before.
      if (wall.is_met_by(reach) && !cut_off(wall.facet())) return false;
    }
    return region_.holds(region_.anchor().position);
  }

  bool find() {
    if (!is_finite(sizes_)) return false;
    found_.assign(region_.anchor().cell);
    bool is_good = true;
    for (std::size_t head = 0; is_good && head < found_.size(); ++head) is_good = visit(found_[head]);
    effort_.cells += found_.size();
    // The box is open: a body without extent needs one around it.
    return is_good && region_.holds(region_.anchor().position);
  }
  const Clear_region<D>& region() const { return region_; }

 private:
  Box<D> box() const {
    Box<D> box;
    for (int k = 0; k < D; ++k) {
      box.low[k] = region_.box().low(k);
      box.high[k] = region_.box().high(k);
    }
    return box;
  }

  /// Cuts its walls off, and adds its neighbours. False if a cut cannot be made.
  bool visit(Cell cell) {
    const std::size_t blocks = snapshot_.block_count(cell);
    for (std::size_t begin = 0; begin < blocks; begin += blocks_at_once) {
      // A bit a facet; lanes without one are met where the planes decide nothing.
      std::uint64_t met = 0, walls = 0;
      if (!is_mapped_) map_box();
      const std::size_t end = std::min(blocks, begin + blocks_at_once);
      for (std::size_t b = begin; b < end; ++b) {
        met |= std::uint64_t{facets_met(snapshot_.blocks(cell)[b])} << 4 * (b - begin);
        walls |= std::uint64_t{snapshot_.impassable_facets(cell, b)} << 4 * (b - begin);
      }
      const auto facet = [begin](std::uint64_t bits) {
        return 4 * begin + static_cast<std::size_t>(std::countr_zero(bits));
      };
      for (std::uint64_t left = met & walls; left != 0; left &= left - 1)
        if (!cut_off(snapshot_.view(cell), facet(left))) return false;
      for (std::uint64_t left = met & ~walls; left != 0; left &= left - 1)
        if (!enter(cell, facet(left))) return false;
    }
    return true;
  }

  /// Adds the cell behind a passable facet; if there are too many, the facet is cut off. False if that cannot
  /// be made.
  bool enter(Cell cell, std::size_t i) {
    const Cell next = snapshot_.neighbour(Snapshot<D>::half_facet(cell, i));
    if (next == Cell::none || found_.contains(next)) return true;
    if (found_.size() >= request_.most_cells) {
      effort_.is_exhausted = true;
      return cut_off(snapshot_.view(cell), i, false);
    }
    prefetch(next);
    found_.add(next);
    return true;
  }

  /// Fetches the data that visit() will need: in a large environment the cells are not in the cache, and so
  /// they come side by side.
  void prefetch(Cell cell) const {
    const Plane_block<D>* planes = snapshot_.blocks(cell);
    for (std::size_t b = 0; b < snapshot_.block_count(cell); ++b) __builtin_prefetch(planes + b);
    __builtin_prefetch(snapshot_.links(cell));
  }

  /// Facets (bits) of a block whose planes the closed box does not certainly lie inside of. The corner of the
  /// box that is furthest outside is a point like any other: its value is within plane_error.
  unsigned facets_met(const Plane_block<D>& block) {
    std::array<Float4, D> far;
    for (std::size_t k = 0; k < D; ++k)
      far[k] = cellwalk::lane_max(block.normal[k] * low_[k], block.normal[k] * high_[k]);
    const Float4 r = far[D - 1] + block.offset;
    Float4 value = far[0] + r;
    if constexpr (D == 3) value = (far[0] + far[1]) + r;
    return ~lane_mask(value < -plane_error) & 0xfu;
  }

  /// Nothing of the environment lies outside its frame.
  void map_box() {
    const Plane_frame<D>& frame = snapshot_.frame();
    for (int k = 0; k < D; ++k) {
      const auto map = [&](double x) {
        return static_cast<float>(std::clamp((x - frame.centre[k]) * frame.scale, -1.0, 1.0));
      };
      const float low = map(region_.box().low(k)), high = map(region_.box().high(k));
      low_[k] = Float4{low, low, low, low};
      high_[k] = Float4{high, high, high, high};
    }
    is_mapped_ = true;
  }

  bool cut_off(Half_facet wall) {
    return cut_off(snapshot_.view(snapshot_.cell_of(wall)), snapshot_.facet_of(wall));
  }
  /// Makes the region smaller until it holds no point of a facet. False if it cannot, without losing its
  /// anchor, or positions if they may not be lost.
  bool cut_off(const Cell_view<D>& cell, std::size_t i, bool may_lose = true) {
    const auto loop = cell.loop(i);
    Pair_box<D> bounds(cell.point(loop[0]));
    for (const std::uint16_t v : loop.subspan(1)) bounds.extend(cell.point(v));
    const Box<D> facet = bounds.box();
    for (int k = 0; k < D; ++k)
      if (facet.low[k] >= region_.box().high(k) || facet.high[k] <= region_.box().low(k)) return true;
    for (const Cut_plane<D>& plane : planes_)
      if (is_beyond(plane, cell, i)) return true;
    if (region_.has_behind_walls(cell, i)) return true;
    return cut_keeping(true, cell, i, facet) || (!targets_.empty() && cut_keeping(false, cell, i, facet)) ||
           (may_lose && !request_.keeps_all && cut_keeping_anchor(cell, i, facet));
  }

  /// The best cut that loses no positions, and no targets where these are to be kept.
  bool cut_keeping(bool with_targets, const Cell_view<D>& cell, std::size_t i, const Box<D>& facet) {
    const Box<D>& kept = with_targets ? wanted_ : kept_;
    double best = 0;
    int axis = 0;
    bool above = true;
    for (int k = 0; k < D; ++k) {
      if (const double gap = facet.low[k] - kept.high[k]; gap > best) {
        best = gap;
        axis = k;
        above = true;
      }
      if (const double gap = kept.low[k] - facet.high[k]; gap > best) {
        best = gap;
        axis = k;
        above = false;
      }
    }
    if (best < enough_ && region_.plane_count() < request_.most_planes) {
      if (cut_by_wall(cell, i, with_targets, best)) return true;
      // To part the targets as well would be in vain where they lie behind a wall.
      if (!(best > 0) && (!with_targets || targets_.empty()) &&
          cut_by_plane(cell, i, apart(cell, i), false, 0))
        return true;
    }
    if (!(best > 0)) return false;
    if (above)
      region_.cut_above(axis, facet.low[axis]);
    else
      region_.cut_below(axis, facet.high[axis]);
    is_mapped_ = false;
    if (!with_targets)
      lose_targets([&](const Point<D>& x) {
        return above ? x[static_cast<std::size_t>(axis)] < facet.low[axis]
                     : x[static_cast<std::size_t>(axis)] > facet.high[axis];
      });
    return true;
  }

  /// The cut that loses the fewest positions.
  bool cut_keeping_anchor(const Cell_view<D>& cell, std::size_t i, const Box<D>& facet) {
    const auto plane = region_.plane_count() < request_.most_planes
                           ? plane_before(cell, i, outward(cell, i), sizes_)
                           : std::nullopt;
    // Positions before the facet along each axis, behind it, and in the half-space before it.
    std::array<std::size_t, 2 * D + 1> counts{};
    const auto is_left = [&](std::size_t cut, const Point<D>& x) {
      if (cut == 2 * D) return plane && dot(plane->normal, x) < plane->offset;
      const std::size_t k = cut / 2;
      return cut % 2 == 0 ? x[k] < facet.low[k] : facet.high[k] < x[k];
    };
    for (const Point<D>& x : positions_)
      for (std::size_t cut = 0; cut < counts.size(); ++cut) counts[cut] += is_left(cut, x);
    std::size_t best = counts.size(), most = 0;
    for (std::size_t cut = 0; cut < counts.size(); ++cut)
      if (counts[cut] > most && is_left(cut, region_.anchor().position)) {
        best = cut;
        most = counts[cut];
      }
    if (most == 0) return false;
    if (best == 2 * D)
      cut(*plane);
    else if (best % 2 == 0)
      region_.cut_above(static_cast<int>(best / 2), facet.low[best / 2]);
    else
      region_.cut_below(static_cast<int>(best / 2), facet.high[best / 2]);
    is_mapped_ = false;
    const auto is_left_now = [&](const Point<D>& x) { return is_left(best, x); };
    lose_what_is_outside(kept_);
    lose_points(positions_, positions_left_, is_left_now);
    lose_targets(is_left_now);
    return true;
  }

  void cut(const Cut_plane<D>& plane) {
    region_.cut(Wall_plane<D>(plane));
    planes_.push_back(plane);
  }

  /// The points that a cut loses are lost: it alone is looked at.
  template <class Is_left>
  void lose_targets(const Is_left& is_left) {
    lose_what_is_outside(wanted_);
    lose_points(targets_, targets_left_, is_left);
  }
  void lose_targets_behind_plane() {
    lose_targets([this](const Point<D>& x) { return region_.is_before_last_plane(x); });
  }
  void lose_what_is_outside(Box<D>& box) const {
    for (int k = 0; k < D; ++k) {
      box.low[k] = std::max(box.low[k], region_.box().low(k));
      box.high[k] = std::min(box.high[k], region_.box().high(k));
    }
  }
  template <class Is_left>
  static void lose_points(std::span<const Point<D>>& points, std::vector<Point<D>>& left,
                          const Is_left& is_left) {
    if (points.data() != left.data()) left.assign(points.begin(), points.end());
    std::erase_if(left, [&](const Point<D>& x) { return !is_left(x); });
    points = left;
  }

  /// Cuts in a direction, if the points to keep are further from there than `best`.
  bool cut_by_plane(const Cell_view<D>& cell, std::size_t i, const Vector<D>& normal, bool with_targets,
                    double best) {
    double most = furthest<D>(normal, positions_);
    if (with_targets) most = std::max(most, furthest<D>(normal, targets_));
    const double gap = best * length(normal);
    // Most that are of no use are found out before anything is bounded.
    if (!(most < dot(normal, cell.point(cell.loop(i)[0])) - gap)) return false;
    const auto plane = plane_before(cell, i, normal, sizes_);
    if (!plane || !(most < plane->offset - gap)) return false;
    cut(*plane);
    if (!with_targets) lose_targets_behind_plane();
    return true;
  }

  /// Cuts along the plane of a wall, exactly, if the points to keep lie before it, and further from it than
  /// `best`.
  bool cut_by_wall(const Cell_view<D>& cell, std::size_t i, bool with_targets, double best) {
    const Wall_plane<D> plane(cell, i, all_sizes());
    const double limit = plane.inside - (best > 0 ? best * length(plane.normal) : 0);
    const auto are_before = [&](std::span<const Point<D>> points) {
      return furthest<D>(plane.normal, points) < limit || (!(best > 0) && plane.has_all_before(points));
    };
    if (!are_before(positions_) || (with_targets && !are_before(targets_))) return false;
    region_.cut(plane);
    if (!with_targets) lose_targets_behind_plane();
    return true;
  }

  /// The largest size of each coordinate of points of the box and of the environment.
  Point<D> all_sizes() const {
    const Plane_frame<D>& frame = snapshot_.frame();
    Point<D> sizes = sizes_;
    for (std::size_t k = 0; k < D; ++k) {
      const double size = std::abs(frame.centre[k]) + frame_and_more / frame.scale;
      // There are frames that map nothing.
      sizes[k] = size > 0 ? std::max(sizes[k], size) : std::numeric_limits<double>::infinity();
    }
    return sizes;
  }

  /// A direction in which a facet lies beyond the positions to keep, if they are convexly apart and it is
  /// soon found: it is turned to the furthest of the points and the nearest of the facet, until they are in
  /// order. Any direction will do; cut_by_plane() computes its worth.
  Vector<D> apart(const Cell_view<D>& cell, std::size_t i) const {
    const auto loop = cell.loop(i);
    Vector<D> normal = outward(cell, i);
    normal = (1 / length(normal)) * normal;
    for (int sine_cosine = 0; sine_cosine < most_turns; ++sine_cosine) {
      const Point<D>*last = nullptr, *first = nullptr;
      double most = -std::numeric_limits<double>::infinity(), least = -most;
      for (const Point<D>& x : positions_)
        if (const double d = dot(normal, x); d > most) {
          most = d;
          last = &x;
        }
      for (const std::uint16_t v : loop)
        if (const double d = dot(normal, cell.point(v)); d < least) {
          least = d;
          first = &cell.point(v);
        }
      if (!last || !first || most < least) break;
      const Vector<D> ahead = *first - *last;
      const double distance = length(ahead);
      if (!(distance > 0)) break;
      normal = normal + (1 / distance) * ahead;
    }
    return normal;
  }

  const Snapshot<D>& snapshot_;
  const Region_request<D>& request_;
  Region_effort& effort_;
  Box<D> kept_, wanted_;  ///< of positions, and with the targets
  // The positions and targets that the region holds.
  std::span<const Point<D>> positions_, targets_;
  std::vector<Point<D>> positions_left_, targets_left_;
  Clear_region<D> region_;
  double enough_ = 0;  ///< distance
  Point<D> sizes_;     ///< the largest size of each coordinate in it
  Cell_list& found_;
  boost::container::static_vector<Cut_plane<D>, Clear_region<D>::most_planes> planes_;
  // The box in the frame, each bound in all lanes.
  bool is_mapped_ = false;
  Spread_point<D> low_, high_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_REGION_SEARCH_H
