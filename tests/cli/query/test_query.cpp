// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <random>
#include <string>
#include <vector>

#include "cli/meshes.h"
#include "cli/query/query_table.h"

namespace cellwalk::test {
namespace {

class Query : public Query_table {
 protected:
  /// Of the answers.
  enum Column { row, status, time, x, y, z, kind, nx, ny, nz, cells, cell };

  Query()
      : Query_table({"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"}) {}
};

constexpr const char* moves_header = "ax,ay,az,bx,by,bz\n";

TEST_F(Query, AnswersEveryStatusInSpace) {
  succeed({"generate", "hexes", "--cells", "4", "2", "2", "-o", "env.ovm"});
  const auto rows = query(std::string(moves_header) +
                          "0.5,0.5,0.5,2.5,0.5,0.5\n"   // two cells on
                          "0.5,0.5,0.5,0.5,0.5,-0.5\n"  // through the floor, half way
                          "9,9,9,1,1,1\n"               // from outside
                          "0.5,0.5,0.5,1/3,0.5,0.5\n"   // 1/3 is no double
                          "0.5,0.5,0.5,3/4,0.5,0x1p-1\n");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0], (Row{"0", "free", "1", "2.5", "0.5", "0.5", "", "", "", "", "3", "2"}));
  EXPECT_EQ(rows[1], (Row{"1", "contact", "0.5", "0.5", "0.5", "0", "facet", "0", "0", "1", "1", "0"}));
  EXPECT_EQ(rows[2], (Row{"2", "outside", "", "", "", "", "", "", "", "", "0", ""}));
  EXPECT_EQ(rows[3], (Row{"3", "invalid", "", "", "", "", "", "", "", "", "0", ""}));
  EXPECT_EQ(rows[4], (Row{"4", "free", "1", "0.75", "0.5", "0.5", "", "", "", "", "1", "0"}));
}

TEST_F(Query, SaysHowManyAndWhatWasInvalid) {
  succeed({"generate", "hexes", "--cells", "2", "-o", "env.ovm"});
  query(std::string(moves_header) + "1,1,1,1,1,1.5\n1,1,1,1,1,9\n1,1,1,nan,1,1\n1,1,1,1,1/3,1\n1,1,1,1\n");
  EXPECT_EQ(said_, "out.csv: 5 motions: 1 free, 1 contact, 3 invalid\n");
  EXPECT_TRUE(warned_.starts_with("cellwalk: queries.csv:4: ")) << warned_;
  EXPECT_NE(warned_.find("rows marked invalid: 3"), std::string::npos) << warned_;
  query(std::string(moves_header));
  EXPECT_EQ(said_, "out.csv: 0 motions\n");
  EXPECT_EQ(warned_, "");
}

TEST_F(Query, AnswersInThePlane) {
  succeed({"generate", "squares", "--cells", "3", "2", "-o", "env.ovm"});
  const auto rows = query(
      "ax,ay,bx,by\n"
      "0.5,0.5,2.5,0.5\n"
      "1.5,1.5,1.5,4.5\n"
      "2.5,1.5,3.5,2.5\n"  // into the corner
      "0.5,0.5,1.5,1.5\n"  // through an inner vertex
      "0,0.5,0,1.5\n"      // along the wall
      "0,0.5,-1,0.5\n");   // off the wall at once
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], (Row{"0", "free", "1", "2.5", "0.5", "", "", "", "", "", "3", "2"}));
  EXPECT_NEAR(std::stod(rows[1][time]), 0.5 / 3, 1e-15);
  EXPECT_EQ(rows[1][kind], "facet");
  EXPECT_EQ(rows[1][nx] + " " + rows[1][ny] + " " + rows[1][nz], "0 -1 ");
  EXPECT_EQ(rows[2][status], "contact");
  EXPECT_EQ(rows[2][kind], "vertex");
  EXPECT_EQ(rows[2][x] + " " + rows[2][y], "3 2");
  EXPECT_EQ(rows[3][status], "free");
  EXPECT_EQ(rows[3][cell], "4");
  EXPECT_EQ(rows[4][status], "free");
  EXPECT_EQ(rows[5][status], "contact");
  EXPECT_EQ(rows[5][time], "0");
}

TEST_F(Query, FindsColumnsByNameAndReadsEveryLineEnd) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  const auto rows =
      query("\xEF\xBB\xBFname, by ,bx,ay,ax\r\nfirst,0.5,1.5,0.5,0.5\r\n\r\nsecond, 1.5 ,0.5,0.5,0.5\r\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][x] + " " + rows[0][y], "1.5 0.5");
  EXPECT_EQ(rows[1][x] + " " + rows[1][y], "0.5 1.5");
}

TEST_F(Query, RefusesTablesThatMakeNoSense) {
  succeed({"generate", "hexes", "--cells", "2", "-o", "env.ovm"});
  expect_refused(3, "", {"queries.csv", "header"});
  expect_refused(3, "ax,ay,bx,by\n1,1,1,1\n", {"queries.csv", "no column 'az'", "ax,ay,bx,by"});
  expect_refused(3, "ax,ax,ay,az,bx,by,bz\n", {"queries.csv:1", "'ax'"});
  expect_failure(3, {"query", "env.ovm", "missing.csv", "-o", "out.csv"}, {"missing.csv"});
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  expect_refused(3, moves_header, {"queries.csv", "az", "2D"});
}

TEST_F(Query, RefusesEnvironmentsThatAreNotCertified) {
  write("env.ovm", hexahedron_ovm(0.25));
  expect_refused(4, moves_header, {"env.ovm: ", "planar"});
  write("env.ovm", "OVM BINARY\n");
  expect_refused(3, moves_header, {"env.ovm"});
}

TEST_F(Query, RefusesCertificatesForKernelsWithoutThem) {
  succeed({"generate", "hexes", "--cells", "2", "-o", "env.ovm"});
  for (const char* kernel : {"lazy", "rational", "double", "double_1e-9", "double_16u", "float"})
    expect_refused(2, moves_header, {"certified", "exact"}, {"--strategy", "certified", "--kernel", kernel});
}

/// Motions of mixed lengths in the box [0,size]^3, half of them between points of the half-integer lattice.
std::string random_moves(int count, int size) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(0, size);
  std::uniform_int_distribution<int> halves(0, 2 * size);
  std::string text = moves_header;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < 6; ++j)
      text += (i % 2 ? std::to_string(anywhere(random)) : std::to_string(halves(random)) + "/2") +
              (j < 5 ? "," : "\n");
  return text;
}

TEST_F(Query, ExactKernelsStrategiesAndThreadsGiveTheSameAnswers) {
  succeed({"generate", "lattice", "--cells", "5", "--seed", "3", "-o", "env.ovm"});
  const std::string motions = random_moves(4000, 5);
  const auto rows = query(motions, {"--json", "counts.json"});
  const auto report = nlohmann::json::parse(text("counts.json"));
  EXPECT_GT(report.at("status").at("free"), 400);
  EXPECT_GT(report.at("status").at("contact"), 400);
  EXPECT_GT(report.at("counts").at("star_searches"), 100) << "degenerate motions are among them";
  EXPECT_GT(report.at("counts").at("plane_blocks"), 1000);

  query(motions, {"--threads", "1", "--json", "one.json"});
  EXPECT_EQ(read_table(path("out.csv")).size(), rows.size() + 1);
  const std::string expected = text("out.csv");
  EXPECT_EQ(text("one.json"), text("counts.json"));
  query(motions, {"--threads", "3"});
  EXPECT_EQ(text("out.csv"), expected);
  query(motions, {"--strategy", "exit_rule"});
  EXPECT_EQ(text("out.csv"), expected);
  for (const char* kernel : {"lazy", "rational"}) {
    query(motions, {"--kernel", kernel});
    EXPECT_EQ(text("out.csv"), expected) << kernel;
  }

  const auto reference = query(motions, {"--strategy", "predictive_simplex"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(reference[i][status], rows[i][status]) << "row " << i;
    EXPECT_EQ(reference[i][time], rows[i][time]) << "row " << i;
  }
}

TEST_F(Query, InexactKernelsAnswerEveryRow) {
  succeed({"generate", "lattice", "--cells", "4", "--rotated", "--scale", "0.125", "-o", "env.ovm"});
  const std::string motions = random_moves(500, 2);
  for (const char* kernel : {"double", "double_1e-9", "double_16u", "float"})
    EXPECT_EQ(query(motions, {"--kernel", kernel}).size(), 500u);
}

#ifdef CELLWALK_TEST_MESHING
TEST_F(Query, AStartOnAMembraneBelongsToEitherSide) {
  // A square of side 2, cut in halves by a wall.
  write("room.poly",
        "6 2 0 0\n1 0 0\n2 1 0\n3 2 0\n4 2 2\n5 1 2\n6 0 2\n7 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 6\n6 6 1\n7 "
        "2 5\n0\n");
  succeed({"import", "room.poly", "-o", "env.ovm"});
  const auto rows = query(
      "ax,ay,bx,by\n"
      "1,1,0.5,1\n"
      "1,1,1.5,1\n"
      "1,1,1,1.5\n"
      "0.5,1,1,1\n"
      "0.5,1,1.5,1\n");
  for (int i = 0; i < 4; ++i) EXPECT_EQ(rows.at(i)[status], "free") << i;
  EXPECT_EQ(rows.at(4)[status], "contact");
  EXPECT_EQ(rows.at(4)[time], "0.5");
  EXPECT_EQ(rows.at(4)[nx], "-1");
}
#endif

}  // namespace
}  // namespace cellwalk::test
