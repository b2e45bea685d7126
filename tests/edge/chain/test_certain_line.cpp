// SPDX-License-Identifier: LGPL-3.0-or-later
// What float lanes prove of a line and a facet, judged by exact signs: in general position, through ridges
// and corners, where coordinates are rounded as badly as can be, in frames much larger than the facet, and at
// all scales. Half of the bound is too little.
#include <cellwalk/internal/edge/certain_line.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <ratio>
#include <vector>

#include "edge/facet_shape.h"

namespace cellwalk::detail {
namespace {

/// A facet as the loop of its corners, and a line from t to q.
template <int D>
struct Line_trial {
  std::vector<Point<D>> loop;
  Point<D> t{}, q{};
};

/// The least sign of the ridges: positive if the line passes the interior, outwards (1) or inwards (-1).
int least_sign(const Line_trial<3>& x, int outwards) {
  int least = 1;
  for (std::size_t k = 0; k < x.loop.size(); ++k)
    least = std::min(least,
                     outwards * orientation_rational(x.t, x.q, x.loop[k], x.loop[(k + 1) % x.loop.size()]));
  return least;
}
int least_sign(const Line_trial<2>& x, int outwards) {
  return std::min(-outwards * orientation_rational(x.t, x.q, x.loop[0]),
                  outwards * orientation_rational(x.t, x.q, x.loop[1]));
}

template <int D>
Plane_frame<D> unit_frame() {
  return {};
}

struct Lines_seen {
  int passed = 0, open = 0, wrong = 0;
};

/// Judges a line as it is and backwards, against the facet and against it from behind.
template <class Part, int D>
void judge_line(const Line_trial<D>& x, const Plane_frame<D>& frame, Lines_seen& seen) {
  Float_point<D> mapped;
  if (!frame.map(x.t, mapped)) return;
  const Cell_shape shape = test::facet_shape(x.loop.size());
  std::vector<std::uint32_t> vertices(x.loop.size());
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::vector<Facet_corners<D>> ahead, behind;
  append_corners<D>(frame, {&shape, vertices, x.loop}, 0, ahead);
  append_from_behind<D>(ahead, behind);
  ASSERT_EQ(std::ranges::count_if(ahead, [](const auto& some) { return !some.continues; }), 1);
  ASSERT_FALSE(ahead.back().continues);
  ASSERT_FALSE(behind.back().continues);
  Certain_line<D, Part> line(frame, x.t, mapped);
  const auto passes = [&](const std::vector<Facet_corners<D>>& facet, bool backwards) {
    line.lead_to(x.q, backwards);
    return std::ranges::all_of(facet, [&](const auto& some) { return line.passes(some); });
  };
  const bool is_passed = passes(ahead, false);
  EXPECT_EQ(passes(behind, true), is_passed);  // the same signs, so the same rounding
  const bool should_pass = least_sign(x, 1) > 0;
  seen.passed += is_passed;
  seen.open += should_pass && !is_passed;
  seen.wrong += is_passed && !should_pass;
  seen.wrong += (passes(behind, false) || passes(ahead, true)) && least_sign(x, -1) <= 0;
}

/// A regular polygon with corners moved along rays from its centre by up to a tenth, in a plane turned at
/// random, of a size.
Line_trial<3> any_facet(Random& random, std::size_t corners, double size, const Point<3>& centre) {
  Vector<3> u{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)},
      v{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
  u = (1 / length(u)) * u;
  v = cross(u, v);
  v = (1 / length(v)) * v;
  Line_trial<3> x;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    const double r = size * (1 + random.real(0, 0.1));
    x.loop.push_back(centre + r * std::cos(angle) * u + r * std::sin(angle) * v);
  }
  const Vector<3> out = cross(u, v);
  const auto beside = [&] { return random.real(-1.5, 1.5) * size * u + random.real(-1.5, 1.5) * size * v; };
  x.t = centre - random.real(0.1, 3) * size * out + beside();
  x.q = centre + random.real(0.1, 3) * size * out + beside();
  return x;
}
Line_trial<2> any_facet(Random& random, std::size_t, double size, const Point<2>& centre) {
  const double angle = random.real(0, 2 * std::numbers::pi);
  const Vector<2> u{std::cos(angle), std::sin(angle)}, out{u[1], -u[0]};
  Line_trial<2> x;
  x.loop = {centre - size * u, centre + size * u};
  const auto beside = [&] { return random.real(-1.5, 1.5) * size * u; };
  x.t = centre - random.real(0.1, 3) * size * out + beside();
  x.q = centre + random.real(0.1, 3) * size * out + beside();
  return x;
}

template <int D>
Point<D> any_point(Random& random, double most) {
  Point<D> x;
  for (double& c : x) c = random.real(-most, most);
  return x;
}

/// Leads the line of a trial through a point of a ridge, or through a corner, and then beside it.
template <int D>
void lead_through_border(Random& random, Line_trial<D>& x, double beside) {
  const std::size_t k = random.below(x.loop.size());
  const Point<D>&a = x.loop[k], &b = x.loop[(k + 1) % x.loop.size()];
  const double s = D == 2 ? 0 : static_cast<double>(random.below(5)) / 4;
  const Point<D> on = a + s * (b - a);
  x.q = random.below(2) == 0 ? on : x.t + 2 * (on - x.t);
  x.q[random.below(D)] += beside;
}

template <int D>
void expect_right_in_general_position() {
  Random random(1);
  Lines_seen seen;
  for (int i = 0; i < 20'000; ++i)
    judge_line<std::ratio<1>>(any_facet(random, 3 + random.below(7), 0.125, any_point<D>(random, 0.5)),
                              unit_frame<D>(), seen);
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_GT(seen.passed, 2'000);
  EXPECT_LT(seen.open, 20);
}

TEST(CertainLine, IsRightAndSeldomOpenInGeneralPosition2) { expect_right_in_general_position<2>(); }
TEST(CertainLine, IsRightAndSeldomOpenInGeneralPosition3) { expect_right_in_general_position<3>(); }

/// Facets of all sizes, down to some ulps of a float in the frame, which then certainly proves nothing.
template <int D>
void expect_right_through_borders() {
  Random random(2);
  Lines_seen seen;
  for (int exponent = 0; exponent < 24; ++exponent)
    for (int i = 0; i < 1'500; ++i) {
      const double size = std::ldexp(0.25, -exponent);
      Line_trial<D> x = any_facet(random, 3 + random.below(7), size, any_point<D>(random, 0.75));
      lead_through_border(random, x,
                          random.real(-1, 1) * std::ldexp(1.0, -6 - static_cast<int>(random.below(44))));
      judge_line<std::ratio<1>>(x, unit_frame<D>(), seen);
    }
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_GT(seen.passed, 100);
  EXPECT_GT(seen.open, 1'000);
}

TEST(CertainLine, IsRightThroughRidgesAndCorners2) { expect_right_through_borders<2>(); }
TEST(CertainLine, IsRightThroughRidgesAndCorners3) { expect_right_through_borders<3>(); }

constexpr double unit = 0x1p-24;
constexpr double half_unit = 0.5 * (1 - 0x1p-20) * unit;

double up_or_down(Random& random, double by) { return random.below(2) == 0 ? by : -by; }

/// A number of [1/2,1) that is rounded to a float by half a unit, up or down: rounding is largest there.
double worst_rounded(Random& random, double near, double units = 0) {
  return (std::round(near / unit) + units) * unit + up_or_down(random, half_unit);
}

/// The line leads along an axis, some units beside the first ridge of a triangle. All coordinates across the
/// axis are rounded by half a unit. The other ridges are passed by far.
Line_trial<3> worst(Random& random) {
  const double base = 0.625, size = std::ldexp(1.0, -4 - static_cast<int>(random.below(12)));
  Line_trial<3> x;
  const std::size_t axis = random.below(3), j = (axis + 1) % 3, k = (axis + 2) % 3;
  const auto at = [&](double along, double y, double z, double units) {
    Point<3> p;
    p[axis] = along;
    p[j] = worst_rounded(random, base + y, units);
    p[k] = worst_rounded(random, base + z);
    return p;
  };
  const double p = size * (1 + random.real(0, 0.5)), beside = static_cast<double>(random.below(6));
  x.t = at(base - size, 0, 0, 0);
  x.loop = {at(base, -p, -p, beside), at(base, p, p, 0), at(base, -4 * size, 4 * size, 0)};
  x.q = x.t;
  x.q[axis] = base + size;
  return x;
}

/// The line leads along a diagonal, some units beside one end of the facet.
Line_trial<2> worst_2(Random& random) {
  const double size = std::ldexp(1.0, -3 - static_cast<int>(random.below(8))),
               beside = static_cast<double>(random.below(4));
  Line_trial<2> x;
  x.t = {worst_rounded(random, 0.5625), worst_rounded(random, 0.5625)};
  for (std::size_t k = 0; k < 2; ++k) x.q[k] = x.t[k] + 0.25 * (1 + up_or_down(random, 2 * half_unit));
  const auto beyond = [&](double across, double units) {
    return Point<2>{worst_rounded(random, 0.5625 + size + across),
                    worst_rounded(random, 0.5625 + size - across, units)};
  };
  // The first end lies to the right of the line, the second to the left.
  if (random.below(2) == 0)
    x.loop = {beyond(size / 4, 0), beyond(0, beside)};
  else
    x.loop = {beyond(0, -beside), beyond(-size / 4, 0)};
  return x;
}

template <class Part, int D, class Make>
Lines_seen judge_worst(const Make& make) {
  Random random(3);
  Lines_seen seen;
  for (int i = 0; i < 40'000; ++i) judge_line<Part>(make(random), unit_frame<D>(), seen);
  return seen;
}

TEST(CertainLine, IsRightWhereRoundingIsWorst) {
  const Lines_seen in_3d = judge_worst<std::ratio<1>, 3>(worst),
                   in_2d = judge_worst<std::ratio<1>, 2>(worst_2);
  EXPECT_EQ(in_3d.wrong, 0);
  EXPECT_EQ(in_2d.wrong, 0);
  EXPECT_GT(in_3d.open, 1'000);
  EXPECT_GT(in_2d.open, 1'000);
}

TEST(CertainLine, IsWrongByHalfOfTheBound) {
  EXPECT_GT((judge_worst<std::ratio<1, 2>, 3>(worst).wrong), 10);
  EXPECT_GT((judge_worst<std::ratio<1, 2>, 2>(worst_2).wrong), 10);
}

/// The same trials in other units: each frame maps them to the same floats.
template <int D>
void expect_the_same_at_all_scales() {
  Random random(4);
  std::vector<Line_trial<D>> trials;
  for (int i = 0; i < 400; ++i) {
    trials.push_back(any_facet(random, 3 + random.below(5), 0.125, any_point<D>(random, 0.5)));
    if (i % 2 == 0) lead_through_border(random, trials.back(), 0x1p-24);
  }
  Lines_seen first;
  for (const Line_trial<D>& x : trials) judge_line<std::ratio<1>>(x, unit_frame<D>(), first);
  EXPECT_GT(first.passed, 40);
  EXPECT_EQ(first.wrong, 0);
  for (const int exponent : {-300, -100, -1, 1, 100, 300}) {
    Lines_seen seen;
    for (Line_trial<D> x : trials) {
      const auto scale = [&](Point<D>& p) {
        for (double& c : p) c = std::ldexp(c, exponent);
      };
      for (Point<D>& p : x.loop) scale(p);
      scale(x.t);
      scale(x.q);
      judge_line<std::ratio<1>>(x, Plane_frame<D>{{}, std::ldexp(1.0, -exponent)}, seen);
    }
    EXPECT_EQ(seen.passed, first.passed) << exponent;
    EXPECT_EQ(seen.wrong, 0) << exponent;
  }
}

TEST(CertainLine, ProvesTheSameAtAllScales2) { expect_the_same_at_all_scales<2>(); }
TEST(CertainLine, ProvesTheSameAtAllScales3) { expect_the_same_at_all_scales<3>(); }

TEST(CertainLine, ProvesNothingOutOfTheFrameOrOfNothing) {
  Random random(5);
  Line_trial<3> x = any_facet(random, 4, 0.25, Point<3>{});
  x.t = {};
  for (const Point<3>& p : x.loop) x.t = x.t + 0.25 * (p - Point<3>{});
  const Vector<3> out = cross(x.loop[1] - x.loop[0], x.loop[2] - x.loop[0]);
  x.t = x.t - out;
  x.q = x.t + 2 * out;
  Lines_seen seen;
  judge_line<std::ratio<1>>(x, unit_frame<3>(), seen);
  ASSERT_EQ(seen.passed, 1);
  const auto expect_nothing = [&](const Line_trial<3>& trial, const Plane_frame<3>& frame) {
    Lines_seen none;
    judge_line<std::ratio<1>>(trial, frame, none);
    EXPECT_EQ(none.passed, 0);
  };
  expect_nothing(x, {{}, std::numeric_limits<double>::quiet_NaN()});
  expect_nothing(x, {{}, 4});  // corners lie outside
  Line_trial<3> still = x;
  still.q = still.t;
  expect_nothing(still, {});
  Line_trial<3> short_line = x;
  for (std::size_t k = 0; k < 3; ++k) short_line.q[k] = short_line.t[k] + std::ldexp(out[k], -70);
  expect_nothing(short_line, {});
  Line_trial<3> endless = x;
  for (std::size_t k = 0; k < 3; ++k) endless.q[k] = endless.t[k] + std::ldexp(out[k], 200);
  expect_nothing(endless, {});
}

}  // namespace
}  // namespace cellwalk::detail
