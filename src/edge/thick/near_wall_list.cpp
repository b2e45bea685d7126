// SPDX-License-Identifier: LGPL-3.0-or-later
// The flood that fills a list, and the tests of a motion against it.
#include <cellwalk/internal/edge/near_wall_list.h>
#include <cellwalk/internal/environment/cell_cluster.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <bit>

#include "hull_in_frame.h"

namespace cellwalk::detail {
namespace {

/// The reach of a first list, in lengths of its first motion.
constexpr double first_reach = 4;
/// What it costs to list the walls of a block, in tests of blocks.
constexpr std::uint64_t cost_of_listing = 8;

template <int D>
Box<D> box_of(std::span<const Thick_motion<D>> motions) {
  Box<D> box;
  for (const Thick_motion<D>& motion : motions) {
    box.extend(motion.p);
    box.extend(motion.target);
    for (const auto& corner : {motion.q, motion.third})
      if (corner) box.extend(*corner);
  }
  return box;
}

/// The points whose hull has all that motions at one corner sweep.
template <int D>
class Points_of_motions {
 public:
  Points_of_motions(std::span<const Thick_motion<D>> motions, Swept_part part) {
    points_.push_back(motions[0].target);
    if (part != Swept_part::end) points_.push_back(motions[0].p);
    for (const Thick_motion<D>& motion : motions) {
      radius_ = std::max(radius_, motion.radius);
      for (const auto& corner : {motion.q, motion.third})
        if (corner && part != Swept_part::way) points_.push_back(*corner);
    }
  }
  std::span<const Point<D>> points() const { return {points_.data(), points_.size()}; }
  double radius() const { return radius_; }

 private:
  boost::container::small_vector<Point<D>, 8> points_;
  double radius_ = 0;
};

template <int D>
double largest_side(const Box<D>& box) {
  double side = 0;
  for (std::size_t k = 0; k < D; ++k) side = std::max(side, box.high[k] - box.low[k]);
  return side;
}

}  // namespace

template <int D>
bool Near_wall_list<D>::holds(const Snapshot<D>& snapshot, std::span<const Thick_motion<D>> motions) const {
  return epoch_ == snapshot.epoch() && box_.contains(box_of(motions));
}

template <int D>
void Near_wall_list<D>::make(const Snapshot<D>& snapshot, Cell start, const Box<D>& part, double radius,
                             std::span<const Thick_motion<D>> motions) {
  // A longer list is made less often: its reach is right where the tests of walls cost about what it cost.
  // Beyond the size of the part, the flood would grow faster than what it saves.
  const double way = length(motions[0].target - motions[0].p);
  reach_ = reach_ == 0 ? first_reach * way : tests_ < cost_ ? 2 * reach_ : reach_ / 2;
  reach_ = std::min(reach_, std::max(first_reach * way, largest_side(part) + radius));
  epoch_ = snapshot.epoch();
  frame_ = snapshot.frame();
  box_ = part;
  box_.extend(box_of(motions));
  box_ = enlarged(box_, reach_);
  lanes_.clear();
  blocks_.clear();
  walls_.clear();
  corners_.clear();
  cost_ = tests_ = 0;
  const Frame_box<D> reach(frame_, enlarged(box_, radius));
  flood_clusters(snapshot, start, reach, [&](const Cell_cluster<D>& cluster, std::size_t) {
    cost_ += cluster.walls.size() + cluster.passages.size();
    for (const Wall_lanes<D>& walls : cluster.walls)
      for_each_met(reach, walls.boxes, [&](std::size_t lane) { add(walls, lane); });
    return true;
  });
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (i % 4 == 0) blocks_.push_back(Facet_boxes<D>::none());
    blocks_.back().enclose(i % 4, lanes_[i].boxes);
  }
  cost_ += cost_of_listing * lanes_.size();
}

template <int D>
void Near_wall_list<D>::add(const Wall_lanes<D>& walls, std::size_t lane) {
  if (walls_.size() % 4 == 0) lanes_.emplace_back();
  lanes_.back().set(walls_.size() % 4, walls, lane);
  walls_.emplace_back();
}

template <int D>
bool Near_wall_list<D>::are_free(const Snapshot<D>& snapshot, std::span<const Thick_motion<D>> motions,
                                 Swept_part part) {
  const Points_of_motions<D> all(motions, part);
  return for_each_near(all.points(), all.radius(), [&](std::size_t i) {
    Wall& wall = look_up(snapshot, i);
    if (wall.known.parts(all.points(), all.radius())) return true;
    return std::ranges::all_of(motions, [&](const auto& motion) { return is_far(wall, motion, part); });
  });
}

template <int D>
std::vector<Half_facet> Near_wall_list<D>::walls_near(const Snapshot<D>& snapshot,
                                                      const Thick_motion<D>& motion) {
  const Points_of_motions<D> all({&motion, 1}, Swept_part::all);
  std::vector<Half_facet> walls;
  for_each_near(all.points(), all.radius(), [&](std::size_t i) {
    if (!look_up(snapshot, i).known.parts(all.points(), all.radius()))
      walls.push_back(Half_facet{lanes_[i / 4].boxes.facets[i % 4]});
    return true;
  });
  return walls;
}

/// Calls use(position) for the walls whose boxes and planes may be nearer than r to the hull of some points,
/// until it returns false. Returns false if it did.
template <int D>
template <class Use>
bool Near_wall_list<D>::for_each_near(std::span<const Point<D>> corners, double r, Use use) {
  Box<D> of_corners;
  for (const Point<D>& x : corners) of_corners.extend(x);
  const Frame_box<D> box(frame_, enlarged(of_corners, r));
  const Hull_in_frame<D> hull(frame_, corners, r);
  tests_ += blocks_.size();
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    for (unsigned blocks = box.met(blocks_[i]); blocks != 0; blocks &= blocks - 1) {
      const std::size_t block = 4 * i + static_cast<std::size_t>(std::countr_zero(blocks));
      ++tests_;
      unsigned walls = box.met(lanes_[block].boxes);
      if (walls != 0) walls &= hull.lanes_near(lanes_[block].planes);
      for (; walls != 0; walls &= walls - 1)
        if (!use(4 * block + static_cast<std::size_t>(std::countr_zero(walls)))) return false;
    }
  return true;
}

/// Takes the corners of a wall.
template <int D>
void Near_wall_list<D>::take_corners(const Snapshot<D>& snapshot, std::size_t i) {
  Wall& wall = walls_[i];
  const Half_facet half{lanes_[i / 4].boxes.facets[i % 4]};
  const Cell_view<D> view = snapshot.view(snapshot.cell_of(half));
  wall.first = static_cast<std::uint32_t>(corners_.size());
  for (const std::uint16_t v : view.loop(snapshot.facet_of(half))) corners_.push_back(view.point(v));
  wall.last = static_cast<std::uint32_t>(corners_.size());
}

/// What is apart from all that a motion sweeps is so from its segments.
template <int D>
bool Near_wall_list<D>::is_far(Wall& wall, const Thick_motion<D>& motion, Swept_part part) {
  const bool are_segments = part == Swept_part::segments;
  const Swept_hull<D> hull = swept_hull(motion, are_segments ? Swept_part::all : part);
  Distance_counts counts;
  Vector<D> direction = wall.known.direction();
  if (is_apart<D>({hull.data(), hull.size()}, corners_of(wall), motion.radius, direction, counts)) {
    if (counts.gjk > 0) wall.known = Parting_direction<D>(corners_of(wall), direction);
    return true;
  }
  return are_segments && is_far(wall, motion, Swept_part::way) && is_far(wall, motion, Swept_part::end);
}

template class Near_wall_list<2>;
template class Near_wall_list<3>;

}  // namespace cellwalk::detail
