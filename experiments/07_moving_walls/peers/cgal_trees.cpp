// SPDX-License-Identifier: LGPL-3.0-or-later
// CGAL's AABB_tree of the boxes, each given as the segment between its lowest and its highest corner.
//
//   cgal_rebuild   built anew in each step: the tree cannot be refitted
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#endif

#include <utility>

#include "tree.h"

namespace cellwalk::moving_walls {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Diagonals = std::vector<Kernel::Segment_3>;
#if CGAL_VERSION_MAJOR >= 6
using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_segment_primitive_3<Kernel, Diagonals::const_iterator>>;
#else
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_segment_primitive<Kernel, Diagonals::const_iterator>>;
#endif
using Aabb_tree = CGAL::AABB_tree<Traits>;

Kernel::Segment_3 diagonal(const Box& box) {
  return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
}

/// Steers a traversal of the tree.
struct Near_box {
  CGAL::Bbox_3 box;
  const Diagonals* diagonals;
  std::vector<std::uint32_t>* triangles;

  bool go_further() const { return true; }
  bool do_intersect(int, const CGAL::AABB_node<Traits>& node) const {
    return CGAL::do_overlap(box, node.bbox());
  }
  void intersection(int, const Traits::Primitive& primitive) const {
    if (CGAL::do_overlap(box, primitive.datum().bbox()))
      triangles->push_back(static_cast<std::uint32_t>(primitive.id() - diagonals->begin()));
  }
};

class Cgal_tree : public Wall_tree {
 public:
  Cgal_tree(const Swept_walls& walls, const Body_edges& edges) : Wall_tree(edges) {
    for (const Box& box : walls.boxes()) diagonals_.push_back(diagonal(box));
    build_tree();
  }
  void update(const Swept_walls& walls) override {
    for (const std::uint32_t t : walls.touched()) diagonals_[t] = diagonal(walls.boxes()[t]);
    build_tree();
  }

 private:
  void build_tree() {
    tree_.clear();
    tree_.insert(diagonals_.cbegin(), diagonals_.cend());
    tree_.build();
  }
  void query(const Box& box, std::vector<std::uint32_t>& triangles) override {
    const Near_box near{
        CGAL::Bbox_3(box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]), &diagonals_,
        &triangles};
    tree_.traversal(0, near);
  }

  Diagonals diagonals_;
  Aabb_tree tree_;
};

}  // namespace

void add_cgal_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees) {
  experiments::Build build;
  auto tree =
      experiments::measured_build(build, "wall", [&] { return std::make_unique<Cgal_tree>(walls, edges); });
  tree->name = "cgal_rebuild";
  tree->library = "cgal";
  tree->build = build;
  trees.push_back(std::move(tree));
}

}  // namespace cellwalk::moving_walls
