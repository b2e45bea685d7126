// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "records/body_checks.h"

namespace cellwalk {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

template <int D>
std::vector<Point<D>> points(std::size_t n) {
  std::vector<Point<D>> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i][0] = static_cast<double>(i);
  return result;
}

template <int D>
std::string refusal(const Body_parts<D>& parts) {
  try {
    make_body(parts);
  } catch (const Error& e) {
    EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(Error_code::input));
    return e.what();
  }
  return "accepted";
}

TEST(MakeBody, SortsEdgesAndDropsThoseThatRepeat) {
  const auto made = make_body<3>({points<3>(5), {}, {{3, 1}, {0, 1}, {1, 3}, {2, 2}}});
  EXPECT_EQ(made.body.edges, (Edges{{0, 1}, {1, 3}}));
  EXPECT_TRUE(made.body.faces.empty());
  EXPECT_EQ(made.null_edges, 1u);
  EXPECT_EQ(made.unused_points, 2u);  // 2 and 4
  EXPECT_EQ(made.body.points, points<3>(5));
}

TEST(MakeBody, GivesTrianglesTheirSidesAndKeepsTheFirstOfEqualOnes) {
  const auto made = make_body<3>({points<3>(4), {{2, 1, 0}, {0, 1, 3}, {1, 2, 0}, {0, 1, 2}, {1, 1, 3}}, {}});
  EXPECT_EQ(made.body.faces, (Faces{{0, 2, 1}, {0, 1, 3}}));
  EXPECT_EQ(made.body.edges, (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}));
  EXPECT_EQ(made.repeated_faces, 2u);
  EXPECT_EQ(made.degenerate_faces, 1u);
  EXPECT_EQ(made.null_edges, 1u);
  EXPECT_EQ(made.cut_polygons, 0u);
  EXPECT_EQ(made.unused_points, 0u);
}

TEST(MakeBody, CutsAPolygonAlikeFromBothSides) {
  const auto made = make_body<3>({points<3>(6), {{5, 3, 1, 4, 2}, {1, 3, 5, 2, 4}}, {}});
  EXPECT_EQ(made.body.faces, (Faces{{1, 4, 2}, {1, 2, 5}, {1, 5, 3}}));
  EXPECT_EQ(made.cut_polygons, 2u);
  EXPECT_EQ(made.repeated_faces, 3u);
  EXPECT_EQ(made.body.edges, (Edges{{1, 2}, {1, 3}, {1, 4}, {1, 5}, {2, 4}, {2, 5}, {3, 5}}));
}

TEST(MakeBody, TakesOnlyTheSidesInThePlane) {
  const auto made = make_body<2>({points<2>(4), {{0, 1, 2, 3}, {2, 1, 0}}, {}});
  EXPECT_EQ(made.body.edges, (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_TRUE(made.body.faces.empty());
  EXPECT_EQ(made.cut_polygons, 0u);
}

TEST(MakeBody, TakesTwoCornersForAnEdgeAndFewerForNothing) {
  const auto made = make_body<3>({points<3>(3), {{2, 0}, {1}, {}}, {}});
  EXPECT_EQ(made.body.edges, (Edges{{0, 2}}));
  EXPECT_EQ(made.unused_points, 1u);
  EXPECT_TRUE(make_body<2>({}).body.points.empty());
}

TEST(MakeBody, RefusesWhatIsOutOfRange) {
  EXPECT_EQ(refusal<3>({points<3>(3), {{0, 1, 2}, {0, 1, 3}}, {}}), "body: polygon 1 names point 3, of 3");
  EXPECT_EQ(refusal<2>({points<2>(3), {}, {{0, 1}, {0, 1}, {7, 1}}}), "body: segment 2 names point 7, of 3");
  auto broken = points<3>(3);
  broken[1][2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal<3>({broken, {}, {}}), "body: point 1 has a coordinate that is not finite");
}

TEST(MakeBody, GivesAnEdgeTheLargestRadiusOfItsSegments) {
  Body_parts<3> parts{points<3>(5), {{0, 1, 2}}, {{3, 1}, {0, 1}, {1, 3}, {4, 4}}, {0.25, 0.5, 0.75, 9}};
  const auto made = make_body(parts);
  EXPECT_EQ(made.body.edges, (Edges{{0, 1}, {0, 2}, {1, 2}, {1, 3}}));
  EXPECT_EQ(made.body.radii, (std::vector<double>{0.5, 0, 0, 0.75}));
  parts.radii = {0, -0.0, 0, 0};
  EXPECT_TRUE(make_body(parts).body.radii.empty());
}

TEST(MakeBody, RefusesRadiiThatAreNone) {
  const std::string what = "body: the radius of segment 1 takes a finite number of at least 0, not ";
  const Body_parts<2> parts{points<2>(3), {}, {{0, 1}, {1, 2}}, {1, -1}};
  EXPECT_EQ(refusal<2>(parts), what + "-1");
  EXPECT_EQ(refusal<2>({parts.points, {}, parts.segments, {1, std::numeric_limits<double>::quiet_NaN()}}),
            what + "nan");
  EXPECT_EQ(refusal<2>({parts.points, {}, parts.segments, {1, std::numeric_limits<double>::infinity()}}),
            what + "inf");
  EXPECT_EQ(refusal<2>({parts.points, {}, parts.segments, {1}}),
            "body: 1 radii for 2 segments: give one for each, or none");
}

/// Random parts against sets: every side and segment is an edge, every edge comes from somewhere, and so on.
TEST(MakeBody, AgreesWithSetsOnRandomParts) {
  Random random(3);
  std::size_t repeated = 0, degenerate = 0, cut = 0, null = 0, unused = 0, thick = 0;
  for (int round = 0; round < 300; ++round) {
    Body_parts<3> parts;
    const std::uint64_t n = 1 + random.below(9);
    parts.points = points<3>(n);
    const auto index = [&] { return static_cast<std::uint32_t>(random.below(n)); };
    for (std::uint64_t k = random.below(6); k > 0; --k) {
      parts.segments.push_back({index(), index()});
      parts.radii.push_back(static_cast<double>(random.below(4)));
    }
    for (std::uint64_t k = random.below(6); k > 0; --k) {
      parts.polygons.emplace_back();
      for (std::uint64_t c = random.below(6); c > 0; --c) parts.polygons.back().push_back(index());
    }
    const auto made = make_body(parts);
    ASSERT_EQ(test::flaw(made.body), "");
    std::set<std::array<std::uint32_t, 2>> given;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
      if (a != b) given.insert({std::min(a, b), std::max(a, b)});
    };
    for (const auto& s : parts.segments) add(s[0], s[1]);
    for (const auto& loop : parts.polygons)
      for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()]);
    for (const auto& e : given)
      EXPECT_TRUE(std::binary_search(made.body.edges.begin(), made.body.edges.end(), e));
    for (const auto& f : made.body.faces)
      for (std::size_t i = 0; i < 3; ++i) add(f[i], f[(i + 1) % 3]);
    EXPECT_EQ(made.body.edges, Edges(given.begin(), given.end()));
    std::map<std::array<std::uint32_t, 2>, double> radii;
    for (std::size_t i = 0; i < parts.segments.size(); ++i) {
      const auto [u, v] = parts.segments[i];
      double& radius = radii[{std::min(u, v), std::max(u, v)}];
      radius = std::max(radius, parts.radii[i]);
    }
    for (std::size_t e = 0; e < made.body.radii.size(); ++e)
      EXPECT_EQ(made.body.radii[e], radii[made.body.edges[e]]);
    thick += !made.body.radii.empty();
    repeated += made.repeated_faces, degenerate += made.degenerate_faces, cut += made.cut_polygons;
    null += made.null_edges, unused += made.unused_points;
  }
  EXPECT_GE(repeated, 20u);
  EXPECT_GE(degenerate, 100u);
  EXPECT_GE(cut, 100u);
  EXPECT_GE(null, 100u);
  EXPECT_GE(unused, 100u);
  EXPECT_GE(thick, 100u);
}

}  // namespace
}  // namespace cellwalk
