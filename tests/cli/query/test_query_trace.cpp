// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk query --trace and --tally: the cells that motions cross, their lengths, and sums by cell.
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "cli/ovm_text.h"
#include "cli/query/query_table.h"

namespace cellwalk::test {
namespace {

class QueryTrace : public Query_table {
 protected:
  QueryTrace()
      : Query_table({"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"}) {}

  std::vector<Row> pieces() const {
    auto rows = read_table(path("pieces.csv"));
    EXPECT_EQ(rows.at(0), (Row{"row", "cell", "length"}));
    rows.erase(rows.begin());
    return rows;
  }

  /// Motions in a grid of n cubes or squares, half of them between lattice points.
  std::string moves(int dimension, int n, std::size_t count) const {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> anywhere(0, n);
    std::uniform_int_distribution<int> halves(0, 2 * n);
    std::string text = dimension == 2 ? "ax,ay,bx,by,weight\n" : "ax,ay,az,bx,by,bz,weight\n";
    for (std::size_t i = 0; i < count; ++i) {
      for (int j = 0; j < 2 * dimension; ++j)
        text += std::to_string(i % 2 != 0 ? anywhere(random) : halves(random) / 2.) + ",";
      text += std::to_string(1 + i % 3) + "\n";
    }
    return text;
  }
};

TEST_F(QueryTrace, GivesTheCellsAndTheLengths) {
  succeed({"generate", "squares", "--cells", "4", "-o", "env.ovm"});
  query(
      "ax,ay,bx,by\n"
      "0.5,0.5,3.5,0.5\n"  // through four cells
      "0.5,0.5,2.5,2.5\n"  // through vertices
      "0.5,1,1.5,1\n"      // along an edge of cells
      "0.25,0.5,-4,0.5\n"  // to the outer wall
      "0.5,0.5,0.5,0.5\n"  // nowhere
      "-1,0.5,0.5,0.5\n"   // from outside
      "1,0.5,2,0.5\n",     // from one side of a cell to the other
      {"--trace", "pieces.csv"});
  const std::string diagonal = "0.7071067811865476", twice = "1.4142135623730951";
  const std::vector<Row> rows = pieces();
  const std::vector<Row> expected{{"0", "0", "0.5"},    {"0", "1", "1"},      {"0", "2", "1"},
                                  {"0", "3", "0.5"},    {"1", "0", diagonal}, {"1", "5", twice},
                                  {"1", "10", diagonal}};
  ASSERT_GE(rows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(rows[i], expected[i]) << i;
  std::map<std::string, double> length;
  for (const Row& row : rows) length[row[0]] += std::stod(row[2]);
  EXPECT_EQ(length["2"], 1);
  EXPECT_EQ(length["3"], 0.25);
  EXPECT_EQ(length.count("4"), 0u);
  EXPECT_EQ(length.count("5"), 0u);
  EXPECT_EQ(length["6"], 1);
}

TEST_F(QueryTrace, SumsUpTheSameForAnyThreads) {
  for (const int dimension : {2, 3}) {
    succeed({"generate", dimension == 2 ? "squares" : "lattice", "--cells", "4", "-o", "env.ovm"});
    const std::string table = moves(dimension, 4, 5000);
    const auto answers = query(table, {"--trace", "pieces.csv", "--tally", "one.vtu", "--threads", "1"});
    const std::string first = text("pieces.csv");
    query(table, {"--trace", "pieces.csv", "--tally", "two.vtu", "--threads", "2"});
    EXPECT_EQ(text("pieces.csv"), first);
    EXPECT_EQ(text("one.vtu"), text("two.vtu"));
    EXPECT_NE(text("one.vtu").find("track_length"), std::string::npos);
    // The pieces of a free motion are as long as it.
    std::vector<double> sums(answers.size());
    for (const Row& row : pieces()) sums[std::stoul(row[0])] += std::stod(row[2]);
    const auto motions = read_table(path("queries.csv"));
    std::size_t free = 0, blocked = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      double square = 0;
      for (int k = 0; k < dimension; ++k)
        square += std::pow(std::stod(motions[i + 1][dimension + k]) - std::stod(motions[i + 1][k]), 2);
      const double length = std::sqrt(square);
      if (answers[i][1] == "free") {
        ++free;
        EXPECT_NEAR(sums[i], length, 1e-14 * (1 + length)) << i;
      } else if (answers[i][1] == "contact") {
        ++blocked;
        EXPECT_NEAR(sums[i], std::stod(answers[i][2]) * length, 1e-14 * (1 + length)) << i;
      } else {
        EXPECT_EQ(sums[i], 0) << i;
      }
    }
    EXPECT_GT(free, 1000u);
    if (dimension == 3) {
      EXPECT_GT(blocked, 1000u);
    }
  }
}

TEST_F(QueryTrace, TakesWeightsFromTheTable) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  query("ax,ay,bx,by,weight\n0.25,0.5,0.75,0.5,3\n1.5,0.5,0.5,0.5,-1\n0.5,1.5,0.75,1.5,x\n",
        {"--tally", "sums.vtu"});
  EXPECT_NE(warned_.find("queries.csv:4"), std::string::npos) << warned_;
  query("ax,ay,bx,by,weight\n0.25,0.5,1.25,0.5,1\n", {"--tally", "same.vtu"});
  query("ax,ay,bx,by\n0.25,0.5,1.25,0.5\n", {"--tally", "plain.vtu"});
  EXPECT_EQ(text("same.vtu"), text("plain.vtu"));
  EXPECT_NE(text("same.vtu"), text("sums.vtu"));
}

TEST_F(QueryTrace, RefusesWhatHasNoPieces) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  const std::string move = "ax,ay,bx,by\n0.5,0.5,0.75,0.5\n";
  for (const char* option : {"--trace", "--tally"}) {
    expect_refused(2, move, {option, "--touch pass"}, {option, "p.csv", "--touch", "stop"});
    expect_refused(2, move, {option, "--kernel exact"}, {option, "p.csv", "--kernel", "double"});
    expect_refused(2, move, {option, "without a radius"}, {option, "p.csv", "--radius", "0.1"});
    expect_refused(2, "px,py,tx,ty,qx,qy\n", {option, "--mode move"}, {option, "p.csv", "--mode", "sweep"});
  }
}

}  // namespace
}  // namespace cellwalk::test
