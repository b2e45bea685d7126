// SPDX-License-Identifier: LGPL-3.0-or-later
// Bullet's static triangle meshes (btBvhTriangleMeshShape, btOptimizedBvh with quantised boxes).
//
//   bullet_swept_box   the paper's: for each check of an edge a box query of its swept triangle, then
//                      segments against the triangles found
//   bullet_ray         performRaycast for each segment, with Bullet's own test, whose triangles extend beyond
//                      their edges
//   bullet_body_box    one box query a body and step
//   bullet_kept_box    the triangles of the enlarged box are kept until the body leaves it; in each step
//                      those whose boxes meet that of the body are tested
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <memory>
#include <utility>
#include <vector>

#include "bullet_world.h"
#include "candidates.h"
#include "replay.h"
#include "segment_triangle.h"

namespace cellwalk::figure_8 {
namespace {

using Triangle = Wall_triangle<btScalar>;

struct Candidate {
  Triangle triangle;
  Box box;
};

using Bullet = experiments::Bullet_walls;

class Swept_box : public Stateless {
 public:
  explicit Swept_box(std::shared_ptr<Bullet> bullet) : bullet_(std::move(bullet)) {}

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    const auto from = rounded<btScalar>(positions[v]), to = rounded<btScalar>(target);
    unsigned answer = 0;
    for (std::size_t k = 0; k < trace_edges; ++k) {
      const Point<3>& end = positions[trace_neighbour(v, k)];
      found_.clear();
      counter.boxes();
      bullet_->query(box_of(positions[v], target, end), [this](std::uint32_t i) { found_.push_back(i); });
      // The box of the first edge holds the vertex's own motion.
      if (k == 0) answer = hits(from, to, counter);
      answer |= hits(answer & 1 ? from : to, rounded<btScalar>(end), counter) << (k + 1);
    }
    return answer;
  }

 private:
  template <class Counter>
  unsigned hits(const Vector_of<btScalar>& a, const Vector_of<btScalar>& b, Counter& counter) const {
    for (const std::uint32_t i : found_) {
      counter.triangle_tests();
      const Triangle& wall = bullet_->triangles[i];
      if (wall.side(a) * wall.side(b) <= 0 && wall.is_on_line(a, b)) return 1;
    }
    return 0;
  }

  std::shared_ptr<Bullet> bullet_;
  std::vector<std::uint32_t> found_;
};

class Ray : public Stateless {
 public:
  explicit Ray(std::shared_ptr<Bullet> bullet) : bullet_(std::move(bullet)) {}

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      struct Callback : btTriangleRaycastCallback {
        using btTriangleRaycastCallback::btTriangleRaycastCallback;
        void processTriangle(btVector3* triangle, int part, int index) override {
          counter->triangle_tests();
          btTriangleRaycastCallback::processTriangle(triangle, part, index);
        }
        btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
          is_hit = true;
          return fraction;
        }
        bool is_hit = false;
        Counter* counter = nullptr;
      } callback(bullet_point(a), bullet_point(b));
      callback.counter = &counter;
      counter.queries();
      bullet_->shape.performRaycast(&callback, callback.m_from, callback.m_to);
      return callback.is_hit;
    });
  }

 private:
  std::shared_ptr<Bullet> bullet_;
};

class Body_box {
 public:
  static constexpr unsigned bits = segment_bits;
  Body_box(std::shared_ptr<Bullet> bullet, double steps) : bullet_(std::move(bullet)), kept_(steps) {}

  void prepare(const Trace& trace) { kept_.reset(trace); }
  template <class Counter>
  bool start(std::size_t body, const Point<3>* positions, const Point<3>* targets, Counter& counter) {
    const auto query = [this](const Box& box, std::vector<Candidate>& list) {
      bullet_->query(box, [&](std::uint32_t i) {
        const Wall_mesh& walls = *bullet_->walls;
        list.push_back(
            {bullet_->triangles[i], box_of(walls.corner(i, 0), walls.corner(i, 1), walls.corner(i, 2))});
      });
    };
    near_ = kept_.find(body, positions, targets, query, counter);
    return near_.empty();
  }
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return vertex_against<btScalar>(
        near_.size(), [this](std::size_t i) -> const Triangle& { return near_[i]->triangle; }, v, positions,
        target, counter);
  }

 private:
  std::shared_ptr<Bullet> bullet_;
  Kept_candidates<Candidate> kept_;
  std::span<const Candidate* const> near_;
};

}  // namespace

void add_bullet_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const auto bullet = measured_build(build, "wall", [&] { return std::make_shared<Bullet>(world.walls); });
  add_peer(peers, CELLWALK_BULLET_NAME("bullet_swept_box"), Swept_box(bullet), build);
  add_peer(peers, CELLWALK_BULLET_NAME("bullet_ray"), Ray(bullet), build);
  add_peer(peers, CELLWALK_BULLET_NAME("bullet_body_box"), Body_box(bullet, 0), build);
  add_peer(peers, CELLWALK_BULLET_NAME("bullet_kept_box"), Body_box(bullet, kept_steps), build);
}

}  // namespace cellwalk::figure_8

/// The entry of the plug-in: both precisions of Bullet have the same symbols, so each is loaded apart.
extern "C" [[gnu::visibility("default")]] void cellwalk_figure_8_peers(
    const cellwalk::figure_8::Grid_world& world, cellwalk::figure_8::Peers& peers);

void cellwalk_figure_8_peers(const cellwalk::figure_8::Grid_world& world, cellwalk::figure_8::Peers& peers) {
  cellwalk::figure_8::add_bullet_peers(world, peers);
  cellwalk::figure_8::add_gimpact_peers(world, peers);
}
