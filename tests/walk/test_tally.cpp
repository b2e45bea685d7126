// SPDX-License-Identifier: LGPL-3.0-or-later
// Tallies: sums do not depend on the order of what is added, and are rounded to nearest.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/tally.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace cellwalk {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Value {
  std::size_t cell;
  double value;
};

std::vector<Value> some_values(std::size_t count, std::size_t cells, double largest) {
  Random random(7);
  std::vector<Value> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::ldexp(random.real(), -static_cast<int>(random.below(30)));
    values.push_back({random.below(cells), (i % 3 == 0 ? -size : size) * largest});
  }
  return values;
}

TEST(Tally, IsTheSumInAnyOrderAndDivision) {
  constexpr std::size_t cells = 5;
  for (const double largest : {1.0, 0x1.8p-200, 3e40}) {
    const std::vector<Value> values = some_values(3000, cells, largest);
    std::vector<Rational> exact(cells, 0);
    Tally forward(cells, largest), backward(cells, largest), first(cells, largest), second(cells, largest);
    for (std::size_t i = 0; i < values.size(); ++i) {
      exact[values[i].cell] += Rational(values[i].value);
      forward.add(values[i].cell, values[i].value);
      const Value& last = values[values.size() - 1 - i];
      backward.add(last.cell, last.value);
      (i % 7 < 3 ? first : second).add(values[i].cell, values[i].value);
    }
    Tally by_words = first;
    by_words.add_words(second.words());
    first.add(second);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      // The values have 30 + 53 bits below the largest, fewer than the 94 that are kept: the sums are exact.
      EXPECT_EQ(forward[cell], static_cast<double>(exact[cell])) << largest;
      EXPECT_EQ(backward[cell], forward[cell]);
      EXPECT_EQ(first[cell], forward[cell]);
      EXPECT_EQ(by_words[cell], forward[cell]);
    }
  }
}

TEST(Tally, RoundsSumsToNearest) {
  Tally tally(1, 1.0);
  for (int i = 0; i < 1000; ++i) tally.add(0, 1.0);
  EXPECT_EQ(tally[0], 1000.0);
  tally.add(0, 0x1p-44);  // half an ulp of 1000: to the even one
  EXPECT_EQ(tally[0], 1000.0);
  tally.add(0, 0x1p-90);
  EXPECT_EQ(tally[0], std::nextafter(1000.0, 2000.0));
  tally.add(0, -0x1p-89);
  EXPECT_EQ(tally[0], 1000.0);
}

TEST(Tally, RoundsWhatLiesFarBelowTheBound) {
  Tally tally(2, 1.0);
  tally.add(0, 0x1p-200);
  tally.add(0, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(tally[0], 0);
  tally.add(1, 0x1.8p-93);
  EXPECT_EQ(tally[1], 0x1p-92);
}

TEST(Tally, RefusesBoundsAndOtherTallies) {
  for (const double largest : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(Tally(3, largest), Error);
  Tally tally(3, 1.0);
  EXPECT_THROW(tally.add(Tally(2, 1.0)), Error);
  EXPECT_THROW(tally.add(Tally(3, 2.0)), Error);
}

}  // namespace
}  // namespace cellwalk
