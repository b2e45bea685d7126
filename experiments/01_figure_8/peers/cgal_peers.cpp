// SPDX-License-Identifier: LGPL-3.0-or-later
// CGAL's AABB_tree over the wall triangles, with a kernel of exact predicates: do_intersect is exact.
//
//   cgal_segment    do_intersect of the tree for each segment
//   cgal_triangle   do_intersect of the tree for each triangle (from, target, q): bits 4 to 6, moved as
//                   recorded
//   cgal_kept_box   the triangles of the enlarged box are kept until the body leaves it; their boxes are
//                   compared first with that of the body, then exactly with that of the segment
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "candidates.h"
#include "common/peers/cgal_walls.h"
#include "families.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

using Cgal = experiments::cgal::Walls;
using experiments::cgal::cgal_point;
using experiments::cgal::Segment_3;
using experiments::cgal::Triangle_3;

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

class Kept_box {
 public:
  static constexpr unsigned bits = segment_bits;
  explicit Kept_box(std::shared_ptr<Cgal> cgal) : cgal_(std::move(cgal)), kept_(kept_steps) {}

  void prepare(const Trace& trace) { kept_.reset(trace); }
  template <class Counter>
  bool start(std::size_t body, const Point<3>* positions, const Point<3>* targets, Counter& counter) {
    const auto query = [this](const Box& b, std::vector<Candidate>& list) { cgal_->query(b, list); };
    near_ = kept_.find(body, positions, targets, query, counter);
    return near_.empty();
  }
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      const Box box = box_of(a, b);
      for (const Candidate* c : near_) {
        if (!experiments::meet(box, c->box)) continue;
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
