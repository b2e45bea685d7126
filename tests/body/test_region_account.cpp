// SPDX-License-Identifier: LGPL-3.0-or-later
// When a body goes without regions: they are tried for so many steps, and left for longer and longer.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "body/region_account.h"

namespace cellwalk::detail {
namespace {

constexpr std::size_t vertices = 100;
/// More than a body has in its account.
constexpr Region_effort dear{.cells = 1'000'000};

int steps_of_rest(Region_account& account) {
  int steps = 0;
  while (!account.begin_step()) ++steps;
  return steps;
}

TEST(RegionAccount, RodsRestFirst) {
  Region_account rod(vertices, true), other(vertices, false);
  EXPECT_EQ(steps_of_rest(rod), 8);
  EXPECT_EQ(steps_of_rest(other), 0);
}

TEST(RegionAccount, RestsTwiceAsLongAfterEachAttemptInVain) {
  Region_account account(vertices, false);
  std::vector<int> rests;
  for (int attempt = 0; attempt < 7; ++attempt) {
    ASSERT_TRUE(account.begin_step());
    account.pay_search(dear);
    rests.push_back(steps_of_rest(account));
  }
  EXPECT_EQ(rests, (std::vector<int>{65, 129, 257, 513, 1025, 1025, 1025}));
}

TEST(RegionAccount, GoesOnWhileSearchesAreEarned) {
  Region_account account(vertices, false);
  Region_effort search{.cells = 50, .walls = 200};  // 18,500
  for (int step = 0; step < 1000; ++step) {
    ASSERT_TRUE(account.begin_step()) << step;
    account.pay_search(search);
    for (std::size_t v = 0; v < vertices; ++v) account.earn(2);  // 35,000
  }
  // It saved no more than a body may: 400,000.
  int searches = 0;
  while (account.begin_step()) {
    account.pay_search(search);
    ++searches;
  }
  EXPECT_EQ(searches, 22);
}

TEST(RegionAccount, ForgetsRestsAfterGoodTimes) {
  Region_account account(vertices, false);
  for (int attempt = 0; attempt < 3; ++attempt) {
    account.pay_search(dear);
    steps_of_rest(account);
  }
  for (std::size_t move = 0; move < 10'000; ++move) account.earn(3);
  ASSERT_TRUE(account.begin_step());
  account.pay_search(dear);
  EXPECT_EQ(steps_of_rest(account), 65);
}

TEST(RegionAccount, MovesAndChainsAreCharged) {
  Region_account by_moves(1, false), by_chains(1, false);  // 2,000
  for (int i = 0; i < 13; ++i) by_moves.pay_move();
  EXPECT_TRUE(by_moves.begin_step());
  by_moves.pay_move();
  EXPECT_FALSE(by_moves.begin_step());
  by_chains.pay_chain();
  by_chains.pay_chain();
  EXPECT_TRUE(by_chains.begin_step());
  by_chains.pay_chain();
  EXPECT_FALSE(by_chains.begin_step());
}

}  // namespace
}  // namespace cellwalk::detail
