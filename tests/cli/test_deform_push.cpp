// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that push bodies, and walls that are only asked for, as `cellwalk deform` reports them.
#include <cmath>
#include <filesystem>

#include "cli/deform_program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

TEST_F(Deform, PushMovesTheRodOutOfTheWay) {
  make_plane({{0, 1}, {4, 5}});
  write("rod.csv", "x,y\n1.5,0.75\n1.5,1.25\n");
  const auto rows = deform("point,x,y\n6,1.75,1\n",
                           {"--body", "rod.csv", "--at-contact", "push", "--positions", "rods.csv"});
  EXPECT_EQ(rows.at(0), (Row{"0", "reached", "1", "1.75", "1", "", "", "", "", "", "", "", "", ""}));
  EXPECT_GT(report_["counts"]["pushes"].get<int>(), 0);
  EXPECT_NE(said_.find("\n  pushes      "), std::string::npos) << said_;
  const auto rods = read_table(path("rods.csv"));
  ASSERT_EQ(rods.size(), 3u);
  EXPECT_EQ(rods[0], (Row{"body", "vertex", "x", "y"}));
  // The membrane now leads from (1,0) over (1.75,1) to (1,2): the rod lies beyond, not far from it.
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(Row(rods[v + 1].begin(), rods[v + 1].begin() + 2), (Row{"0", std::to_string(v)}));
    const double x = std::stod(rods[v + 1][2]), y = std::stod(rods[v + 1][3]);
    EXPECT_GE(x, 1 + 0.75 * (1 - std::abs(y - 1))) << v;
    EXPECT_LT(x, 2) << v;
  }
  // It can stand there: what is written is the start of the next command.
  std::filesystem::rename(path("out.ovm"), path("env.ovm"));
  std::filesystem::rename(path("rods.csv"), path("rod.csv"));
  EXPECT_EQ(deform("point,x,y\n6,1.25,1\n", {"--body", "rod.csv"}).at(0)[1], "reached");
}

TEST_F(Deform, PushedBodiesStayBeforeOtherWalls) {
  make_plane({{0, 1}, {4, 5}, {1, 2}, {5, 6}});
  write("rod.csv", "x,y\n1.75,0.75\n1.75,1.25\n");
  const auto rows = deform("point,x,y\n6,1.9375,1\n",
                           {"--body", "rod.csv", "--at-contact", "push", "--positions", "rods.csv"});
  EXPECT_GT(report_["counts"]["pushes"].get<int>(), 0);
  EXPECT_GT(std::stod(rows.at(0)[3]), 1.75);
  const auto rods = read_table(path("rods.csv"));
  for (const std::size_t v : {1, 2}) EXPECT_LE(std::stod(rods.at(v)[2]), 2) << "behind the other membrane";
}

TEST_F(Deform, AskMovesNothing) {
  make_plane({{0, 1}, {4, 5}});
  write("rod.csv", "x,y\n1.5,0.75\n1.5,1.25\n");
  // The second does not see the first; nor is the last done.
  write("moves.csv", "point,x,y\n6,1.25,1\n6,1.75,1\n7,1.75,1\n");
  const std::vector<std::string> ask{"deform",       "env.ovm",     "moves.csv", "--body",  "rod.csv",
                                     "--at-contact", "test",        "--report",  "ask.csv", "--json",
                                     "ask.json",     "--positions", "rods.csv"};
  const std::string said = succeed(ask);
  EXPECT_TRUE(said.starts_with("env.ovm: certified, 2D\n")) << said;
  const auto rows = read_table(path("ask.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(Row(rows[1].begin() + 1, rows[1].begin() + 3), (Row{"reached", "1"}));
  EXPECT_EQ(Row(rows[2].begin() + 1, rows[2].begin() + 5), (Row{"contact", "0.6666666666666666", "1", "1"}));
  EXPECT_EQ(Row(rows[3].begin() + 1, rows[3].begin() + 3), (Row{"reached", "1"}));
  EXPECT_EQ(json::parse(text("ask.json"))["counts"]["made"], 0);
  EXPECT_EQ(text("rods.csv"), "body,vertex,x,y\n0,0,1.5,0.75\n0,1,1.5,1.25\n");
  std::vector<std::string> both = ask;
  both.insert(both.end(), {"-o", "out.ovm"});
  std::filesystem::remove(path("ask.csv"));
  std::filesystem::remove(path("ask.json"));
  std::filesystem::remove(path("rods.csv"));
  expect_failure(2, both, {"--at-contact test moves nothing, so that there is no environment to write"});
}

}  // namespace
}  // namespace cellwalk::test
