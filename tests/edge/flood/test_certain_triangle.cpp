// SPDX-License-Identifier: LGPL-3.0-or-later
// What float lanes prove of a swept triangle and a facet, judged in rational arithmetic: in general position,
// touching in a point, a line or a plane, needles, tiny moves, all sizes and scales, and where coordinates
// are rounded as badly as can be.
#include <cellwalk/internal/edge/certain_triangle.h>
#include <cellwalk/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "edge/facet_shape.h"
#include "edge/flood/triangle_trials.h"

namespace cellwalk::test {
namespace {

using detail::Certain_meeting;
using detail::Certain_triangle;
using detail::Facet_corners;

struct Meetings_seen {
  int met = 0, missed = 0, open = 0, false_met = 0, false_missed = 0, uncertain = 0;

  int wrong() const { return false_met + false_missed; }
  int all() const { return met + missed + open; }
};

template <int D>
Certain_meeting meeting_of(const Triangle_trial<D>& x, const Plane_frame<D>& frame,
                           const Certain_triangle<D>& triangle) {
  const Cell_shape shape = facet_shape(x.loop.size());
  std::vector<std::uint32_t> vertices(x.loop.size());
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::vector<Facet_corners<D>> corners;
  detail::append_corners<D>(frame, {&shape, vertices, x.loop}, 0, corners);
  const auto lane = static_cast<unsigned>(x.loop.size() % 4);
  return triangle.meeting(corners, triangle.sides(block_of<D>(x.loop, frame, lane)), lane);
}

/// Judges a triangle whose corners are named in all orders, and a facet seen from both sides.
template <int D>
void judge(Triangle_trial<D> x, Meetings_seen& seen, const Plane_frame<D>& frame = {}) {
  const bool should_meet = do_meet(x);
  for (int order = 0; order < 6; ++order) {
    if (order % 2 == 0)
      std::swap(x.t.a, x.t.b);
    else
      std::swap(x.t.b, x.t.q);
    std::reverse(x.loop.begin(), x.loop.end());
    const Certain_triangle<D> triangle(frame, x.t);
    if (!triangle.is_certain()) {
      ++seen.uncertain;
      continue;
    }
    const Certain_meeting meeting = meeting_of(x, frame, triangle);
    seen.met += meeting == Certain_meeting::met;
    seen.missed += meeting == Certain_meeting::missed;
    seen.open += meeting == Certain_meeting::open;
    seen.false_met += meeting == Certain_meeting::met && !should_meet;
    seen.false_missed += meeting == Certain_meeting::missed && should_meet;
  }
}

TEST(CertainTriangle, IsRightAndSeldomOpenInGeneralPosition3) {
  Random random(1);
  Meetings_seen seen;
  for (int i = 0; i < 3'000; ++i) judge(any_trial(random, {0.125, 0.3, 0.5}), seen);
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_EQ(seen.uncertain, 0);
  EXPECT_GT(seen.met, 3'000);
  EXPECT_GT(seen.missed, 6'000);
  EXPECT_LT(seen.open, seen.all() / 200);
}

TEST(CertainTriangle, LooksAtLinesOfFacetsOnly2) {
  Random random(1);
  Meetings_seen seen;
  for (int i = 0; i < 6'000; ++i) {
    const double size = std::ldexp(0.25, -static_cast<int>(random.below(24)));
    judge(any_trial_2(random, {size, 2 * size, 0.5}), seen);
  }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_EQ(seen.met, 0);
  EXPECT_GT(seen.missed, 3'000);
}

/// Facets and triangles of all sizes, each of them larger than the other, down to some ulps of a float.
TEST(CertainTriangle, IsRightAtAllSizes3) {
  Random random(2);
  Meetings_seen seen;
  for (int exponent = 0; exponent < 24; ++exponent)
    for (int i = 0; i < 200; ++i) {
      const double facet = std::ldexp(0.125, -exponent),
                   triangle = std::min(0.4, std::ldexp(facet, static_cast<int>(random.below(9)) - 4));
      judge(any_trial(random, {facet, triangle, 0.5}), seen);
    }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_GT(seen.met, 1'000);
  EXPECT_GT(seen.missed, 8'000);
  EXPECT_LT(seen.open, seen.all() / 2);
}

/// So far that the lanes see it, that only exact signs do, or not at all.
double beside(Random& random) {
  return random.below(3) == 0 ? 0 : random.real(-1, 1) * std::ldexp(1.0, -static_cast<int>(random.below(50)));
}

TEST(CertainTriangle, IsRightThroughRidgesAndCorners3) {
  Random random(3);
  Meetings_seen seen;
  for (int exponent = 0; exponent < 20; ++exponent)
    for (int i = 0; i < 300; ++i) {
      const double size = std::ldexp(0.125, -exponent);
      Triangle_trial<3> x = any_trial(random, {size, 2 * size, 0.5});
      lead_through(random, x.t, on_ridge(random, x.loop));
      Point<3>* corner[] = {&x.t.a, &x.t.b, &x.t.q};
      (*corner[random.below(3)])[random.below(3)] += size * beside(random);
      judge(x, seen);
    }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_GT(seen.met, 300);
  EXPECT_GT(seen.missed, 300);
  EXPECT_GT(seen.open, 5'000);
}

/// The triangle touches the facet from one side with a corner or a side, at any point of the facet.
TEST(CertainTriangle, IsRightWhereTrianglesTouchFacets3) {
  Random random(4);
  Meetings_seen seen;
  for (int i = 0; i < 6'000; ++i) {
    const double size = std::ldexp(0.125, -static_cast<int>(random.below(20)));
    const Point<3> centre = any_point<3>(random, {}, 0.5);
    const Exact_plane plane(random, size, centre);
    Triangle_trial<3> x = any_trial(random, {size, 2 * size, 0}, plane, centre);
    const auto in_plane = [&] { return plane.at(random.real(-600, 600), random.real(-600, 600)); };
    x.t.a = in_plane();
    if (random.below(2) == 0) x.t.b = in_plane();
    x.t.a[random.below(3)] += size * beside(random);
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_GT(seen.missed, 1'000);
  EXPECT_GT(seen.open, 5'000);
}

TEST(CertainTriangle, IsRightInThePlaneOfTheFacet3) {
  Random random(5);
  Meetings_seen seen;
  for (int i = 0; i < 4'000; ++i) {
    const double size = std::ldexp(0.125, -static_cast<int>(random.below(20)));
    const Point<3> centre = any_point<3>(random, {}, 0.5);
    const Exact_plane plane(random, size, centre);
    Triangle_trial<3> x = any_trial(random, {size, 2 * size, 0}, plane, centre);
    for (Point<3>* p : {&x.t.a, &x.t.b, &x.t.q})
      *p = plane.at(random.real(-1200, 1200), random.real(-1200, 1200));
    if (random.below(2) == 0) x.t.b[random.below(3)] += size * beside(random);
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_GT(seen.open, 5'000);
}

/// p moves along its edge, or hardly at all.
TEST(CertainTriangle, IsRightOfNeedlesAndTinyMoves3) {
  Random random(6);
  Meetings_seen seen;
  for (int i = 0; i < 8'000; ++i) {
    const double size = std::ldexp(0.125, -static_cast<int>(random.below(12)));
    Triangle_trial<3> x = any_trial(random, {size, 2 * size, 0.5});
    if (random.below(2) == 0) lead_through(random, x.t, on_ridge(random, x.loop));
    if (random.below(2) == 0) {
      constexpr double shares[] = {-0.5, 0.5, 1, 1.5, 0x1p-20};
      x.t.b = x.t.a + shares[random.below(5)] * (x.t.q - x.t.a);
      if (random.below(2) == 0) x.t.b[random.below(3)] += size * beside(random);
    } else {
      x.t.b = any_point<3>(random, x.t.a, 0x1p-30);
    }
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_GT(seen.met, 2'000);
  EXPECT_GT(seen.missed, 10'000);
}

constexpr double unit = 0x1p-24;
constexpr double half_unit = 0.5 * (1 - 0x1p-20) * unit;

/// A corner of a triangular facet pierces the triangle by less than a unit, or fails to, next to a. All
/// coordinates of these two points are rounded by half a unit, so that the height of the corner is off by 1.
Triangle_trial<3> worst_height(Random& random, bool pierces) {
  const double sense = pierces ? 1 : -1;
  const auto rounded_to = [](double x) { return std::round(x / unit) * unit; };
  const Vector<3> n{random.real(0.3, 1), random.real(0.3, 1), random.real(0.1, 0.4)};
  const auto along = [&](double x, double y) { return Vector<3>{x, y, -(n[0] * x + n[1] * y) / n[2]}; };
  Triangle_trial<3> x;
  for (double& c : x.t.a) c = rounded_to(random.real(0.6, 0.9)) + sense * half_unit;
  const double size = 0x1p-4;
  const double turn = random.real(0, 2 * std::numbers::pi);
  const auto beside = [&](double angle, double r) {
    return along(r * std::cos(turn + angle), r * std::sin(turn + angle));
  };
  x.t.b = x.t.a + beside(0, 0.125 * size);
  x.t.q = x.t.a + beside(1.5, 0.125 * size);
  Point<3> c = x.t.a + beside(random.real(0.5, 1), random.real(0.2, 0.4) * 0.125 * size);
  for (double& k : c) k = rounded_to(k) - sense * half_unit;
  // The last coordinate puts it at the plane.
  const double over = dot(n, c - x.t.a) / (n[2] * unit);
  c[2] -= unit * (pierces ? std::ceil(over) : std::floor(over));
  const Vector<3> up = (size / length(n)) * n;
  x.loop = {c, c + up + beside(random.real(-0.5, 0.5), size / 16),
            c + up + beside(random.real(1, 2), size / 16)};
  return x;
}

TEST(CertainTriangle, IsRightWhereHeightsAreRoundedWorst3) {
  for (const bool pierces : {true, false}) {
    Random random(7);
    Meetings_seen seen;
    int meet = 0;
    for (int i = 0; i < 4'000; ++i) {
      const Triangle_trial<3> x = worst_height(random, pierces);
      meet += do_meet(x);
      judge(x, seen);
    }
    EXPECT_EQ(seen.wrong(), 0) << "half of the bound is too little";
    EXPECT_EQ(seen.uncertain, 0);
    EXPECT_GT(seen.open, seen.all() / 2);
    EXPECT_EQ(meet, pierces ? 4'000 : 0);
  }
}

/// The same trials in other units: each frame maps them to the same floats.
TEST(CertainTriangle, SaysTheSameAtAllScales3) {
  Random random(8);
  std::vector<Triangle_trial<3>> trials;
  for (int i = 0; i < 300; ++i) {
    trials.push_back(any_trial(random, {0.125, 0.3, 0.5}));
    if (i % 2 == 0) lead_through(random, trials.back().t, on_ridge(random, trials.back().loop));
  }
  Meetings_seen first;
  for (const Triangle_trial<3>& x : trials) judge(x, first);
  EXPECT_EQ(first.wrong(), 0);
  for (const int exponent : {-200, -60, -1, 1, 60, 200}) {
    Meetings_seen seen;
    for (Triangle_trial<3> x : trials) {
      for (Point<3>& p : x.loop) p = std::ldexp(1.0, exponent) * p;
      for (Point<3>* p : {&x.t.a, &x.t.b, &x.t.q}) *p = std::ldexp(1.0, exponent) * *p;
      judge(x, seen, Plane_frame<3>{{}, std::ldexp(1.0, -exponent)});
    }
    EXPECT_EQ(seen.met, first.met) << exponent;
    EXPECT_EQ(seen.missed, first.missed) << exponent;
    EXPECT_EQ(seen.wrong(), 0) << exponent;
  }
}

TEST(CertainTriangle, IsNotCertainOutOfTheFrameOrOfNothing) {
  const auto is_certain = [](const Point<3>& a, const Point<3>& b, const Point<3>& q) {
    return Certain_triangle<3>({}, {a, b, q}).is_certain();
  };
  const Point<3> a{0.5, 0, 0}, b{0, 0.5, 0}, q{0, 0, 0.5}, outside{0, 1.25, 0}, next_to_a{0.5, 0x1p-70, 0};
  EXPECT_TRUE(is_certain(a, b, q));
  EXPECT_FALSE(is_certain(a, a, q));
  EXPECT_FALSE(is_certain(a, b, a));
  EXPECT_FALSE(is_certain(a, b, b));
  EXPECT_FALSE(is_certain(a, next_to_a, q));
  EXPECT_FALSE(is_certain(outside, b, q));
  EXPECT_FALSE(is_certain(a, outside, q));
  EXPECT_FALSE(is_certain(a, b, outside));
  EXPECT_FALSE(is_certain(a, b, {std::numeric_limits<double>::infinity(), 0, 0}));
  EXPECT_FALSE(Certain_triangle<2>({}, {{0.5, 0}, {0, 0.5}, {0.5, 0}}).is_certain());
  EXPECT_FALSE(Certain_triangle<2>({}, {{0.5, 0}, {0, 1.5}, {0, 0}}).is_certain());
}

/// Ridges with an end outside of the frame, or near one, say nothing.
TEST(CertainTriangle, IsRightOfFacetsAcrossTheFrame3) {
  Random random(9);
  Meetings_seen seen;
  for (int i = 0; i < 2'000; ++i) {
    Triangle_trial<3> x = any_trial(random, {0.25, 0.4, 0});
    const Vector<3> off{1.125, random.real(-0.5, 0.5), random.real(-0.5, 0.5)};
    for (Point<3>& p : x.loop)
      p = p + Vector<3>{off[0], std::round(off[1] * 64) / 64, std::round(off[2] * 64) / 64};
    for (Point<3>* p : {&x.t.a, &x.t.b, &x.t.q}) {
      *p = *p + off;
      (*p)[0] = std::min((*p)[0], 1.0);
    }
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong(), 0);
  EXPECT_LT(seen.met, seen.open / 100);
  EXPECT_GT(seen.open, 1'000);
}

}  // namespace
}  // namespace cellwalk::test
