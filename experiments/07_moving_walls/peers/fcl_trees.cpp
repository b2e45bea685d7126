// SPDX-License-Identifier: LGPL-3.0-or-later
// FCL's hierarchy of boxes along the axes. It knows of motion: after an update its boxes hold each triangle
// as it was and as it is. It is traversed here, as FCL has no queries by boxes.
//
//   fcl_refit   beginUpdateModel, updateSubModel, endUpdateModel: all boxes anew, bottom up
#include <fcl/math/bv/utility.h>

#include <utility>

#include "common/peers/fcl_walls.h"
#include "tree.h"

namespace cellwalk::moving_walls {
namespace {

using experiments::fcl_point;

class Fcl_tree : public Wall_tree {
 public:
  Fcl_tree(const Swept_walls& walls, const Body_edges& edges) : Wall_tree(edges) {
    for (const Point<3>& p : walls.positions()) points_.push_back(fcl_point(p));
    std::vector<fcl::Triangle> triangles;
    for (const auto& t : walls.walls().triangles) triangles.emplace_back(t[0], t[1], t[2]);
    model_.beginModel(static_cast<int>(triangles.size()), static_cast<int>(points_.size()));
    model_.addSubModel(points_, triangles);
    model_.endModel();
  }
  void update(const Swept_walls& walls) override {
    // What is there now becomes what was before: it has to be where the last step ended.
    for (const Wall_move& m : walls.last_moves())
      model_.vertices[m.vertex] = points_[m.vertex] = fcl_point(m.after);
    for (const Wall_move& m : walls.moves()) points_[m.vertex] = fcl_point(m.to);
    model_.beginUpdateModel();
    model_.updateSubModel(points_);
    model_.endUpdateModel(/*refit=*/true, /*bottomup=*/true);
  }

 private:
  void query(const Box& box, std::vector<std::uint32_t>& triangles) override {
    const fcl::AABBd asked(fcl_point(box.low), fcl_point(box.high));
    experiments::visit_triangles(model_, asked, stack_, [&](int i) {
      triangles.push_back(static_cast<std::uint32_t>(i));
      return false;
    });
  }

  experiments::Fcl_boxes model_;
  std::vector<fcl::Vector3d> points_;
  std::vector<int> stack_;
};

}  // namespace

void add_fcl_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees) {
  experiments::Build build;
  auto tree =
      experiments::measured_build(build, "wall", [&] { return std::make_unique<Fcl_tree>(walls, edges); });
  tree->name = "fcl_refit";
  tree->library = "fcl";
  tree->build = build;
  trees.push_back(std::move(tree));
}

}  // namespace cellwalk::moving_walls
