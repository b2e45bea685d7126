// SPDX-License-Identifier: LGPL-3.0-or-later
// CGAL's AABB_tree over the wall triangles, with a kernel of exact predicates: do_intersect is exact.
//
//   cgal_segment    do_intersect of the tree for each segment
//   cgal_triangle   do_intersect of the tree for each triangle (from, target, q): bits 4 to 6, moved as
//                   recorded
//   cgal_kept_box   the triangles of the enlarged box are kept until the body leaves it; their boxes are
//                   compared first with that of the body, then exactly with that of the segment
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "candidates.h"
#include "families.h"
#include "measured_build.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;
using Triangles = std::vector<Triangle_3>;
#if CGAL_VERSION_MAJOR >= 6
using Triangle_traits =
    CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
using Triangle_traits =
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif
using Tree = CGAL::AABB_tree<Triangle_traits>;

Point_3 cgal_point(const Point<3>& p) { return {p[0], p[1], p[2]}; }

struct Cgal {
  explicit Cgal(const Wall_mesh& walls) {
    triangles.reserve(walls.triangles.size());
    for (std::size_t i = 0; i < walls.triangles.size(); ++i)
      triangles.emplace_back(cgal_point(walls.corner(i, 0)), cgal_point(walls.corner(i, 1)),
                             cgal_point(walls.corner(i, 2)));
    tree.insert(triangles.cbegin(), triangles.cend());
    tree.build();
  }
  Triangles triangles;
  Tree tree;
};

class Segment_query : public Stateless {
 public:
  explicit Segment_query(std::shared_ptr<Cgal> cgal) : cgal_(std::move(cgal)) {}

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      counter.queries();
      return cgal_->tree.do_intersect(Segment_3(cgal_point(a), cgal_point(b)));
    });
  }

 private:
  std::shared_ptr<Cgal> cgal_;
};

class Triangle_query : public Stateless {
 public:
  static constexpr unsigned bits = triangle_bits;
  explicit Triangle_query(std::shared_ptr<Cgal> cgal) : cgal_(std::move(cgal)) {}

  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    unsigned answer = 0;
    for (std::size_t k = 0; k < trace_edges; ++k) {
      counter.queries();
      const Triangle_3 tau(cgal_point(positions[v]), cgal_point(target),
                           cgal_point(positions[trace_neighbour(v, k)]));
      answer |= static_cast<unsigned>(cgal_->tree.do_intersect(tau)) << (4 + k);
    }
    return answer;
  }

 private:
  std::shared_ptr<Cgal> cgal_;
};

struct Candidate {
  Triangle_3 triangle;
  Box box;
};

/// Steers a traversal of the tree: appends the triangles whose boxes meet a box.
struct Near_box {
  CGAL::Bbox_3 box;
  std::vector<Candidate>* list;

  bool go_further() const { return true; }
  bool do_intersect(int, const CGAL::AABB_node<Tree::AABB_traits>& node) const {
    return CGAL::do_overlap(box, node.bbox());
  }
  void intersection(int, const Tree::Primitive& primitive) const {
    const Triangle_3& triangle = primitive.datum();
    const CGAL::Bbox_3 b = triangle.bbox();
    if (CGAL::do_overlap(box, b))
      list->push_back({triangle, {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}}});
  }
};

class Kept_box {
 public:
  static constexpr unsigned bits = segment_bits;
  explicit Kept_box(std::shared_ptr<Cgal> cgal) : cgal_(std::move(cgal)), kept_(kept_margin) {}

  void prepare(const Trace& trace) { kept_.reset(trace.bodies); }
  template <class Counter>
  bool start(std::size_t body, const Point<3>* positions, const Point<3>* targets, Counter& counter) {
    const auto query = [this](const Box& b, std::vector<Candidate>& list) {
      // Boxes against boxes is all that candidates need; an exact test of each triangle and the box would
      // cost more than it saves.
      Near_box near{CGAL::Bbox_3(b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]), &list};
      cgal_->tree.traversal(0, near);
    };
    near_ = kept_.find(body, positions, targets, query, counter);
    return near_.empty();
  }
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      const Box box = box_of(a, b);
      for (const Candidate* c : near_) {
        if (!meet(box, c->box)) continue;
        counter.triangle_tests();
        if (CGAL::do_intersect(c->triangle, Segment_3(cgal_point(a), cgal_point(b)))) return true;
      }
      return false;
    });
  }

 private:
  std::shared_ptr<Cgal> cgal_;
  Kept_candidates<Candidate> kept_;
  std::span<const Candidate* const> near_;
};

}  // namespace

void add_cgal_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const auto cgal = measured_build(build, "wall", [&] { return std::make_shared<Cgal>(world.walls); });
  add_peer(peers, "cgal_segment", Segment_query(cgal), build);
  add_peer(peers, "cgal_triangle", Triangle_query(cgal), build);
  add_peer(peers, "cgal_kept_box", Kept_box(cgal), build);
}

}  // namespace cellwalk::figure_8
