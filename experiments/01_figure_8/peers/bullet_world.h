// SPDX-License-Identifier: LGPL-3.0-or-later
// The wall triangles as Bullet holds them. btScalar is float, or double where BT_USE_DOUBLE_PRECISION is
// defined.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H

#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <limits>
#include <vector>

#include "body_box.h"
#include "world.h"

namespace cellwalk::figure_8 {

/// The name of a method in this precision. A macro: the two plug-ins must share no variable.
#ifdef BT_USE_DOUBLE_PRECISION
#define CELLWALK_BULLET_NAME(name) (name "_double")
#else
#define CELLWALK_BULLET_NAME(name) (name)
#endif

/// Vertex and index arrays, and Bullet's view of them.
class Bullet_mesh {
 public:
  explicit Bullet_mesh(const Wall_mesh& walls) {
    vertices_.reserve(3 * walls.points.size());
    for (const Point<3>& p : walls.points)
      for (const double x : p) vertices_.push_back(static_cast<btScalar>(x));
    indices_.reserve(3 * walls.triangles.size());
    for (const auto& triangle : walls.triangles)
      for (const std::uint32_t i : triangle) indices_.push_back(static_cast<int>(i));
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(walls.triangles.size());
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data());
    mesh.m_triangleIndexStride = 3 * sizeof(int);
    mesh.m_numVertices = static_cast<int>(walls.points.size());
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
    mesh.m_vertexStride = 3 * sizeof(btScalar);
    mesh_.addIndexedMesh(mesh, PHY_INTEGER);
  }
  Bullet_mesh(const Bullet_mesh&) = delete;
  Bullet_mesh& operator=(const Bullet_mesh&) = delete;

  btTriangleIndexVertexArray& mesh() { return mesh_; }

 private:
  std::vector<btScalar> vertices_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray mesh_;
};

inline btVector3 bullet_point(const Point<3>& p) {
  return {static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2])};
}

/// By how much of itself a coordinate of a rounded box is moved outward: four times the largest error of
/// rounding it.
inline constexpr btScalar box_rounding = 2 * std::numeric_limits<btScalar>::epsilon();

inline btVector3 rounded_down(const Point<3>& p) {
  const btVector3 r = bullet_point(p);
  return sizeof(btScalar) == sizeof(double) ? r : r - box_rounding * r.absolute();
}
inline btVector3 rounded_up(const Point<3>& p) {
  const btVector3 r = bullet_point(p);
  return sizeof(btScalar) == sizeof(double) ? r : r + box_rounding * r.absolute();
}

/// Adds the methods on Bullet's triangle hierarchy.
void add_bullet_peers(const Grid_world& world, Peers& peers);
/// Adds GIMPACT's.
void add_gimpact_peers(const Grid_world& world, Peers& peers);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H
