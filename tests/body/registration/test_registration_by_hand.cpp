// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies whose faces need sides of walls that are hard to find, or that there are not; and the bounds of the
// search for them.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "body/registration/box_cells.h"
#include "body/registration/lift_judge.h"

namespace cellwalk::test {
namespace {

Body_soup<3> body_of(const std::vector<Point<3>>& points,
                     const std::vector<std::vector<std::uint32_t>>& faces) {
  Body_parts<3> parts;
  parts.points = points;
  parts.polygons = faces;
  return make_body(parts).body;
}

/// Empty if a body is accepted, which must be right then; else why it is not.
std::string refusal(const Snapshot<3>& snapshot, const Body_soup<3>& soup) {
  try {
    Body<3> body(snapshot, Locator<3>(snapshot), soup);
    EXPECT_NO_THROW(body.validate());
    EXPECT_EQ(Lift_judge(snapshot, soup).fault(body), "");
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::outside);
    return error.what();
  }
}

bool has_ended(const std::string& refusal) {
  return refusal.find("the search for other sides of walls ended without a result") != std::string::npos;
}

/// A room of cells, 2 x 2 of them in a row, with walls at the centres of facets given by a rule.
Environment<3> room(unsigned length, const std::function<bool(const Point<3>&)>& is_wall) {
  auto environment = Environment<3>::build(hex_grid({.cells = {length, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  for (std::size_t c = 0; c < snapshot.cell_count(); ++c)
    for (std::size_t i = 0; i < 6; ++i) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(c), i);
      if (snapshot.neighbour(f) != Cell::none && is_wall(centroid(snapshot, f)))
        environment.set_impassable(f, true);
    }
  return environment;
}
/// In every second cell of the row a wall at half height.
bool is_in_row(const Point<3>& x) { return x[2] == 1 && x[1] < 1 && static_cast<int>(x[0]) % 2 == 1; }
Environment<3> row_of_walls(unsigned walls) { return room(2 * walls + 1, is_in_row); }

/// An edge along all these walls, in their plane, has two chains at each. The face hangs from it.
TEST(RegistrationByHand, AFaceHangsFromARowOfWallsOfAnyLength) {
  for (const unsigned walls : {1u, 8u, 9u, 20u}) {
    const Environment<3> environment = row_of_walls(walls);
    const double end = 2 * walls + 0.5;
    for (const double z : {0.25, 1.75}) {
      const Body_soup<3> soup = body_of({{0.5, 0.5, 1}, {end, 0.5, 1}, {end / 2, 0.5, z}}, {{0, 1, 2}});
      EXPECT_EQ(refusal(environment.snapshot(), soup), "") << walls << " " << z;
    }
    const Body_soup<3> both = body_of(
        {{0.5, 0.5, 1}, {end, 0.5, 1}, {end / 2, 0.5, 0.25}, {end / 2, 0.5, 1.75}}, {{0, 1, 2}, {0, 1, 3}});
    const std::string why = refusal(environment.snapshot(), both);
    EXPECT_FALSE(why.empty());
    EXPECT_EQ(has_ended(why), walls > 8);
  }
}

/// A wall that stands on the first wall of the row has the face below it, and one that hangs from the second
/// has it above. No more than 256 of the 2^10 chains of the edge are tried.
TEST(RegistrationByHand, AnEdgeOfTooManyChainsIsReported) {
  const auto make = [](bool first_is_below) {
    return room(21, [&](const Point<3>& x) {
      const bool is_at_first = static_cast<int>(x[0]) == 1, is_at_second = static_cast<int>(x[0]) == 3;
      if (x[1] == 1) return (is_at_first && (x[2] > 1) == first_is_below) || (is_at_second && x[2] < 1);
      return is_in_row(x) || ((is_at_first || is_at_second) && x[2] == 1);
    });
  };
  const Body_soup<3> soup = body_of({{0.5, 0.5, 1}, {20.5, 0.5, 1}, {2.5, 1.75, 1}}, {{0, 1, 2}});
  const Environment<3> above = make(false), mixed = make(true);
  EXPECT_EQ(refusal(above.snapshot(), soup), "");
  ASSERT_TRUE(Lift_judge(mixed.snapshot(), soup).can_be_somewhere());
  const std::string why = refusal(mixed.snapshot(), soup);
  EXPECT_TRUE(has_ended(why)) << why;
}

/// A strip in the plane of walls, each of which it may pass on either side; at its end an edge from which one
/// face hangs, and on which another one stands.
TEST(RegistrationByHand, TheSearchEndsAfterSomeStepsBack) {
  constexpr std::uint32_t walls = 12;
  const Environment<3> environment = row_of_walls(walls);
  const auto make = [&](std::uint32_t length) {
    std::vector<Point<3>> points;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t k = 0; k < length; ++k) {
      points.insert(points.end(), {{2 * k + 1.5, 0.75, 1}, {2 * k + 1.5, 1.5, 1}});
      if (k == 0) continue;
      const std::uint32_t v = 2 * k;
      faces.insert(faces.end(), {{v - 2, v - 1, v + 1}, {v - 2, v, v + 1}});
    }
    const std::uint32_t v = 2 * length;
    const double x = 2.0 * length;
    points.insert(points.end(),
                  {{x + 0.75, 0.5, 1}, {x + 2.25, 0.5, 1}, {x + 1.5, 0.5, 0.5}, {x + 1.5, 0.5, 1.5}});
    faces.insert(faces.end(), {{v - 2, v, v + 1}, {v, v + 1, v + 2}, {v, v + 1, v + 3}});
    return body_of(points, faces);
  };
  const std::string of_short = refusal(environment.snapshot(), make(4));
  EXPECT_FALSE(of_short.empty());
  EXPECT_FALSE(has_ended(of_short)) << of_short;
  const std::string of_long = refusal(environment.snapshot(), make(walls - 1));
  EXPECT_TRUE(has_ended(of_long)) << of_long;
  EXPECT_EQ(refusal(environment.snapshot(), make(walls - 1)), of_long);
}

/// Each part has two sides to choose from, but the last one has none.
TEST(RegistrationByHand, PartsOfABodyDoNotDependOnEachOther) {
  constexpr unsigned walls = 24;
  const Environment<3> environment = row_of_walls(walls);
  std::vector<Point<3>> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (unsigned k = 0; k < walls; ++k) {
    const double x = 2 * k + 0.75;
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {{x, 0.5, 1}, {x + 1.5, 0.5, 1}, {x + 0.75, 0.75, 1}});
    faces.push_back({first, first + 1, first + 2});
  }
  // It hangs from its edge.
  points.push_back({points[0][0] + 0.75, 0.5, 0.25});
  const auto last = static_cast<std::uint32_t>(points.size());
  faces.push_back({0, 1, last - 1});
  EXPECT_EQ(refusal(environment.snapshot(), body_of(points, faces)), "");
  points.insert(points.end(), {{47.5, 0.5, 0.25}, {47.5, 0.5, 1.75}});
  for (const std::uint32_t other : {last, last + 1}) faces.push_back({last - 4, last - 3, other});
  const std::string why = refusal(environment.snapshot(), body_of(points, faces));
  EXPECT_FALSE(why.empty());
  EXPECT_FALSE(has_ended(why));
}

/// A sheet in a wall, all of whose faces may be on either side, and a face that hangs from another wall.
TEST(RegistrationByHand, ManyFacesMayHaveAChoice) {
  const Environment<3> environment = row_of_walls(2);
  constexpr std::uint32_t n = 40;
  std::vector<Point<3>> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      points.push_back({1.25 + 0.0078125 * i, 0.25 + 0.0078125 * j, 1});
      if (i == n || j == n) continue;
      const std::uint32_t v = i * (n + 1) + j;
      faces.insert(faces.end(), {{v, v + 1, v + n + 2}, {v, v + n + 2, v + n + 1}});
    }
  const auto first = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), {{2.75, 0.5, 1}, {4.25, 0.5, 1}, {3.5, 0.5, 0.25}});
  faces.push_back({first, first + 1, first + 2});
  const Snapshot<3>& snapshot = environment.snapshot();
  EXPECT_NO_THROW(Body<3>(snapshot, Locator<3>(snapshot), body_of(points, faces)).validate());
}

/// A wall whose side has a corner in the middle: beside it, another wall ends there. The edge passes the
/// first part of this side between both walls and free space, and the rest in free space. Face 012 has the
/// wall above it; face 013 begins above or below both.
TEST(RegistrationByHand, AnEdgeIsOnOneSideOfAWallThoughItIsFreeFurtherOn) {
  const std::array<double, 6> x{-4, -1, 0, 0.5, 1, 4};
  const std::array<double, 5> y{-3, 0, 0.5, 2, 4};
  std::vector<Box_cell> boxes;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
      for (const double z : {-1.0, 0.0}) {
        const bool is_long = x[i] >= 0 && x[i] < 1;
        if (is_long && y[j] == 0.5) continue;
        boxes.push_back({{x[i], y[j], z}, {x[i + 1], is_long && y[j] == 0 ? 2 : y[j + 1], z + 1}});
      }
  const Cell_soup<3> soup = box_cells(boxes, [](const Box_cell& facet) {
    if (facet.low[1] != 0) return false;
    if (facet.low[2] == 0 && facet.high[2] == 0) return facet.low[0] >= -1 && facet.high[0] <= 1;
    return facet.low[0] == 0.5 && facet.high[0] == 0.5 && facet.low[2] == 0;  // stands on the wall
  });
  const Environment<3> environment = Environment<3>::build(soup);
  for (const double height : {0.5, -0.5})
    for (const bool is_turned : {false, true}) {
      std::vector<Point<3>> points{{0, -2, 0}, {0, 3, 0}, {3, 1, 0}, {-3, 1, height}};
      if (is_turned) std::swap(points[0], points[1]);
      const Body_soup<3> body = body_of(points, {{0, 1, 2}, {0, 1, 3}});
      EXPECT_EQ(Lift_judge(environment.snapshot(), body).can_be_somewhere(), height < 0);
      EXPECT_EQ(refusal(environment.snapshot(), body).empty(), height < 0) << height << is_turned;
    }
}

}  // namespace
}  // namespace cellwalk::test
