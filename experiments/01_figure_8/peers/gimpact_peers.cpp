// SPDX-License-Identifier: LGPL-3.0-or-later
// GIMPACT, the paper's second comparison: the triangle (from, target, q) against the triangles of the walls,
// the way its own mesh against mesh algorithm tests pairs (overlap_test_conservative, then
// find_triangle_collision_clip_method), with margin 0. It answers bits 4 to 6; these do not say what moves,
// so it moves as recorded.
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>
#include <utility>

#include "bullet_world.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

struct Gimpact {
  explicit Gimpact(const Wall_mesh& walls) : mesh(walls), shape(&mesh.mesh()) {
    shape.setMargin(0);
    shape.updateBound();
    part = shape.getMeshPart(0);
    part->lockChildShapes();
  }
  Bullet_mesh mesh;
  btGImpactMeshShape shape;
  btGImpactMeshShapePart* part = nullptr;
};

class Tau {
 public:
  static constexpr unsigned bits = triangle_bits;
  explicit Tau(std::shared_ptr<Gimpact> gimpact) : gimpact_(std::move(gimpact)) {}

  void prepare(const Trace&) {}
  template <class Counter>
  bool start(std::size_t, const Point<3>*, const Point<3>*, Counter&) {
    return false;
  }
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    unsigned answer = 0;
    for (std::size_t k = 0; k < trace_edges; ++k)
      answer |= static_cast<unsigned>(meets(positions[v], target, positions[trace_neighbour(v, k)], counter))
                << (4 + k);
    return answer;
  }

 private:
  template <class Counter>
  bool meets(const Point<3>& a, const Point<3>& b, const Point<3>& c, Counter& counter) {
    btPrimitiveTriangle tau;
    tau.m_margin = 0;
    tau.m_vertices[0] = bullet_point(a);
    tau.m_vertices[1] = bullet_point(b);
    tau.m_vertices[2] = bullet_point(c);
    const btAABB box(tau.m_vertices[0], tau.m_vertices[1], tau.m_vertices[2]);
    found_.resize(0);
    counter.boxes();
    if (!gimpact_->part->getBoxSet()->boxQuery(box, found_)) return false;
    tau.buildTriPlane();
    for (int i = 0; i < found_.size(); ++i) {
      btPrimitiveTriangle wall;
      gimpact_->part->getPrimitiveTriangle(found_[i], wall);
      wall.m_margin = 0;
      wall.buildTriPlane();
      counter.triangle_tests();
      GIM_TRIANGLE_CONTACT contact;
      if (tau.overlap_test_conservative(wall) && tau.find_triangle_collision_clip_method(wall, contact))
        return true;
    }
    return false;
  }

  std::shared_ptr<Gimpact> gimpact_;
  btAlignedObjectArray<int> found_;
};

}  // namespace

void add_gimpact_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const auto gimpact = measured_build(build, "wall", [&] { return std::make_shared<Gimpact>(world.walls); });
  add_peer(peers, CELLWALK_BULLET_NAME("gimpact_tau"), Tau(gimpact), build);
}

}  // namespace cellwalk::figure_8
