// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/orientation_value.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/random.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace cellwalk::test {
namespace {

using Judge = boost::multiprecision::cpp_rational;  // of another library

TEST(Fraction, IsComparedAndAddedLikeARational) {
  Random random(3);
  int equal = 0;
  const auto draw = [&] { return static_cast<int>(random.below(15)) - 7; };
  for (int k = 0; k < 20000; ++k) {
    const int n = draw(), m = draw(), d = draw() | 1, e = draw() | 1;
    const Fraction x{Ring(n), Ring(d)}, y{Ring(m), Ring(e)};
    const Judge of_x(Judge(n) / d), of_y(Judge(m) / e);
    EXPECT_EQ(x < y, of_x < of_y);
    EXPECT_EQ(x == y, of_x == of_y);
    equal += of_x == of_y;
    EXPECT_EQ(to_rational(middle(x, y)) * 2, to_rational(x) + to_rational(y));
    EXPECT_EQ(to_rational(x * y), to_rational(x) * to_rational(y));
  }
  EXPECT_GT(equal, 500);
}

TEST(Fraction, RootsAreRoundedToNearestAndTiesToEven) {
  Random random(6);
  int ties = 0;
  for (int k = 0; k < 5000; ++k) {
    // Squares of doubles, of what lies halfway between two, and anything.
    const double root = std::ldexp(random.real(1, 2), static_cast<int>(random.below(200)) - 100);
    const double above = std::nextafter(root, HUGE_VAL);
    const int kind = static_cast<int>(random.below(3));
    const Ring twice = kind == 0 ? Ring(root) + Ring(root) : Ring(root) + Ring(above);
    const Ring more = kind == 2 ? Ring(std::ldexp(root * random.real(-1, 1), -55)) : Ring(0);
    const Fraction square{(twice + more) * (twice + more), Ring(4)};
    const double found = root_to_nearest(square);
    const bool is_even = std::fmod(std::ldexp(root, 52 - std::ilogb(root)), 2) == 0;
    const bool is_up = kind == 1 ? !is_even : more > Ring(0);
    const double near = is_up ? above : root;
    EXPECT_EQ(found, near) << kind << ", " << root;
    ties += kind == 1;
  }
  EXPECT_GT(ties, 1000);
}

TEST(Fraction, IsRoundedDownAsATimeAndTowardsZeroAsADouble) {
  Random random(4);
  int exact = 0;
  for (int k = 0; k < 20000; ++k) {
    // Long numbers, and products that are doubles after all.
    const double d = random.real(1, 2), t = std::ldexp(random.real(), -static_cast<int>(random.below(60)));
    const bool is_double = random.chance(0.2);
    const double n = is_double ? 0 : random.real() * d;
    const Fraction x = is_double ? Fraction(Ring(t) * Ring(d), Ring(d)) : Fraction(Ring(n), Ring(d));
    const Judge value = is_double ? Judge(t) : Judge(Judge(n) / Judge(d));
    const Exact_time time = to_time(x);
    EXPECT_LE(Judge(time.rounded()), value);
    EXPECT_GT(Judge(std::nextafter(time.rounded(), 2.0)), value);
    EXPECT_EQ(time.fraction() == nullptr, Judge(time.rounded()) == value);
    EXPECT_EQ(to_rational(time), to_rational(x));
    EXPECT_EQ(to_double(x), time.rounded());
    EXPECT_EQ(to_double(Fraction(-x.numerator(), x.denominator())), -time.rounded());
    exact += time.fraction() == nullptr;
  }
  EXPECT_GT(exact, 2000);
  EXPECT_LT(exact, 8000);
}

TEST(Fraction, IsRoundedBeyondTheRangeOfItsParts) {
  Ring huge(1e300), part(1e299);
  for (int k = 0; k < 3; ++k) {
    huge = huge * Ring(1e300);
    part = part * Ring(1e300);
  }
  const Fraction tenth(part, huge);
  EXPECT_LE(Judge(to_double(tenth)) * Judge(1e300), Judge(1e299));
  EXPECT_GT(Judge(std::nextafter(to_double(tenth), 1.0)) * Judge(1e300), Judge(1e299));
  // Parts of which doubles know some bits only.
  Ring tiny(1.1e-160), third(3.3e-160);
  tiny = tiny * Ring(1.1e-160);
  third = third * Ring(1.1e-160);
  EXPECT_NEAR(to_double(Fraction(tiny, third)), 1.0 / 3, 1e-15);
  EXPECT_EQ(to_double(Fraction(0.0)), 0);
  EXPECT_EQ(to_double(Fraction(5e-324)), 5e-324);
}

Judge orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const auto x = [](double v) { return Judge(v); };
  return (x(q[0]) - x(p[0])) * (x(r[1]) - x(p[1])) - (x(q[1]) - x(p[1])) * (x(r[0]) - x(p[0]));
}

TEST(OrientationValue, BoundsValuesAndTheirRoots) {
  Random random(6);
  Predicate_counts counts;
  int roots = 0, narrow = 0, unknown = 0;
  for (int k = 0; k < 20000; ++k) {
    // Points of all sizes; half of them nearly or exactly on one line.
    const double size = std::ldexp(1.0, static_cast<int>(random.below(400)) - 200);
    const auto draw = [&] { return Point<2>{size * random.real(-1, 1), size * random.real(-1, 1)}; };
    const Point<2> q = draw(), r = draw();
    Point<2> a = draw();
    const Point<2> b = draw();
    if (random.chance(0.5)) a = point_on<2>(q, r, random.real());
    const Judge v_0 = orientation(a, q, r), v_1 = orientation(b, q, r);
    const Orientation_value at_a = orientation_value(counts, a, q, r),
                            at_b = orientation_value(counts, b, q, r);
    EXPECT_EQ(at_a.sign, v_0.sign());
    EXPECT_LE(Judge(at_a.low), abs(v_0));
    EXPECT_TRUE(std::isinf(at_a.high) || Judge(at_a.high) >= abs(v_0));
    unknown += at_a.low == 0;
    if (at_a.sign * at_b.sign >= 0) continue;
    ++roots;
    const Judge root = v_0 / (v_0 - v_1);
    const Root_bounds bounds = root_bounds(at_a, at_b);
    EXPECT_LE(Judge(bounds.low), root);
    EXPECT_GE(Judge(bounds.high), root);
    narrow += bounds.high - bounds.low < 1e-12 * bounds.high;
  }
  EXPECT_GT(roots, 5000);
  EXPECT_GT(narrow, 2000);
  EXPECT_GT(unknown, 2000);
}

}  // namespace
}  // namespace cellwalk::test
