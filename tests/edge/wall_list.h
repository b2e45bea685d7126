// SPDX-License-Identifier: LGPL-3.0-or-later
// All walls of a world, prepared once so that many swept triangles can be held against all of them. What is
// told apart by boxes or by a plane costs next to nothing; the rest is left to rational_sweep.h.
#ifndef CELLWALK_TESTS_EDGE_WALL_LIST_H
#define CELLWALK_TESTS_EDGE_WALL_LIST_H

#include <cellwalk/environment/snapshot.h>

#include <array>
#include <optional>
#include <vector>

#include "edge/integer_complex.h"
#include "edge/rational_sweep.h"

namespace cellwalk::test {

template <int D>
std::vector<Point<D>> polygon(const Snapshot<D>& snapshot, Half_facet f) {
  std::vector<Point<D>> points;
  for (const std::uint32_t v : snapshot.loop(f)) points.push_back(snapshot.point(v));
  return points;
}

template <int D>
class Wall_list {
 public:
  /// All impassable facets, each once: from the side of its lesser half-facet.
  explicit Wall_list(const Snapshot<D>& snapshot);

  /// True if a wall crosses the open triangle abq, as crosses() says.
  bool is_crossed(const Point<D>& a, const Point<D>& b, const Point<D>& q) const;
  /// The least first_crossing() of all walls.
  std::optional<double> first_hit(const Point<D>& a, const Point<D>& b, const Point<D>& q) const;

  std::vector<Half_facet> facets;
  std::vector<std::vector<Point<D>>> polygons;

 private:
  struct Prepared {
    std::array<Point<D>, 2> box;
    std::vector<std::array<oracle::Big, D>> points;
    oracle::Affine<D, oracle::Big> plane;
  };
  struct Swept;

  bool is_apart(const Swept& triangle, const Prepared& wall) const;
  /// Calls visit for the number of each wall that is not found to be apart from the triangle, until it
  /// returns false.
  template <class Visit>
  void for_each_near(const Point<D>& a, const Point<D>& b, const Point<D>& q, const Visit& visit) const;

  int shift_ = 0;  ///< integers are points scaled by 2^shift
  std::vector<Prepared> prepared_;
};

extern template class Wall_list<2>;
extern template class Wall_list<3>;

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_WALL_LIST_H
