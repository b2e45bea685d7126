// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces of bodies: beside slits, and after moves that left them alone.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {
namespace {

/// A box above and a box below the plane y = 0, x from 0 to 2. From x = 1 on they share a facet. Before it
/// each has walls of its own, one and two: a slit.
Snapshot<3> beside_a_slit() {
  Cell_soup<3> soup;
  const std::vector<Point<2>> outline{{0, 0}, {0.5, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}, {2, -1}, {0, -1}};
  for (const double z : {0.0, 1.0})
    for (const Point<2>& x : outline) soup.points.push_back({x[0], x[1], z});
  const auto prism = [&soup](std::initializer_list<std::uint32_t> corners) {
    const std::vector<std::uint32_t> base(corners);
    std::vector<std::uint32_t> top;
    for (const std::uint32_t v : base) top.push_back(v + 8);
    soup.add_facet(std::vector<std::uint32_t>(base.rbegin(), base.rend()));
    soup.add_facet(top);
    for (std::size_t k = 0; k < base.size(); ++k) {
      const std::uint32_t u = base[k], v = base[(k + 1) % base.size()];
      soup.add_facet({u, v, v + 8, u + 8});
    }
    soup.end_cell();
  };
  prism({0, 2, 3, 4, 5});
  prism({7, 6, 3, 2, 1, 0});
  return compile(soup);
}

TEST(BodyFaces, ASlitIsMetFromBothSides) {
  const Snapshot<3> snapshot = beside_a_slit();
  for (const double side : {1.0, -1.0}) {
    const double y = 0.25 * side;
    Body<3> body(snapshot, Locator<3>(snapshot),
                 {{{0.25, y, 0.25}, {1.5, y, 0.5}, {0.25, y, 0.75}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}});
    Body_options options;
    options.sweep.sweep = Sweep::faces;
    Body_counts counts;
    const auto move = [&](std::uint32_t v, double to) {
      Point<3> target = body.positions()[v];
      target[1] = to;
      const auto contact = body.move_vertex(v, target, options, counts);
      EXPECT_NO_THROW(body.validate());
      return contact.has_value();
    };
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_FALSE(move(v, 0)) << "on it";
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_TRUE(move(v, -y)) << "through it";
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_FALSE(move(v, y)) << "off it";
    EXPECT_TRUE(move(0, -y));
  }
}

/// A room with a large block in one of its corners.
Snapshot<3> round_a_corner() {
  std::vector<std::uint32_t> solid;
  for (std::uint32_t z = 0; z < 3; ++z)
    for (std::uint32_t y = 4; y < 12; ++y)
      for (std::uint32_t x = 4; x < 12; ++x) solid.push_back(x + 12 * (y + 12 * z));
  return rooms<3>({12, 12, 3}, solid);
}

/// A strip of triangles that lies in a room, and how it is moved.
struct Strip {
  static constexpr std::uint32_t all = 8;  ///< its vertices

  explicit Strip(const Snapshot<3>& snapshot, const Point<3>& at)
      : body(snapshot, Locator<3>(snapshot), soup(at)) {
    options.sweep.sweep = Sweep::triangle;
  }

  static Body_soup<3> soup(const Point<3>& at) {
    Body_soup<3> soup;
    constexpr std::uint32_t count = all;
    for (std::uint32_t v = 0; v < count; ++v)
      soup.points.push_back({at[0] + 0.1 * v, at[1] + (v % 2) * 0.3, at[2]});
    for (std::uint32_t v = 0; v + 1 < count; ++v) {
      soup.edges.push_back({v, v + 1});
      if (v + 2 == count) break;
      soup.edges.push_back({v, v + 2});
      soup.faces.push_back({v, v + 1, v + 2});
    }
    return soup;
  }

  void step(const Vector<3>& by, std::uint32_t only = all) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (std::uint32_t v = 0; v < targets.size(); ++v)
      if (only == all || v == only) targets[v] = targets[v] + by;
    body.step(targets, options, report, counts);
  }

  Body<3> body;
  Body_options options;
  Body_counts counts;
  Step_report<3> report;
};

/// Round a corner, nearly all the way without tests: particles and chains are where they were. Then faces are
/// asked about.
TEST(BodyFaces, AreRegisteredWhereTheBodyIs) {
  const Snapshot<3> snapshot = round_a_corner();
  Strip strip(snapshot, {10, 1.7, 1.5});
  for (int k = 0; k < 85; ++k) strip.step({-0.1, 0, 0});
  for (int k = 0; k < 80; ++k) strip.step({0, 0.1, 0});
  EXPECT_TRUE(strip.report.contacts.empty());
  EXPECT_GT(strip.counts.in_region, 1000u);
  strip.step({0, 0, -5}, 7);
  EXPECT_FALSE(strip.report.contacts.empty()) << "on the floor";
  strip.options.sweep.sweep = Sweep::faces;
  EXPECT_NO_THROW(strip.step({0, 0, 1}, 7));
  strip.body.refresh(strip.counts);
  EXPECT_NO_THROW(strip.body.validate());
}

/// Whatever sweep comes after whatever other, and whether or not everything is caught up with in between: the
/// same.
TEST(BodyFaces, AnyOrderOfSweepsIsTheSame) {
  const Snapshot<3> snapshot = round_a_corner();
  Random random(5);
  int steps = 0, with_faces = 0;
  Body_counts counts;
  for (int trial = 0; trial < 60; ++trial) {
    const Point<3> at{random.real(0.2, 11), random.real(0.2, 3.4), random.real(0.2, 2.8)};
    std::optional<Strip> lazy;
    try {
      lazy.emplace(snapshot, at);
    } catch (const Error&) {
      continue;  // no room there
    }
    Strip eager = *lazy, plain = *lazy;
    plain.options.clearance = false;
    Vector<3> drift{};
    Sweep sweep{};
    for (int k = 0; k < 120; ++k, ++steps) {
      if (k % 30 == 0) {
        sweep = static_cast<Sweep>(random.below(3));
        drift = {random.real(-0.2, 0.2), random.real(-0.2, 0.2), random.real(-0.02, 0.02)};
      }
      const auto only =
          static_cast<std::uint32_t>(random.below(4) == 0 ? random.below(Strip::all) : Strip::all);
      Vector<3> by = drift;
      for (double& x : by) x += random.real(-0.02, 0.02);
      for (Strip* strip : {&*lazy, &eager, &plain}) {
        strip->options.sweep.sweep = sweep;
        strip->report.clear();
        ASSERT_NO_THROW(strip->step(by, only)) << trial << " " << k;
      }
      for (Strip* strip : {&eager, &plain}) {
        strip->body.refresh(strip->counts);
        ASSERT_NO_THROW(strip->body.validate()) << trial << " " << k;
        ASSERT_TRUE(std::ranges::equal(lazy->body.positions(), strip->body.positions())) << trial << " " << k;
        ASSERT_EQ(lazy->report.contacts.size(), strip->report.contacts.size()) << trial << " " << k;
      }
      with_faces += sweep == Sweep::faces;
    }
    counts += lazy->counts;
  }
  EXPECT_GT(steps, 1000);
  EXPECT_GT(with_faces, 300);
  EXPECT_GT(counts.in_region, 1000u);
  EXPECT_GT(counts.catch_ups, 300u);
  EXPECT_GT(counts.contacts, 100u);
  EXPECT_GT(counts.faces.walls, 100u);
}

}  // namespace
}  // namespace cellwalk::test
