// SPDX-License-Identifier: LGPL-3.0-or-later
// The worlds in which walk and locate meet the oracle, and the motions made up for them.
#ifndef CELLWALK_TESTS_WALK_ORACLE_WORLDS_H
#define CELLWALK_TESTS_WALK_ORACLE_WORLDS_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::oracle {

/// A world and what the making of motions needs to know of it.
template <int D>
struct World {
  std::string name;
  Cell_soup<D> soup;
  /// Small combinations of its points are exact, so that degenerate motions really are.
  bool is_dyadic = true;
};

inline constexpr int world_kinds = 15;

/// World number i: its kind is i % world_kinds, its seed i. Walls, solid and missing cells in most of them;
/// slits (walls in one place that are not glued) in those of the last three kinds, and about some vertices of
/// every second world of simplices.
template <int D>
World<D> make_world(std::uint64_t i);

enum class Motion_kind {
  generic,        ///< to a random point of the world's box
  generic_short,  ///< by up to about a cell
  to_lattice,     ///< to a combination of a cell's points with weights that are multiples of 1/8
  to_vertex,
  to_edge,         ///< to a point inside an edge
  to_facet,        ///< to a point inside a facet
  to_wall,         ///< to a point of a wall
  through_vertex,  ///< aimed at a feature and past it
  through_edge,
  through_facet,
  in_wall_plane,  ///< within the plane of a wall
  along_edge,     ///< along an edge, often beyond it
  backward,       ///< back along the last motion, often beyond its start
  /// To a point next to a lattice point, edge or facet, or past one: by 1 ulp up to the error of the planes.
  nearly,
  nowhere,  ///< zero motion
  count
};
inline constexpr int motion_kinds = static_cast<int>(Motion_kind::count);
inline constexpr bool is_generic(Motion_kind k) {
  return k == Motion_kind::generic || k == Motion_kind::generic_short;
}

/// Makes up starts and targets in one world.
template <int D>
class Motion_source {
 public:
  Motion_source(const World<D>& world, std::uint64_t seed);

  Motion_kind kind(bool generic);
  /// A point that a motion of this kind may start from; may lie in no free cell. Motions in a wall plane and
  /// along an edge need the start that was made for them.
  Point<D> start(Motion_kind kind);
  /// A target for a motion from `from`; `last` is where the one before started.
  Point<D> target(Motion_kind kind, const Point<D>& from, const Point<D>& last);
  Random& random() { return random_; }

 private:
  using Loop = std::span<const std::uint32_t>;
  const Point<D>& point(std::uint32_t v) const { return world_.soup.points[v]; }
  Point<D> combine(const Point<D>& origin, const Point<D>& u, int i, const Point<D>& v, int j) const;
  Loop any_facet() { return world_.soup.facet(random_.below(world_.soup.facet_count())); }
  Point<D> in_box();
  Point<D> in_cell();
  Point<D> in_facet(Loop loop);
  Point<D> on_edge(Loop loop);
  Point<D> near(const Point<D>& p, double distance);
  Point<D> next_to(const Point<D>& p);
  int between(int low, int high) { return low + static_cast<int>(random_.below(high - low + 1)); }

  const World<D>& world_;
  Random random_;
  std::vector<std::uint32_t> walls_;  // half-facets
  Loop support_;                      // wall or edge on which the last start was put
  Point<D> low_, high_;
};

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_WALK_ORACLE_WORLDS_H
