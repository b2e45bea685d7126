// SPDX-License-Identifier: LGPL-3.0-or-later
// The wall triangles as FCL holds them, and a traversal of its hierarchies: FCL has no public query by a box.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_FCL_WALLS_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_FCL_WALLS_H

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>

#include <memory>
#include <vector>

#include "wall_mesh.h"

namespace cellwalk::experiments {

inline fcl::Vector3d fcl_point(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// FCL's hierarchy with boxes of a kind.
template <class Bv>
std::shared_ptr<fcl::BVHModel<Bv>> fcl_model(const Wall_mesh& walls) {
  std::vector<fcl::Vector3d> points;
  points.reserve(walls.points.size());
  for (const Point<3>& p : walls.points) points.push_back(fcl_point(p));
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(walls.triangles.size());
  for (const auto& t : walls.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<fcl::BVHModel<Bv>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

using Fcl_boxes = fcl::BVHModel<fcl::AABBd>;

/// Calls visit(index) for the triangles whose boxes meet a box, until it returns true.
/// \param stack memory to use again
/// \return whether it did
template <class Visit>
bool visit_triangles(Fcl_boxes& model, const fcl::AABBd& box, std::vector<int>& stack, const Visit& visit) {
  stack.assign(1, 0);
  while (!stack.empty()) {
    const fcl::BVNode<fcl::AABBd>& node = model.getBV(stack.back());
    stack.pop_back();
    if (!node.bv.overlap(box)) continue;
    if (!node.isLeaf()) {
      stack.push_back(node.leftChild());
      stack.push_back(node.rightChild());
    } else if (visit(node.primitiveId())) {
      return true;
    }
  }
  return false;
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_FCL_WALLS_H
