// SPDX-License-Identifier: LGPL-3.0-or-later
// The wall triangles as Bullet holds them. btScalar is float, or double where BT_USE_DOUBLE_PRECISION is
// defined.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_BULLET_WALLS_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_BULLET_WALLS_H

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "box.h"
#include "wall_mesh.h"
#include "wall_triangle.h"

namespace cellwalk::experiments {

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

/// The walls in Bullet's triangle hierarchy (btBvhTriangleMeshShape, btOptimizedBvh with quantised boxes),
/// and each triangle with its plane.
struct Bullet_walls {
  explicit Bullet_walls(const Wall_mesh& w)
      : walls(&w), mesh(w), shape(&mesh.mesh(), /*useQuantizedAabbCompression=*/true) {
    triangles.reserve(w.triangles.size());
    for (std::size_t i = 0; i < w.triangles.size(); ++i)
      triangles.emplace_back(w.corner(i, 0), w.corner(i, 1), w.corner(i, 2));
  }
  const Wall_mesh* walls;
  Bullet_mesh mesh;
  btBvhTriangleMeshShape shape;
  std::vector<Wall_triangle<btScalar>> triangles;

  /// Calls found(index) for the triangles whose boxes meet a box.
  template <class Found>
  void query(const Box& box, const Found& found) {
    struct Callback : btNodeOverlapCallback {
      explicit Callback(const Found& f) : found(f) {}
      void processNode(int, int index) override { found(static_cast<std::uint32_t>(index)); }
      const Found& found;
    } callback(found);
    shape.getOptimizedBvh()->reportAabbOverlappingNodex(&callback, rounded_down(box.low),
                                                        rounded_up(box.high));
  }
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_BULLET_WALLS_H
