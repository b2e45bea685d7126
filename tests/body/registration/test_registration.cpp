// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/body.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {
namespace {

template <int D>
std::string refusal(const Snapshot<D>& snapshot, const Body_soup<D>& soup,
                    Error_code code = Error_code::outside) {
  try {
    Body<D>(snapshot, Locator<D>(snapshot), soup);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "";
}

TEST(Registration, FindsCellsAndChains) {
  const Snapshot<3> snapshot = rooms<3>({3, 1, 1}, {});
  const Body_soup<3> soup{{{0.5, 0.5, 0.5}, {2.5, 0.5, 0.25}, {0.25, 0.25, 0.25}}, {{0, 1}, {0, 2}}, {}};
  const Body<3> body(snapshot, Locator<3>(snapshot), soup);
  EXPECT_EQ(body.chain(0).size(), 2u);
  EXPECT_TRUE(body.chain(1).empty());
  EXPECT_NO_THROW(body.validate());
}

TEST(Registration, LooksAtNoFacesInThePlane) {
  const Snapshot<2> snapshot = rooms<2>({3, 3}, {});
  const Body_soup<2> soup{{{1.2, 1.2}, {1.6, 1.2}, {1.4, 1.6}}, {{0, 1}, {1, 2}, {0, 2}}, {{0, 1, 2}}};
  Body<2> body(snapshot, Locator<2>(snapshot), soup);
  EXPECT_TRUE(body.faces().empty());
  Step_report<2> report;
  Body_counts counts;
  std::vector<Point<2>> targets(soup.points);
  for (Point<2>& x : targets) x[0] += 3;
  body.step(targets, {}, report, counts);
  EXPECT_FALSE(report.contacts.empty());
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

TEST(Registration, RefusesEdgesAndFacesThatDoNotFit) {
  const Snapshot<3> snapshot = rooms<3>({1, 1, 1}, {});
  const std::vector<Point<3>> points{{0.2, 0.2, 0.2}, {0.8, 0.2, 0.2}, {0.2, 0.8, 0.2}, {0.2, 0.2, 0.8}};
  using Edges = std::vector<std::array<std::uint32_t, 2>>;
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  const auto refused = [&](const Edges& edges, const Faces& faces) {
    return refusal<3>(snapshot, {points, edges, faces}, Error_code::usage);
  };
  EXPECT_EQ(refused({{0, 1}, {0, 2}, {1, 2}}, {{2, 1, 0}}), "");
  EXPECT_EQ(
      refused({{0, 1}, {1, 2}, {0, 2}}, {{0, 1, 2}}),
      "edge 2 of the body, from vertex 0 to 2, does not come after edge 1: sort the edges of a body with "
      "faces, each with its lower vertex first");
  EXPECT_EQ(
      refused({{0, 1}, {0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}),
      "edge 1 of the body, from vertex 0 to 1, does not come after edge 0: sort the edges of a body with "
      "faces, each with its lower vertex first");
  EXPECT_EQ(
      refused({{0, 1}, {1, 2}, {2, 0}}, {{0, 1, 2}}),
      "edge 2 of the body, from vertex 2 to 0, does not have its lower vertex first: sort the edges of a "
      "body with faces, each with its lower vertex first");
  EXPECT_EQ(refused({{0, 1}, {0, 2}}, {{0, 1, 2}}),
            "face 0 of the body has a side from vertex 1 to 2 that is not among its edges: list each side");
  EXPECT_EQ(refused({{0, 1}, {0, 2}, {0, 3}, {1, 2}}, {{0, 1, 2}, {3, 0, 1}}),
            "face 1 of the body has a side from vertex 1 to 3 that is not among its edges: list each side");
  EXPECT_EQ(refused({{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 1}}),
            "face 0 of the body has a side from vertex 1 to 1 that is not among its edges: list each side");
  EXPECT_EQ(refused({{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 4}}), "face 0 of the body names vertex 4 of 4");
  EXPECT_EQ(refused({{0, 1}, {2, 5}}, {}), "edge 1 of the body names vertex 5 of 4");
  // Without faces the order of edges does not matter.
  EXPECT_EQ(refused({{2, 1}, {0, 1}}, {}), "");
}

TEST(Registration, RefusesVerticesAndEdgesWithTheirPlace) {
  const Snapshot<2> snapshot = rooms<2>({3, 1}, {});
  EXPECT_EQ(refusal<2>(snapshot, {{{0.5, 0.5}, {4, 0.5}}, {{0, 1}}, {}}),
            "vertex 1 of the body, at (4, 0.5), is outside the environment: move the body into free space");
  const Snapshot<2> with_solid = rooms<2>({3, 1}, {1});
  EXPECT_EQ(refusal<2>(with_solid, {{{1.5, 0.5}}, {}, {}}),
            "vertex 0 of the body, at (1.5, 0.5), is in a solid cell: move the body into free space");
  EXPECT_EQ(refusal<2>(with_solid, {{{0.5, 0.5}, {2.5, 0.5}}, {{0, 1}}, {}}),
            "edge 0 of the body, from vertex 0 at (0.5, 0.5) to vertex 1 at (2.5, 0.5), crosses a wall at "
            "(1, 0.5), in cell 0: "
            "move the body into free space");
}

/// A room of two cells with a membrane between them from y = 0 to 1; above it, they are joined.
Snapshot<2> membrane() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}};
  const auto cell = [&](std::array<std::uint32_t, 4> v, int wall) {
    for (int i = 0; i < 4; ++i) soup.add_facet({v[i], v[(i + 1) % 4]}, i == wall);
    soup.end_cell();
  };
  cell({0, 1, 4, 3}, 1);
  cell({1, 2, 5, 4}, 3);
  cell({3, 4, 7, 6}, -1);
  cell({4, 5, 8, 7}, -1);
  return compile(soup);
}

TEST(Registration, TakesTheSideFromWhichAllEdgesCanBePassed) {
  const Snapshot<2> snapshot = membrane();
  const Locator<2> locator(snapshot);
  // A vertex on the membrane, joined to one on its left or on its right.
  for (const double x : {0.5, 1.5}) {
    const Body<2> body(snapshot, locator, {{{1, 0.5}, {x, 0.5}}, {{0, 1}}, {}});
    EXPECT_EQ(body.particles()[0].cell, body.particles()[1].cell);
    EXPECT_NO_THROW(body.validate());
  }
  // Two vertices on the membrane: the third decides for both, although the edge between the two may lie on
  // either side.
  for (const double x : {0.5, 1.5}) {
    const Body<2> body(snapshot, locator, {{{1, 0.25}, {1, 0.5}, {x, 0.5}}, {{0, 1}, {1, 2}}, {}});
    EXPECT_EQ(body.particles()[0].cell, body.particles()[2].cell);
    EXPECT_NO_THROW(body.validate());
  }
  // One that would have to be on both.
  EXPECT_NE(refusal<2>(snapshot, {{{1, 0.5}, {0.5, 0.5}, {1.5, 0.5}}, {{0, 1}, {0, 2}}, {}}), "");
}

/// Two cells on both sides of a line. Each has two facets in it: a way from x = 0 to 1, and a wall from 1 to
/// 2.
Snapshot<2> gap_and_wall() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, -1}, {2, -1}};
  const auto cell = [&](const std::array<std::uint32_t, 5>& v, int wall) {
    for (int i = 0; i < 5; ++i) soup.add_facet({v[i], v[(i + 1) % 5]}, i == wall);
    soup.end_cell();
  };
  cell({0, 1, 2, 4, 3}, 1);
  cell({1, 0, 5, 6, 2}, 4);
  return compile(soup);
}

TEST(Registration, LeadsEdgesThroughTheInsideOfAFacetInWhosePlaneTheyLie) {
  const Snapshot<2> snapshot = gap_and_wall();
  const Locator<2> locator(snapshot);
  // From the way to the wall, on the side on which the third vertex is.
  for (const double y : {0.5, -0.5})
    for (const bool is_first_on_wall : {false, true}) {
      const Point<2> on_way{0.5, 0}, on_wall{1.5, 0}, off{1.5, y};
      const Body_soup<2> soup = is_first_on_wall ? Body_soup<2>{{on_wall, on_way, off}, {{0, 1}, {0, 2}}, {}}
                                                 : Body_soup<2>{{on_way, on_wall, off}, {{0, 1}, {1, 2}}, {}};
      ASSERT_EQ(refusal<2>(snapshot, soup), "");
      const Body<2> body(snapshot, locator, soup);
      EXPECT_EQ(body.particles()[is_first_on_wall ? 0 : 1].cell, body.particles()[2].cell);
      EXPECT_NO_THROW(body.validate());
    }
}

/// A line with walls from 2 i to 2 i + 1, behind each of which one of its sides is a pocket, closed by a wall
/// across.
Snapshot<2> pockets(std::uint32_t count) {
  Cell_soup<2> soup;
  const std::uint32_t width = 2 * count;
  for (int y = -1; y <= 1; ++y)
    for (std::uint32_t x = 0; x <= width; ++x)
      soup.points.push_back({static_cast<double>(x), static_cast<double>(y)});
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t v = row * (width + 1) + x;
      const std::array<std::uint32_t, 4> corners{v, v + 1, v + width + 2, v + width + 1};
      const bool is_pocket = row == x / 2 % 2;
      for (std::uint32_t i = 0; i < 4; ++i) {
        const bool is_on_line = i == (row == 0 ? 2u : 0u), is_across = i == (x % 2 == 0 ? 1u : 3u);
        soup.add_facet({corners[i], corners[(i + 1) % 4]},
                       x % 2 == 0 ? is_on_line || (is_across && is_pocket) : is_across && is_pocket);
      }
      soup.end_cell();
    }
  return compile(soup);
}

TEST(Registration, FindsTheOneWayPastManyPockets) {
  for (const std::uint32_t count : {1u, 4u, 40u}) {
    const Snapshot<2> snapshot = pockets(count);
    const Locator<2> locator(snapshot);
    const double end = 2.0 * count;
    for (const bool is_turned : {false, true}) {
      const Point<2> left{0, 0}, right{end, 0};
      const Body_soup<2> soup{{is_turned ? right : left, is_turned ? left : right}, {{0, 1}}, {}};
      ASSERT_EQ(refusal<2>(snapshot, soup), "") << count;
      const Body<2> body(snapshot, locator, soup);
      EXPECT_GE(body.chain(0).size(), 2u * count - 2);
      EXPECT_NO_THROW(body.validate());
    }
  }
}

TEST(Registration, TriesTheOtherSideWhereOneLeadsNowhere) {
  // Vertices that no edge joins, each with a choice; and two that must agree.
  const Snapshot<2> snapshot = membrane();
  Body_soup<2> soup{{{1, 0.25}, {1, 0.5}, {1, 0.75}, {1, 0.875}, {0.5, 0.75}}, {{1, 2}, {2, 4}}, {}};
  const Body<2> body(snapshot, Locator<2>(snapshot), soup);
  EXPECT_EQ(body.particles()[1].cell, body.particles()[4].cell);
  EXPECT_NO_THROW(body.validate());
}

TEST(Registration, AcceptsBodiesAtRestInWallPlanes) {
  const Snapshot<3> snapshot = rooms<3>({4, 4, 2}, {});
  Body_placement<3> placement;
  placement.position = {2, 2, 0.5};
  const Body<3> body(snapshot, Locator<3>(snapshot), transformed(hexahedron_body(1, true), placement));
  EXPECT_EQ(body.positions()[0][2], 0) << "it stands on the floor";
  EXPECT_NO_THROW(body.validate());
}

}  // namespace
}  // namespace cellwalk::test
