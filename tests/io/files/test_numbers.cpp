// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/numbers.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace cellwalk::io {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(Numbers, AreReadAsDecimalHexadecimalAndFraction) {
  struct Case {
    const char* text;
    double value;
  };
  const Case cases[] = {{"1.5", 1.5},
                        {"+2", 2},
                        {"-0", -0.0},
                        {"-1.55991e-008", -1.55991e-8},
                        {".5", 0.5},
                        {"5e-324", 5e-324},
                        {"1e-400", 0},
                        {"-1e-400", -0.0},
                        {"0x1.8p+1", 3},
                        {"-0X1.8P1", -3},
                        {"+0x1p-1074", 5e-324},
                        {"0x.8p0", 0.5},
                        {"3/4", 0.75},
                        {"-6/8", -0.75},
                        {"0/7", 0},
                        {"-0/7", -0.0},
                        {"008/0016", 0.5},
                        {"10/5", 2},
                        {"9007199254740993/9007199254740993", 1}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const Parsed_number n = parse_number(c.text);
    ASSERT_TRUE(n) << n.reason;
    EXPECT_EQ(bits(n.value), bits(c.value));
  }
}

TEST(Numbers, AreRefusedWithAReason) {
  struct Case {
    const char *text, *reason;
  };
  const Case cases[] = {{"", "an empty field where a number is expected"},
                        {"abc", "'abc' is not a number that a double can hold"},
                        {"1.5x", "'1.5x' is not a number that a double can hold"},
                        {"1 2", "'1 2' is not a number that a double can hold"},
                        {"+-1", "'+-1' is not a number that a double can hold"},
                        {"1e999", "'1e999' is not a number that a double can hold"},
                        {"0x", "'0x' is not a number that a double can hold"},
                        {"0x-1", "'0x-1' is not a number that a double can hold"},
                        {"inf", "'inf' is not finite"},
                        {"nan", "'nan' is not finite"},
                        {"1/3", "the fraction '1/3' is not exactly a double"},
                        {"9007199254740993/1", "the fraction '9007199254740993/1' is not exactly a double"},
                        {"1/0", "the denominator of '1/0' is zero"},
                        {"1/-2", "'1/-2' is not a fraction of integers"},
                        {"1.5/2", "'1.5/2' is not a fraction of integers"},
                        {"/2", "'/2' is not a fraction of integers"},
                        {"1/", "'1/' is not a fraction of integers"},
                        {"1/2/3", "'1/2/3' is not a fraction of integers"}};
  for (const Case& c : cases) EXPECT_EQ(parse_number(c.text).reason, c.reason) << c.text;
}

TEST(Numbers, FractionsReachTheEndsOfTheRange) {
  const std::string smallest =
      "1/" + std::string(
                 "202402253307310618352495346718917307049556649764142118356901358027430"
                 "3395679953463140098000000000000000");
  EXPECT_FALSE(parse_number(smallest));
  // 2^-1074 and 2^-1075 as fractions; the second is not a double.
  std::string power = "1";
  auto doubled = [](std::string d) {
    int carry = 0;
    for (std::size_t i = d.size(); i-- > 0;) {
      const int x = (d[i] - '0') * 2 + carry;
      d[i] = static_cast<char>('0' + x % 10);
      carry = x / 10;
    }
    return carry ? "1" + d : d;
  };
  for (int i = 0; i < 1023; ++i) power = doubled(power);
  EXPECT_EQ(parse_number(power + "/1").value, 0x1p1023);
  EXPECT_FALSE(parse_number(doubled(power) + "/1")) << "2^1024 overflows";
  for (int i = 1023; i < 1074; ++i) power = doubled(power);
  EXPECT_EQ(parse_number("1/" + power).value, 5e-324);
  EXPECT_FALSE(parse_number("1/" + doubled(power)));
  EXPECT_FALSE(parse_number(std::string(3000, '1') + "/1"));
}

TEST(Numbers, WrittenAreReadBackBitForBit) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    ASSERT_EQ(bits(parse_number(shortest(x)).value), bits(x)) << shortest(x);
    ASSERT_EQ(bits(parse_number(hexadecimal(x)).value), bits(x)) << hexadecimal(x);
  }
  EXPECT_EQ(shortest(-0.0), "-0");
  EXPECT_EQ(hexadecimal(3), "0x1.8p+1");
}

}  // namespace
}  // namespace cellwalk::io
