// SPDX-License-Identifier: LGPL-3.0-or-later
// What edges say: copies of facets, T-junctions, components, shells and bands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "repaired.h"

namespace cellwalk {
namespace {

using test::box;
using test::cube;
using test::join;
using test::refusal;
using test::repair;
using test::Repaired;
using test::turned_by_angles;

double volume(const Surface_soup& surface) { return repair(surface).certificate.free_volume; }

/// A neighbour has the middle of a side as a corner: the side is split, and no gap is left to be capped.
TEST(RepairOfEdges, CornersOnSides) {
  for (const double off : {0.0, 1e-7}) {  // in the plane, and beside the side
    Surface_soup surface = cube({0, 0, 0}, 2);
    const std::vector<std::uint32_t> quad = surface.facets[0];
    surface.points.push_back(0.5 * (surface.points[quad[0]] + surface.points[quad[1]]) +
                             Vector<3>{0, off, 0});
    surface.facets[0] = {quad[0], 8, quad[1], quad[2], quad[3]};
    const Repaired r = repair(surface);
    EXPECT_EQ(r.step("split").substr(0, 26), "1 side split at a point on") << off;
    EXPECT_TRUE(r.report.parts.empty());
    EXPECT_NEAR(r.certificate.free_volume, 8, 1e-6);
  }
}

/// A facet given twice goes if that closes the surface, in whatever direction it is given. Boxes that share a
/// part of their walls keep both, with or without a triangle missing.
TEST(RepairOfEdges, CopiesOfFacets) {
  for (const bool is_turned : {false, true}) {
    Surface_soup twice = cube({0, 0, 0}, 2);
    std::vector<std::uint32_t> copy = twice.facets[2];
    if (is_turned) std::reverse(copy.begin(), copy.end());
    twice.facets.push_back(copy);
    const Repaired r = repair(twice);
    EXPECT_EQ(r.step("repeated").substr(0, 31), "2 facets given twice left out, ") << is_turned;
    EXPECT_EQ(r.step("sheets"), "");
    EXPECT_DOUBLE_EQ(r.certificate.free_volume, 8);
  }
  const Surface_soup shared = join(box({0, 0, 0}, {2, 2, 2}), box({0, 0, 0}, {2, 2, 3}));
  for (std::size_t left_out = 0; left_out <= shared.facets.size(); ++left_out) {
    Surface_soup surface = shared;
    if (left_out < shared.facets.size())
      surface.facets.erase(surface.facets.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Repaired r = repair(surface);
    EXPECT_EQ(r.step("repeated"), "") << left_out;
    EXPECT_DOUBLE_EQ(r.certificate.free_volume, 12) << left_out;
  }
}

/// A box that stands on the wall of another one, inside it, is a hollow in it only if its facets are turned
/// inside out, also where rounding parts the two.
TEST(RepairOfEdges, ComponentsThatTouchFromInside) {
  const Surface_soup outer = box({0, 0, 0}, {4, 4, 4}), inner = box({0, 1, 1}, {2, 3, 3});
  for (double angle = 0; angle < 3; angle += 0.3) {
    EXPECT_NEAR(volume(turned_by_angles(join(outer, inner), angle)), 64, 1e-9) << angle;
    EXPECT_NEAR(volume(turned_by_angles(join(outer, test::turned(inner)), angle)), 56, 1e-9) << angle;
  }
  EXPECT_DOUBLE_EQ(volume(join(outer, box({1, 1, 1}, {2, 3, 3}))), 60);
}

/// Of bodies with a common corner or edge, one may be given inside out.
TEST(RepairOfEdges, ComponentsThatShareCorners) {
  const Surface_soup one = cube({0, 0, 0}, 2);
  for (const Point<3>& at : {Point<3>{2, 2, 2}, {2, 2, 0}})
    EXPECT_DOUBLE_EQ(volume(join(one, test::turned(cube(at, 2)))), 16);
}

/// A shell inside another one stays a hollow if triangles of it are missing: it is no sheet.
TEST(RepairOfEdges, HollowWithAHole) {
  const Surface_soup hollow = join(cube({0, 0, 0}, 4), cube({1, 1, 1}, 2));
  for (std::size_t f = 6; f < 12; ++f) {
    Surface_soup open = hollow;
    open.facets.erase(open.facets.begin() + static_cast<std::ptrdiff_t>(f));
    const Repaired r = repair(open);
    EXPECT_EQ(r.step("sheets"), "") << f;
    EXPECT_DOUBLE_EQ(r.certificate.free_volume, 56) << f;
  }
}

/// Two plates that face each other are no thick wall, nor is the gap between them a lumen.
TEST(RepairOfEdges, PlatesHaveNoLumen) {
  const Surface_soup plates = join(box({0, 0, 0}, {9, 9, 1}), box({0, 0, 6}, {9, 9, 7}));
  Surface_soup open = plates;
  open.facets.pop_back();
  const Repaired r = repair(open);
  EXPECT_EQ(r.step("lumen"), "");
  EXPECT_DOUBLE_EQ(r.certificate.free_volume, 162);
}

/// A channel with the profile of a horseshoe: rays from one leg meet the other one, but what is between them
/// is open.
TEST(RepairOfEdges, AChannelThatBendsBackIsNoWall) {
  Surface_soup s;
  // Around the profile; two corners in the middle of straight sides part it into three quadrangles.
  const std::array<std::array<double, 2>, 8> profile{
      {{0, 0}, {1, 0}, {9, 0}, {10, 0}, {10, 10}, {9, 10}, {9, 1}, {1, 1}}};
  for (const double z : {0., 9.})
    for (const auto& [x, y] : profile) s.points.push_back({x, y, z});
  s.points.push_back({0, 10, 0}), s.points.push_back({1, 10, 0});
  s.points.push_back({0, 10, 9}), s.points.push_back({1, 10, 9});
  constexpr std::uint32_t a = 16, b = 17;  // the ends of the first leg; 2 higher on the other side
  const std::vector<std::vector<std::uint32_t>> quadrangles{{0, 1, 7, b, a}, {1, 2, 6, 7}, {2, 3, 4, 5, 6}};
  const auto above = [](std::uint32_t v) { return v < 8 ? v + 8 : v + 2; };
  for (const auto& q : quadrangles) {
    s.facets.push_back({q.rbegin(), q.rend()});
    s.facets.emplace_back();
    for (const std::uint32_t v : q) s.facets.back().push_back(above(v));
  }
  const std::vector<std::uint32_t> around{0, 1, 2, 3, 4, 5, 6, 7, b, a};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::uint32_t v = around[i], w = around[(i + 1) % around.size()];
    s.facets.push_back({v, w, above(w), above(v)});
  }
  const double volume = 9 * (10 + 8 + 10);
  EXPECT_DOUBLE_EQ(repair(s).certificate.free_volume, volume);
  s.facets.erase(s.facets.begin() + 8);  // an open end, so that no closed surface speaks for itself
  const Repaired open = repair(s);
  EXPECT_EQ(open.step("lumen"), "");
  EXPECT_NEAR(open.certificate.free_volume, volume, 1e-9);
}

/// A refusal says where directions, or the two sides of a band, are the reason.
TEST(RepairOfEdges, RefusalsNameTheBand) {
  Surface_soup band;
  constexpr std::uint32_t n = 24;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    for (const double side : {-0.4, 0.4}) {
      const double r = 2 + side * std::cos(a / 2);
      band.points.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(a / 2)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    band.facets.push_back({a, c, b}), band.facets.push_back({b, c, d});
  }
  const std::string problem = refusal([&] { repair(join(cube({8, 0, 0}, 2), band)); });
  EXPECT_NE(problem.find("one-sided band"), std::string::npos) << problem;
}

}  // namespace
}  // namespace cellwalk
