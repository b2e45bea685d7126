// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace cellwalk {
namespace {

using Number = boost::multiprecision::cpp_bin_float_100;

template <int D>
std::string refusal(const Body_placement<D>& placement) {
  try {
    transformed(Body_soup<D>{{Point<D>{1}}, {}, {}}, placement);
  } catch (const Error& e) {
    EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(Error_code::usage));
    return e.what();
  }
  return "accepted";
}

TEST(Transform, NothingChangesNothing) {
  const auto body = icosphere_body(0.7, 1);
  const auto same = transformed(body, {});
  EXPECT_EQ(same.points, body.points);
  EXPECT_EQ(same.edges, body.edges);
  EXPECT_EQ(same.faces, body.faces);
}

TEST(Transform, QuarterTurnsAreExact) {
  const Body_soup<3> body{{{0.1, -0.7, 3.3}}, {}, {}};
  const auto [x, y, z] = body.points[0];
  struct Case {
    Vector<3> axis;
    double degrees;
    Point<3> expected;
  };
  const Case cases[] = {{{0, 0, 1}, 90, {-y, x, z}},        {{0, 0, 5}, -270, {-y, x, z}},
                        {{0, 0, -1e-200}, 270, {-y, x, z}}, {{0, 0, 1}, 180, {-x, -y, z}},
                        {{0, 3, 0}, 90, {z, y, -x}},        {{1, 0, 0}, 90, {x, -z, y}},
                        {{1, 0, 0}, -90, {x, z, -y}},       {{1e200, 0, 0}, 36000360, {x, y, z}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.degrees);
    EXPECT_EQ(transformed(body, {1, {c.axis, c.degrees}, {}}).points[0], c.expected);
  }
  const Body_soup<2> plane{{{0.1, -0.7}}, {}, {}};
  EXPECT_EQ(transformed(plane, {1, {90}, {}}).points[0], (Point<2>{0.7, 0.1}));
  EXPECT_EQ(transformed(plane, {2, {-180}, {1, 1}}).points[0], (Point<2>{0.8, 2.4}));
}

TEST(Transform, GivesNoNegativeZero) {
  const auto body = transformed(quad_body(2), {1, {180}, {1, 1}});
  for (const auto& p : body.points)
    for (double c : p) EXPECT_FALSE(std::signbit(c));
}

/// Nearest doubles, against quaternions in 100 digits.
TEST(Transform, RoundsOnce) {
  Random random(5);
  std::size_t rounded = 0;
  for (int round = 0; round < 2000; ++round) {
    Body_placement<3> placement;
    Point<3> p;
    for (double& x : p) x = random.real(-3, 3);
    for (double& x : placement.rotation.axis) x = random.real(-1, 1);
    for (double& x : placement.position) x = random.real(-10, 10);
    placement.rotation.degrees = random.real(-1000, 1000);
    placement.scale = random.real(0.1, 4);
    const Point<3> q = transformed(Body_soup<3>{{p}, {}, {}}, placement).points[0];

    const auto& axis = placement.rotation.axis;
    const Number half = Number(placement.rotation.degrees) * boost::math::constants::pi<Number>() / 360;
    Number norm = 0;
    for (double a : axis) norm += Number(a) * a;
    const Number w = cos(half), s = sin(half) / sqrt(norm);
    const std::array<Number, 3> u{s * axis[0], s * axis[1], s * axis[2]};
    const auto product = [](const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
      return std::array<Number, 3>{Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
                                   Number(a[0] * b[1] - a[1] * b[0])};
    };
    const std::array<Number, 3> v{p[0], p[1], p[2]};
    auto t = product(u, v);
    for (std::size_t k = 0; k < 3; ++k) t[k] += w * v[k];
    const auto twice = product(u, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Number exact = (v[k] + 2 * twice[k]) * placement.scale + placement.position[k];
      EXPECT_EQ(q[k], exact.convert_to<double>());
      rounded += Number(q[k]) != exact;
    }
  }
  EXPECT_GE(rounded, 5900u);
}

TEST(Transform, RefusesWhatMakesNoSense) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal<2>({0, {}, {}}), "placement: the scale must be a positive number, not 0");
  EXPECT_EQ(refusal<3>({nan, {}, {}}), "placement: the scale must be a positive number, not nan");
  EXPECT_EQ(refusal<2>({1, {nan}, {}}),
            "placement: the angle of the rotation must be a finite number of degrees");
  EXPECT_EQ(refusal<3>({1, {{0, 0, 0}, 1}, {}}),
            "placement: the axis of the rotation must be finite and not zero");
  EXPECT_EQ(refusal<2>({1.5e308, {}, {1.5e308, 0}}),
            "placement: vertex 0 gets a coordinate that is not finite: choose a smaller scale or position");
}

}  // namespace
}  // namespace cellwalk
