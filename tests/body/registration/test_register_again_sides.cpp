// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that are registered again after edits at them: none comes to another side of a wall that stood
// before.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "body/places.h"

namespace cellwalk::test {
namespace {

/// An environment of unit squares or cubes, and a body in it.
template <int D>
class Scene {
 public:
  using Place = Point<D>;

  explicit Scene(const std::array<std::uint32_t, D>& cells, std::initializer_list<Place> walls = {})
      : environment_(made(cells)) {
    close(walls);
  }

  Environment<D>& environment() { return environment_; }
  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }
  void close(std::initializer_list<Place> facets) { set(facets, true); }
  void set(std::initializer_list<Place> facets, bool wall) {
    for (const Place& centre : facets) environment_.set_impassable(facet_at(snapshot(), centre), wall);
  }

  Body<D> body(std::vector<Place> points, std::vector<std::array<std::uint32_t, 2>> edges,
               std::vector<std::array<std::uint32_t, 3>> faces = {}) const {
    return {snapshot(), Locator<D>(snapshot()), {std::move(points), std::move(edges), std::move(faces)}};
  }

 private:
  static Environment<D> made(const std::array<std::uint32_t, D>& cells) {
    if constexpr (D == 2)
      return Environment<2>::build(square_grid({.cells = cells}));
    else
      return Environment<3>::build(hex_grid({.cells = cells}));
  }

  Environment<D> environment_;
};

/// Whether vertices come to their targets, one after the other.
template <int D>
bool come(Body<D>& body, std::initializer_list<std::pair<std::uint32_t, Point<D>>> moves,
          Sweep sweep = Sweep::faces) {
  Body_options options;
  options.sweep.sweep = sweep;
  Body_counts counts;
  for (const auto& [vertex, target] : moves)
    if (body.move_vertex(vertex, target, options, counts)) return false;
  return true;
}

/// The same of a copy.
template <int D>
bool would_come(const Body<D>& body, std::initializer_list<std::pair<std::uint32_t, Point<D>>> moves) {
  Body<D> copy = body;
  return come(copy, moves);
}

template <int D>
void register_again(Body<D>& body, const Snapshot<D>& snapshot) {
  EXPECT_NO_THROW(body.register_again(Locator<D>(snapshot)));
  EXPECT_NO_THROW(body.validate());
}

template <int D>
std::string refusal(Body<D>& body, const Snapshot<D>& snapshot) {
  try {
    body.register_again(Locator<D>(snapshot));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::outside);
    return error.what();
  }
  return {};
}

// A vertex at the rim of a wall is linked with all cells around; that in which it is registered is cut off.
TEST(RegisterAgainSides, AVertexAtARimDoesNotTakeItsNeighbourThroughTheWall) {
  for (const double mirror : {1.0, -1.0})
    for (const std::uint32_t rim : {0u, 1u}) {
      SCOPED_TRACE(testing::Message() << mirror << " " << rim);
      const auto at = [&](double x, double y) { return Point<2>{1 + mirror * (x - 1), y}; };
      Scene<2> scene({2, 2}, {{1, 0.5}});
      const std::uint32_t low = 1 - rim;
      std::vector<Point<2>> points(2);
      points[rim] = at(1, 1);
      points[low] = at(1.25, 0.5);
      Body<2> body = scene.body(points, {{0, 1}});
      ASSERT_TRUE(come<2>(body, {{low, at(1, 0.5)}}));
      ASSERT_FALSE(would_come<2>(body, {{low, at(0.5, 0.5)}}));
      scene.close({at(0.5, 1)});
      register_again(body, scene.snapshot());
      EXPECT_FALSE(would_come<2>(body, {{low, at(0.5, 0.5)}})) << "through the wall";
      EXPECT_TRUE(would_come<2>(body, {{low, at(1.5, 0.5)}})) << "off it";
    }
}

TEST(RegisterAgainSides, AnEdgeInTheLineOfAMembraneStaysOnItsSide) {
  for (const double up : {0.5, -0.5})
    for (const double from : {0.125, -0.125})
      for (const std::uint32_t left : {0u, 1u}) {
        SCOPED_TRACE(testing::Message() << up << " " << from << " " << left);
        Scene<2> scene({3, 2}, {{1.5, 1}});
        const std::uint32_t right = 1 - left;
        std::vector<Point<2>> points(2);
        points[left] = {0.25, 1};
        points[right] = {2.75, 1 + up};
        Body<2> body = scene.body(points, {{0, 1}});
        ASSERT_TRUE(come<2>(body, {{left, {0.25, 1 + from}}, {left, {0.25, 1}}, {right, {2.75, 1}}}));
        ASSERT_FALSE(would_come<2>(body, {{left, {0.25, 1 - up}}, {right, {2.75, 1 - up}}}));
        scene.close({{0.5, 1}});
        register_again(body, scene.snapshot());
        EXPECT_FALSE(would_come<2>(body, {{left, {0.25, 1 - up}}, {right, {2.75, 1 - up}}})) << "through it";
        EXPECT_TRUE(would_come<2>(body, {{right, {2.75, 1 + up}}, {left, {0.25, 1 + up}}})) << "off it";
      }
}

// The cells of an edge that rests on a membrane get the names of others, and others get theirs.
TEST(RegisterAgainSides, CompactionLeavesBodiesOnTheirSides) {
  int renamed = 0;
  for (const double up : {0.25, -0.25})
    for (std::uint32_t k = 0; k < 16; ++k) {
      SCOPED_TRACE(testing::Message() << up << " " << k);
      const Point<2> middle{k % 4 + 0.5, k / 4 + 0.5};
      Scene<2> scene({4, 4}, {{2.5, 2}});
      Body<2> body = scene.body({{2.25, 2 + up}, {2.75, 2 + up}}, {{0, 1}});
      ASSERT_TRUE(come<2>(body, {{0, {2.25, 2}}, {1, {2.75, 2}}}));
      const Cell before = body.particles()[0].cell;
      const auto expect_side = [&] {
        register_again(body, scene.snapshot());
        EXPECT_FALSE(would_come<2>(body, {{0, {2.25, 2 - up}}, {1, {2.75, 2 - up}}})) << "through it";
        EXPECT_TRUE(would_come<2>(body, {{0, {2.25, 2 + up}}, {1, {2.75, 2 + up}}})) << "off it";
      };
      if (k != 6 && k != 10) {  // those at the membrane
        scene.environment().insert_point(cell_at<2>(scene.snapshot(), middle), middle);
        expect_side();
      }
      scene.environment().compact();
      expect_side();
      renamed += body.particles()[0].cell != before;
    }
  EXPECT_GT(renamed, 5);
}

// Two cells are split one after the other: the first gives its name to a part of the second.
TEST(RegisterAgainSides, ANameThatAnotherCellHasNowIsNotTakenForTheCell) {
  for (const double up : {1.0, -1.0})
    for (const std::uint32_t left : {0u, 1u}) {
      SCOPED_TRACE(testing::Message() << up << " " << left);
      Cell_soup<2> soup;
      soup.points = {{-4, 0}, {0, 0}, {4, 0}, {0, 6}, {0, -6}};
      for (const auto& [a, b, c] : {std::array{0u, 1u, 3u}, {1u, 2u, 3u}, {0u, 4u, 1u}, {1u, 4u, 2u}})
        add_polygon(soup, std::array{a, b, c});
      auto environment = Environment<2>::build(soup);
      const Snapshot<2>& snapshot = environment.snapshot();
      for (const double x : {-2.0, 2.0}) environment.set_impassable(facet_at<2>(snapshot, {x, 0}), true);
      const std::uint32_t right = 1 - left;
      std::vector<Point<2>> points(2);
      points[left] = {-2, up};
      points[right] = {2, up};
      Body<2> body(snapshot, Locator<2>(snapshot), {points, {{0, 1}}, {}});
      ASSERT_TRUE(come<2>(body, {{left, {-2, 0}}, {right, {2, 0}}}));
      const Cell gone = body.particles()[left].cell;
      environment.insert_point(gone, {-1.5, 1.5 * up});
      environment.insert_point(cell_at<2>(snapshot, {-2, -up}), {-1.5, -1.5 * up});
      ASSERT_TRUE(snapshot.is_cell(gone)) << "the name has a cell again";
      register_again(body, snapshot);
      EXPECT_FALSE(would_come<2>(body, {{left, {-2, -up / 4}}, {right, {2, -up / 4}}})) << "through it";
      EXPECT_TRUE(would_come<2>(body, {{left, {-2, up / 4}}, {right, {2, up / 4}}})) << "off it";
    }
}

enum class Change { fill, split, close };

// A vertex on a membrane where two cells meet: that in which it is registered is filled, split or cut off.
TEST(RegisterAgainSides, AVertexStaysOnItsSideWhateverBecomesOfItsCell) {
  for (const double up : {0.5, -0.5})
    for (const double from : {0.5, -0.5})
      for (const Change change : {Change::fill, Change::split, Change::close}) {
        SCOPED_TRACE(testing::Message() << up << " " << from << " " << static_cast<int>(change));
        Scene<2> scene({2, 2}, {{0.5, 1}, {1.5, 1}});
        Body<2> body = scene.body({{1 + from, 1 + up}}, {});
        ASSERT_TRUE(come<2>(body, {{0, {1, 1}}}));
        const Cell cell = body.particles()[0].cell;
        Point<2> own{1.5, 1 + up}, other{0.5, 1 + up};
        if (cell_at<2>(scene.snapshot(), own) != cell) std::swap(own, other);
        ASSERT_EQ(cell_at<2>(scene.snapshot(), own), cell);
        if (change == Change::fill) scene.environment().fill(cell);
        if (change == Change::split) scene.environment().insert_point(cell, own);
        if (change == Change::close) scene.close({{1, 1 + up}});
        register_again(body, scene.snapshot());
        EXPECT_TRUE(would_come<2>(body, {{0, change == Change::fill ? other : own}})) << "off it";
        for (const double x : {0.5, 1.5})
          EXPECT_FALSE(would_come<2>(body, {{0, {x, 1 - up}}})) << "through it, to " << x;
      }
}

TEST(RegisterAgainSides, AVertexWhoseSideIsFilledIsRefused) {
  Scene<2> scene({2, 2}, {{0.5, 1}, {1.5, 1}});
  Body<2> body = scene.body({{1, 1.5}}, {});
  ASSERT_TRUE(come<2>(body, {{0, {1, 1}}}));
  const std::array above{cell_at<2>(scene.snapshot(), {0.5, 1.5}), cell_at<2>(scene.snapshot(), {1.5, 1.5})};
  for (const Cell cell : above) scene.environment().fill(cell);
  EXPECT_NE(refusal(body, scene.snapshot()).find("is on a side of walls that was filled"), std::string::npos);
  scene.environment().excavate(above[0]);
  scene.close({{0.5, 1}});  // it was opened
  register_again(body, scene.snapshot());
  EXPECT_TRUE(would_come<2>(body, {{0, {0.5, 1.5}}}));
  EXPECT_FALSE(would_come<2>(body, {{0, {0.5, 0.5}}}));
}

// An edge rests on two walls; a third one is put up on it, on its side.
TEST(RegisterAgainSides, AWallInTheWayIsRefusedAndNotAvoidedThroughAnother) {
  for (const double up : {0.25, -0.25}) {
    Scene<2> scene({2, 2}, {{0.5, 1}, {1.5, 1}});
    Body<2> body = scene.body({{0.5, 1 + up}, {1.5, 1 + up}}, {{0, 1}});
    ASSERT_TRUE(come<2>(body, {{0, {0.5, 1}}, {1, {1.5, 1}}}));
    scene.close({{1, 1 + 2 * up}});
    EXPECT_NE(refusal(body, scene.snapshot()).find("edge 0 of the body"), std::string::npos);
    scene.set({{1, 1 + 2 * up}}, false);
    register_again(body, scene.snapshot());
    EXPECT_TRUE(would_come<2>(body, {{0, {0.5, 1 + up}}, {1, {1.5, 1 + up}}}));
    EXPECT_FALSE(would_come<2>(body, {{0, {0.5, 1 - up}}}));
  }
}

// The same of a face around a membrane.
TEST(RegisterAgainSides, AWallInAFaceIsRefusedAndNotAvoidedThroughAnother) {
  for (const double start : {0.5, 1.5})
    for (const bool own : {true, false}) {
      SCOPED_TRACE(testing::Message() << start << " " << own);
      Scene<3> scene({10, 10, 2}, {{4.5, 4.5, 1}});
      Body<3> body =
          scene.body({{1, 1, start}, {9.5, 1, start}, {4, 9, start}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}});
      ASSERT_TRUE(come<3>(body, {{0, {1, 1, 1}}, {1, {9.5, 1, 1}}, {2, {4, 9, 1}}}));
      scene.close({{4, 4.5, own ? start : 2 - start}});
      if (own) {
        EXPECT_NE(refusal(body, scene.snapshot()).find("pierced"), std::string::npos);
        continue;
      }
      register_again(body, scene.snapshot());
      EXPECT_TRUE(would_come<3>(body, {{0, {1, 1, start}}, {1, {9.5, 1, start}}, {2, {4, 9, start}}}));
      EXPECT_FALSE(
          would_come<3>(body, {{0, {1, 1, 2 - start}}, {1, {9.5, 1, 2 - start}}, {2, {4, 9, 2 - start}}}));
    }
}

// A face needs another chain of its edge; another part of the body rests on a membrane far off.
TEST(RegisterAgainSides, WhatOneFaceNeedsLeavesOthersOnTheirSides) {
  for (const double start : {1.5, 2.5}) {
    SCOPED_TRACE(start);
    Scene<3> scene({14, 12, 12}, {{7.5, 5.5, 6}, {3.5, 3.5, 2}});
    Body<3> body =
        scene.body({{6, 6, 6}, {9, 5, 5}, {7.5, 10, 10}, {1, 1, start}, {9, 1, start}, {3, 9, start}},
                   {{0, 1}, {0, 2}, {1, 2}, {3, 4}, {3, 5}, {4, 5}}, {{0, 1, 2}, {3, 4, 5}});
    ASSERT_TRUE(come<3>(body, {{2, {7.5, 10, 9}}, {1, {9, 6, 6}}}));
    ASSERT_TRUE(come<3>(body, {{3, {1, 1, 2}}, {4, {9, 1, 2}}, {5, {3, 9, 2}}}));
    scene.close({{7.5, 6, 5.5}});
    register_again(body, scene.snapshot());
    const double other = 4 - start;
    EXPECT_FALSE(would_come<3>(body, {{3, {1, 1, other}}, {4, {9, 1, other}}, {5, {3, 9, other}}}));
    EXPECT_TRUE(would_come<3>(body, {{3, {1, 1, start}}, {4, {9, 1, start}}, {5, {3, 9, start}}}));
  }
}

// What a face rests on is filled from its side, or split; no edge passes there.
TEST(RegisterAgainSides, AFaceStaysOnItsSideWhateverBecomesOfTheCellBetween) {
  for (const double start : {0.5, 1.5})
    for (const Change change : {Change::fill, Change::split}) {
      SCOPED_TRACE(testing::Message() << start << " " << static_cast<int>(change));
      Scene<3> scene({10, 10, 2}, {{4.5, 4.5, 1}});
      Body<3> body =
          scene.body({{1, 1, start}, {9.5, 1, start}, {4, 9, start}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}});
      ASSERT_TRUE(come<3>(body, {{0, {1, 1, 1}}, {1, {9.5, 1, 1}}, {2, {4, 9, 1}}}));
      const Point<3> middle{4.5, 4.5, start};
      const Cell cell = cell_at<3>(scene.snapshot(), middle);
      if (change == Change::fill) {
        scene.environment().fill(cell);
        EXPECT_NE(refusal(body, scene.snapshot()).find("pierced"), std::string::npos);
        continue;
      }
      scene.environment().insert_point(cell, middle);
      register_again(body, scene.snapshot());
      EXPECT_TRUE(would_come<3>(body, {{0, {1, 1, start}}, {1, {9.5, 1, start}}, {2, {4, 9, start}}}));
      EXPECT_FALSE(
          would_come<3>(body, {{0, {1, 1, 2 - start}}, {1, {9.5, 1, 2 - start}}, {2, {4, 9, 2 - start}}}));
    }
}

TEST(RegisterAgainSides, AnEdgeInOneCellDoesNotPassAWallWhenThatIsFilled) {
  for (const double up : {0.5, -0.5}) {
    SCOPED_TRACE(up);
    Scene<2> scene({3, 2}, {{1.5, 1}});
    Body<2> body = scene.body({{1.25, 1 + up}, {1.75, 1 + up}}, {{0, 1}});
    ASSERT_TRUE(come<2>(body, {{0, {1, 1}}, {1, {2, 1}}}));
    ASSERT_TRUE(body.chain(0).empty());
    scene.environment().fill(cell_at<2>(scene.snapshot(), {1.5, 1 + up}));
    EXPECT_NE(refusal(body, scene.snapshot()).find("edge 0 of the body"), std::string::npos);
  }
}

TEST(RegisterAgainSides, AVertexHasAllPartsOfItsCell) {
  for (std::size_t filled = 0; filled < 4; ++filled) {
    Scene<2> scene({1, 1});
    Body<2> body = scene.body({{0.5, 0.5}}, {});
    const Cell whole = cell_at<2>(scene.snapshot(), {0.5, 0.5});
    scene.environment().fill(scene.environment().insert_point(whole, {0.5, 0.5})[filled]);
    register_again(body, scene.snapshot());
  }
}

TEST(RegisterAgainSides, ForgottenEditsAreRefused) {
  Scene<2> scene({2, 1});
  Body<2> body = scene.body({{0.5, 0.5}}, {});
  for (int k = 0; k < 2; ++k) scene.environment().compact();
  try {
    body.register_again(Locator<2>(scene.snapshot()));
    ADD_FAILURE() << "it is not known where it was";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::usage) << error.what();
  }
}

TEST(RegisterAgainSides, FacesThatAreNotSweptAreLeftAlone) {
  Scene<3> scene({8, 8, 2}, {{4, 4.5, 0.5}});
  Body<3> body =
      scene.body({{1, 1, 1.5}, {7.5, 1, 1.5}, {4.25, 7.5, 1.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}});
  ASSERT_TRUE(come<3>(body, {{0, {1, 1, 0.5}}, {1, {7.5, 1, 0.5}}, {2, {4.25, 7.5, 0.5}}}, Sweep::triangle));
  scene.close({{7, 7.5, 1.5}});
  register_again(body, scene.snapshot());
  EXPECT_TRUE(come<3>(body, {{0, {1, 1, 1.5}}}, Sweep::triangle));
  EXPECT_THROW(come<3>(body, {{0, {1, 1, 0.5}}}), Error) << "the wall pierces the face still";
}

// A sheet lies between cells, with its vertices in cells on both sides. A wall is made in its plane: then it
// must be on one side.
TEST(RegisterAgainSides, ASheetThatWasOnNoSideComesToOne) {
  Scene<3> scene({3, 4, 2});
  Body<3> body =
      scene.body({{0.5, 0.5, 1.5}, {1.5, 3.5, 1}, {2.5, 0.5, 0.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}});
  ASSERT_TRUE(come<3>(body, {{0, {0.5, 0.5, 1}}, {2, {2.5, 0.5, 1}}}));
  scene.close({{0.5, 0.5, 1}, {0.5, 1.5, 1}, {1.5, 1.5, 1}, {2.5, 1.5, 1}, {2.5, 0.5, 1}});
  register_again(body, scene.snapshot());
}

}  // namespace
}  // namespace cellwalk::test
