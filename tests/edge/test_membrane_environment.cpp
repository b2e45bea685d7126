// SPDX-License-Identifier: LGPL-3.0-or-later
// Any triangle can be made a membrane of a certified environment, however thin, small or far out it is.
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <gtest/gtest.h>

#include <iostream>
#include <stdexcept>

#include "edge/membrane_environment.h"
#include "edge/rational_touch.h"

namespace cellwalk::test {
namespace {

using Triangle = std::array<Point<3>, 3>;

Point<3> random_point(Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

/// Thin ones have a corner within 2^-40 of the line of the others, beyond their ends now and then.
Triangle needle(Random& random) {
  const Point<3> a = random_point(random, 1), b = random_point(random, 1);
  return {a, b, a + random.real(-0.5, 1.5) * (b - a) + random_point(random, 0x1p-40)};
}

Triangle on_axes(Random& random) {
  const std::size_t axis = random.below(3);
  Triangle t;
  for (auto& p : t) {
    for (double& x : p) x = static_cast<double>(random.below(5)) - 2;
    p[axis] = 1;
  }
  return t;
}

struct Membrane_seen {
  int triangles = 0, walks = 0, blocked = 0;
};

void check_membrane(const Triangle& t, std::span<const Point<3>> inside, Membrane_seen& seen) {
  ++seen.triangles;
  Build_report report;
  const Environment<3> environment = membrane_environment(t, inside, &report);
  const Certificate& c = report.certificate;
  EXPECT_EQ(c.cells, 14u);
  EXPECT_EQ(c.facets, 31u);
  EXPECT_EQ(c.vertices, 8u);
  EXPECT_EQ(c.boundary_facets, 6u);
  EXPECT_EQ(c.membranes, 1u);
  EXPECT_EQ(c.walls, 7u);
  EXPECT_EQ(c.components, 1u);
  EXPECT_FALSE(report.flipped);

  const Snapshot<3>& snapshot = environment.snapshot();
  const Cell above = snapshot.cell(0), below = snapshot.cell(1);
  const Half_facet membrane = Snapshot<3>::half_facet(above, 0);
  EXPECT_TRUE(snapshot.is_impassable(membrane));
  EXPECT_EQ(snapshot.neighbour(membrane), below);
  Triangle corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = snapshot.point(snapshot.loop(membrane)[i]);
  EXPECT_EQ(corners, (Triangle{t[0], t[2], t[1]}));

  const Locator<3> locator(snapshot);
  Walk_counts counts;
  // At each corner a particle passes from one side to the other: free space goes round the rim.
  const Point<3> lower_pole = snapshot.point(4);
  for (const Point<3>& corner : t) {
    EXPECT_EQ(locator.locate(corner).sides.size(), 1);
    Particle<3> particle{corner, above, 0, 0};
    EXPECT_EQ(move(snapshot, particle, lower_pole, counts).status, Walk_status::arrived);
  }
  // The points lie well inside, and between them the triangle is in the way, all of it and nothing else.
  for (const Point<3>& from : inside) {
    EXPECT_EQ(locator.locate(t[0] + 4.0 * (from - t[0])).status, Location_status::free);
    for (const Point<3>& to : inside) {
      Particle<3> particle = locator.particle_at(from).value();
      ASSERT_NE(particle.cell, Cell::none);
      const bool is_blocked = move(snapshot, particle, to, counts).status == Walk_status::contact;
      EXPECT_EQ(is_blocked, touch_of_point(from, to, t).any());
      ++seen.walks;
      seen.blocked += is_blocked;
    }
  }
}

/// Points in pairs that see each other through the triangle or just past it, and others.
std::vector<Point<3>> points_round(const Triangle& t, Random& random, double size) {
  std::vector<Point<3>> points;
  for (int k = 0; k < 3; ++k) {
    const Point<3> on = t[0] + random.real(0, 0.7) * (t[1] - t[0]) + random.real(0, 0.7) * (t[2] - t[0]);
    const Vector<3> path = random_point(random, size);
    points.push_back(on + path);
    points.push_back(on - random.real(0.1, 1) * path);
  }
  return points;
}

template <class Make>
void check_kind(const char* kind, int triangles, double size, Make make) {
  Random random(7);
  Membrane_seen seen;
  while (seen.triangles < triangles) {
    const Triangle t = make(random);
    if (!are_collinear(t[0], t[1], t[2])) check_membrane(t, points_round(t, random, size), seen);
  }
  std::cout << kind << ": " << seen.triangles << " triangles, " << seen.walks << " walks, " << seen.blocked
            << " blocked\n";
  EXPECT_GT(seen.blocked, seen.walks / 20);
  EXPECT_LT(seen.blocked, seen.walks / 2);
}

TEST(MembraneEnvironment, HoldsAnyTriangle) {
  check_kind("any", 100, 1, [](Random& random) {
    return Triangle{random_point(random, 1), random_point(random, 1), random_point(random, 1)};
  });
}

TEST(MembraneEnvironment, HoldsNeedles) { check_kind("needles", 100, 1, needle); }

TEST(MembraneEnvironment, HoldsTrianglesOnAxes) { check_kind("on axes", 100, 1, on_axes); }

TEST(MembraneEnvironment, HoldsTinyOnesInLargeScenes) {
  // A triangle of 2^-44 round the origin in a scene of size 1, seen from points that aim at it.
  check_kind("tiny", 100, 1, [](Random& random) {
    return Triangle{random_point(random, 0x1p-44), random_point(random, 0x1p-44),
                    random_point(random, 0x1p-44)};
  });
}

TEST(MembraneEnvironment, HoldsTrianglesFarFromTheOrigin) {
  check_kind("far out", 100, 0x1p-10, [](Random& random) {
    const Point<3> far = random_point(random, 0x1p+20);
    return Triangle{far + random_point(random, 0x1p-20), far + random_point(random, 0x1p-20),
                    far + random_point(random, 0x1p-20)};
  });
}

TEST(MembraneEnvironment, HoldsTrianglesAtAnyScale) {
  for (const double scale : {0x1p-300, 0x1p+300})
    check_kind("scaled", 50, scale, [scale](Random& random) {
      return Triangle{random_point(random, scale), random_point(random, scale), random_point(random, scale)};
    });
}

TEST(MembraneEnvironment, RefusesPointsOnALine) {
  EXPECT_THROW(membrane_environment({{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace cellwalk::test
