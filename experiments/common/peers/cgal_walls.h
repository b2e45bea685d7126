// SPDX-License-Identifier: LGPL-3.0-or-later
// The wall triangles in CGAL's AABB_tree, with a kernel of exact predicates.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_CGAL_WALLS_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_CGAL_WALLS_H

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <cstddef>
#include <vector>

#include "box.h"
#include "wall_mesh.h"

namespace cellwalk::experiments::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;
using Triangles = std::vector<Triangle_3>;
#if CGAL_VERSION_MAJOR >= 6
using Triangle_traits =
    CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
using Triangle_traits =
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif
using Tree = CGAL::AABB_tree<Triangle_traits>;

inline Point_3 cgal_point(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// Steers a traversal of the tree: appends the triangles whose boxes meet a box.
template <class Candidate>
struct Near_box {
  CGAL::Bbox_3 box;
  std::vector<Candidate>* list;

  bool go_further() const { return true; }
  bool do_intersect(int, const CGAL::AABB_node<Tree::AABB_traits>& node) const {
    return CGAL::do_overlap(box, node.bbox());
  }
  void intersection(int, const Tree::Primitive& primitive) const {
    const Triangle_3& triangle = primitive.datum();
    const CGAL::Bbox_3 b = triangle.bbox();
    if (CGAL::do_overlap(box, b))
      list->push_back({triangle, {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}}});
  }
};

struct Walls {
  explicit Walls(const Wall_mesh& walls) {
    triangles.reserve(walls.triangles.size());
    for (std::size_t i = 0; i < walls.triangles.size(); ++i)
      triangles.emplace_back(cgal_point(walls.corner(i, 0)), cgal_point(walls.corner(i, 1)),
                             cgal_point(walls.corner(i, 2)));
    tree.insert(triangles.cbegin(), triangles.cend());
    tree.build();
  }
  /// Appends the triangles whose boxes meet a box. Boxes against boxes is all that candidates need: an exact
  /// test of each triangle and the box would cost more than it saves.
  template <class Candidate>
  void query(const Box& b, std::vector<Candidate>& list) const {
    const Near_box<Candidate> near{
        CGAL::Bbox_3(b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]), &list};
    tree.traversal(0, near);
  }

  Triangles triangles;
  Tree tree;
};

}  // namespace cellwalk::experiments::cgal

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_CGAL_WALLS_H
