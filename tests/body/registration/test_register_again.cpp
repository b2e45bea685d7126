// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that are registered again after edits: where nothing changed, they are as they were.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "body/membrane_room.h"
#include "body/places.h"

namespace cellwalk::test {
namespace {

Environment<3> room() {
  Grid_options<3> options;
  options.cells = {14, 12, 12};
  return Environment<3>::build(hex_grid(options));
}

void close(Environment<3>& environment, const std::vector<Point<3>>& centres) {
  for (const Point<3>& centre : centres)
    environment.set_impassable(facet_at(environment.snapshot(), centre), true);
}

template <int D>
struct Registration_of {
  explicit Registration_of(const Body<D>& body) {
    for (const Particle<D>& p : body.particles()) cells.push_back(p.cell);
    for (std::size_t e = 0; e < body.edges().size(); ++e) chains.push_back(body.chain(e));
  }
  bool operator==(const Registration_of&) const = default;

  std::vector<Cell> cells;
  std::vector<Chain> chains;
};

// Walls reach the line y = z = 6 from below and from behind.
const Point<3> below{7.5, 6, 5.5}, behind{7.5, 5.5, 6};

/// A face with its corner 0 in that line, and corner 1 in the quarter between these walls. Then that comes
/// into the line too, and the edge keeps the quarter.
Body<3> face_at_line(const Snapshot<3>& snapshot, const Point<3>& corner, const Point<3>& moved) {
  Body<3> body(snapshot, Locator<3>(snapshot),
               {{{6, 6, 6}, {9, 5, 5}, corner}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}});
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  Body_counts counts;
  EXPECT_FALSE(body.move_vertex(2, moved, options, counts));
  EXPECT_FALSE(body.move_vertex(1, {9, 6, 6}, options, counts));
  EXPECT_NO_THROW(body.validate());
  return body;
}

TEST(RegisterAgain, EditsFarOffLeaveCellsAndChainsAsTheyAre) {
  Environment<3> environment = room();
  close(environment, {below, behind});
  const Snapshot<3>& snapshot = environment.snapshot();
  Body<3> body = face_at_line(snapshot, {7.5, 2, 2}, {7.5, 2, 3});
  const Registration_of<3> before(body);
  const std::vector<std::function<void()>> edits{
      [&] {
        close(environment, {{1.5, 1.5, 2}});
      },
      [&] {
        environment.insert_point(cell_at<3>(snapshot, {1.5, 1.5, 1.5}), {1.5, 1.5, 1.5});
      },
      [&] {
        environment.fill(cell_at<3>(snapshot, {2.5, 1.5, 1.5}));
      },
  };
  for (std::size_t i = 0; i < edits.size(); ++i) {
    SCOPED_TRACE(i);
    edits[i]();
    EXPECT_THROW(body.validate(), Error);
    EXPECT_NO_THROW(body.register_again(Locator<3>(snapshot)));
    EXPECT_NO_THROW(body.validate());
    EXPECT_EQ(Registration_of<3>(body), before);
  }
}

TEST(RegisterAgain, AChainThroughAFacetThatIsClosedIsFoundAnew) {
  Environment<3> environment = room();
  Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()),
               {{{6, 6, 6}, {9, 5, 5}}, {{0, 1}}, {}});
  Body_counts counts;
  ASSERT_FALSE(body.move_vertex(1, {9, 6, 6}, {}, counts));
  // One after the other of the four ways along the line is closed.
  for (int way = 0; way < 4; ++way) {
    SCOPED_TRACE(way);
    const Chain before = body.chain(0);
    ASSERT_FALSE(before.empty());
    environment.set_impassable(before[before.size() / 2], true);
    if (way == 3) {
      EXPECT_THROW(body.register_again(Locator<3>(environment.snapshot())), Error);
      break;
    }
    EXPECT_NO_THROW(body.register_again(Locator<3>(environment.snapshot())));
    EXPECT_NO_THROW(body.validate());
    EXPECT_NE(body.chain(0), before);
  }
}

// A wall comes between the face and the chain of its edge, through which no wall goes.
TEST(RegisterAgain, AChainThatAFaceCannotHaveAnyMoreIsFoundAnew) {
  Environment<3> environment = room();
  close(environment, {behind});
  const Snapshot<3>& snapshot = environment.snapshot();
  Body<3> body = face_at_line(snapshot, {7.5, 10, 10}, {7.5, 10, 9});
  const Chain before = body.chain(0);
  close(environment, {below});
  Walk_counts counts;
  EXPECT_TRUE(is_chain(snapshot, body.particles()[0], body.particles()[1], before, counts));
  EXPECT_NO_THROW(body.register_again(Locator<3>(snapshot)));
  EXPECT_NO_THROW(body.validate());
  EXPECT_NE(body.chain(0), before);
}

TEST(RegisterAgain, AVertexWhoseCellIsGoneFollowsItsNeighbour) {
  // An edge lies in a wall, from one side. The cell of one of its ends is replaced.
  for (const double side : {-1.0, 1.0})
    for (const std::uint32_t lost : {0u, 1u}) {
      SCOPED_TRACE(testing::Message() << side << " " << lost);
      Environment<2> environment = Environment<2>::build(square_grid({.cells = {2, 2}}));
      const Snapshot<2>& snapshot = environment.snapshot();
      for (const double y : {0.5, 1.5}) environment.set_impassable(facet_at<2>(snapshot, {1, y}), true);
      Body<2> body(snapshot, Locator<2>(snapshot),
                   {{{1 + 0.25 * side, 0.5}, {1 + 0.25 * side, 1.5}}, {{0, 1}}, {}});
      Body_counts counts;
      ASSERT_FALSE(body.move_vertex(0, {1, 0.5}, {}, counts));
      ASSERT_FALSE(body.move_vertex(1, {1, 1.5}, {}, counts));
      const Cell gone = body.particles()[lost].cell, kept = body.particles()[1 - lost].cell;
      environment.insert_point(gone, {1 + 0.5 * side, 0.5 + lost});
      ASSERT_FALSE(snapshot.is_cell(gone));
      body.register_again(Locator<2>(snapshot));
      EXPECT_NO_THROW(body.validate());
      EXPECT_EQ(body.particles()[1 - lost].cell, kept);
      for (const std::uint32_t v : {0u, 1u}) {
        const double y = 0.5 + v;
        EXPECT_TRUE(body.move_vertex(v, {1 - 0.25 * side, y}, {}, counts)) << "through the wall";
        EXPECT_FALSE(body.move_vertex(v, {1 + 0.25 * side, y}, {}, counts)) << "off it";
      }
    }
}

// Membranes lie strictly inside of a face that was lowered or lifted to them: no edge knows its side.
TEST(RegisterAgain, AFaceStaysOnItsSideOfWhatLiesInIt) {
  for (const double start : {0.5, 1.5}) {
    auto environment = with_membranes({6.9, 3.9, 0.9}, {9.1, 6.1, 1.1});
    const Snapshot<3>& snapshot = environment.snapshot();
    Moving face(snapshot, {{1, 1, start}, {20, 1, start}, {8, 11, start}}, {{0, 1, 2}});
    ASSERT_TRUE(face.lift(1));
    environment.set_impassable(facet_at(snapshot, {20.5, 11.5, 1}), true);
    face.register_again(snapshot);
    EXPECT_FALSE(face.lift(2 - start)) << "through the membranes";
    EXPECT_TRUE(face.lift(start)) << "off them";
  }
}

// Compaction renames cells. A name may be that of another cell at the vertex then, and names of facets may be
// gone.
TEST(RegisterAgain, BodiesGoOnAfterCompaction) {
  for (std::uint32_t length = 2; length < 7; ++length) {
    Environment<2> environment = Environment<2>::build(square_grid({.cells = {length, 1}}));
    const Snapshot<2>& snapshot = environment.snapshot();
    for (std::uint32_t i = 0; i < length; ++i) {
      const Point<2> middle{i + 0.5, 0.5};
      environment.insert_point(cell_at(snapshot, middle), middle);
    }
    std::vector<Body<2>> bodies;
    for (std::uint32_t u = 0; u <= length; ++u)
      for (std::uint32_t v = 0; v <= length; ++v)
        bodies.push_back({snapshot, Locator<2>(snapshot), {{{1.0 * u, 0}, {1.0 * v, 1}}, {{0, 1}}, {}}});
    const std::size_t slots = snapshot.half_facet_slots();
    environment.compact();
    EXPECT_LT(snapshot.half_facet_slots(), slots);
    for (Body<2>& body : bodies) {
      EXPECT_NO_THROW(body.register_again(Locator<2>(snapshot)));
      EXPECT_NO_THROW(body.validate());
    }
  }
}

}  // namespace
}  // namespace cellwalk::test
