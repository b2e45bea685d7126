// SPDX-License-Identifier: LGPL-3.0-or-later
// CGAL's AABB_tree over the wall triangles, and exact signs behind a filter.
//
//   cgal_body, cgal_group, cgal_star   boxes are kept for each body, group of 8 vertices, star of a vertex
//   cgal_move                          a traversal of the tree by the box of each move
//   cgal_doubles_body, ..              the same in doubles, where bodies have a radius: then all measure
//                                      distances
//   cgal_tree                          do_intersect of the tree for each segment, without a box: judges the
//                                      recorded answers independently of the library, but takes touches for
//                                      hits
#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/peers/cgal_walls.h"
#include "kept_boxes.h"

namespace cellwalk::real_scenes {
namespace {

namespace cgal = experiments::cgal;

/// The plane of a triangle in doubles, with a bound of the error: most points need no sign of CGAL.
class Filtered_plane {
 public:
  explicit Filtered_plane(const cgal::Triangle_3& t) : origin_(t[0]) {
    const cgal::Kernel::Vector_3 u = t[1] - t[0], v = t[2] - t[0];
    normal_ = CGAL::cross_product(u, v);
    double most = 0;
    for (int k = 0; k < 3; ++k) most = std::max({most, std::abs(u[k]), std::abs(v[k])});
    // With m the largest coordinate of the sides, d that of the point from the origin and e = 2^-53, the
    // coordinates of the normal are at most 2 m^2 and wrong by at most 8 e m^2, so each of the three terms of
    // the scalar product is wrong by 12 e m^2 d, and their sum by 12 e m^2 d more: 48 e m^2 d. The rest is
    // for terms of the order of e^2, and numbers that vanish.
    error_ = 64 * 0x1p-53 * most * most + 1e-280;
  }
  /// The side of a point, or zero where it is not certain.
  CGAL::Sign side(const cgal::Point_3& p) const {
    const cgal::Kernel::Vector_3 d = p - origin_;
    const double product = normal_ * d;
    const double bound = error_ * std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    return product > bound ? CGAL::POSITIVE : product < -bound ? CGAL::NEGATIVE : CGAL::ZERO;
  }

 private:
  cgal::Point_3 origin_;
  cgal::Kernel::Vector_3 normal_;
  double error_;
};

struct Cgal {
  explicit Cgal(const Wall_mesh& mesh) : walls(mesh) {}

  struct Candidate {
    Candidate(const cgal::Triangle_3& t, const Box& b) : triangle(t), plane(t), box(b) {}
    cgal::Triangle_3 triangle;
    Filtered_plane plane;
    Float_box box;
  };
  using Place = cgal::Point_3;

  void query(const Box& box, std::vector<Candidate>& list) const { walls.query(box, list); }
  Place place(const Point<3>& p) const { return cgal::cgal_point(p); }
  bool is_behind(const Candidate& c, const Place& p) const {
    const CGAL::Sign certain = c.plane.side(p);
    if (certain != CGAL::ZERO) return certain == CGAL::POSITIVE;
    const cgal::Triangle_3& t = c.triangle;
    return CGAL::orientation(t[0], t[1], t[2], p) == CGAL::POSITIVE;
  }
  bool is_on_line(const Candidate& c, const Place& a, const Place& b) const {
    const cgal::Triangle_3& t = c.triangle;
    bool left = false, right = false;
    for (int k = 0; k < 3 && !(left && right); ++k) {
      const CGAL::Orientation sign = CGAL::orientation(a, b, t[k], t[(k + 1) % 3]);
      left |= sign == CGAL::POSITIVE;
      right |= sign == CGAL::NEGATIVE;
    }
    return !(left && right);
  }

  cgal::Walls walls;
};

/// The distance of segments from triangles: by the library's exact predicate, which tries the direction first
/// that parted them when the triangle was last tested, or in doubles. Planes exclude most triangles.
struct Cgal_distances {
  Cgal_distances(const Wall_mesh& mesh, double r, bool exact) : walls(mesh), radius(r), is_exact(exact) {}

  struct Candidate {
    Candidate(const cgal::Triangle_3& t, const Box& b) : box(b) {
      for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = {t[k][0], t[k][1], t[k][2]};
      normal = unit_normal(corners[0], corners[1], corners[2]);
    }
    std::array<Point<3>, 3> corners;
    Vector<3> normal;
    Float_box box;
    mutable Vector<3> direction{};
  };
  using Place = Point<3>;

  void query(const Box& box, std::vector<Candidate>& list) const { walls.query(box, list); }
  const Point<3>& place(const Point<3>& p) const { return p; }
  bool is_near(const Candidate& c, const Point<3>& a, const Point<3>& b) const {
    const std::array segment{a, b};
    if (is_exact) {
      Distance_counts uncounted;
      return !detail::is_apart<3>(segment, c.corners, radius, c.direction, uncounted);
    }
    const double at_a = dot(c.normal, a - c.corners[0]), at_b = dot(c.normal, b - c.corners[0]);
    if (std::min(at_a, at_b) > radius || std::max(at_a, at_b) < -radius) return false;
    const detail::Nearest<3> nearest = detail::nearest_in_doubles<3>(segment, c.corners);
    const Vector<3> between = nearest.on_b - nearest.on_a;
    return dot(between, between) < radius * radius || (at_a * at_b < 0 && pierces(c, a, b));
  }

  cgal::Walls walls;
  double radius;
  bool is_exact;

 private:
  static bool pierces(const Candidate& c, const Point<3>& a, const Point<3>& b) {
    bool left = false, right = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double volume = dot(cross(c.corners[k] - a, c.corners[(k + 1) % 3] - a), b - a);
      left |= volume > 0;
      right |= volume < 0;
    }
    return !(left && right);
  }
};

class Tree_queries : public Placed_peer {
 public:
  Tree_queries(const Motion& motion, std::shared_ptr<Cgal> cgal)
      : Placed_peer(motion), cgal_(std::move(cgal)) {}

  void prepare() override {}
  void step(std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) override {
    for (std::size_t b = 0; b < motion_.bodies(); ++b) {
      const Lists& neighbours = motion_.joints[b]->neighbours;
      const std::size_t first = motion_.first_vertex[b];
      Point<3>* const x = positions_.data() + first;
      for (std::uint32_t v = 0; v < neighbours.size(); ++v) {
        const Point<3>& to = targets[first + v];
        bool stays = hits(x[v], to);
        for (const std::uint32_t q : neighbours[v]) stays = stays || hits(to, x[q]);
        blocked[first + v] = stays;
        if (!stays) x[v] = to;
      }
    }
  }

 private:
  bool hits(const Point<3>& a, const Point<3>& b) const {
    return cgal_->walls.tree.do_intersect(cgal::Segment_3(cgal::cgal_point(a), cgal::cgal_point(b)));
  }

  std::shared_ptr<Cgal> cgal_;
};

}  // namespace

void add_cgal_peers(const Scene_walls& walls, const Motion& motion, Peers& peers) {
  Build build;
  if (motion.radius > 0) {
    for (const bool is_exact : {true, false}) {
      const auto distances = experiments::measured_build(build, "wall", [&] {
        return std::make_shared<Cgal_distances>(*walls.mesh, motion.radius, is_exact);
      });
      add_kept_boxes(is_exact ? "cgal" : "cgal_doubles", is_exact, motion, distances, build, peers);
    }
    return;
  }
  const auto cgal =
      experiments::measured_build(build, "wall", [&] { return std::make_shared<Cgal>(*walls.mesh); });
  add_kept_boxes("cgal", true, motion, cgal, build, peers);
  auto tree = std::make_unique<Tree_queries>(motion, cgal);
  tree->name = "cgal_tree";
  tree->library = "cgal";
  tree->is_exact = true;
  tree->build = build;
  peers.push_back(std::move(tree));
}

}  // namespace cellwalk::real_scenes
