// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies with a radius that move about in the worlds of the walk, where all walls are measured in rational
// arithmetic after each step.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <vector>

#include "edge/thick_motions.h"
#include "edge/thick_oracle.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Judged {
  int steps = 0, moved = 0, contacts = 0, bodies = 0, at_radius = 0, by_faces = 0, in_region = 0;
};

/// The body is a polyline of two edges, or (3D) a triangle.
enum class Shape { line, triangle };

template <int D>
class Thick_walker {
 public:
  Thick_walker(std::uint64_t seed, Shape shape, Judged& judged)
      : judged_(judged),
        seed_(seed),
        shape_(shape),
        world_(thick_world<D>(seed)),
        snapshot_(Snapshot<D>::compile(world_.soup, glue(world_.soup))),
        locator_(snapshot_),
        oracle_(snapshot_),
        random_(seed) {}

  void run() {
    if (oracle_.walls().empty()) return;
    Thick_motions<D> motions(world_, oracle_, seed_, shape_ == Shape::triangle);
    for (int tries = 0; tries < 4 && !::testing::Test::HasFatalFailure(); ++tries) {
      const Thick_motion<D> m = motions.next();
      std::optional<Body<D>> body = body_at(m);
      if (body) move_about(*body, m.target - m.p);
    }
  }

 private:
  /// Its edges have radii that are possible at first.
  std::optional<Body<D>> body_at(const Thick_motion<D>& m) {
    Body_soup<D> soup;
    soup.points = before(m);
    soup.edges = {{0, 1}, {0, 2}, {1, 2}};
    if (shape_ == Shape::line) {
      soup.points.push_back(m.p);
      soup.edges = {{0, 1}, {1, 2}};
    } else {
      soup.faces = {{0, 1, 2}};
    }
    const double most = root_rounded_down(oracle_.square_to_walls(soup.points));
    if (!(most > 0)) return {};
    const auto radius = [&] { return random_.chance(0.3) ? most : most * random_.real(); };
    if (random_.chance(0.3))
      soup.radii = {radius()};
    else
      for (std::size_t e = 0; e < soup.edges.size(); ++e)
        soup.radii.push_back(e != 0 && random_.chance(0.2) ? 0 : radius());
    std::optional<Body<D>> body;
    try {
      body.emplace(snapshot_, locator_, soup);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::outside);  // on a wall, without a radius
    }
    return body;
  }

  void move_about(Body<D>& body, const Vector<D>& way) {
    ++judged_.bodies;
    Body_options options;
    options.rule = random_.chance(0.3)   ? Step_rule::reject
                   : random_.chance(0.3) ? Step_rule::reject_at_target
                                         : Step_rule::slide;
    options.reports_blocked = true;
    const bool may_sweep_faces = shape_ == Shape::triangle && options.rule != Step_rule::reject_at_target;
    options.sweep.sweep = may_sweep_faces && random_.chance(0.8) ? Sweep::faces
                          : random_.chance(0.2)                  ? Sweep::three_segments
                                                                 : Sweep::triangle;
    Body_counts counts, uncounted;
    // Without regions free of walls, all goes the same way, but for sides of walls that thin edges touch.
    Body<D> twin = body;
    bool has_thin = false;
    for (std::size_t e = 0; e < body.edges().size(); ++e) has_thin |= body.radius(e) == 0;
    Body_options untrusting = options;
    untrusting.clearance = false;
    const int least_halvings = random_.chance(0.5) ? 0 : 4;
    for (int step = 0; step < 6 && !::testing::Test::HasFatalFailure(); ++step) {
      const std::vector<Point<D>> before(body.positions().begin(), body.positions().end());
      std::vector<Point<D>> targets = before;
      for (Point<D>& x : targets)
        if (random_.chance(0.7))
          x = x + std::ldexp(1, -least_halvings - static_cast<int>(random_.below(3))) * way;
      Step_report<D> report;
      body.step(targets, options, report, counts);
      ++judged_.steps;
      judged_.contacts += static_cast<int>(report.contacts.size() + report.blocked.size());
      for (const Contact<D>& contact : report.contacts)
        judged_.by_faces += contact.body == Body_feature::face;
      // Moves in a region leave cells stale, which the next step may find so, or not.
      if (random_.chance(0.5)) body.refresh(uncounted);
      Body<D> refreshed = body;
      refreshed.refresh(uncounted);
      judge_places(refreshed, options.sweep.sweep == Sweep::faces);
      ASSERT_NO_THROW(refreshed.validate());
      Step_report<D> of_twin;
      twin.step(targets, untrusting, of_twin, uncounted);
      if (!has_thin) {
        ASSERT_TRUE(std::ranges::equal(body.positions(), twin.positions())) << "world " << seed_;
        ASSERT_EQ(report.contacts.size(), of_twin.contacts.size());
      }
      for (std::size_t v = 0; v < before.size(); ++v) judged_.moved += body.positions()[v] != before[v];
      if (options.rule != Step_rule::slide) judge_moves(body, before, targets, options, report);
    }
    judged_.in_region += static_cast<int>(counts.in_region);
    for (std::size_t e = 0; e < body.edges().size(); ++e)
      judged_.at_radius += body.radius(e) > 0 && root_rounded_down(oracle_.square_to_walls(edge(body, e))) <
                                                     body.radius(e) * (1 + 1e-9);
  }

  static std::vector<Point<D>> edge(const Body<D>& body, std::size_t e) {
    const auto [u, v] = body.edges()[e];
    return {body.positions()[u], body.positions()[v]};
  }

  bool is_free(const std::vector<Point<D>>& hull, double r) const {
    return r == 0 || root_is_at_least(oracle_.square_to_walls(hull), r);
  }

  /// All parts keep their distance, and bounds of it are true.
  void judge_places(const Body<D>& body, bool sweeps_faces) {
    for (std::size_t e = 0; e < body.edges().size(); ++e) {
      const std::vector<Point<D>> ends = edge(body, e);
      const auto square = oracle_.square_to_walls(ends);
      ASSERT_TRUE(root_is_at_least(square, body.radius(e))) << "edge " << e << " world " << seed_;
      const double up_to = 2 * body.radius(e) + length(ends[1] - ends[0]);
      const double bound = body.clearances(up_to)[e];
      ASSERT_TRUE(root_is_at_least(square, bound)) << "edge " << e;
      double size = 0;
      for (const auto& wall : oracle_.walls())
        size = std::max(size, length(wall.high - ends[0]) + length(wall.low - ends[0]));
      ASSERT_GE(bound, std::min(up_to, root_rounded_down(square)) - 0x1p-40 * size)
          << "edge " << e << " world " << seed_;
    }
    if (!sweeps_faces) return;
    const std::vector<Point<D>> face(body.positions().begin(), body.positions().end());
    ASSERT_TRUE(is_free(face, radius_of_face(body))) << "world " << seed_;
  }

  static double radius_of_face(const Body<D>& body) {
    return std::min({body.radius(0), body.radius(1), body.radius(2)});
  }

  /// The vertices went straight to their targets, or stayed: each as the definition says, while those before
  /// it were moved already.
  void judge_moves(const Body<D>& body, const std::vector<Point<D>>& before,
                   const std::vector<Point<D>>& targets, const Body_options& options,
                   const Step_report<D>& report) {
    const bool at_target = options.rule == Step_rule::reject_at_target;
    const bool by_segments = options.sweep.sweep == Sweep::three_segments;
    std::vector<Point<D>> now = before;
    for (std::uint32_t v = 0; v < before.size(); ++v) {
      const bool stays = body.positions()[v] == before[v];
      ASSERT_TRUE(stays || body.positions()[v] == targets[v]);
      if (targets[v] == before[v]) continue;
      bool has_thin = false, is_way_free = true, is_swept_free = true;
      std::uint64_t ends = 0, sweeps = 0, thin = 0;
      const auto neighbours = body.neighbours(v);
      for (std::size_t i = 0; i < neighbours.size(); ++i) {
        const double r = body.radius(edge_between(body, v, neighbours[i]));
        const Point<D>& q = now[neighbours[i]];
        has_thin |= r == 0;
        thin |= std::uint64_t{r == 0} << i;
        is_way_free &= is_free({before[v], targets[v]}, r);
        ends |= std::uint64_t{!is_free({targets[v], q}, r)} << i;
        const bool is_triangle_free = is_free({before[v], targets[v], q}, r);
        sweeps |= std::uint64_t{!is_triangle_free} << i;
        is_swept_free &= is_triangle_free;
      }
      if (options.sweep.sweep == Sweep::faces) {
        const double r = radius_of_face(body);
        has_thin |= r == 0;
        std::vector<Point<D>> tetrahedron = now;
        tetrahedron.push_back(targets[v]);
        is_swept_free &= is_free(tetrahedron, r);
      }
      const bool is_allowed = at_target || by_segments ? is_way_free && ends == 0 : is_swept_free;
      if (!stays) {
        EXPECT_TRUE(is_allowed) << "world " << seed_ << " vertex " << v;
      } else if (!has_thin) {
        EXPECT_FALSE(is_allowed) << "world " << seed_ << " vertex " << v;
      }
      if (at_target) {
        const auto found = std::ranges::find(report.blocked, v, &Rejected_move<D>::vertex);
        const Rejected_move<D> said = found == report.blocked.end() ? Rejected_move<D>{} : *found;
        if (!is_way_free || (thin == 0 && said.is_vertex_blocked)) {
          EXPECT_EQ(said.is_vertex_blocked, !is_way_free) << "world " << seed_;
          if (!is_way_free) {
            EXPECT_EQ(said.contact->body, Body_feature::vertex);
          }
        } else if (!said.is_vertex_blocked) {
          EXPECT_EQ(said.edges & ~thin, ends) << "world " << seed_;
          EXPECT_EQ(said.swept_edges & ~thin, by_segments ? 0 : sweeps) << "world " << seed_;
        }
      }
      now[v] = body.positions()[v];
    }
  }

  static std::size_t edge_between(const Body<D>& body, std::uint32_t u, std::uint32_t v) {
    std::size_t e = 0;
    while (body.edges()[e] != std::array{std::min(u, v), std::max(u, v)}) ++e;
    return e;
  }

  Judged& judged_;
  std::uint64_t seed_;
  Shape shape_;
  const oracle::World<D> world_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const Thick_oracle<D> oracle_;
  Random random_;
};

template <int D>
void test_random(Shape shape) {
  Judged judged;
  const int worlds = static_cast<int>(oracle::scaled_count(120));
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(worlds); ++seed) {
    Thick_walker<D>(seed, shape, judged).run();
    if (::testing::Test::HasFatalFailure()) return;
  }
  std::cout << judged.bodies << " bodies, " << judged.steps << " steps, " << judged.moved << " moves, "
            << judged.contacts << " contacts, of faces " << judged.by_faces << ", at their radius "
            << judged.at_radius << ", moved in regions " << judged.in_region << '\n';
  if (oracle::is_shortened()) return;
  EXPECT_GT(judged.bodies, 2 * worlds);
  EXPECT_GT(judged.moved, 10 * worlds);
  EXPECT_GT(judged.contacts, 5 * worlds);
  EXPECT_GT(judged.at_radius, worlds / 2);
  EXPECT_GT(judged.in_region, worlds / 10);
  EXPECT_GE(judged.by_faces, shape == Shape::triangle ? 1 : 0);
}

TEST(ThickBodies, KeepTheirDistance2) { test_random<2>(Shape::line); }
TEST(ThickBodies, KeepTheirDistance3) { test_random<3>(Shape::line); }
TEST(ThickBodies, KeepTheDistanceOfFaces) { test_random<3>(Shape::triangle); }

}  // namespace
}  // namespace cellwalk::test
