// SPDX-License-Identifier: LGPL-3.0-or-later
// The flood that fills a list, and the tests of a motion against it.
#include <cellwalk/internal/edge/near_wall_list.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "near_walls.h"

namespace cellwalk::detail {
namespace {

/// The reach of a first list, in lengths of its first motion.
constexpr double first_reach = 4;
/// Reaches whose squares are exact enough, see reaches().
constexpr double least_reach = 0x1p-500, largest_reach = 0x1p500;

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

}  // namespace

/// In doubles the square of a distance is off by less than 2^-50 of it, and where it underflows by less than
/// that part of the least square of a reach.
template <int D>
bool Near_wall_list<D>::reaches(const Point<D>& x, const Point<D>& from) const {
  const Vector<D> way = x - from;
  return dot(way, way) <= square_of_reach_;
}

template <int D>
bool Near_wall_list<D>::is_free(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion) {
  const Point<D>& q = *motion.q;
  const auto is_at = [&](const Point<D>& p, const Point<D>& still) {
    return reaches(motion.p, p) && reaches(motion.target, p) && reaches(q, still);
  };
  // Either end of the edge may be the one that moves.
  if (epoch_ != snapshot.epoch() || !(is_at(p_, q_) || is_at(q_, p_))) {
    make(snapshot, start, motion);
    if (!is_at(p_, q_)) {
      square_of_reach_ = -1;  // the edge may leave it untested
      Edge_counts uncounted;
      return !sweep_thick(snapshot, start, motion, uncounted).contact;
    }
  }
  const std::array<Point<D>, 3> hull{motion.p, motion.target, q};
  Box<D> box;
  for (const Point<D>& x : hull) box.extend(x);
  tests_ += walls_.size();
  Distance_counts uncounted;
  for (Wall& wall : walls_) {
    bool is_far = false;
    for (std::size_t k = 0; k < D; ++k)
      is_far |=
          wall.box.low[k] - box.high[k] > motion.radius || box.low[k] - wall.box.high[k] > motion.radius;
    if (is_far) continue;
    if (!is_apart<D>(hull, {corners_.data() + wall.first, corners_.data() + wall.last}, motion.radius,
                     wall.near, uncounted))
      return false;
  }
  return true;
}

template <int D>
void Near_wall_list<D>::make(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion) {
  // A longer list is made less often: its reach is right where the tests of walls cost about what it cost.
  // Beyond the size of the edge, the flood would grow faster than what it saves.
  const double way = length(motion.target - motion.p);
  reach_ = reach_ == 0 ? first_reach * way : tests_ < facets_ ? 2 * reach_ : reach_ / 2;
  reach_ = std::min(reach_, std::max(first_reach * way, length(*motion.q - motion.p) + motion.radius));
  reach_ = std::max(reach_, (1 + 0x1p-40) * way);
  const bool is_in_range = reach_ > least_reach && reach_ < largest_reach;
  square_of_reach_ = is_in_range ? reach_ * reach_ * (1 - 0x1p-48) : -1;
  walls_.clear();
  corners_.clear();
  facets_ = tests_ = 0;
  p_ = motion.p;
  q_ = *motion.q;
  epoch_ = snapshot.epoch();
  if (!is_in_range) return;
  const std::array<Point<D>, 2> edge{p_, q_};
  const double near = above(motion.radius + reach_);
  Cell_list cells;
  Near_walls<D>(snapshot, edge, near).visit(start, cells, [&](Half_facet half) {
    const Cell_view<D> view = snapshot.view(snapshot.cell_of(half));
    Wall wall{static_cast<std::uint32_t>(corners_.size()), 0, {}, {}};
    for (const std::uint16_t v : view.loop(snapshot.facet_of(half))) {
      corners_.push_back(view.point(v));
      wall.box.extend(corners_.back());
    }
    wall.last = static_cast<std::uint32_t>(corners_.size());
    Distance_counts uncounted;
    if (std::isfinite(near) && is_apart<D>(edge, {corners_.data() + wall.first, corners_.data() + wall.last},
                                           near, wall.near, uncounted))
      corners_.resize(wall.first);
    else
      walls_.push_back(wall);
  });
  for (std::size_t i = 0; i < cells.size(); ++i) facets_ += snapshot.facet_count(cells[i]);
}

template class Near_wall_list<2>;
template class Near_wall_list<3>;

}  // namespace cellwalk::detail
