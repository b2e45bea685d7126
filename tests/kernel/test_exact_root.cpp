// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/exact_root.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "kernel/root_judge.h"

namespace cellwalk::test {
namespace {

constexpr double largest_double = std::numeric_limits<double>::max();
constexpr auto least_double = std::numeric_limits<double>::denorm_min();

int as_int(std::strong_ordering order) { return (order > 0) - (order < 0); }

Exact_root root_of(const Judged_root& root) {
  const auto which = root.side < 0 ? Exact_root::Which::lower : Exact_root::Which::upper;
  return Exact_root::of(quadratic(root.polynomial), which).value();
}

std::vector<Judged_root> judged_roots(const Polynomial& p) {
  if (!has_roots(p)) return {};
  return {{p, -1}, {p, 1}};
}

int integer(Random& random, int size) {
  return static_cast<int>(random.below(2 * static_cast<std::uint64_t>(size) + 1)) - size;
}
int not_zero(Random& random, int size) {
  const int x = integer(random, size - 1);
  return x < 0 ? x : x + 1;
}

/// A product of doubles of all sizes.
Rational_judge product_of_doubles(Random& random) {
  const auto draw = [&random]() -> double {
    if (random.chance(0.1)) return random.chance(0.5) ? 5e-324 : -1e308;
    return std::ldexp(random.real(-1, 1), integer(random, 1023));
  };
  return Rational_judge(draw()) * Rational_judge(draw());
}

Polynomial small(Random& random) { return {integer(random, 3), integer(random, 3), integer(random, 3)}; }

Polynomial times(const Rational_judge& factor, const Polynomial& p) {
  return {factor * p[0], factor * p[1], factor * p[2]};
}
Polynomial sum(const Polynomial& p, const Polynomial& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
/// Its roots are those of p times a power of two.
Polynomial stretched(const Polynomial& p, int exponent) {
  return {p[0] * power_of_two(2 * exponent), p[1] * power_of_two(exponent), p[2]};
}

struct Pair {
  Polynomial p, q;
};

enum Kind { of_small_integers, shared_root, double_root, proportional, close, close_to_fraction, of_doubles };
constexpr std::array kinds{of_small_integers, shared_root, double_root, proportional, close,
                           close_to_fraction, of_doubles};

Pair pair_of(Kind kind, Random& random) {
  const Rational_judge a = not_zero(random, 5), b = integer(random, 5);
  const auto with_factor = [&] { return product_of_factors(a, b, integer(random, 3), not_zero(random, 5)); };
  const Polynomial p = small(random);
  switch (kind) {
    case of_small_integers:
      return {p, small(random)};
    case shared_root:
      return {with_factor(), with_factor()};
    case double_root: {
      const Polynomial square = product_of_factors(a, b, a, b);
      return {times(not_zero(random, 3), square), random.chance(0.5) ? with_factor() : times(-3, square)};
    }
    case proportional:
      return {p, times(not_zero(random, 5) * power_of_two(integer(random, 9)), p)};
    case close:
      return {p, sum(p, times(power_of_two(-210 - integer(random, 9)), small(random)))};
    case close_to_fraction: {
      if (!has_roots(p)) return {p, p};
      const Rational_judge x = approximation({p, random.chance(0.5) ? 1 : -1}, 210);
      return {p, product_of_factors(a, -a * x, random.chance(0.5) ? 0 : a, b)};
    }
    case of_doubles:
      break;
  }
  const auto draw = [&] { return product_of_doubles(random); };
  return {{draw(), draw(), draw()}, {draw(), draw(), draw()}};
}

/// One of a kind, or that with roots and coefficients of other sizes.
Pair any_size(Pair pair, Random& random) {
  if (random.chance(0.7)) return pair;
  const int exponent = integer(random, 1000);
  const auto resized = [&](const Polynomial& p) {
    return times(not_zero(random, 1) * power_of_two(integer(random, 2000)), stretched(p, exponent));
  };
  return {resized(pair.p), resized(pair.q)};
}

struct Order_tally {
  int pairs = 0, equal = 0, equal_of_others = 0, linear = 0, doubles = 0, without_root = 0, near = 0;
  int falling = 0, zeros = 0;
};

void judge_order(const Judged_root& x, const Judged_root& y, Order_tally& tally) {
  const Exact_root of_x = root_of(x), of_y = root_of(y);
  const int expected = judged_order(x, y);
  ASSERT_EQ(as_int(of_x <=> of_y), expected);
  ASSERT_EQ(as_int(of_y <=> of_x), -expected);
  ASSERT_EQ(of_x == of_y, expected == 0);
  const bool have_same = are_proportional(of_x.polynomial(), of_y.polynomial());
  ++tally.pairs;
  tally.equal += expected == 0;
  tally.equal_of_others += expected == 0 && !have_same;
  tally.near +=
      expected != 0 && abs(approximation(x, 300) - approximation(y, 300)) < power_of_two(-200) && !have_same;
}

void judge_sign(const Judged_root& x, const Polynomial& other, Order_tally& tally) {
  const int expected = judged_sign(x, other);
  ASSERT_EQ(root_of(x).sign_of(quadratic(other)), expected);
  tally.zeros += expected == 0;
}

void judge_polynomial(const Polynomial& p, Order_tally& tally) {
  const bool is_linear = p[2] == 0 && p[1] != 0, is_double = has_double_root(p);
  for (const auto which : {Exact_root::Which::lower, Exact_root::Which::upper}) {
    const auto root = Exact_root::of(quadratic(p), which);
    ASSERT_EQ(root.has_value(), has_roots(p));
    if (!root) continue;
    ASSERT_EQ(root->as_fraction().has_value(), is_linear || is_double);
    if (root->as_fraction()) {
      ASSERT_EQ(Exact_root(*root->as_fraction()), *root);
    }
    ASSERT_EQ(root->sign_of(quadratic(p)), 0);
  }
  tally.linear += is_linear;
  tally.doubles += is_double;
  tally.falling += p[2] < 0;
  tally.without_root += !has_roots(p);
}

TEST(ExactRoot, OrderAndSignsAreExact) {
  Random random(1);
  Order_tally tally;
  for (int i = 0; i < 200; ++i) {
    for (const Kind kind : kinds) {
      const auto [p, q] = any_size(pair_of(kind, random), random);
      judge_polynomial(p, tally);
      judge_polynomial(q, tally);
      for (const Judged_root& x : judged_roots(p)) {
        judge_sign(x, q, tally);
        judge_sign(x, {q[1], 2 * q[2], 0}, tally);
        judge_sign(x, small(random), tally);
        for (const Judged_root& y : judged_roots(q)) judge_order(x, y, tally);
      }
      if (HasFatalFailure()) FAIL() << "pair " << i << " of kind " << kind;
    }
  }
  EXPECT_GT(tally.pairs, 3000);
  EXPECT_GT(tally.equal, 1000);
  EXPECT_GT(tally.equal_of_others, 300);
  EXPECT_GT(tally.near, 200);
  EXPECT_GT(tally.linear, 200);
  EXPECT_GT(tally.doubles, 250);
  EXPECT_GT(tally.falling, 1000);
  EXPECT_GT(tally.without_root, 500);
  EXPECT_GT(tally.zeros, 1000);
}

struct Rounding_tally {
  int roots = 0, exact = 0, negative = 0, subnormal = 0, zero = 0, at_ends = 0;
};

void judge_rounding(const Judged_root& x, Rounding_tally& tally) {
  const auto order = [&x](double y) { return judged_order(x, judged_root(Rational_judge(y))); };
  if (order(largest_double) > 0 || order(-largest_double) < 0) return;
  const Exact_root root = root_of(x);
  const auto [value, is_exact] = rounded_down(root);
  const double next = std::nextafter(value, std::numeric_limits<double>::infinity());
  ASSERT_TRUE(std::isfinite(value));
  ASSERT_EQ(order(value), !is_exact);
  ASSERT_EQ(as_int(root <=> value), !is_exact);
  ASSERT_EQ(root == value, is_exact);
  if (std::isfinite(next)) {
    ASSERT_LT(order(next), 0);
    ASSERT_LT(root, next);
  }
  const Exact_time time = to_time(root);
  ASSERT_EQ(time.rounded(), value);
  ASSERT_EQ(time.fraction() == nullptr, is_exact);
  if (!is_exact) {
    ASSERT_EQ(std::holds_alternative<Fraction>(time.fraction()->source), root.as_fraction().has_value());
  }
  ++tally.roots;
  tally.exact += is_exact;
  tally.negative += value < 0;
  tally.subnormal += value != 0 && std::abs(value) < std::numeric_limits<double>::min();
  tally.zero += value == 0;
  tally.at_ends += std::abs(value) >= largest_double / 2;
}

TEST(ExactRoot, IsRoundedDown) {
  Random random(2);
  Rounding_tally tally;
  for (int i = 0; i < 200; ++i) {
    for (const Kind kind : kinds) {
      for (const Polynomial& p : {any_size(pair_of(kind, random), random).q, pair_of(kind, random).q})
        for (const Judged_root& x : judged_roots(p)) judge_rounding(x, tally);
      if (HasFatalFailure()) FAIL() << "pair " << i << " of kind " << kind;
    }
  }
  EXPECT_GT(tally.roots, 3000);
  EXPECT_GT(tally.exact, 1000);
  EXPECT_LT(tally.exact, 2500);
  EXPECT_GT(tally.negative, 1000);
}

TEST(ExactRoot, NextToADoubleIsRoundedDown) {
  Random random(3);
  Rounding_tally tally;
  for (int i = 0; i < 1500; ++i) {
    const std::array special{0.0,
                             least_double,
                             3 * least_double,
                             1.0,
                             0x1p-1022,
                             largest_double,
                             0x1p-1000,
                             1 / 3.0,
                             random.real(),
                             random.real(),
                             random.real() * 0x1p-1030,
                             0x1p-53,
                             1 - 0x1p-53};
    const double x = special[random.below(special.size())] * (random.chance(0.5) ? 1 : -1);
    const Rational_judge scale = x == 0 ? Rational_judge(least_double) : abs(Rational_judge(x));
    // From an ulp off, or its half, down to much less.
    const Rational_judge offset =
        Rational_judge(integer(random, 1)) * scale * power_of_two(-52 - static_cast<int>(random.below(200)));
    const Rational_judge root = Rational_judge(x) + (random.chance(0.2) ? Rational_judge(0) : offset);
    const int a = integer(random, 2), b = integer(random, 3);
    // The other root is near, far, or equal; or there is none.
    const Rational_judge other = random.chance(0.3)   ? root
                                 : random.chance(0.3) ? scale * b
                                                      : Rational_judge(b);
    Polynomial p =
        product_of_factors(1, -root, a, a == 0 ? Rational_judge(b | 1) : Rational_judge(-a * other));
    if (random.chance(0.3)) p[0] += scale * scale * power_of_two(-100 - static_cast<int>(random.below(99)));
    for (const Judged_root& r : judged_roots(times(power_of_two(integer(random, 2000)), p)))
      judge_rounding(r, tally);
    if (HasFatalFailure()) FAIL() << "polynomial " << i;
  }
  EXPECT_GT(tally.roots, 2000);
  EXPECT_GT(tally.exact, 500);
  EXPECT_GT(tally.negative, 700);
  EXPECT_GT(tally.subnormal, 300);
  EXPECT_GT(tally.zero, 100);
  EXPECT_GT(tally.at_ends, 50);
}

TEST(ExactRoot, IsRoundedWhereverDoublesFail) {
  // Coefficients that no common factor brings into the range of doubles, and roots in it.
  Rounding_tally tally;
  for (const int exponent : {-1000, -300, 0, 300, 1000})
    for (const int of_other : {-3000, -2000, -1100, 1100, 2000, 3000})
      for (const int side : {-1, 1}) {
        const Rational_judge root = power_of_two(exponent) / 4 * 5, other = side * 7 * power_of_two(of_other);
        const Polynomial p = product_of_factors(1, -root, 1, -other);
        Polynomial above = p;
        above[0] += power_of_two(exponent + of_other - 300);
        for (const Polynomial& q : {p, above, times(power_of_two(-4000), p)})
          for (const Judged_root& x : judged_roots(q)) judge_rounding(x, tally);
      }
  EXPECT_GT(tally.roots, 150);
}

TEST(ExactRoot, OfKnownPolynomials) {
  const auto polynomial = [](int a, int b, int c) { return Quadratic{Ring(a), Ring(b), Ring(c)}; };
  const Exact_root lower = Exact_root::of(polynomial(-1, 0, 2), Exact_root::Which::lower).value();
  const Exact_root upper = Exact_root::of(polynomial(-1, 0, 2), Exact_root::Which::upper).value();
  EXPECT_LT(lower, upper);
  EXPECT_EQ(rounded_down(upper).value, 1.4142135623730949);
  EXPECT_EQ(rounded_down(lower).value, -1.4142135623730951);
  EXPECT_EQ(upper.sign_of(polynomial(0, 5, -7)), 1);
  EXPECT_EQ(upper.sign_of(polynomial(0, 0, -1)), -1);
  EXPECT_EQ(upper.sign_of(polynomial(0, 0, 0)), 0);
  EXPECT_EQ(upper.sign_of(polynomial(3, 0, -6)), 0);
  EXPECT_FALSE(upper.as_fraction());
  EXPECT_FALSE(Exact_root::of(polynomial(1, 0, 2), Exact_root::Which::lower));
  EXPECT_FALSE(Exact_root::of(polynomial(0, 0, 2), Exact_root::Which::lower));
  EXPECT_FALSE(Exact_root::of(polynomial(0, 0, 0), Exact_root::Which::lower));
  EXPECT_EQ(Exact_root::of(polynomial(4, -4, 1), Exact_root::Which::lower), Exact_root(Fraction(0.5)));
  EXPECT_EQ(Exact_root(Fraction(0.5)), 0.5);
  EXPECT_TRUE(are_proportional(polynomial(0, 0, 0), polynomial(0, 0, 0)));
  EXPECT_FALSE(are_proportional(polynomial(0, 0, 0), polynomial(0, 0, 1)));
  EXPECT_FALSE(are_proportional(polynomial(1, 2, 0), polynomial(0, 0, 0)));
  EXPECT_TRUE(are_proportional(polynomial(1, 2, 0), polynomial(-2, -4, 0)));
  EXPECT_FALSE(are_proportional(polynomial(1, 0, 2), polynomial(-1, 0, 2)));
  EXPECT_FALSE(are_proportional(polynomial(1, 2, 3), polynomial(1, 2, 4)));
}

/// A time, and the root that it is.
struct Judged_time {
  Exact_time time;
  Judged_root root;
};

/// Times that are n/d, or very close to it, with all kinds of sources.
std::vector<Judged_time> times_near(int n, int d, Random& random) {
  const Judged_root fraction = judged_root(Rational_judge(n) / d);
  const double x = n, y = d;
  std::vector<Judged_time> result{
      {to_time(Fraction(Ring(n), Ring(d))), fraction},
      {to_time(Crossing<2>{{0, 0}, {y, y}, {{{x - 1, x + 1}, {x + 1, x - 1}}}}), fraction},
      {to_time(Crossing<3>{{0, 0, 0}, {y, y, 0}, {{{x - 1, x + 1, 0}, {x + 1, x - 1, 0}, {x, x, 1}}}}),
       fraction},
      {Exact_time(x / y), judged_root(Rational_judge(x / y))}};
  const auto add = [&](const Polynomial& p) {
    for (const Judged_root& root : judged_roots(p)) result.push_back({to_time(root_of(root)), root});
  };
  const auto with_factor = [&] { return product_of_factors(d, -n, integer(random, 2), not_zero(random, 3)); };
  const Polynomial p = with_factor();
  add(p);
  add(with_factor());
  add(times(-3, product_of_factors(d, -n, d, -n)));
  add(sum(p, times(power_of_two(-60 - static_cast<int>(random.below(150))), small(random))));
  return result;
}

TEST(ExactRoot, IsComparedWithOtherTimes) {
  Random random(4);
  const auto is_root = [](const Exact_time& time) {
    return time.fraction() && std::holds_alternative<Exact_root>(time.fraction()->source);
  };
  const auto is_crossing = [](const Exact_time& time) {
    return time.fraction() && (std::holds_alternative<Crossing<2>>(time.fraction()->source) ||
                               std::holds_alternative<Crossing<3>>(time.fraction()->source));
  };
  int equal_crossings = 0, equal_fractions = 0, equal_roots = 0, near_crossings = 0, near_fractions = 0,
      near_roots = 0;
  for (int i = 0; i < 300; ++i) {
    const int d = 2 + static_cast<int>(random.below(9)), n = 1 + static_cast<int>(random.below(d - 1u));
    const auto times = times_near(n, d, random);
    for (const auto& [s, root_s] : times)
      for (const auto& [t, root_t] : times) {
        const int expected = judged_order(root_s, root_t);
        ASSERT_EQ(as_int(s <=> t), expected) << n << '/' << d << ": " << s.rounded() << ", " << t.rounded();
        if (!is_root(s) || !t.fraction() || s.rounded() != t.rounded() || s.fraction() == t.fraction())
          continue;
        int& count = is_crossing(t) ? (expected == 0 ? equal_crossings : near_crossings)
                     : is_root(t)   ? (expected == 0 ? equal_roots : near_roots)
                                    : (expected == 0 ? equal_fractions : near_fractions);
        ++count;
      }
  }
  EXPECT_GT(equal_crossings, 200);
  EXPECT_GT(equal_fractions, 200);
  EXPECT_GT(equal_roots, 100);
  EXPECT_GT(near_crossings, 200);
  EXPECT_GT(near_fractions, 200);
  EXPECT_GT(near_roots, 100);
}

}  // namespace
}  // namespace cellwalk::test
