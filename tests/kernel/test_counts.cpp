// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/counts.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace cellwalk {
namespace {

struct Inner {
  std::uint64_t deep = 0;
  static constexpr std::array<std::string_view, 1> names{"deep"};
};

struct Outer {
  std::uint64_t first = 0, second = 0;
  Inner inner;
  static constexpr std::array<std::string_view, 2> names{"first", "second"};
};

TEST(Counts, EveryOneIsAdded) {
  Outer sum{1, 2, {3}};
  sum += Outer{10, 20, {30}};
  EXPECT_EQ(sum.first, 11u);
  EXPECT_EQ(sum.second, 22u);
  EXPECT_EQ(sum.inner.deep, 33u);
}

TEST(Counts, HaveTheirNamesInOrder) {
  const auto named = named_counts(Outer{1, 2, {3}});
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(named[0], std::pair(std::string_view("first"), std::uint64_t{1}));
  EXPECT_EQ(named[1], std::pair(std::string_view("second"), std::uint64_t{2}));
}

TEST(Counts, WithoutANameAreNoticed) {
  EXPECT_TRUE(names_all_before<Outer>(offsetof(Outer, inner)));
  EXPECT_FALSE(names_all_before<Outer>(sizeof(Outer)));
}

}  // namespace
}  // namespace cellwalk
