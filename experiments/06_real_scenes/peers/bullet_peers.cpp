// SPDX-License-Identifier: LGPL-3.0-or-later
// Bullet's static triangle meshes (btBvhTriangleMeshShape, in single precision), asked for the triangles
// of a box.
//
//   bullet_body, bullet_group,   boxes are kept for each body, group of 8 vertices,
//   bullet_star                  star of a vertex
//   bullet_move                  a box query for each move
#include "common/peers/bullet_walls.h"
#include "kept_boxes.h"

namespace cellwalk::real_scenes {
namespace {

using experiments::Bullet_walls;
using experiments::Wall_triangle;

struct Bullet {
  explicit Bullet(const Wall_mesh& mesh) : walls(mesh) {}

  struct Candidate {
    Wall_triangle<btScalar> triangle;
    Float_box box;
  };
  using Place = experiments::Vector_of<btScalar>;

  void query(const Box& box, std::vector<Candidate>& list) {
    walls.query(box, [&](std::uint32_t i) {
      const Wall_mesh& mesh = *walls.walls;
      const Box bounds = experiments::box_of(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
      // Boxes of the hierarchy are quantised.
      if (meet(bounds, box)) list.push_back({walls.triangles[i], Float_box(bounds)});
    });
  }
  Place place(const Point<3>& p) const { return experiments::rounded<btScalar>(p); }
  bool is_behind(const Candidate& c, const Place& p) const { return c.triangle.side(p) > 0; }
  bool is_on_line(const Candidate& c, const Place& a, const Place& b) const {
    return c.triangle.is_on_line(a, b);
  }

  Bullet_walls walls;
};

}  // namespace

void add_bullet_peers(const Scene_walls& walls, const Motion& motion, Peers& peers) {
  Build build;
  const auto bullet =
      experiments::measured_build(build, "wall", [&] { return std::make_shared<Bullet>(*walls.mesh); });
  add_kept_boxes("bullet", false, motion, bullet, build, peers);
}

}  // namespace cellwalk::real_scenes
