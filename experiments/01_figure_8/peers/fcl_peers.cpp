// SPDX-License-Identifier: LGPL-3.0-or-later
// FCL has no segments against meshes, and its continuous queries move whole models. A segment is therefore
// given as a triangle.
//
//   fcl_collide    fcl::collide of a model of one triangle, refitted for each query, with the model of the
//                  walls (OBBRSS boxes, since every call copies models of AABBs as a whole). The triangle is
//                  thin, since the oriented box of a degenerate one has no frame.
//   fcl_boxes      its AABB hierarchy and its test of triangles, called directly with the triangle (a, b, b):
//                  the test projects onto axes, the axis of a zero normal separates nothing, and the axes of
//                  a segment against a triangle are left. Nothing is enlarged.
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "body_box.h"
#include "common/peers/fcl_walls.h"
#include "families.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

using experiments::fcl_model;
using experiments::fcl_point;

/// Width of a thin triangle, in cells: far below what a wrong answer could be told from, far above the
/// rounding of its box.
constexpr double thin = 0x1p-30;

class Collide : public Stateless {
 public:
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  explicit Collide(std::shared_ptr<Model> walls)
      : walls_(std::move(walls)), query_(std::make_shared<Model>()) {
    query_->beginModel(1, 3);
    query_->addTriangle({0, 0, 0}, {1, 0, 0}, {1, thin, 0});
    query_->endModel();
  }

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      counter.queries();
      query_->beginReplaceModel();
      query_->replaceTriangle(fcl_point(a), fcl_point(b), beside(fcl_point(a), fcl_point(b)));
      query_->endReplaceModel();
      const fcl::CollisionRequestd request(1, false);
      fcl::CollisionResultd result;
      const fcl::Transform3d identity = fcl::Transform3d::Identity();
      return fcl::collide(query_.get(), identity, walls_.get(), identity, request, result) > 0;
    });
  }

 private:
  /// b, shifted along the axis that the segment has least of.
  static fcl::Vector3d beside(const fcl::Vector3d& a, fcl::Vector3d b) {
    Eigen::Index k = 0;
    (b - a).cwiseAbs().minCoeff(&k);
    b[k] += thin;
    return b;
  }

  std::shared_ptr<Model> walls_, query_;
};

class Boxes : public Stateless {
 public:
  using Model = experiments::Fcl_boxes;
  explicit Boxes(std::shared_ptr<Model> walls) : walls_(std::move(walls)) {}

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      counter.queries();
      return hits(fcl_point(a), fcl_point(b), counter);
    });
  }

 private:
  template <class Counter>
  bool hits(const fcl::Vector3d& a, const fcl::Vector3d& b, Counter& counter) {
    return experiments::visit_triangles(*walls_, fcl::AABBd(a, b), stack_, [&](int i) {
      counter.triangle_tests();
      const fcl::Triangle& t = walls_->tri_indices[i];
      const fcl::Vector3d* x = walls_->vertices;
      return fcl::detail::Intersectd::intersect_Triangle(a, b, b, x[t[0]], x[t[1]], x[t[2]]);
    });
  }

  std::shared_ptr<Model> walls_;
  std::vector<int> stack_;
};

}  // namespace

void add_fcl_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const auto oriented = measured_build(build, "wall", [&] { return fcl_model<fcl::OBBRSSd>(world.walls); });
  add_peer(peers, "fcl_collide", Collide(oriented), build);
  const auto aligned = measured_build(build, "wall", [&] { return fcl_model<fcl::AABBd>(world.walls); });
  add_peer(peers, "fcl_boxes", Boxes(aligned), build);
}

}  // namespace cellwalk::figure_8
