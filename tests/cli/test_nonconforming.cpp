// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes that do not conform, at every door.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

/// A square beside two smaller ones.
const char* const hanging_off =
    "OFF\n8 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n2 1 0\n3 0 0\n3 1 0\n3 2 0\n4 0 1 2 3\n4 1 5 6 4\n4 4 6 7 2\n";

const std::vector<std::string> refusal{
    "hanging.off: cells 0 and 1 share a part of a line at (2, 0.5) but no facet, the first of 2 "
    "such pairs: divide them by `cellwalk import`, with neither --strict nor --conform off, or keep "
    "duplicates "
    "(--duplicates keep) to have walls there"};

using Nonconforming = Program;

TEST_F(Nonconforming, IsRefusedByEveryCommandThatReadsItAsItIs) {
  write("hanging.off", hanging_off);
  write("moves.csv", "ax,ay,bx,by\n1,0.5,2.5,0.5\n");
  write("walls.csv", "point,x,y\n3,0,2.5\n");
  write("changes.json", R"({"changes": [{"fill": {"box": [[0, 0], [1.5, 1.5]]}}]})");
  write("scene.json", R"({"environment": "hanging.off", "particles": [{"count": 3}], "steps": 2})");
  expect_failure(4, {"check", "hanging.off"}, refusal);
  expect_failure(4, {"import", "hanging.off", "-o", "env.ovm", "--json", "r.json", "--conform", "off"},
                 refusal);
  expect_failure(4, {"import", "hanging.off", "-o", "env.ovm", "--duplicates", "merge", "--conform", "off"},
                 refusal);
  expect_failure(4, {"query", "hanging.off", "moves.csv", "-o", "a.csv"}, refusal);
  expect_failure(4, {"deform", "hanging.off", "walls.csv", "-o", "env.ovm"}, refusal);
  expect_failure(4, {"edit", "hanging.off", "changes.json", "-o", "env.ovm"}, refusal);
  expect_failure(4, {"run", "scene.json", "-o", "out"}, refusal);
}

TEST_F(Nonconforming, IsRefinedByImport) {
  write("hanging.off", hanging_off);
  write("moves.csv", "ax,ay,bx,by\n1,0.5,2.5,0.5\n1,1,2.5,1\n2.5,0.5,2.5,1.5\n");
  for (const std::string environment : {"env.ovm", "env.cellwalk"}) {
    const std::string said = succeed({"import", "hanging.off", "-o", environment, "--json", "report.json"});
    EXPECT_NE(
        said.find("  refined     cells did not conform: 2 pairs of facets overlapped, the first of cells "
                  "0 and 1 at (2, 0.5)\n              1 facet divided into 2 pieces\n"),
        std::string::npos)
        << said;
    const auto report = nlohmann::json::parse(text("report.json"));
    EXPECT_EQ(report.at("refined").at("pairs"), 2);
    EXPECT_EQ(report.at("refined").at("facets"), 1);
    EXPECT_EQ(report.at("refined").at("pieces"), 2);
    EXPECT_EQ(report.at("refined").at("points_added"), 0);
    EXPECT_EQ(report.at("certificate").at("components"), 1);
    EXPECT_EQ(report.at("certificate").at("walls"), 7);
    succeed({"check", environment});
    succeed({"query", environment, "moves.csv", "-o", "a.csv"});
    const auto answers = read_table(path("a.csv"));
    for (std::size_t row = 1; row <= 3; ++row) EXPECT_EQ(answers[row][1], "free");
  }
  // What it wrote conforms.
  succeed({"import", "env.ovm", "-o", "again.ovm", "--json", "report.json"});
  EXPECT_EQ(nlohmann::json::parse(text("report.json")).at("refined").at("pairs"), 0);
  EXPECT_EQ(text("again.ovm"), text("env.ovm"));
}

TEST_F(Nonconforming, HasWallsIfDuplicatesAreKept) {
  write("hanging.off", hanging_off);
  write("moves.csv", "ax,ay,bx,by\n1,0.5,2.5,0.5\n2.5,0.5,2.5,1.5\n");
  const std::string said =
      succeed({"import", "hanging.off", "-o", "env.ovm", "--json", "report.json", "--duplicates", "keep"});
  const std::string note =
      "  noted       2 pairs of facets that overlap in a line, with walls between free cells: the first of "
      "cells 0 and 1 at (2, 0.5)\n";
  EXPECT_NE(said.find(note), std::string::npos) << said;
  const auto facing = nlohmann::json::parse(text("report.json")).at("changed").at("facing_walls");
  EXPECT_EQ(facing.at("overlapping").at("pairs"), 2);
  EXPECT_EQ(facing.at("overlapping").at("first").at("cells"), (std::vector<int>{0, 1}));
  EXPECT_EQ(facing.at("near").at("pairs"), 0);
  expect_failure(4, {"check", "env.ovm"}, {"env.ovm: cells 0 and 1 share a part of a line"});
  EXPECT_NE(succeed({"check", "env.ovm", "--duplicates", "keep"}).find(note), std::string::npos);
  succeed({"query", "env.ovm", "moves.csv", "-o", "a.csv", "--duplicates", "keep"});
  EXPECT_EQ(read_table(path("a.csv"))[1][1], "contact");
  EXPECT_EQ(read_table(path("a.csv"))[2][1], "free");
  // A compiled file keeps them apart.
  succeed({"import", "hanging.off", "-o", "env.cellwalk", "--duplicates", "keep"});
  EXPECT_NE(succeed({"check", "env.cellwalk"}).find(note), std::string::npos);
}

TEST_F(Nonconforming, GapsOfRoundingAreRefusedClosedOrNoted) {
  // A smaller square begins an ulp beyond a larger one.
  write(
      "gap.off",
      "OFF\n8 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n2.0000000000000004 1 0\n3 1 0\n3 2 0\n2.0000000000000004 2 0\n"
      "4 0 1 2 3\n4 4 5 6 7\n");
  expect_failure(4, {"import", "gap.off", "-o", "env.ovm"},
                 {"cells 0 and 1 have facets that face each other at (2, 1.5) but do not touch",
                  "--conform 1e-9", "--conform off"});
  const std::string said =
      succeed({"import", "gap.off", "-o", "env.ovm", "--json", "report.json", "--conform", "off"});
  const std::string note =
      " of facets within 3.60555e-09 of each other, with walls between free cells: the first of cells 0 and "
      "1 "
      "at (2, 1.5), 4.44089e-16 apart\n";
  EXPECT_NE(said.find("nothing: every cell is exact as it is"), std::string::npos) << said;
  EXPECT_NE(said.find("  noted       1 pair" + note), std::string::npos) << said;
  const auto near = nlohmann::json::parse(text("report.json")).at("changed").at("facing_walls").at("near");
  EXPECT_EQ(near.at("pairs"), 1);
  EXPECT_EQ(near.at("first").at("distance"), 0x1p-51);
  EXPECT_NE(succeed({"check", "env.ovm", "--json", "report.json"}).find("1 pair" + note), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text("report.json")).at("facing_walls").at("near").at("pairs"), 1);
  // The file marks its walls: they are meant.
  EXPECT_NE(succeed({"import", "env.ovm", "-o", "again.ovm"}).find("1 pair" + note), std::string::npos);
  EXPECT_EQ(text("again.ovm"), text("env.ovm"));
  const std::string joined =
      succeed({"import", "gap.off", "-o", "env.ovm", "--json", "report.json", "--conform", "1e-9"});
  EXPECT_NE(joined.find("joined with others, the farthest by 4.44089e-16"), std::string::npos) << joined;
  EXPECT_EQ(nlohmann::json::parse(text("report.json")).at("certificate").at("components"), 1);
  EXPECT_EQ(nlohmann::json::parse(text("report.json")).at("certificate").at("walls"), 7);
}

}  // namespace
}  // namespace cellwalk::test
