// SPDX-License-Identifier: LGPL-3.0-or-later
// All changes of an environment, at random, one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "reshape/operations_soak.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <int D>
void soak(bool generic, std::size_t worlds) {
  test::Operation_tally tally;
  const std::string name = std::to_string(D) + "D " + (generic ? "generic" : "lattice");
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 4 + 1);
  for (std::uint64_t number = 0; number < count; ++number) {
    SCOPED_TRACE(name + ", world " + std::to_string(number));
    test::Operations_world<D> world(number, generic);
    test::Operations<D> operations(world, tally);
    for (int phase = 0; phase < 16; ++phase) {
      SCOPED_TRACE("phase " + std::to_string(phase));
      operations.run_phase();
      if (testing::Test::HasFailure()) break;
    }
    constexpr std::size_t printed_every = 100;
    if (number % printed_every == printed_every - 1) tally.print(name.c_str());
    if (testing::Test::HasFailure()) break;
  }
  tally.print(name.c_str());
  const test::Replacement_tally& made = tally.replacements;
  for (std::size_t k = 0; k < made.made.size(); ++k)
    if (D == 3 || k != 3) {
      EXPECT_GE(made.made[k], std::max<std::size_t>(count / 16, D == 2)) << made.names[k];
    }
  EXPECT_GT(tally.improvements, count);
  EXPECT_GT(tally.closings.made, static_cast<int>(count));
  EXPECT_GT(tally.closings.refused, static_cast<int>(count / 4));
  EXPECT_GT(tally.growths.opened + tally.growths.excavated, static_cast<int>(count));
  EXPECT_GT(tally.peeled, count);
  EXPECT_GT(tally.merged, count / 2);
  if (!oracle::is_shortened()) {
    EXPECT_GT(tally.merges_held, count / 16);
  }
  EXPECT_GT(tally.slit, count / 16);
  EXPECT_GT(tally.peels, tally.peeled);
  EXPECT_GT(tally.split, count);
  EXPECT_GT(tally.opened, count / 16);
  EXPECT_GT(tally.moved, count);
  EXPECT_GT(tally.contacts, count / 16);
}

TEST(OperationsSoak, Generic2D) { soak<2>(true, 50); }
TEST(OperationsSoak, Lattice2D) { soak<2>(false, 50); }
TEST(OperationsSoak, Generic3D) { soak<3>(true, 12); }
TEST(OperationsSoak, Lattice3D) { soak<3>(false, 10); }

}  // namespace
}  // namespace cellwalk
