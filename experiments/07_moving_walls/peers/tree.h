// SPDX-License-Identifier: LGPL-3.0-or-later
// What a peer is: a hierarchy of boxes, kept up to date step by step, that names the pairs of a triangle and
// an edge that may meet. Who tests the pairs, and in which arithmetic, is no matter of the hierarchy.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_PEERS_TREE_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_PEERS_TREE_H

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../swept_walls.h"
#include "common/peers/measured_build.h"

namespace cellwalk::moving_walls {

struct Pair {
  std::uint32_t triangle, edge;
};

class Tree {
 public:
  virtual ~Tree() = default;
  /// Adapts the hierarchy to the boxes of a step.
  virtual void update(const Swept_walls& walls) = 0;
  /// Appends the pairs of a touched triangle and an edge whose boxes meet.
  virtual void find(const Swept_walls& walls, std::vector<Pair>& pairs) = 0;

  std::string name, library;
  experiments::Build build;
};

/// A hierarchy over the boxes of triangles, which is asked for groups of edges.
class Wall_tree : public Tree {
 public:
  explicit Wall_tree(const Body_edges& edges) : edges_(edges) {}
  void find(const Swept_walls& walls, std::vector<Pair>& pairs) override {
    for (const Body_edges::Group& group : edges_.groups) {
      if (!meet(group.box, walls.touched_box())) continue;
      near_.clear();
      query(group.box, near_);
      add_pairs(walls, group, pairs);
    }
  }

 protected:
  /// Appends at least the triangles whose boxes meet a box.
  virtual void query(const Box& box, std::vector<std::uint32_t>& triangles) = 0;
  /// Appends the pairs of a group and the triangles found.
  void add_pairs(const Swept_walls& walls, const Body_edges::Group& group, std::vector<Pair>& pairs) const {
    for (const std::uint32_t t : near_) {
      const Box& box = walls.boxes()[t];
      if (!walls.is_touched(t) || !meet(box, group.box)) continue;
      for (std::uint32_t e = group.begin; e < group.end; ++e)
        if (meet(box, edges_.boxes[e])) pairs.push_back({t, e});
    }
  }

  const Body_edges& edges_;
  std::vector<std::uint32_t> near_;
};

using Trees = std::vector<std::unique_ptr<Tree>>;

// Each appends its hierarchies; walls and edges must outlive them.
void add_bullet_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees);
void add_embree_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees);
void add_fcl_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees);
void add_cgal_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_PEERS_TREE_H
