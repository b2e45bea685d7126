// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle of chains, and with it the complete sweep, where the answer is known by heart; and sweeps broken
// on purpose.
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <cmath>

#include "edge/edge_worlds.h"
#include "edge/sweep_judge.h"
#include "oracle/squares_and_cubes.h"

namespace cellwalk::test {
namespace {

using oracle::make_cubes;
using oracle::make_squares;
using oracle::set_wall;
using oracle::Share;
using Walls = std::vector<std::array<std::uint32_t, 2>>;
using Cells = std::vector<std::uint32_t>;

/// An edge whose end p moves from a to b: where it is, and the cells that its chain passes, from the cell of
/// p to that of q.
template <int D>
struct Case {
  Point<D> a, b, q;
  Cells chain;
};

template <int D>
Cell_soup<D> walled(Cell_soup<D> soup, const Walls& walls) {
  for (const auto& [c, d] : walls) set_wall(soup, c, d);
  return soup;
}

template <int D>
class Scene {
 public:
  Scene(Cell_soup<D> soup, const Walls& walls)
      : oracle(walled(std::move(soup), walls)),
        snapshot(Snapshot<D>::compile(oracle.soup(), glue(oracle.soup()))),
        locator_(snapshot) {}

  /// What becomes of a case.
  struct Judged {
    oracle::Edge_motion<D> motion;
    oracle::Outcomes outcomes;
    Sweep_result<D> result;  ///< of the library, which must be right
  };

  Judged judge(const Case<D>& c) const {
    const Particle<D> from = particle(c.a, c.chain.front()), q = particle(c.q, c.chain.back());
    const Chain before = chain(c.chain);
    Particle<D> to = from;
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    Edge_counts counts;
    const auto walked = move(snapshot, to, c.b, counts.walk, {&visited, &crossed});
    const bool blocked = walked.status != Walk_status::arrived;
    if (blocked) to = particle(c.b, snapshot.index(visited.back()));
    const Vertex_path<D> path{from, to, visited, crossed, blocked};
    Judged judged{motion_of(oracle.soup(), snapshot, path, q, before), {}, {}};
    judged.outcomes = oracle.judge(judged.motion);
    judged.result = sweep_triangle(snapshot, path, q, before, counts);
    const Sweep_fault fault = fault_of(oracle, judged.motion, judged.outcomes, snapshot, judged.result);
    EXPECT_EQ(fault, Sweep_fault::none) << fault_names[static_cast<std::size_t>(fault)];
    return judged;
  }

  /// The chain that passes these cells.
  Chain chain(const Cells& cells) const {
    Chain chain;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      const Cell c = snapshot.cell(cells[i]);
      std::size_t f = 0;
      const auto leads = [&](Half_facet h) {
        return !snapshot.is_impassable(h) && snapshot.neighbour(h) == snapshot.cell(cells[i + 1]);
      };
      while (!leads(Snapshot<D>::half_facet(c, f))) ++f;
      chain.push_back(Snapshot<D>::half_facet(c, f));
    }
    return chain;
  }

  const oracle::Chain_oracle<D> oracle;
  const Snapshot<D> snapshot;

 private:
  Particle<D> particle(const Point<D>& x, std::uint32_t cell) const {
    Particle<D> p = locator_.particle_at(x).value_or(Particle<D>{x});
    p.position = x;
    p.cell = snapshot.cell(cell);
    return p;
  }

  const Locator<D> locator_;
};

template <int D>
void expect_free(const Scene<D>& scene, const Case<D>& c) {
  const auto judged = scene.judge(c);
  EXPECT_TRUE(judged.outcomes.blocks.empty());
  EXPECT_EQ(judged.outcomes.ends.size(), 1u);
  EXPECT_FALSE(judged.result.contact);
}

template <int D>
void expect_blocked(const Scene<D>& scene, const Case<D>& c, const Share& time) {
  const auto judged = scene.judge(c);
  EXPECT_FALSE(judged.outcomes.may_be_free());
  ASSERT_EQ(judged.outcomes.blocks.size(), 1u);
  EXPECT_TRUE(judged.outcomes.blocks[0] == time)
      << judged.outcomes.blocks[0].numerator << "/" << judged.outcomes.blocks[0].denominator;
  EXPECT_TRUE(judged.result.contact);
}

// Squares: 0 and 1 below, 2 and 3 above, 4 and 5 on top.

TEST(ChainOracle, AnEdgeTurnsOverAPassableVertex) {
  const Case<2> turns{{1.75, 1.25}, {1.25, 1.75}, {0.5, 0.5}, {3, 1, 0}};
  expect_free({make_squares(2, 2), {}}, turns);
  // Behind the vertex it would pass a wall; and it may touch it there.
  expect_blocked({make_squares(2, 2), {{0, 2}}}, turns, {1, 2});
  expect_free<2>({make_squares(2, 2), {{0, 2}}}, {{1.75, 1.25}, {1.5, 1.5}, {0.5, 0.5}, {3, 1, 0}});
}

TEST(ChainOracle, WallsMeetAtAnAngle) {
  const Scene<2> corner(make_squares(2, 2), {{0, 1}, {1, 3}});
  expect_blocked(corner, {{1.25, 1.75}, {1.75, 1.25}, {0.5, 0.5}, {3, 2, 0}}, {1, 2});
  expect_free(corner, {{1.25, 1.75}, {1.5, 1.5}, {0.5, 0.5}, {3, 2, 0}});
}

TEST(ChainOracle, AnEdgeInAMembraneIsPulledOff2) {
  const Scene<2> scene(make_squares(2, 2), {{0, 1}});
  const Point<2> rim{1, 1}, q{1, 0.25};
  expect_blocked(scene, {rim, {1.5, 1.25}, q, {0}}, {0, 1});
  expect_free(scene, {rim, {0.5, 1.25}, q, {0}});
  expect_free(scene, {rim, {1.5, 1.25}, q, {1}});
  expect_blocked(scene, {rim, {0.5, 1.25}, q, {1}}, {0, 1});
}

TEST(ChainOracle, AnEndMovesInTheLineOfTheEdge) {
  const Scene<2> scene(make_squares(2, 3), {{0, 1}, {2, 3}});
  const Point<2> q{1, 0.25}, above{1, 2.5};
  // p comes down on the right, where it lies once it is displaced. An edge on the left is blocked as soon as
  // there is a wall.
  const auto expect_right_only = [&](const Cells& chain) {
    const auto expect = [&](const Case<2>& down, const Share& time) {
      chain.back() == 1 ? expect_free(scene, down) : expect_blocked(scene, down, time);
    };
    expect({above, {1, 1.5}, q, chain}, {1, 2});
    expect({above, {1, 0}, q, chain}, {1, 5});
    expect({above, {1, -1.5}, q, chain}, {1, 8});
  };
  for (const std::uint32_t side : {0u, 1u}) {
    expect_free(scene, {{1, 0.5}, above, q, {side}});
    expect_right_only({4 + side, 2 + side, side});
    expect_right_only({4 + side, 5 - side, 3 - side, 1 - side});
  }
  // Along the boundary, and over q.
  expect_free(scene, {{0.5, 0}, {1.75, 0}, {0.25, 0}, {0}});
  expect_free(Scene<2>(make_squares(2, 2), {}), {{1.75, 0}, {0, 0}, {0.25, 0}, {1, 0}});
}

// Cubes: 0 to 3 below as the squares, 4 to 7 above them.

TEST(ChainOracle, AnEdgePassesAMembraneInItsLine) {
  const Case<3> passes{{0.5, 1, 1.5}, {1.5, 1, 1.5}, {1, 1, 0.5}, {4, 0}};
  const Scene<3> two_walls(make_cubes(2, 2, 2), {{0, 1}, {2, 3}});
  const Wall_list<3> list(two_walls.snapshot);
  EXPECT_FALSE(list.is_crossed(passes.a, passes.b, passes.q)) << "no wall crosses by itself";
  expect_blocked(two_walls, passes, {1, 2});
  // Round the rim of one wall there is a way.
  expect_free({make_cubes(2, 2, 2), {{0, 1}}}, passes);
  expect_free({make_cubes(2, 2, 2), {{2, 3}}}, passes);
}

TEST(ChainOracle, WallsMeetInThePlaneOfTheTriangle) {
  const Case<3> between{{0.75, 1.75, 1}, {1.75, 1.5, 1}, {0.5, 0.25, 1}, {2, 0}};
  const Scene<3> two_walls(make_cubes(2, 2, 2), {{0, 1}, {4, 5}});
  EXPECT_FALSE(Wall_list<3>(two_walls.snapshot).is_crossed(between.a, between.b, between.q));
  expect_blocked(two_walls, between, {9, 14});
  expect_free({make_cubes(2, 2, 2), {{0, 1}}}, between);
  // A wall, and at an angle to it a roof that leads into another.
  expect_free({make_cubes(2, 2, 2), {{0, 1}, {1, 5}}}, between);
  expect_blocked({make_cubes(2, 2, 2), {{0, 1}, {4, 5}, {1, 5}}}, between, {9, 14});
}

TEST(ChainOracle, AnEdgeSlidesAlongAWallOfSeveralCells) {
  const Scene<3> scene(make_cubes(3, 2, 2), {{1, 2}, {4, 5}});
  expect_free(scene, {{0.5, 0.25, 0}, {1.75, 1.75, 0}, {0.25, 0.5, 0}, {0}});
  // On both sides of a membrane.
  for (const std::uint32_t side : {1u, 2u}) {
    expect_free(scene, {{2, 0.5, 0.5}, {2, 1.75, 0.25}, {2, 0.25, 0.5}, {side}});
    expect_free(scene, {{2, 1.75, 0.5}, {2, 0.5, 0.25}, {2, 0.25, 0.5}, {side + 3, side}});
    expect_free(scene, {{2, 1.75, 0.5}, {2, 0.5, 1.75}, {2, 0.25, 0.5}, {side + 3, side}});
  }
}

TEST(ChainOracle, AnEdgeTurnsOverAPassableRidge) {
  const Case<3> turns{{1.75, 1.25, 0.5}, {1.25, 1.75, 0.625}, {0.5, 0.5, 0.5}, {3, 1, 0}};
  expect_free({make_cubes(2, 2, 1), {}}, turns);
  expect_blocked({make_cubes(2, 2, 1), {{0, 2}}}, turns, {1, 2});
}

TEST(ChainOracle, AnEdgeInAMembraneIsPulledOff3) {
  const Scene<3> scene(make_cubes(2, 2, 2), {{0, 1}});
  const Point<3> rim{1, 1, 0.75}, q{1, 0.25, 0.25};
  expect_blocked(scene, {rim, {1.5, 1.25, 0.75}, q, {0}}, {0, 1});
  expect_free(scene, {rim, {0.5, 1.25, 0.75}, q, {0}});
}

TEST(ChainOracle, TheSideTakenAtARimIsAChoice) {
  const Scene<3> scene(make_cubes(2, 2, 2), {{0, 1}});
  const Point<3> q{1, 0.5, 1.25}, low{1, 1.5, 0.5};
  const auto judged = scene.judge({{1, 1.5, 1.25}, low, q, {6, 4}});
  EXPECT_EQ(judged.outcomes.ends.size(), 2u);
  EXPECT_EQ(judged.outcomes.choices, 1);
  EXPECT_TRUE(judged.outcomes.lies_in_wall);
  // It is kept.
  expect_free(scene, {low, {0.75, 1.5, 0.5}, q, {2, 0, 4}});
  expect_blocked(scene, {low, {1.25, 1.5, 0.5}, q, {2, 0, 4}}, {0, 1});
  expect_blocked(scene, {low, {0.75, 1.5, 0.5}, q, {3, 1, 5}}, {0, 1});
  expect_free(scene, {low, {1.25, 1.5, 0.5}, q, {3, 1, 5}});
}

/// Two boxes, 0 below y = 1 and 1 above it, that share two squares: a wall for z < 1 and a window for z > 1.
Cell_soup<3> wall_and_window() {
  Cell_soup<3> soup;
  for (int i = 0; i < 18; ++i) soup.points.push_back({double(i % 2), double(i / 2 % 3), double(i / 6)});
  const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return x + 2 * (y + 3 * z); };
  const auto add = [&](std::vector<std::uint32_t> loop, bool turned, bool wall = false) {
    if (turned) std::reverse(loop.begin(), loop.end());
    soup.add_facet(loop, wall);
  };
  for (const std::uint32_t cell : {0u, 1u}) {
    const bool turned = cell == 1;  // the second one mirrors the first
    const std::uint32_t y = 2 * cell;
    add({at(0, y, 0), at(1, y, 0), at(1, y, 2), at(0, y, 2)}, turned);
    add({at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)}, turned, true);
    add({at(0, 1, 1), at(0, 1, 2), at(1, 1, 2), at(1, 1, 1)}, turned);
    add({at(0, y, 0), at(0, y, 2), at(0, 1, 2), at(0, 1, 1), at(0, 1, 0)}, turned);
    add({at(1, y, 0), at(1, 1, 0), at(1, 1, 1), at(1, 1, 2), at(1, y, 2)}, turned);
    add({at(0, y, 0), at(0, 1, 0), at(1, 1, 0), at(1, y, 0)}, turned);
    add({at(0, y, 2), at(1, y, 2), at(1, 1, 2), at(0, 1, 2)}, turned);
    soup.end_cell();
  }
  return soup;
}

TEST(ChainOracle, AnEdgeLiesInAWallAndAWindowOfOneCell) {
  const Scene<3> scene(wall_and_window(), {});
  const Point<3> q{0.5, 1, 0.25}, in_window{0.25, 1, 1.25}, in_wall{0.25, 1, 0.5};
  for (const std::uint32_t side : {0u, 1u})
    // On which side of the window p is makes no difference. On the wall it is above, where it lies once it is
    // displaced.
    for (const Cells& chain : {Cells{side}, Cells{1 - side, side}}) {
      expect_free(scene, {in_window, {0.75, 1, 1.5}, q, chain});
      if (side == 1)
        expect_free(scene, {in_window, in_wall, q, chain});
      else
        expect_blocked(scene, {in_window, in_wall, q, chain}, {1, 3});
    }
}

TEST(ChainOracle, AnEdgeWeavesThroughASheetOfWindows) {
  // At every second place a wall, of which the edge lies on one side or the other: the sweep must not try
  // them all.
  constexpr std::uint32_t length = 33;
  Walls walls;
  Cells chain;
  for (std::uint32_t x = 0; x < length; ++x) {
    if (x % 2 == 0) walls.push_back({x, x + length});
    const std::uint32_t side = x / 2 % 2 == 0 ? 0 : length;
    chain.push_back(x + side);
    if (x % 2 == 1) chain.push_back(x + length - side);
  }
  const Scene<3> scene(make_cubes(length, 2, 1), walls);
  const Point<3> p{0.5, 1, 0.5}, q{length - 0.5, 1, 0.25};
  expect_free(scene, {p, {0.5, 1, 0.625}, q, chain});
}

TEST(ChainOracle, BrokenSweepsAreCaught) {
  const Scene<3> scene(make_cubes(2, 2, 2), {{0, 1}, {2, 3}});
  const auto blocked = scene.judge({{0.5, 1, 1.5}, {1.5, 1, 1.5}, {1, 1, 0.5}, {4, 0}});
  const auto fault = [](const auto& in, const auto& judged, const auto& result) {
    return fault_of(in.oracle, judged.motion, judged.outcomes, in.snapshot, result);
  };
  auto wrong = blocked.result;
  for (const double toward : {0.0, 1.0}) {
    wrong.contact->set_time(Exact_time(std::nextafter(0.5, toward)));
    EXPECT_EQ(fault(scene, blocked, wrong), Sweep_fault::wrong_time);
  }
  wrong = {{}, scene.chain({4, 0})};
  EXPECT_EQ(fault(scene, blocked, wrong), Sweep_fault::false_free);
  // A membrane with a way round it at both ends: the chain must stay on its side.
  const Scene<2> membrane(make_squares(2, 3), {{2, 3}});
  const auto free = membrane.judge({{1, 2.5}, {1, 2.75}, {1, 0.25}, {4, 2, 0}});
  EXPECT_EQ(fault(membrane, free, Sweep_result<2>{{}, membrane.chain({4, 5, 3, 1, 0})}),
            Sweep_fault::wrong_chain);
  EXPECT_EQ(fault(membrane, free, Sweep_result<2>{{}, membrane.chain({4})}), Sweep_fault::wrong_chain);
  EXPECT_EQ(fault(membrane, free, Sweep_result<2>{Contact<2>{}, {}}), Sweep_fault::false_block);
  // The oracle itself does not begin with what is no chain.
  EXPECT_THROW(membrane.judge({{0.5, 2.5}, {0.5, 2.75}, {0.5, 0.25}, {4, 5, 3, 1, 0}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace cellwalk::test
