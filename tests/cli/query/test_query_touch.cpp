// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk query --mode move --touch stop.
#include <random>
#include <string>
#include <vector>

#include "cli/ovm_text.h"
#include "cli/query/query_table.h"

namespace cellwalk::test {
namespace {

class QueryTouch : public Query_table {
 protected:
  /// Of the answers.
  enum Column { row, status, time, x, y, z, kind, nx, ny, nz, cells, cell };

  QueryTouch()
      : Query_table({"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"}) {}
};

TEST_F(QueryTouch, StopsWhereAWallIsMet) {
  succeed({"generate", "squares", "--cells", "5", "-o", "env.ovm"});
  write("env.ovm", Ovm_text(text("env.ovm")).set_solid(12).text());
  const std::string moves =
      "ax,ay,bx,by\n"
      "0.5,2,4.5,2\n"      // along a side of the obstacle
      "1.5,2.5,2.5,3.5\n"  // past its corner
      "0.5,0.5,0.5,5\n"    // to the outer wall
      "0.5,0.5,4.5,0.5\n"  // nowhere near
      "0.5,0.5,0.5,6\n"    // out
      "0.5,5,0.5,4.5\n"    // off a wall
      "0.5,5,0.5,5.5\n"    // through the wall it stands on
      "0.5,5,1.5,5\n";     // along it
  const auto pass = query(moves, {"--touch", "pass"});
  const auto stop = query(moves, {"--touch", "stop"});
  ASSERT_EQ(stop.size(), 8u);
  for (const std::size_t i : {0, 1, 2, 3, 5, 7}) EXPECT_EQ(pass[i][status], "free") << i;
  EXPECT_EQ(stop[0][status] + " " + stop[0][time] + " " + stop[0][kind], "contact 0.375 vertex");
  EXPECT_EQ(stop[0][x] + " " + stop[0][y], "2 2");
  EXPECT_EQ(stop[1][status] + " " + stop[1][time] + " " + stop[1][kind], "contact 0.5 vertex");
  EXPECT_EQ(stop[2], (Row{"2", "contact", "1", "0.5", "5", "", "facet", "0", "-1", "", "5", "20"}));
  EXPECT_EQ(stop[3], pass[3]);
  EXPECT_EQ(stop[4][status] + " " + stop[4][kind] + " " + stop[4][y], "contact facet 5");
  EXPECT_EQ(stop[4][cell], pass[4][cell]);
  EXPECT_EQ(stop[5], pass[5]);
  EXPECT_EQ(stop[6][status] + " " + stop[6][time], "contact 0");
  EXPECT_EQ(stop[7][status] + " " + stop[7][time], "contact 0");
}

TEST_F(QueryTouch, ComesNoLaterThanACrossingAndAtTheSameTimeInGeneralPosition) {
  succeed({"generate", "lattice", "--cells", "4", "--seed", "3", "-o", "env.ovm"});
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anywhere(0, 4);
  std::uniform_int_distribution<int> halves(0, 8);
  std::string moves = "ax,ay,az,bx,by,bz\n";
  for (int i = 0; i < 2000; ++i)
    for (int j = 0; j < 6; ++j)
      moves += std::to_string(i % 2 ? anywhere(random) : halves(random) / 2.) + (j < 5 ? "," : "\n");
  const auto pass = query(moves);
  const auto stop = query(moves, {"--touch", "stop", "--threads", "2"});
  const std::string expected = text("out.csv");
  int crossed = 0, touched = 0, general = 0;
  for (std::size_t i = 0; i < pass.size(); ++i) {
    if (pass[i][status] == "contact") {
      ++crossed;
      ASSERT_EQ(stop[i][status], "contact") << i;
      // The walk's own times are rounded to within 4 ulp.
      EXPECT_LE(std::stod(stop[i][time]), std::stod(pass[i][time]) * (1 + 8 * 0x1p-53)) << i;
    } else if (stop[i][status] == "contact") {
      ++touched;
    }
    if (i % 2 == 0 || pass[i][status] == "outside") continue;
    ++general;
    EXPECT_EQ(stop[i][status], pass[i][status]) << i;
    if (stop[i][status] != "contact") continue;
    EXPECT_NEAR(std::stod(stop[i][time]), std::stod(pass[i][time]), 1e-15) << i;
    for (const Column column : {kind, nx, ny, nz, cell}) EXPECT_EQ(stop[i][column], pass[i][column]) << i;
  }
  EXPECT_GT(crossed, 500);
  EXPECT_GT(touched, 50);
  EXPECT_GT(general, 500);
  query(moves, {"--touch", "stop", "--threads", "1"});
  EXPECT_EQ(text("out.csv"), expected);
}

TEST_F(QueryTouch, NeedsTheExactKernel) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  for (const char* kernel : {"lazy", "double", "float"})
    expect_refused(2, "ax,ay,bx,by\n", {"--touch stop needs --kernel exact"},
                   {"--touch", "stop", "--kernel", kernel});
}

}  // namespace
}  // namespace cellwalk::test
