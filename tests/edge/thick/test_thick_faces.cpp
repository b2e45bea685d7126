// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces with a radius before single walls, whose times were found by hand or by an independent program in
// rationals: most of them are degenerate, or have roots that are no times.
#include <cellwalk/internal/edge/thick_wall.h>
#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace cellwalk::test {
namespace {

struct Face_before_wall {
  const char* name;
  std::array<Point<3>, 4> swept;  ///< a corner before and after its motion, and those that stand still
  std::vector<Point<3>> wall;
  double radius;
  double time = 0;                ///< rounded down
  std::array<double, 2> exact{};  ///< numerator and denominator; 0 if it has a square root
  Vector<3> towards_wall{};       ///< the shortest vector at that time, of any length
};

std::vector<Face_before_wall> blocked_faces() {
  return {
      {"becomes a segment, wall with a collinear corner",
       {{{8, 6, 3}, {8, 10, -1}, {0, 1, 4}, {2, 3, 3}}},
       {{0, 4, 2}, {2, 4, 2}, {2, 5, 2}, {2, 6, 2}, {0, 6, 2}},
       1,
       0x1.8p-1,
       {3, 4},
       {-2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0}},
      {"becomes a segment beside a side",
       {{{-6, -8, -4}, {4, -3, 6}, {0, 1, 2}, {0, 3, 2}}},
       {{1, 0, 0}, {1, 0, -4}, {1, -3, -1}, {1, -3, 3}},
       1,
       0x1.3333333333333p-1,
       {3, 5},
       {1, 0, 0}},
      {"still side at r, its corner",
       {{{2, -7, 12}, {-3, 3, 2}, {2, -1, 4}, {3, 0, 2}}},
       {{1, 1, 0}, {0, 2, 1}},
       3,
       0x1.4p-1,
       {5, 8},
       {-2, 1, -2}},
      {"still side at r, parallel to that of the wall",
       {{{4, 3, 10}, {-4, 7, 2}, {2, 6, 8}, {6, 6, 8}}},
       {{3, 6, 0}, {5, 6, 0}, {5, 8, 0}, {3, 8, 0}},
       8,
       0x1p-2,
       {1, 4},
       {0, 0, -8}},
      {"moves onto its corner at r",
       {{{-1, 0, -6}, {-1, 0, 2}, {1, 0, 0}, {-1, 0, 0}}},
       {{3, 0, 3}, {3, 2, 3}, {1, 2, 3}, {1, 1, 3}, {1, 0, 3}, {2, 0, 3}},
       3,
       0x1.8p-1,
       {3, 4},
       {0, 0, 3}},
      {"is an edge at r",
       {{{2, 3, 7}, {-2, -1, -1}, {3, 2, 5}, {3, 2, 5}}},
       {{2, 1, 1}, {5, 1, 1}, {4, 2, 1}, {3, 2, 1}},
       4,
       0x1p-2,
       {1, 4},
       {0, 0, -4}},
      {"roots before and after",
       {{{1, 1, -4}, {1, 1, 8}, {1, 4, -1}, {0, 4, 0}}},
       {{2, 0, 4}, {3, 0, 4}, {3, 2, 4}, {1, 2, 4}, {1, 1, 4}},
       2,
       0x1p-1,
       {1, 2},
       {0, 0, 2}},
      {"lower root",
       {{{1, 5, 2}, {-1, 1, 6}, {4, 3, 4}, {0, 4, 5}}},
       {{1, 0, 3}, {3, 0, 3}, {4, 1, 3}, {2, 3, 3}, {1, 1, 3}},
       1,
       0x1.66ff96db4951ep-6,
       {0, 0},
       {-0.312093451788, -0.872560710729, -0.375813096424}},
      {"upper root",
       {{{-1, 0, 3}, {3, 1, 3}, {1, -1, 3}, {2, 0, 0}}},
       {{3, 0, 3}, {5, 0, 3}, {6, 1, 3}, {4, 3, 3}, {3, 1, 3}},
       2,
       0x1.be98eaeb4868ap-2,
       {0, 0},
       {1.83663655161, 0.326726896772, 0.721121149462}},
      {"becomes parallel to the wall",
       {{{0, 3, 7}, {5, -2, -3}, {-1, 0, 1}, {-1, -2, 1}}},
       {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {0, 1, 0}},
       1,
       0x1.3333333333333p-1,
       {3, 5},
       {0, 0, -1}},
      {"in the plane of the wall",
       {{{5, -2, 2}, {-3, 6, 2}, {-1, 0, 2}, {-1, -1, 2}}},
       {{1, 1, 2}, {3, 1, 2}, {4, 2, 2}, {2, 4, 2}, {1, 2, 2}},
       1,
       0x1p-2,
       {1, 4},
       {0, 1, 0}},
      {"starts as a segment at r",
       {{{6, 2, 0}, {4, 0, 2}, {-2, -2, 0}, {0, -1, 0}}},
       {{3, 2, 3}, {7, 2, 7}, {7, 5, 4}, {3, 5, 0}},
       3,
       0x0p+0,
       {0, 1},
       {-1, 2, 2}},
      {"is a segment all the way",
       {{{2, 2, 2}, {-2, -2, -2}, {3, 3, 3}, {2, 2, 2}}},
       {{1, 0, 0}, {3, 0, 0}, {3, 2, 0}, {1, 2, 0}},
       1,
       0x1p-2,
       {1, 4},
       {0, 0, -1}},
      {"starts as an edge",
       {{{2, 1, 3}, {1, -1, 3}, {4, 2, 3}, {2, 1, 3}}},
       {{2, 0, 4}, {0, 0, 2}, {2, -2, 4}, {4, -2, 6}},
       1,
       0x1.c71c71c71c71cp-4,
       {1, 9},
       {-4.0 / 9.0, -7.0 / 9.0, 4.0 / 9.0}},
      {"a row vanishes before",
       {{{6, 6, -7}, {-4, 1, 3}, {2, 4, 0}, {4, 2, 0}}},
       {{2, 1, 1}, {2, -1, -1}, {2, -3, -2}, {2, -3, 0}, {2, 0, 1}},
       2,
       0x1.3333333333333p-1,
       {3, 5},
       {-2.0 / 3.0, -4.0 / 3.0, 4.0 / 3.0}},
      {"nearest on its border",
       {{{1, -1, 5}, {1, 2, 5}, {0, 0, 0}, {3, 0, 0}}},
       {{0, 3, 1}, {1, 1, 3}, {0, 2, 1}},
       1,
       0x1.5555555555555p-2,
       {1, 3},
       {0, 1, 0}},
      {"spike",
       {{{4, 9, 6}, {4, 9, 2}, {0, 0, 6}, {8, 0, 6}}},
       {{4, 3, 0}, {4, 5, 0}, {4, 4, 4}},
       1,
       0x1.17a2f5abad5a2p-1,
       {0, 0},
       {0, -0.235889894354, -0.971779788708}},
      {"still side at r, inside",
       {{{-2, 4, 8}, {6, 4, -8}, {4, 0, 1}, {4, 8, 1}}},
       {{4, 4, 0}, {3, 3, -2}, {5, 3, -2}},
       1,
       0x1.cp-2,
       {7, 16},
       {0, 0, -1}},
      {"still side at r, across one of the wall",
       {{{8, 0, 5}, {13, -10, -5}, {2, 4, 1}, {4, 2, 1}}},
       {{1, 2, 0}, {3, 2, 0}, {3, 4, 0}, {1, 4, 0}},
       1,
       0x1.9999999999999p-2,
       {2, 5},
       {0, 0, -1}},
  };
}

/// They come as near as their radius.
std::vector<Face_before_wall> free_faces() {
  return {
      {"tangent to the half-space of the ridge at r",
       {{{8, 4, 1}, {0, 4, 1}, {4, 0, 1}, {4, 8, 1}}},
       {{4, 4, 0}, {3, 3, -2}, {5, 3, -2}},
       1},
      {"turns through the line of the ridge in the plane at r",
       {{{8, 4, 1}, {0, 2, 1}, {4, 0, 1}, {4, 8, 1}}},
       {{2, 2, 0}, {6, 2, 0}, {6, 6, 0}, {2, 6, 0}},
       1},
      {"target exactly at r, face/vertex",
       {{{4, 9, 8}, {4, 9, 5}, {0, 0, 5}, {8, 0, 5}}},
       {{4, 3, 0}, {4, 5, 0}, {4, 4, 4}},
       1},
      {"coplanar with the wall, slides along a side at r",
       {{{0, -1, 0}, {8, -1, 0}, {2, -3, 0}, {6, -3, 0}}},
       {{2, 0, 0}, {6, 0, 0}, {6, 4, 0}, {2, 4, 0}},
       1},
      {"touches on the way (p passes a corner at r), p crosses the line of the ridge",
       {{{0, 0, 3}, {8, 0, 3}, {4, -2, 3}, {4, -6, 3}}},
       {{4, 0, 2}, {3, 0, 0}, {5, 0, 0}},
       1},
  };
}

bool is_apart(const Face_before_wall& c, double radius) {
  Vector<3> direction{};
  Distance_counts uncounted;
  return detail::is_apart<3>(c.swept, c.wall, radius, direction, uncounted);
}

TEST(ThickFaces, AreBlockedAtTheirTimes) {
  for (const Face_before_wall& c : blocked_faces())
    for (const bool is_turned : {false, true}) {
      SCOPED_TRACE(c.name);
      ASSERT_FALSE(is_apart(c, c.radius));
      std::array<Point<3>, 4> swept = c.swept;
      if (is_turned) std::swap(swept[2], swept[3]);
      const auto met = detail::first_meeting<3>(swept, c.wall, c.radius);
      ASSERT_TRUE(met);
      EXPECT_EQ(met->time.rounded(), c.time);
      if (c.exact[1] != 0) {
        EXPECT_EQ(met->time, to_time(Fraction(Ring(c.exact[0]), Ring(c.exact[1]))));
      }
      EXPECT_LT(length(met->normal - normalized(c.towards_wall)), 1e-9);
    }
}

TEST(ThickFaces, AreFreeAtTheirRadius) {
  for (const Face_before_wall& c : free_faces()) {
    SCOPED_TRACE(c.name);
    EXPECT_TRUE(is_apart(c, c.radius));
    EXPECT_FALSE(is_apart(c, c.radius * (1 + 0x1p-52)));
  }
}

}  // namespace
}  // namespace cellwalk::test
