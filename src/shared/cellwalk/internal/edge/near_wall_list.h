// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls near an edge or a face with a radius, which decide its moves as long as it stays where they were
// listed.
// Theory: docs/radius.md, lists of near walls.
#ifndef CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H
#define CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/distance.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// All moves of its corners must be tested by the list, or it must be forgotten. Nothing is counted: lists
/// are not saved with a body, whose counts would depend on that.
template <int D>
class Near_wall_list {
 public:
  /// True if a motion is free: the exact answer.
  /// \param start a free cell in whose closure motion.p lies
  /// \param motion of a vertex without edges, an edge or a face, the same each time
  /// \param moving the number of p among its corners; q and the third one follow in cyclic order
  /// \param part that has to keep the distance; all tested parts of one motion count as its test
  /// \pre where the motion starts, it is at least at the distance of its radius from every wall; the radius
  ///        is that of all motions before
  /// Cost: a comparison of boxes for each wall listed, is_apart() for those near; a flood of the cells nearer
  /// than the radius and the reach where the list ends, and a closer look at its walls if it lasts.
  bool is_free(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion, std::size_t moving,
               Swept_part part = Swept_part::all);
  /// Its corners are about to move without a test.
  void forget() { square_of_reach_ = -1; }

 private:
  struct Wall {
    std::uint32_t first, last;  ///< its corners
    Box<D> box;
    Feature_pair near;  ///< that was nearest when it was last tested
  };

  bool reaches(const Thick_motion<D>& motion, std::size_t moving) const;
  bool is_apart_from_all(const Swept_hull<D>& hull, double radius);
  std::span<const Point<D>> corners_of(const Wall& wall) const {
    return {corners_.data() + wall.first, corners_.data() + wall.last};
  }
  void refine(std::size_t corners);
  void make(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion, std::size_t moving);

  std::vector<Wall> walls_;
  std::vector<Point<D>> corners_;
  std::array<Point<D>, 3> listed_{};  ///< where the corners were
  std::uint64_t epoch_ = 0;
  double square_of_reach_ = -1;  ///< rounded down; negative: the list holds nothing
  double reach_ = 0;
  double near_ = 0;          ///< the radius and the reach
  bool is_coarse_ = false;   ///< some walls are farther than that
  std::uint64_t boxes_ = 0;  ///< looked at by the flood: about what the list cost
  std::uint64_t tests_ = 0;  ///< of walls since
};

extern template class Near_wall_list<2>;
extern template class Near_wall_list<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H
