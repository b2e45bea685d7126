// SPDX-License-Identifier: LGPL-3.0-or-later
// FCL's hierarchy of axis-aligned boxes, in double precision. The planes of the triangles are kept beside it;
// where the ends of a segment lie on different sides, FCL's test of two triangles is given the segment as the
// triangle (a, b, b): it projects onto axes, the axis of a zero normal separates nothing, and the axes of a
// segment against a triangle are left.
//
//   fcl_body, fcl_group, fcl_star   boxes are kept for each body, group of 8 vertices, star of a vertex
//   fcl_move                        a traversal by the box of each move
//
// Where bodies have a radius, segments are FCL's capsules, and its solver (GJK) tests them against triangles.
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "common/peers/fcl_walls.h"
#include "common/peers/wall_triangle.h"
#include "kept_boxes.h"

namespace cellwalk::real_scenes {
namespace {

using experiments::Wall_triangle;

struct Fcl {
  explicit Fcl(const Wall_mesh& mesh) : model(experiments::fcl_model<fcl::AABBd>(mesh)) {
    candidates.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      candidates.emplace_back(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
  }

  struct Candidate {
    Candidate(const Point<3>& a, const Point<3>& b, const Point<3>& c)
        : triangle(a, b, c), box(experiments::box_of(a, b, c)) {}
    Wall_triangle<double> triangle;
    Float_box box;
  };
  using Place = experiments::Vector_of<double>;

  void query(const Box& box, std::vector<Candidate>& list) {
    const fcl::AABBd asked(experiments::fcl_point(box.low), experiments::fcl_point(box.high));
    experiments::visit_triangles(*model, asked, stack, [&](int i) {
      list.push_back(candidates[static_cast<std::size_t>(i)]);
      return false;
    });
  }
  Place place(const Point<3>& p) const { return experiments::rounded<double>(p); }
  bool is_behind(const Candidate& c, const Place& p) const { return c.triangle.side(p) > 0; }
  bool is_on_line(const Candidate& c, const Place& a, const Place& b) const {
    const auto& t = c.triangle.corners;
    return fcl::detail::Intersectd::intersect_Triangle(point(a), point(b), point(b), point(t[0]), point(t[1]),
                                                       point(t[2]));
  }
  static fcl::Vector3d point(const Place& p) { return {p.x, p.y, p.z}; }

  std::shared_ptr<experiments::Fcl_boxes> model;
  std::vector<Candidate> candidates;
  std::vector<int> stack;
};

/// Planes exclude most triangles.
struct Fcl_capsules {
  Fcl_capsules(const Wall_mesh& mesh, double r) : radius(r), model(experiments::fcl_model<fcl::AABBd>(mesh)) {
    candidates.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      candidates.emplace_back(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
  }

  struct Candidate {
    Candidate(const Point<3>& a, const Point<3>& b, const Point<3>& c)
        : corners{experiments::fcl_point(a), experiments::fcl_point(b), experiments::fcl_point(c)},
          normal((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized()),
          box(experiments::box_of(a, b, c)) {}
    std::array<fcl::Vector3d, 3> corners;
    fcl::Vector3d normal;
    Float_box box;
  };
  using Place = fcl::Vector3d;

  void query(const Box& box, std::vector<Candidate>& list) {
    const fcl::AABBd asked(experiments::fcl_point(box.low), experiments::fcl_point(box.high));
    experiments::visit_triangles(*model, asked, stack, [&](int i) {
      list.push_back(candidates[static_cast<std::size_t>(i)]);
      return false;
    });
  }
  Place place(const Point<3>& p) const { return experiments::fcl_point(p); }
  bool is_near(const Candidate& c, const Place& a, const Place& b) {
    const double at_a = c.normal.dot(a - c.corners[0]), at_b = c.normal.dot(b - c.corners[0]);
    if (std::min(at_a, at_b) > radius || std::max(at_a, at_b) < -radius) return false;
    if (a != last_a || b != last_b) {
      // A capsule of FCL lies along the z axis, around the origin.
      last_a = a, last_b = b;
      capsule.lz = (b - a).norm();
      place_of_capsule.translation() = (a + b) / 2;
      place_of_capsule.linear() =
          Eigen::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), b - a).toRotationMatrix();
    }
    return solver.shapeTriangleIntersect(capsule, place_of_capsule, c.corners[0], c.corners[1], c.corners[2]);
  }

  double radius;
  std::shared_ptr<experiments::Fcl_boxes> model;
  std::vector<Candidate> candidates;
  std::vector<int> stack;
  fcl::Capsuled capsule{radius, 0};
  fcl::Transform3d place_of_capsule = fcl::Transform3d::Identity();  ///< of the last segment
  fcl::Vector3d last_a = fcl::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), last_b = last_a;
  fcl::detail::GJKSolver_libccdd solver;
};

}  // namespace

void add_fcl_peers(const Scene_walls& walls, const Motion& motion, Peers& peers) {
  Build build;
  if (motion.radius > 0) {
    const auto capsules = experiments::measured_build(
        build, "wall", [&] { return std::make_shared<Fcl_capsules>(*walls.mesh, motion.radius); });
    return add_kept_boxes("fcl", false, motion, capsules, build, peers);
  }
  const auto fcl =
      experiments::measured_build(build, "wall", [&] { return std::make_shared<Fcl>(*walls.mesh); });
  add_kept_boxes("fcl", false, motion, fcl, build, peers);
}

}  // namespace cellwalk::real_scenes
