// SPDX-License-Identifier: LGPL-3.0-or-later
// Bullet's quantised hierarchies. It computes boxes from the vertices of triangles, so that each box is given
// to it as a triangle with the lowest and the highest corner of it.
//
//   bullet_refit    btOptimizedBvh::refit: all boxes anew, bottom up
//   bullet_partial  partialRefitTree: the subtrees of 2 kB that meet the box of what moved
//   bullet_bodies   the other way round: a hierarchy of the edges of the bodies, refitted in each step as if
//                   the bodies had moved, and asked for each triangle that moves
#include <algorithm>
#include <array>
#include <utility>

#include "common/peers/bullet_walls.h"
#include "tree.h"

namespace cellwalk::moving_walls {
namespace {

using experiments::rounded_down;
using experiments::rounded_up;

/// How far walls may go out of where they are first, in sizes of all of them.
constexpr btScalar room = 0.25;

class Bullet_boxes {
 public:
  explicit Bullet_boxes(const std::vector<Box>& boxes) : corners_(2 * boxes.size()) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      set(i, boxes[i]);
      const int low = static_cast<int>(2 * i);
      indices_.insert(indices_.end(), {low, low + 1, low + 1});
    }
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(boxes.size());
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data());
    mesh.m_triangleIndexStride = 3 * sizeof(int);
    mesh.m_numVertices = static_cast<int>(corners_.size());
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(corners_.data());
    mesh.m_vertexStride = sizeof(corners_[0]);
    mesh_.addIndexedMesh(mesh, PHY_INTEGER);
    mesh_.calculateAabbBruteForce(low_, high_);
    const btVector3 margin = room * (high_ - low_);
    low_ -= margin;
    high_ += margin;
    shape_ =
        std::make_unique<btBvhTriangleMeshShape>(&mesh_, /*useQuantizedAabbCompression=*/true, low_, high_);
  }
  Bullet_boxes(const Bullet_boxes&) = delete;
  Bullet_boxes& operator=(const Bullet_boxes&) = delete;

  void set(std::uint32_t i, const Box& box) {
    const btVector3 low = rounded_down(box.low), high = rounded_up(box.high);
    for (int k = 0; k < 3; ++k) {
      corners_[2 * i][static_cast<std::size_t>(k)] = low[k];
      corners_[2 * i + 1][static_cast<std::size_t>(k)] = high[k];
    }
  }
  /// As refitTree(), which computes the box of the whole shape, too, by six passes over all triangles.
  void refit() { shape_->getOptimizedBvh()->refit(&mesh_, low_, high_); }
  void refit(const Box& part) { shape_->partialRefitTree(rounded_down(part.low), rounded_up(part.high)); }
  /// Subtree by subtree: a partial refit leaves the nodes above them as they are.
  void ask_subtrees() {
    shape_->getOptimizedBvh()->setTraversalMode(btQuantizedBvh::TRAVERSAL_STACKLESS_CACHE_FRIENDLY);
  }

  template <class Found>
  void query(const Box& box, const Found& found) {
    struct Callback : btNodeOverlapCallback {
      explicit Callback(const Found& f) : found(f) {}
      void processNode(int, int index) override { found(static_cast<std::uint32_t>(index)); }
      const Found& found;
    } callback(found);
    shape_->getOptimizedBvh()->reportAabbOverlappingNodex(&callback, rounded_down(box.low),
                                                          rounded_up(box.high));
  }

 private:
  std::vector<std::array<btScalar, 3>> corners_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray mesh_;
  btVector3 low_, high_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

class Bullet_tree : public Wall_tree {
 public:
  Bullet_tree(const Swept_walls& walls, const Body_edges& edges, bool is_partial)
      : Wall_tree(edges), is_partial_(is_partial), tree_(walls.boxes()) {
    if (is_partial) tree_.ask_subtrees();
  }
  void update(const Swept_walls& walls) override {
    for (const std::uint32_t t : walls.touched()) tree_.set(t, walls.boxes()[t]);
    if (!is_partial_) return tree_.refit();
    // Subtrees are found by their boxes of before.
    Box part = walls.touched_box();
    for (std::size_t k = 0; k < 3; ++k) {
      part.low[k] = std::min(part.low[k], last_.low[k]);
      part.high[k] = std::max(part.high[k], last_.high[k]);
    }
    last_ = walls.touched_box();
    if (!walls.touched().empty()) tree_.refit(part);
  }

 private:
  void query(const Box& box, std::vector<std::uint32_t>& triangles) override {
    tree_.query(box, [&](std::uint32_t t) { triangles.push_back(t); });
  }

  bool is_partial_;
  Bullet_boxes tree_;
  Box last_ = Box::nowhere();
};

class Bullet_bodies : public Tree {
 public:
  explicit Bullet_bodies(const Body_edges& edges) : edges_(edges), tree_(edges.boxes) {}
  void update(const Swept_walls&) override {
    for (std::uint32_t e = 0; e < edges_.boxes.size(); ++e) tree_.set(e, edges_.boxes[e]);
    tree_.refit();
  }
  void find(const Swept_walls& walls, std::vector<Pair>& pairs) override {
    for (const std::uint32_t t : walls.touched()) {
      const Box& box = walls.boxes()[t];
      tree_.query(box, [&](std::uint32_t e) {
        if (meet(box, edges_.boxes[e])) pairs.push_back({t, e});
      });
    }
  }

 private:
  const Body_edges& edges_;
  Bullet_boxes tree_;
};

}  // namespace

void add_bullet_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees) {
  const auto add = [&](const char* name, const auto& make) {
    experiments::Build build;
    auto tree = experiments::measured_build(build, "wall", make);
    tree->name = name;
    tree->library = "bullet";
    tree->build = build;
    trees.push_back(std::move(tree));
  };
  add("bullet_refit", [&] { return std::make_unique<Bullet_tree>(walls, edges, false); });
  add("bullet_partial", [&] { return std::make_unique<Bullet_tree>(walls, edges, true); });
  add("bullet_bodies", [&] { return std::make_unique<Bullet_bodies>(edges); });
}

}  // namespace cellwalk::moving_walls
