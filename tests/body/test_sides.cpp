// SPDX-License-Identifier: LGPL-3.0-or-later
// A vertex that may pass a wall on either side takes the one on which its edges pass. Stars of edges move in
// lattices with membranes, in planes of walls and past their rims, judged by all combinations of sides.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "edge/membrane_lattice.h"
#include "edge/sides_oracle.h"
#include "edge/sweep_judge.h"
#include "oracle/seed.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Sides_seen {
  int bodies = 0, moves = 0, free = 0, blocked = 0;
  int several_ways = 0;  ///< of the vertex
  int some_free = 0;     ///< of them free, and others not
  int rescued = 0;       ///< free, but not on the sides that the vertex prefers
  int later = 0;         ///< blocked, but later than there
};

template <int D>
class Sides_trial {
 public:
  Sides_trial(std::uint64_t seed, Sides_seen& seen)
      : seen_(seen),
        random_(seed),
        soup_(Membrane_lattice<D>::soup(random_)),
        snapshot_(Snapshot<D>::compile(soup_, glue(soup_))),
        locator_(snapshot_),
        oracle_(soup_),
        chains_(soup_) {}

  void try_body() {
    Body_soup<D> star;
    const std::uint32_t edges = 1 + static_cast<std::uint32_t>(random_.below(D == 2 ? 3 : 4));
    star.points.push_back(Membrane_lattice<D>::point(random_));
    for (std::uint32_t e = 1; e <= edges; ++e) {
      star.points.push_back(end_near(star.points[0]));
      star.edges.push_back({0, e});
    }
    std::optional<Body<D>> body;
    try {
      body.emplace(snapshot_, locator_, star);
    } catch (const Error&) {
      return;  // walls are in its way
    }
    ++seen_.bodies;
    for (int n = 0; n < 8; ++n) {
      const auto v = static_cast<std::uint32_t>(random_.chance(0.6) ? 0 : random_.below(edges + 1));
      move(*body, v, end_near(body->positions()[v]));
    }
  }

 private:
  Point<D> end_near(const Point<D>& from) { return Membrane_lattice<D>::near(from, random_); }

  std::vector<oracle::Edge_at<D>> edges_at(const Body<D>& body, std::uint32_t v) const {
    std::vector<oracle::Edge_at<D>> edges;
    for (std::size_t e = 0; e < body.edges().size(); ++e) {
      const auto [u, w] = body.edges()[e];
      if (u != v && w != v) continue;
      const Particle<D>& q = body.particles()[u == v ? w : u];
      const Chain chain = u == v ? body.chain(e) : reversed(snapshot_, body.chain(e));
      edges.push_back({q.position, snapshot_.index(q.cell), soup_chain(soup_, snapshot_, chain)});
    }
    return edges;
  }

  /// The contact on the sides that the vertex prefers when it walks alone.
  std::optional<Contact<D>> on_preferred_sides(const Body<D>& body, std::uint32_t v, const Point<D>& target) {
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    detail::Sides_taken none;
    Edge_counts counts;
    Particle<D> moved = body.particles()[v];
    const auto walked =
        detail::move_on_sides(snapshot_, moved, target, counts.walk, {&visited, &crossed}, &none);
    moved.position = target;
    const Vertex_path<D> path{body.particles()[v], moved, visited, crossed, walked.contact.has_value()};
    std::optional<Contact<D>> first;
    if (walked.contact)
      first = vertex_contact(snapshot_, path.from.position, target, *walked.contact, counts.walk);
    for (std::size_t e = 0; e < body.edges().size(); ++e) {
      const auto [u, w] = body.edges()[e];
      if (u != v && w != v) continue;
      const Particle<D>& q = body.particles()[u == v ? w : u];
      const Chain chain = u == v ? body.chain(e) : reversed(snapshot_, body.chain(e));
      const auto contact = sweep_edge_along(snapshot_, path, q, chain, {}, counts).contact;
      if (contact && (!first || contact->exact_time() < first->exact_time())) first = contact;
    }
    return first;
  }

  void move(Body<D>& body, std::uint32_t v, const Point<D>& target) {
    const Particle<D> from = body.particles()[v];
    if (from.position == target) return;
    const oracle::Sides_truth truth = oracle::judge_sides<D>(oracle_, chains_, from.position, target,
                                                             snapshot_.index(from.cell), edges_at(body, v));
    const auto preferred = on_preferred_sides(body, v, target);
    std::ostringstream text;
    text << "vertex " << v << " from";
    for (const double x : from.position) text << ' ' << x;
    text << " to";
    for (const double x : target) text << ' ' << x;
    text << ", ways " << truth.ways << " of which free " << truth.free_ways;
    const auto contact = body.move_vertex(v, target, {}, counts_);
    ASSERT_EQ(!contact, truth.is_free()) << text.str();
    if (contact) {
      ASSERT_TRUE(truth.is_time(contact->time)) << text.str();
    }
    ASSERT_NO_THROW(body.validate()) << text.str();
    ++seen_.moves;
    seen_.free += !contact;
    seen_.blocked += contact.has_value();
    seen_.several_ways += truth.ways > 1;
    seen_.some_free += truth.is_free() && truth.free_ways < truth.ways;
    seen_.rescued += !contact && preferred;
    seen_.later += contact && preferred && preferred->exact_time() < contact->exact_time();
  }

  Sides_seen& seen_;
  Random random_;
  const Cell_soup<D> soup_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const oracle::Oracle<D> oracle_;
  const oracle::Chain_oracle<D> chains_;
  Body_counts counts_;
};

template <int D>
void test_stars() {
  Sides_seen seen;
  const std::size_t worlds = oracle::scaled_count(D == 2 ? 100 : 60);
  for (std::uint64_t i = 0; i < worlds; ++i) {
    SCOPED_TRACE("world " + std::to_string(i));
    Sides_trial<D> trial(oracle::reseeded(i), seen);
    for (int n = 0; n < 12; ++n) {
      trial.try_body();
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  std::cout << D << "D: bodies " << seen.bodies << ", moves " << seen.moves << ", free " << seen.free
            << ", blocked " << seen.blocked << ", several ways " << seen.several_ways << ", some free "
            << seen.some_free << "; free on other sides than the preferred " << seen.rescued
            << ", blocked later there " << seen.later << "\n";
  if (worlds < (D == 2 ? 100 : 60)) return;  // too few to meet everything
  EXPECT_GT(seen.blocked, 500);
  EXPECT_GT(seen.several_ways, 60);
  EXPECT_GT(seen.rescued, 10);
  if (D == 2) {
    EXPECT_GT(seen.later, 2);
  }
}

/// The symmetries of the cube [0,4]^3: axes in any order, each forwards or backwards.
struct Symmetry {
  std::array<std::size_t, 3> axis;
  std::array<bool, 3> is_reversed;

  Point<3> operator()(const Point<3>& x) const {
    Point<3> y;
    for (std::size_t k = 0; k < 3; ++k) y[k] = is_reversed[k] ? 4 - x[axis[k]] : x[axis[k]];
    return y;
  }
};

std::vector<Symmetry> symmetries() {
  std::vector<Symmetry> all;
  std::array<std::size_t, 3> axis{0, 1, 2};
  do
    for (int r = 0; r < 8; ++r) all.push_back({axis, {(r & 1) != 0, (r & 2) != 0, (r & 4) != 0}});
  while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

/// A shelf in the plane z = 2 from x = 2 on, over a part of y, in a symmetric picture.
Environment<3> shelf(const Symmetry& in_picture, double low_y, double high_y) {
  auto environment = Environment<3>::build(hex_grid({.cells = {4, 4, 4}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  std::set<std::vector<Point<3>>> walls;
  for (int x = 2; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      if (y < low_y || y + 1 > high_y) continue;
      std::vector<Point<3>> corners;
      for (int k = 0; k < 4; ++k) corners.push_back(in_picture({x + (k & 1) * 1.0, y + (k >> 1) * 1.0, 2}));
      std::ranges::sort(corners);
      walls.insert(corners);
    }
  for (std::size_t c = 0; c < snapshot.cell_slots(); ++c)
    for (std::size_t i = 0; i < 6; ++i) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(c), i);
      std::vector<Point<3>> corners;
      for (const std::uint32_t v : snapshot.loop(f)) corners.push_back(snapshot.point(v));
      std::ranges::sort(corners);
      if (walls.contains(corners)) environment.set_impassable(f, true);
    }
  return environment;
}

/// Slides a box along the plane of the shelf, its top or its bottom in that plane. The number of contacts.
std::size_t slide_along_shelf(const Symmetry& in_picture, bool is_below, double low_y, double high_y,
                              const Body_options& options) {
  const Environment<3> environment = shelf(in_picture, low_y, high_y);
  Body_parts<3> box;
  for (int k = 0; k < 8; ++k)
    box.points.push_back(in_picture(
        {0.5 + 0.5 * (k & 1), 0.75 + 2.5 * (k >> 1 & 1), (is_below ? 1.5 : 2) + 0.5 * (k >> 2 & 1)}));
  box.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()), make_body(box).body);
  const Vector<3> step = in_picture({0.1875, 0, 0}) - in_picture({0, 0, 0});
  Step_report<3> report;
  Body_counts counts;
  for (int n = 0; n < 14; ++n) {
    std::vector<Point<3>> targets;
    for (const Point<3>& x : body.positions()) targets.push_back(x + step);
    body.step(targets, options, report, counts);
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
  }
  return report.contacts.size();
}

TEST(Sides, ABoxSlidesUnderAShelfAndOverIt) {
  constexpr std::array sweeps{Sweep::triangle, Sweep::faces, Sweep::three_segments};
  std::size_t slid = 0;
  for (const Symmetry& in_picture : symmetries())
    for (const bool is_below : {true, false}) {
      Body_options options;
      options.sweep.sweep = sweeps[slid++ % 3];
      SCOPED_TRACE(testing::Message()
                   << (is_below ? "below" : "above") << ", sweep " << static_cast<int>(options.sweep.sweep)
                   << ", axes " << testing::PrintToString(in_picture.axis) << ", reversed "
                   << testing::PrintToString(in_picture.is_reversed));
      ASSERT_EQ(slide_along_shelf(in_picture, is_below, 0, 4, options), 0u);
      options.rule = Step_rule::reject_at_target;
      ASSERT_EQ(slide_along_shelf(in_picture, is_below, 0, 4, options), 0u) << "at the target";
    }
  EXPECT_EQ(slid, 48u * 2);
}

/// The shelf is narrower than the box: its rim passes edges in their middle, beside all vertices.
TEST(Sides, EdgesPassANarrowShelfOnTheSideOfTheirFaces) {
  constexpr std::array<std::array<double, 2>, 3> shelves{{{1, 2}, {0, 2}, {2, 3}}};
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  std::size_t slid = 0;
  for (const Symmetry& in_picture : symmetries())
    for (const bool is_below : {true, false}) {
      const auto [low, high] = shelves[slid++ % 3];
      ASSERT_EQ(slide_along_shelf(in_picture, is_below, low, high, options), 0u)
          << (is_below ? "below" : "above") << ", y from " << low << ", axes "
          << testing::PrintToString(in_picture.axis) << ", reversed "
          << testing::PrintToString(in_picture.is_reversed);
    }
  EXPECT_EQ(slid, 48u * 2);
}

TEST(Sides, VerticesTakeThoseOnWhichTheirEdgesPass2) { test_stars<2>(); }
TEST(Sides, VerticesTakeThoseOnWhichTheirEdgesPass3) { test_stars<3>(); }

}  // namespace
}  // namespace cellwalk::test
