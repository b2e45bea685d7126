// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/clear_region.h>

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "cut_plane.h"
#include "point_box.h"

namespace cellwalk {
namespace {

using detail::Box;
using detail::box_of;
using detail::Cut_plane;

/// A box cut at so many steps from the body will do; nearer to it, a half-space is tried.
constexpr double enough_steps = 4;
/// How often a direction is turned to part two sets of points.
constexpr int most_turns = 12;

template <int D>
class Region_search {
 public:
  Region_search(const Snapshot<D>& snapshot, const Particle<D>& anchor, const Region_request<D>& request,
                Region_effort& effort)
      : snapshot_(snapshot),
        request_(request),
        effort_(effort),
        kept_(box_of<D>(request.positions)),
        wanted_(kept_),
        region_(anchor, kept_.low, kept_.high) {
    const Box<D> targets = box_of<D>(request.targets);
    wanted_.extend(targets);
    double step = 0;
    Vector<D> up, down;
    for (std::size_t k = 0; k < D; ++k) {
      up[k] = targets.high[k] - kept_.high[k];
      down[k] = kept_.low[k] - targets.low[k];
      step = std::max({step, std::abs(up[k]), std::abs(down[k])});
    }
    enough_ = enough_steps * step;
    Point<D> low, high;
    for (std::size_t k = 0; k < D; ++k) {
      const double around = request.steps_around * step;
      low[k] = wanted_.low[k] - request.steps_ahead * std::max(0.0, down[k]) - around;
      high[k] = wanted_.high[k] + request.steps_ahead * std::max(0.0, up[k]) + around;
    }
    region_ = {anchor, low, high};
  }

  std::optional<Clear_region<D>> find() {
    for (int k = 0; k < D; ++k)
      sizes_[k] = std::max(std::abs(region_.box().low(k)), std::abs(region_.box().high(k)));
    if (!is_finite(sizes_)) return {};
    found_.push_back(region_.anchor().cell);
    bool is_good = true;
    for (std::size_t head = 0; is_good && head < found_.size(); ++head) is_good = visit(found_[head]);
    effort_.cells += found_.size();
    // The box is open: a body without extent needs one around it.
    if (!is_good || !region_.holds(region_.anchor().position)) return {};
    return region_;
  }

 private:
  /// Cuts its walls off, and adds its neighbours. False if a cut cannot be made.
  bool visit(Cell cell) {
    const Cell_view<D> view = snapshot_.view(cell);
    boost::container::small_vector<std::size_t, 16> open;
    const std::size_t blocks = snapshot_.block_count(cell);
    for (std::size_t b = 0; b < blocks; ++b) {
      for (unsigned met = facets_met(snapshot_.blocks(cell)[b]); met != 0; met &= met - 1) {
        const std::size_t i = 4 * b + static_cast<std::size_t>(std::countr_zero(met));
        if (i >= view.facet_count()) break;
        const Half_facet f = Snapshot<D>::half_facet(cell, i);
        if (!snapshot_.is_impassable(f))
          open.push_back(i);
        else if (!cut_off(view, i))
          return false;
      }
    }
    for (const std::size_t i : open) {
      const Cell next = snapshot_.neighbor(Snapshot<D>::half_facet(cell, i));
      if (is_found(next)) continue;
      if (found_.size() >= request_.most_cells) {
        effort_.is_exhausted = true;
        if (!cut_off(view, i, false)) return false;
        continue;
      }
      found_.push_back(next);
      note_found(next);
    }
    return true;
  }

  /// Few cells are compared one by one, many looked up in a table.
  bool is_found(Cell cell) const {
    if (table_.empty()) return std::find(found_.begin(), found_.end(), cell) != found_.end();
    std::size_t i = slot(cell);
    while (table_[i] != Cell::none && table_[i] != cell) i = (i + 1) & (table_.size() - 1);
    return table_[i] == cell;
  }
  void note_found(Cell cell) {
    if (table_.empty() ? found_.size() < 32 : 2 * found_.size() <= table_.size()) {
      if (!table_.empty()) put(cell);
      return;
    }
    table_.assign(4 * std::bit_ceil(found_.size()), Cell::none);
    for (const Cell c : found_) put(c);
  }
  void put(Cell cell) {
    std::size_t i = slot(cell);
    while (table_[i] != Cell::none) i = (i + 1) & (table_.size() - 1);
    table_[i] = cell;
  }
  std::size_t slot(Cell cell) const { return (to_index(cell) * 0x9e3779b1u >> 8) & (table_.size() - 1); }

  /// Facets (bits) of a block whose planes the closed box does not certainly lie inside of. The corner of the box that is
  /// furthest outside is a point like any other: its value is within plane_error.
  unsigned facets_met(const Plane_block<D>& block) {
    if (!is_mapped_) map_box();
    std::array<Float4, D> furthest;
    for (std::size_t k = 0; k < D; ++k) {
      const Float4 low = block.normal[k] * low_[k], high = block.normal[k] * high_[k];
      furthest[k] = low > high ? low : high;
    }
    const Float4 r = furthest[D - 1] + block.offset;
    Float4 value = furthest[0] + r;
    if constexpr (D == 3) value = (furthest[0] + furthest[1]) + r;
    return ~lane_mask(value < -plane_error) & 0xfu;  // not numbers, where the frame overflows, count as met
  }

  /// Nothing of the environment lies outside its frame.
  void map_box() {
    const Plane_frame<D>& frame = snapshot_.frame();
    for (int k = 0; k < D; ++k) {
      const auto map = [&](double x) {
        return static_cast<float>(std::clamp((x - frame.center[k]) * frame.scale, -1.0, 1.0));
      };
      const float low = map(region_.box().low(k)), high = map(region_.box().high(k));
      low_[k] = Float4{low, low, low, low};
      high_[k] = Float4{high, high, high, high};
    }
    is_mapped_ = true;
  }

  /// Makes the region smaller until it holds no point of a facet. False if it cannot, without losing its anchor, or positions if
  /// they may not be lost.
  bool cut_off(const Cell_view<D>& cell, std::size_t i, bool may_lose = true) {
    Box<D> facet;
    for (const std::uint16_t v : cell.loop(i)) facet.extend(cell.point(v));
    for (int k = 0; k < D; ++k)
      if (facet.low[k] >= region_.box().high(k) || facet.high[k] <= region_.box().low(k)) return true;
    for (const Cut_plane<D>& plane : planes_)
      if (detail::is_beyond(plane, cell, i)) return true;
    return cut_keeping(wanted_, cell, i, facet) || cut_keeping(kept_, cell, i, facet) ||
           (may_lose && cut_keeping_anchor(cell, i, facet));
  }

  /// The best cut that loses nothing of a box, nor of the positions (and targets) in it.
  bool cut_keeping(const Box<D>& kept, const Cell_view<D>& cell, std::size_t i, const Box<D>& facet) {
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
    if (best < enough_ && planes_.size() < Clear_region<D>::most_planes) {
      const bool with_targets = &kept == &wanted_;
      if (cut_by_plane(cell, i, detail::outward(cell, i), with_targets, best)) return true;
      // To part the targets as well would be in vain where they lie behind a wall.
      if (!(best > 0) && !with_targets && cut_by_plane(cell, i, apart(cell, i), false, 0)) return true;
    }
    if (!(best > 0)) return false;
    if (above)
      region_.cut_above(axis, facet.low[axis]);
    else
      region_.cut_below(axis, facet.high[axis]);
    is_mapped_ = false;
    if (&kept == &kept_) lose_what_is_outside(wanted_);
    return true;
  }

  /// The cut that loses the fewest positions.
  bool cut_keeping_anchor(const Cell_view<D>& cell, std::size_t i, const Box<D>& facet) {
    std::size_t most = 0;
    Clear_region<D> best = region_;
    const auto consider = [&](const Clear_region<D>& region) {
      if (!region.holds(region.anchor().position)) return false;
      const auto count =
          static_cast<std::size_t>(std::count_if(request_.positions.begin(), request_.positions.end(),
                                                 [&](const Point<D>& x) { return region.holds(x); }));
      if (count <= most) return false;
      most = count;
      best = region;
      return true;
    };
    for (int k = 0; k < D; ++k) {
      Clear_region<D> below = region_, above = region_;
      below.cut_above(k, facet.low[k]);
      above.cut_below(k, facet.high[k]);
      consider(below);
      consider(above);
    }
    if (const auto plane = plane_before(cell, i, detail::outward(cell, i))) {
      Clear_region<D> below = region_;
      below.cut(plane->normal, plane->offset);
      if (consider(below)) planes_.push_back(*plane);
    }
    if (most == 0) return false;
    region_ = best;
    is_mapped_ = false;
    lose_what_is_outside(kept_);
    lose_what_is_outside(wanted_);
    return true;
  }

  void lose_what_is_outside(Box<D>& box) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int k = 0; k < D; ++k) {
      box.low[k] = std::max(box.low[k], std::nextafter(region_.box().low(k), infinity));
      box.high[k] = std::min(box.high[k], std::nextafter(region_.box().high(k), -infinity));
    }
  }

  /// Cuts in a direction, if the points to keep are further from there than `best`.
  bool cut_by_plane(const Cell_view<D>& cell, std::size_t i, const Vector<D>& normal, bool with_targets,
                    double best) {
    const auto plane = plane_before(cell, i, normal);
    if (!plane) return false;
    const double gap = best * length(normal);
    if (!is_before(*plane, gap, request_.positions)) return false;
    if (with_targets && !is_before(*plane, gap, request_.targets)) return false;
    region_.cut(plane->normal, plane->offset);
    planes_.push_back(*plane);
    return true;
  }

  /// None if nothing can be said, or there are as many half-spaces as there may be.
  std::optional<Cut_plane<D>> plane_before(const Cell_view<D>& cell, std::size_t i,
                                           const Vector<D>& normal) const {
    if (planes_.size() == Clear_region<D>::most_planes) return {};
    return detail::plane_before(cell, i, normal, sizes_);
  }

  /// True if the points that the region holds are inside a half-space, and further inside than a gap, in units of its normal.
  bool is_before(const Cut_plane<D>& plane, double gap, std::span<const Point<D>> points) const {
    const double most = plane.offset - gap;
    return std::all_of(points.begin(), points.end(),
                       [&](const Point<D>& x) { return dot(plane.normal, x) < most || !region_.holds(x); });
  }

  /// A direction in which a facet lies beyond the positions to keep, if they are convexly apart and it is soon found: it is turned
  /// to the furthest of the points and the nearest of the facet, until they are in order. Any direction will do; plane_before() and
  /// is_before() say what it is worth.
  Vector<D> apart(const Cell_view<D>& cell, std::size_t i) const {
    const auto loop = cell.loop(i);
    Vector<D> normal = detail::outward(cell, i);
    normal = (1 / length(normal)) * normal;
    for (int turn = 0; turn < most_turns; ++turn) {
      const Point<D>*last = nullptr, *first = nullptr;
      double most = -std::numeric_limits<double>::infinity(), least = -most;
      for (const Point<D>& x : request_.positions)
        if (const double d = dot(normal, x); d > most && region_.holds(x)) {
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
  Clear_region<D> region_;
  double enough_ = 0;  ///< distance
  Point<D> sizes_;     ///< the largest size of each coordinate in it
  boost::container::small_vector<Cell, 64> found_;
  std::vector<Cell> table_;  ///< of those found, by hash
  boost::container::static_vector<Cut_plane<D>, Clear_region<D>::most_planes> planes_;
  // The box in the frame, each bound in all lanes.
  bool is_mapped_ = false;
  Spread_point<D> low_, high_;
};

}  // namespace

template <int D>
std::optional<Clear_region<D>> find_clear_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                 const Region_request<D>& request, Region_effort& effort) {
  return Region_search<D>(snapshot, anchor, request, effort).find();
}

template std::optional<Clear_region<2>> find_clear_region<2>(const Snapshot<2>&, const Particle<2>&,
                                                             const Region_request<2>&, Region_effort&);
template std::optional<Clear_region<3>> find_clear_region<3>(const Snapshot<3>&, const Particle<3>&,
                                                             const Region_request<3>&, Region_effort&);

}  // namespace cellwalk
