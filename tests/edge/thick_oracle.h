// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of edges and faces with a radius, by definition: all walls, no cells, no flood, and distances of
// hulls in rational arithmetic.
#ifndef CELLWALK_TESTS_EDGE_THICK_ORACLE_H
#define CELLWALK_TESTS_EDGE_THICK_ORACLE_H

#include <cellwalk/environment/snapshot.h>

#include <optional>
#include <vector>

#include "kernel/rational_distance.h"

namespace cellwalk::test {

/// An edge with a radius whose end p moves to a target while q stands still; or a face, if it has a third
/// corner.
template <int D>
struct Thick_motion {
  Point<D> p, target, q;
  double radius = 0;
  std::optional<Point<D>> third{};
};

/// The corners that stand still.
template <int D>
std::vector<Point<D>> still_corners(const Thick_motion<D>& m) {
  return m.third ? std::vector{m.q, *m.third} : std::vector{m.q};
}
/// All, before it moves.
template <int D>
std::vector<Point<D>> before(const Thick_motion<D>& m) {
  std::vector<Point<D>> corners = still_corners(m);
  corners.insert(corners.begin(), m.p);
  return corners;
}
/// Those of what it sweeps.
template <int D>
std::vector<Point<D>> swept(const Thick_motion<D>& m) {
  std::vector<Point<D>> corners = before(m);
  corners.push_back(m.target);
  return corners;
}

/// An impassable facet with a free cell on at least one side.
template <int D>
struct Thick_wall {
  Half_facet facet;  ///< seen from a free side
  std::vector<Point<D>> corners;
  Hull<D> hull;
  Point<D> low, high;
};

template <int D>
class Thick_oracle {
 public:
  using Wall = Thick_wall<D>;

  explicit Thick_oracle(const Snapshot<D>& snapshot);

  const std::vector<Wall>& walls() const { return walls_; }

  /// The square of the least distance of the hull of some points to all walls.
  /// \pre there is a wall
  Fraction square_to_walls(std::span<const Point<D>> points) const;

  /// The walls that are nearer than r to the hull of some points.
  std::vector<const Wall*> nearer_than(double r, std::span<const Point<D>> points) const;

  /// True if none of these walls is nearer than the radius to what has been swept at a time.
  static bool is_free_until(const Fraction& time, const Thick_motion<D>& motion,
                            const std::vector<const Wall*>& walls);

  /// The shortest vector from the edge or face at a time to a hull.
  static Shortest<D> from_part_at(const Fraction& time, const Thick_motion<D>& motion, const Hull<D>& hull);

 private:
  std::vector<Wall> walls_;
};

extern template class Thick_oracle<2>;
extern template class Thick_oracle<3>;

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_THICK_ORACLE_H
