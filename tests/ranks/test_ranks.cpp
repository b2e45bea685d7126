// SPDX-License-Identifier: LGPL-3.0-or-later
// Ranks as far as one process goes; several are in test_mpi.py.
#include <cellwalk/internal/ranks/ranks.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cellwalk {
namespace {

TEST(Ranks, AloneHandsEverythingToItself) {
  Ranks ranks = Ranks::join();
  EXPECT_TRUE(ranks.is_alone());
  EXPECT_TRUE(ranks.is_first());
  EXPECT_FALSE(is_later_rank());
  EXPECT_EQ(ranks.block(7).begin, 0u);
  EXPECT_EQ(ranks.block(7).end, 7u);
  EXPECT_EQ(ranks.gather("mine"), std::vector<std::string>{"mine"});
  EXPECT_EQ(ranks.broadcast("all's"), "all's");
  ranks.fail(Error_code::input, "the caller has printed it");  // and goes on: it ends itself
  ranks.leave();
}

}  // namespace
}  // namespace cellwalk
