// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to simulation: how far walls are from points of free space.
#ifndef CELLWALK_SIMULATION_BODIES_NEAREST_WALLS_H
#define CELLWALK_SIMULATION_BODIES_NEAREST_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/box.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace cellwalk::detail {

/// A point of a wall, and how far it is.
template <int D>
struct Near_wall {
  Point<D> point{};
  double distance = 0;
};

/// The walls of free cells as simplices, in a tree of boxes. All is rounded: decisions about motion are for
/// walks.
template <int D>
class Nearest_walls {
 public:
  /// \param left_out facets that do not count, each from one side or both
  /// Cost: about 1 us a wall.
  Nearest_walls(const Snapshot<D>& snapshot, const std::set<Half_facet>& left_out);

  /// The nearest point of a wall. Without walls, a point at the distance of the size of the environment.
  /// Cost: about 1 us (logarithmic in the number of walls), if the point is near that of the call before.
  Near_wall<D> nearest(const Point<D>& x);

 private:
  using Simplex = std::array<Point<D>, static_cast<std::size_t>(D)>;
  struct Node {
    Box<D> box;
    std::uint32_t begin = 0, end = 0;  ///< its simplices
    std::uint32_t second = 0;          ///< the second of its two nodes, the first is the next; 0: it has none
  };
  void add(const Snapshot<D>& snapshot, Half_facet wall);
  std::uint32_t divide(std::uint32_t begin, std::uint32_t end);

  std::vector<Simplex> simplices_;
  std::vector<Node> nodes_;  ///< the root first
  double size_ = 1;          ///< of the environment
  std::uint32_t last_ = 0;   ///< the simplex found by the call before
  std::vector<std::uint32_t> open_;
};

extern template class Nearest_walls<2>;
extern template class Nearest_walls<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_NEAREST_WALLS_H
