// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls near a connected part of a body with a radius, which decide its moves as long as it stays in a
// box.
// Theory: docs/radius.md, lists of near walls.
#ifndef CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H
#define CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/environment/cell_cluster.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/distance.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// All moves of the corners of the part must be tested by the list, or it must be forgotten. Nothing is
/// counted: lists are not saved with a body, whose counts would depend on that.
template <int D>
class Near_wall_list {
 public:
  /// True if the list decides motions of edges and faces of the part, or of its vertex.
  bool holds(const Snapshot<D>& snapshot, std::span<const Thick_motion<D>> motions) const;
  /// Lists the walls around a part.
  /// \param start a free cell in whose closure the corner lies that moves
  /// \param part the box of all its corners
  /// \param radius the largest of its radii
  /// \param motions at one corner, at least one; the list will hold for them
  /// \pre the edges of the part, or its one vertex, are at least at the distance of their radii from all
  ///      walls, and join all of its corners
  /// Cost: a flood of the clusters of cells nearer than the radius and the reach, which follows from the work
  /// with the list before.
  void make(const Snapshot<D>& snapshot, Cell start, const Box<D>& part, double radius,
            std::span<const Thick_motion<D>> motions);
  /// True if motions at one corner are free: the exact answer.
  /// \param part that has to keep the distance, the end only after the way; all tested parts are one test
  /// \pre holds(); where the motions start, they are at least at the distance of their radii from every wall
  /// Cost: a comparison of boxes for four walls at a time, is_apart() for those near.
  bool are_free(const Snapshot<D>& snapshot, std::span<const Thick_motion<D>> motions,
                Swept_part part = Swept_part::all);
  /// The walls that may be near a motion: among them all that are.
  /// \pre holds()
  std::vector<Half_facet> walls_near(const Snapshot<D>& snapshot, const Thick_motion<D>& motion);
  /// Some corners of the part are about to move without a test.
  void forget() { box_ = {}; }

 private:
  struct Wall {
    std::uint32_t first = 0, last = 0;  ///< its corners
    Parting_direction<D> known;         ///< that parted it when it was last tested
  };

  void add(const Wall_lanes<D>& walls, std::size_t lane);
  Wall& look_up(const Snapshot<D>& snapshot, std::size_t wall) {
    if (walls_[wall].last == 0) take_corners(snapshot, wall);
    return walls_[wall];
  }
  void take_corners(const Snapshot<D>& snapshot, std::size_t wall);
  std::span<const Point<D>> corners_of(const Wall& wall) const {
    return {corners_.data() + wall.first, corners_.data() + wall.last};
  }
  template <class Use>
  bool for_each_near(std::span<const Point<D>> corners, double r, Use use);
  bool is_far(Wall& wall, const Thick_motion<D>& motion, Swept_part part);

  Box<D> box_;  ///< of what it holds for; empty: of nothing
  std::uint64_t epoch_ = 0;
  double reach_ = 0;
  Plane_frame<D> frame_;  ///< of boxes and planes: that of the snapshot may change, and the walls not
  std::vector<Wall_lanes<D>> lanes_;    ///< of the walls, four by four
  std::vector<Facet_boxes<D>> blocks_;  ///< with a box in each lane round four walls
  std::vector<Wall> walls_;             ///< known once they were needed
  std::vector<Point<D>> corners_;
  std::uint64_t cost_ = 0;   ///< of the flood, in blocks of four boxes
  std::uint64_t tests_ = 0;  ///< of blocks since
};

extern template class Near_wall_list<2>;
extern template class Near_wall_list<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_NEAR_WALL_LIST_H
