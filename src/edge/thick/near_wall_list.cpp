// SPDX-License-Identifier: LGPL-3.0-or-later
// The flood that fills a list, and the tests of a motion against it.
#include <cellwalk/internal/edge/near_wall_list.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "near_walls.h"

namespace cellwalk::detail {
namespace {

/// The reach of a first list, in lengths of its first motion.
constexpr double first_reach = 4;
/// A list whose walls were all tested so often is worth a closer look at each of them.
constexpr std::uint64_t tests_until_refined = 16;
/// Reaches whose squares are exact enough, see reaches(); beyond them a list holds all walls.
constexpr double least_reach = 0x1p-500, largest_reach = 0x1p500;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

/// In doubles the square of a distance is off by less than 2^-50 of it, and where it underflows by less than
/// that part of the least square of a reach.
template <int D>
bool Near_wall_list<D>::reaches(const Thick_motion<D>& motion, std::size_t moving) const {
  const auto is_near = [&](const Point<D>& x, std::size_t corner) {
    const Vector<D> way = x - listed_[corner];
    return dot(way, way) <= square_of_reach_;
  };
  const std::size_t size = corner_count(motion);
  return is_near(motion.p, moving) && is_near(motion.target, moving) &&
         (!motion.q || is_near(*motion.q, (moving + 1) % size)) &&
         (!motion.third || is_near(*motion.third, (moving + 2) % size));
}

template <int D>
bool Near_wall_list<D>::is_free(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion,
                                std::size_t moving, Swept_part part) {
  if (epoch_ != snapshot.epoch() || !reaches(motion, moving)) make(snapshot, start, motion, moving);
  if (is_coarse_ && tests_ > tests_until_refined * walls_.size()) refine(corner_count(motion));
  const auto keeps_distance = [&](Swept_part tested) {
    return is_apart_from_all(swept_hull(motion, tested), motion.radius);
  };
  if (part == Swept_part::segments) return keeps_distance(Swept_part::way) && keeps_distance(Swept_part::end);
  return keeps_distance(part);
}

template <int D>
bool Near_wall_list<D>::is_apart_from_all(const Swept_hull<D>& hull, double radius) {
  Box<D> box;
  for (const Point<D>& x : hull) box.extend(x);
  tests_ += walls_.size();
  Distance_counts uncounted;
  for (Wall& wall : walls_) {
    bool is_far = false;
    for (std::size_t k = 0; k < D; ++k)
      is_far |= wall.box.low[k] - box.high[k] > radius || box.low[k] - wall.box.high[k] > radius;
    if (is_far) continue;
    if (!is_apart<D>({hull.data(), hull.size()}, corners_of(wall), radius, wall.near, uncounted))
      return false;
  }
  return true;
}

template <int D>
void Near_wall_list<D>::make(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion,
                             std::size_t moving) {
  boost::container::static_vector<Point<D>, 3> hull{motion.p};
  for (const auto& corner : {motion.q, motion.third})
    if (corner) hull.push_back(*corner);
  for (std::size_t i = 0; i < hull.size(); ++i) listed_[(moving + i) % hull.size()] = hull[i];
  // A longer list is made less often: its reach is right where the tests of walls cost about what it cost.
  // Beyond the size of the edge, the flood would grow faster than what it saves.
  const double way = length(motion.target - motion.p);
  double size = 0;
  for (const Point<D>& x : hull) size = std::max(size, length(x - motion.p));
  reach_ = reach_ == 0 ? first_reach * way : tests_ < boxes_ ? 2 * reach_ : reach_ / 2;
  reach_ = std::min(reach_, std::max(first_reach * way, size + motion.radius));
  reach_ = std::max({reach_, (1 + 0x1p-40) * way, least_reach});
  if (!(reach_ < largest_reach)) reach_ = infinity;
  square_of_reach_ = reach_ * reach_ * (1 - 0x1p-48);
  epoch_ = snapshot.epoch();
  walls_.clear();
  corners_.clear();
  tests_ = 0;
  near_ = std::nextafter(motion.radius + reach_, infinity);
  const Near_walls<D> walls(snapshot, {hull.data(), hull.size()}, near_);
  boxes_ = walls.visit_by_clusters(start, [&](Half_facet half) {
    const Cell_view<D> view = snapshot.view(snapshot.cell_of(half));
    Wall wall{static_cast<std::uint32_t>(corners_.size()), 0, {}, {}};
    for (const std::uint16_t v : view.loop(snapshot.facet_of(half))) {
      corners_.push_back(view.point(v));
      wall.box.extend(corners_.back());
    }
    wall.last = static_cast<std::uint32_t>(corners_.size());
    walls_.push_back(wall);
  });
  is_coarse_ = std::isfinite(near_);
}

/// Drops the walls that were found by their boxes only.
template <int D>
void Near_wall_list<D>::refine(std::size_t corners) {
  is_coarse_ = false;
  Distance_counts uncounted;
  std::erase_if(walls_, [&](const Wall& wall) {
    Feature_pair of_start;
    return is_apart<D>({listed_.data(), corners}, corners_of(wall), near_, of_start, uncounted);
  });
}

template class Near_wall_list<2>;
template class Near_wall_list<3>;

}  // namespace cellwalk::detail
