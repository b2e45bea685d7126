// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge: whether a wall passes through an edge both ends of which move at the same time, in straight
// lines, by brute force over all walls and in fractions. It shares no predicate with the library.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_WALL_JUDGE_H
#define CELLWALK_EXPERIMENTS_ABLATION_WALL_JUDGE_H

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/peers/wall_mesh.h"

namespace cellwalk::ablation {

/// The edge from p(s) = a + s (b - a) to q(s) = c + s (d - c), s from 0 to 1.
struct Moving_edge {
  Point<3> a, b, c, d;
};

enum class Verdict : std::uint8_t {
  free,
  blocked,
  undecided  ///< degenerate: something is touched, or lies in a plane with it; nothing else blocks
};

/// The sign of det(q - p, r - p, t - p).
/// Cost: some 20 ns; some us where rounded numbers do not tell.
int orientation_sign(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& t);

/// A point that moves from a to b, against a triangle.
Verdict point_meets_triangle(const Point<3>& a, const Point<3>& b, std::span<const Point<3>, 3> triangle);

/// The inside of a moving edge, against the inside of a line segment uv.
///
/// orientation(p(s), q(s), u, v) is affine in p and in q, so quadratic in s, with the coefficients
/// orientation(a,c,u,v), (orientation(a,d,u,v) + orientation(b,c,u,v)) / 2 and orientation(b,d,u,v) in the
/// basis of Bernstein. Each root is isolated at the vertex of the parabola, and the signs there that tell
/// whether the segments meet are found by bisection.
Verdict edge_passes_segment(const Moving_edge& edge, const Point<3>& u, const Point<3>& v);

/// All walls of a world.
class Wall_judge {
 public:
  explicit Wall_judge(const experiments::Wall_mesh& walls);

  /// Judges a motion that begins free: no wall meets the edge at the start. Then the first wall that is met
  /// is met by an end, or in an edge of the wall by the inside of the edge; and where the edge passes the
  /// edge of a wall, there is a wall on one side of it.
  /// Cost: 0.2 us a wall near the motion, 0.1 ms for each that rounded numbers do not tell apart.
  Verdict judge(const Moving_edge& edge) const;

  /// Whether a wall crosses the segment pq.
  Verdict judge_segment(const Point<3>& p, const Point<3>& q) const;

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;
  using Tree =
      boost::geometry::index::rtree<std::pair<Box, std::uint32_t>, boost::geometry::index::rstar<16>>;

  static Box box_of(std::span<const Point<3>> points);
  /// Calls visit with the number of each item whose box meets another, until it returns true.
  template <class Visit>
  static bool any_near(const Tree& tree, const Box& box, const Visit& visit);

  std::vector<std::array<Point<3>, 3>> triangles_;
  std::vector<std::array<Point<3>, 2>> segments_;  ///< the edges of the walls, each once
  Tree triangle_tree_, segment_tree_;
};

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_WALL_JUDGE_H
