// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "common/confidence.h"
#include "common/manifest.h"
#include "common/seeds.h"

namespace cellwalk::experiments {
namespace {

TEST(Confidence, IntervalsOfWilsonByTheBook) {
  const Share_interval i = confidence_interval(10, 100);
  EXPECT_NEAR(i.low, 0.0552, 5e-5);
  EXPECT_NEAR(i.high, 0.1744, 5e-5);
  const Share_interval half = confidence_interval(50, 100);
  EXPECT_NEAR(half.low + half.high, 1, 1e-15);
  EXPECT_NEAR(half.low, 0.4038, 5e-5);
}

TEST(Confidence, RuleOfThreeWhereNoneOrAllFailed) {
  EXPECT_EQ(confidence_interval(0, 1000).low, 0);
  EXPECT_EQ(confidence_interval(0, 1000).high, 3.0 / 1000);
  EXPECT_EQ(confidence_interval(1000, 1000).low, 1 - 3.0 / 1000);
  EXPECT_EQ(confidence_interval(1000, 1000).high, 1);
  EXPECT_EQ(confidence_interval(0, 2).high, 1);
  EXPECT_EQ(confidence_interval(0, 0).high, 1);
}

TEST(Confidence, HoldsTheShareAndNarrows) {
  double width = 1;
  for (std::uint64_t n = 10; n <= 1'000'000; n *= 10) {
    const Share_interval i = confidence_interval(n / 10, n);
    EXPECT_LT(i.low, 0.1);
    EXPECT_GT(i.high, 0.1);
    EXPECT_LT(i.high - i.low, width);
    width = i.high - i.low;
  }
  EXPECT_LT(width, 0.0013);
}

TEST(Seeds, PartsAndNumbersDiffer) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t seed : {1u, 2u})
    for (const char* part : {"", "a", "b", "ab", "ba"})
      for (std::uint64_t number = 0; number < 100; ++number) seeds.insert(part_seed(seed, part, number));
  EXPECT_EQ(seeds.size(), 2u * 5 * 100);
  static_assert(part_seed(1, "walks", 2) == part_seed(1, "walks", 2));
}

TEST(Manifest, SaysWhatWasBuilt) {
  const auto m = manifest("abc");
  EXPECT_EQ(m.at("commit"), "abc");
  EXPECT_NE(m.at("flags").get<std::string>().find("-ffp-contract=off"), std::string::npos);
  for (const char* key : {"cellwalk", "compiler", "processor"}) EXPECT_NE(m.at(key), "") << key;
  EXPECT_NE(m.at("versions").at("cgal"), "");
  EXPECT_NE(m.at("versions").at("boost"), "");
}

}  // namespace
}  // namespace cellwalk::experiments
