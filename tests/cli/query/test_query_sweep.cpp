// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "cli/ovm_text.h"
#include "cli/query/query_table.h"

namespace cellwalk::test {
namespace {

class QuerySweep : public Query_table {
 protected:
  /// Of the answers.
  enum Column { row, status, time, x, y, z, kind, body, nx, ny, nz, cells, cell };

  QuerySweep()
      : Query_table(
            {"row", "status", "time", "x", "y", "z", "kind", "body", "nx", "ny", "nz", "cells", "cell"}) {
    always_ = {"--mode", "sweep"};
  }

  /// A grid of 5^D unit cells, the one in its middle solid.
  void make_room(int dimension) const {
    succeed({"generate", dimension == 2 ? "squares" : "hexes", "--cells", "5", "-o", "env.ovm"});
    write("env.ovm", Ovm_text(text("env.ovm")).set_solid(dimension == 2 ? 12 : 62).text());
  }
};

constexpr const char* plane = "px,py,tx,ty,qx,qy\n";
constexpr const char* space = "px,py,pz,tx,ty,tz,qx,qy,qz\n";

/// The obstacle fits between the edge before the motion, the edge after it, and the way of p.
constexpr const char* round_obstacle_2 = "0.5,0.5,4.5,0.5,2.5,4.5\n";
constexpr const char* round_obstacle_3 = "0.5,2.5,0.5,4.5,2.5,0.5,2.5,2.5,4.5\n";

TEST_F(QuerySweep, AnswersEveryStatusInThePlane) {
  make_room(2);
  const auto rows = query(std::string(plane) +
                          "0.5,0.5,4.5,0.5,2.5,0.5\n"   // in one line
                          "0.5,0.5,0.5,6.5,0.75,0.5\n"  // p leaves the room
                          "0.5,1.5,3.5,1.5,1/2,7/2\n"   // the edge turns over the obstacle
                          "0.5,2.5,0.5,3.5,4.5,2.5\n"   // the edge begins across the obstacle
                          "2.5,2.5,0.5,3.5,4.5,4.5\n"   // p begins in the obstacle
                          "0.5,0.5,0.5,3.5,-1,0.5\n"    // q begins outside
                          "0.5,0.5,0.5,1/3,4.5,0.5\n"   // 1/3 is no double
                          "0x1p-1,1/2,0.5,3/4,3/4,.5\n");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows[0], (Row{"0", "free", "1", "4.5", "0.5", "", "", "", "", "", "", "5", "4"}));
  EXPECT_EQ(rows[1],
            (Row{"1", "contact", "0.75", "0.5", "5", "", "facet", "vertex", "0", "-1", "", "5", "20"}));
  // The line from q = (1/2,7/2) through the corner (2,2) meets the way of p at x = 5/2.
  EXPECT_EQ(rows[2][status], "contact");
  EXPECT_NEAR(std::stod(rows[2][time]), 2. / 3, 1e-15);
  EXPECT_EQ(rows[2][x] + " " + rows[2][y] + " " + rows[2][z], "2 2 ");
  EXPECT_EQ(rows[2][kind] + " " + rows[2][body], "vertex edge");
  EXPECT_NEAR(std::stod(rows[2][nx]), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(std::stod(rows[2][ny]), -std::sqrt(0.5), 1e-15);
  EXPECT_EQ(rows[3], (Row{"3", "outside", "", "", "", "", "", "", "", "", "", "0", ""}));
  EXPECT_EQ(rows[4][status], "outside");
  EXPECT_EQ(rows[5][status], "outside");
  EXPECT_EQ(rows[6], (Row{"6", "invalid", "", "", "", "", "", "", "", "", "", "0", ""}));
  EXPECT_EQ(rows[7], (Row{"7", "free", "1", "0.5", "0.75", "", "", "", "", "", "", "1", "0"}));
  EXPECT_EQ(said_, "out.csv: 8 motions: 2 free, 2 contact, 3 outside, 1 invalid\n");
  EXPECT_TRUE(warned_.starts_with("cellwalk: queries.csv:8: ty: ")) << warned_;
  EXPECT_NE(warned_.find("rows marked invalid: 1"), std::string::npos) << warned_;
}

TEST_F(QuerySweep, AnswersInSpace) {
  make_room(3);
  const auto rows = query(std::string(space) + round_obstacle_3 +
                          "0.5,0.5,0.5,0.5,0.5,3.5,4.5,0.5,0.5\n"    // free
                          "0.5,2.5,2.5,3.5,2.5,2.5,0.5,0.5,0.5\n"    // p runs into the obstacle
                          "0.5,2.5,2.5,0.5,1.5,2.5,4.5,2.5,2.5\n");  // the edge begins across it
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0][status] + " " + rows[0][kind] + " " + rows[0][body], "contact edge edge");
  EXPECT_NEAR(std::stod(rows[0][time]), 1. / 6, 1e-15);
  EXPECT_EQ(rows[0][x] + " " + rows[0][y] + " " + rows[0][z], "2 2.5 3");
  EXPECT_NEAR(std::stod(rows[0][nx]), -3 / std::sqrt(10.), 1e-15);
  EXPECT_EQ(std::stod(rows[0][ny]), 0);
  EXPECT_NEAR(std::stod(rows[0][nz]), 1 / std::sqrt(10.), 1e-15);
  EXPECT_EQ(rows[1], (Row{"1", "free", "1", "0.5", "0.5", "3.5", "", "", "", "", "", "4", "75"}));
  EXPECT_EQ(rows[2],
            (Row{"2", "contact", "0.5", "2", "2.5", "2.5", "facet", "vertex", "-1", "0", "0", "2", "61"}));
  EXPECT_EQ(rows[3][status], "outside");
}

TEST_F(QuerySweep, ThreeSegmentsMissWhatFitsBetween) {
  for (const int dimension : {2, 3}) {
    make_room(dimension);
    const std::string motion =
        dimension == 2 ? std::string(plane) + round_obstacle_2 : std::string(space) + round_obstacle_3;
    const auto triangle = query(motion, {"--sweep", "triangle"}).at(0);
    EXPECT_EQ(triangle[status] + " " + triangle[body], "contact edge");
    EXPECT_NEAR(std::stod(triangle[time]), 1. / 6, 1e-15);
    EXPECT_EQ(query(motion).at(0), triangle) << "the default";
    EXPECT_EQ(query(motion, {"--sweep", "faces"}).at(0), triangle) << "an edge has no face";
    EXPECT_EQ(query(motion, {"--sweep", "three_segments"}).at(0)[status], "free");
  }
}

/// The solid cell is left behind by the edge before half of the motion, and the wall of the room is met at
/// its end.
TEST_F(QuerySweep, BisectionOfTheSegmentMayBeLate) {
  succeed({"generate", "squares", "--cells", "7", "5", "-o", "env.ovm"});
  write("env.ovm", Ovm_text(text("env.ovm")).set_solid(8).set_solid(13).text());  // at (1,1) and (6,1)
  const std::string motion = std::string(plane) + "0.25,0.75,6.75,0.75,0.5,4.75\n";
  const double first = (31.0 / 30 - 0.25) / 6.5, second = (0.5 + 5.5 * 16 / 15 - 0.25) / 6.5;
  const auto time_of = [&](const std::vector<std::string>& options) {
    const Row answer = query(motion, options).at(0);
    EXPECT_EQ(answer[status] + " " + answer[body], "contact edge");
    return std::stod(answer[time]);
  };
  EXPECT_NEAR(time_of({"--contact", "dichotomic", "--tolerance", "0.0078125"}), first, 0x1p-7);
  EXPECT_NEAR(time_of({"--contact", "dichotomic_segment", "--tolerance", "0.0078125"}), second, 0x1p-7);
  EXPECT_NEAR(time_of({"--contact", "exhaustive", "--search-limit", "none"}), first, 1e-15);
}

TEST_F(QuerySweep, TouchStopEndsWhereTouchPassGoesOn) {
  make_room(2);
  // The edge turns round q till it lies along the upper side of the obstacle, and p comes to the outer wall;
  // then an edge that lies there begins, and one that meets nothing.
  const std::string motions = std::string(plane) +
                              "1.5,3.5,1.5,3,3.5,3\n"
                              "1.5,4.5,1.5,5,3.5,3.5\n"
                              "2.25,3,2.25,3.5,2.75,3\n"
                              "1.5,4,1.5,4.5,3.5,3.5\n";
  const auto pass = query(motions, {"--touch", "pass"});
  const auto stop = query(motions, {"--touch", "stop"});
  ASSERT_EQ(stop.size(), 4u);
  for (const Row& r : pass) EXPECT_EQ(r[status], "free");
  EXPECT_EQ(stop[0][status] + " " + stop[0][time] + " " + stop[0][body], "contact 1 edge");
  EXPECT_EQ(stop[1][status] + " " + stop[1][time] + " " + stop[1][body], "contact 1 vertex");
  EXPECT_EQ(stop[1][x] + " " + stop[1][y] + " " + stop[1][nx] + " " + stop[1][ny], "1.5 5 0 -1");
  EXPECT_EQ(stop[3], pass[3]);
  EXPECT_EQ(query(motions), pass) << "the default";
}

TEST_F(QuerySweep, AStartOnAWallBelongsToTheSideThatGetsFurthest) {
  // Two halves of a square of side 4 with a membrane between them, and in each an obstacle beside it: left
  // from y = 1 to 2, right from 2 to 3.
  succeed({"generate", "squares", "--cells", "4", "-o", "env.ovm"});
  Ovm_text room(text("env.ovm"));
  for (const std::size_t left : {1, 5, 9, 13}) room.separate(left, left + 1);
  write("env.ovm", room.set_solid(5).set_solid(10).text());
  const std::string motions = std::string(plane) +
                              "2,0.5,1.5,0.5,2,0.25\n"  // to either side
                              "2,0.5,2.5,0.5,2,0.25\n"
                              "2,0.5,1.5,0.5,2.5,0.25\n"  // q says which side it is
                              "2,0.5,2.5,0.5,2.5,0.25\n"
                              "2.5,0.25,2.5,0.75,2,0.5\n"  // q has sides, too
                              "2.5,0.25,1.5,0.25,2,0.5\n"
                              "1.5,0.25,2.5,0.25,2.5,0.5\n"  // across the membrane
                              "2,0.5,2,3.5,2,0.25\n"         // left as far as y = 1, right as far as y = 2
                              "2,3.5,2,0.5,2,3.75\n"         // left as far as y = 2, right as far as y = 3
                              "2,0.5,2,1.5,2,0.25\n";        // left as far as y = 1, right all the way
  for (const auto& options : std::vector<std::vector<std::string>>{
           {}, {"--contact", "exhaustive"}, {"--contact", "dichotomic", "--tolerance", "0x1p-30"}}) {
    SCOPED_TRACE(options.empty() ? "exact" : options[1]);
    const auto rows = query(motions, options);
    ASSERT_EQ(rows.size(), 10u);
    for (const std::size_t i : {0, 1, 3, 4, 9}) EXPECT_EQ(rows[i][status], "free") << i;
    EXPECT_EQ(rows[0][cell] + " " + rows[1][cell] + " " + rows[9][cell], "1 2 6");
    EXPECT_EQ(rows[2][status] + " " + rows[2][time] + " " + rows[2][nx], "contact 0 1");
    EXPECT_EQ(rows[5][status], "contact");
    EXPECT_EQ(rows[6][status], "outside");
    EXPECT_EQ(rows[7][status] + " " + rows[7][time] + " " + rows[7][y], "contact 0.5 2");
    EXPECT_EQ(rows[8][status] + " " + rows[8][time] + " " + rows[8][y], "contact 0.5 2");
  }
}

TEST_F(QuerySweep, AnEdgePastTheRimOfAWallMayEndOnEitherSideOfIt) {
  // A membrane from (2,0) to (2,1), and edges in its line.
  succeed({"generate", "squares", "--cells", "4", "-o", "env.ovm"});
  write("env.ovm", Ovm_text(text("env.ovm")).separate(1, 2).text());
  const auto rows = query(std::string(plane) +
                          "2,1.5,1.5,1.5,2,0.5\n"
                          "2,1.5,2.5,1.5,2,0.5\n"
                          "2,0.5,1.5,0.5,2,1.5\n"
                          "2,0.5,2.5,0.5,2,1.5\n");
  ASSERT_EQ(rows.size(), 4u);
  for (const Row& r : rows) EXPECT_EQ(r[status], "free") << r[row];
}

/// Motions of edges in the box [0,size]^3, half of them between points of the half-integer lattice, most of
/// them short.
std::string random_sweeps(int count, int size) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> anywhere(0, size), near(-1, 1);
  std::uniform_int_distribution<int> halves(0, 2 * size), near_halves(-2, 2);
  std::string text = space;
  for (int i = 0; i < count; ++i) {
    const bool on_lattice = i % 2 == 0;
    std::string fields[9];
    for (int k = 0; k < 3; ++k) {
      const double p = on_lattice ? halves(random) / 2. : anywhere(random);
      for (int j = 0; j < 3; ++j) {
        const double shift = j == 0 ? 0 : on_lattice ? near_halves(random) / 2. : near(random);
        fields[3 * j + k] = std::to_string(p + shift);
      }
    }
    for (int j = 0; j < 9; ++j) text += fields[j] + (j < 8 ? "," : "\n");
  }
  return text;
}

class QuerySweepRandom : public QuerySweep {
 protected:
  void SetUp() override {
    succeed({"generate", "lattice", "--cells", "4", "--seed", "3", "-o", "env.ovm"});
    exact_ = query(motions_, {"--json", "counts.json"});
  }

  const std::string motions_ = random_sweeps(1500, 4);
  std::vector<Row> exact_;
};

TEST_F(QuerySweepRandom, ThreadsGiveTheSameAnswers) {
  const auto report = nlohmann::json::parse(text("counts.json"));
  EXPECT_EQ(report.at("motions"), 1500);
  for (const char* s : {"free", "contact", "outside"}) EXPECT_GT(report.at("status").at(s), 100) << s;
  for (const char* count : {"same_cell", "same_chain", "event_sweeps", "relinked"})
    EXPECT_GT(report.at("counts").at(count), 10) << count;
  EXPECT_GT(report.at("counts").at("walk").at("star_searches"), 100);
  int by_vertex = 0, by_edge = 0;
  for (const Row& r : exact_) {
    by_vertex += r[body] == "vertex";
    by_edge += r[body] == "edge";
  }
  EXPECT_GT(by_vertex, 50);
  EXPECT_GT(by_edge, 50);
  const std::string expected = text("out.csv");
  for (const char* threads : {"1", "3"}) {
    query(motions_, {"--threads", threads, "--json", "again.json"});
    EXPECT_EQ(text("out.csv"), expected);
    EXPECT_EQ(text("again.json"), text("counts.json"));
  }
}

TEST_F(QuerySweepRandom, DichotomicIsWithinItsBoundAndNeverLater) {
  const auto rows = query(motions_, {"--contact", "dichotomic", "--tolerance", "0x1p-10"});
  int earlier = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i][status], exact_[i][status]) << i;
    if (rows[i][status] != "contact") continue;
    EXPECT_LE(std::stod(rows[i][time]), std::stod(exact_[i][time])) << i;
    EXPECT_LE(std::stod(exact_[i][time]), std::stod(rows[i][time]) + 1. / 1024) << i;
    earlier += std::stod(rows[i][time]) < std::stod(exact_[i][time]);
  }
  EXPECT_GT(earlier, 20);
}

TEST_F(QuerySweepRandom, ExhaustiveFindsAContactWhereverThereIsOne) {
  int equal = 0, other = 0;
  const auto flooded = query(motions_, {"--contact", "exhaustive", "--json", "counts.json"});
  EXPECT_GT(nlohmann::json::parse(text("counts.json")).at("counts").at("searches"), 50);
  for (std::size_t i = 0; i < flooded.size(); ++i) {
    ASSERT_EQ(flooded[i][status], exact_[i][status]) << i;
    if (exact_[i][body] != "edge") continue;
    (flooded[i][time] == exact_[i][time] ? equal : other) += 1;
    // Not in the degenerate half: there an obstacle that is merely touched counts as well.
    if (i % 2 == 1) {
      EXPECT_EQ(flooded[i][time], exact_[i][time]) << i;
    }
  }
  EXPECT_GT(equal, 50);
  EXPECT_GT(other, 0);
  const auto traversed = query(motions_, {"--contact", "exhaustive", "--search-cells", "traversed"});
  int later = 0;
  for (std::size_t i = 0; i < traversed.size(); ++i) {
    ASSERT_EQ(traversed[i][status], exact_[i][status]) << i;
    later += traversed[i][time] != flooded[i][time];
  }
  EXPECT_GT(later, 0) << "the first obstacle is not always in the cells that the edge passes at its end";
}

TEST_F(QuerySweepRandom, ThreeSegmentsFindNothingElseAndTouchesComeFirst) {
  const auto segments = query(motions_, {"--sweep", "three_segments"});
  const auto stop = query(motions_, {"--touch", "stop"});
  int missed = 0, touched = 0;
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    if (exact_[i][status] == "free") {
      EXPECT_EQ(segments[i][status], "free") << i;
      touched += stop[i][status] == "contact";
    } else if (exact_[i][status] == "contact") {
      missed += segments[i][status] == "free";
      ASSERT_EQ(stop[i][status], "contact") << i;
      EXPECT_LE(std::stod(stop[i][time]), std::stod(exact_[i][time])) << i;
    }
  }
  EXPECT_GT(missed, 0);
  EXPECT_GT(touched, 50);
}

TEST_F(QuerySweep, RefusesTablesAndOptionsThatMakeNoSense) {
  make_room(2);
  expect_refused(3, "px,py,tx,ty\n", {"queries.csv", "no column 'qx'"});
  expect_refused(3, "ax,ay,bx,by\n", {"queries.csv", "no column 'px'"});
  expect_refused(3, space, {"queries.csv", "pz", "2D"});
  for (const char* kernel : {"lazy", "double", "float"})
    expect_refused(2, plane, {"--kernel exact", "sweeps are exact only"}, {"--kernel", kernel});
  expect_refused(2, plane, {"--strategy needs --mode move"}, {"--strategy", "certified"});
  expect_refused(2, plane, {"--tolerance needs --contact dichotomic"}, {"--tolerance", "0.5"});
  expect_refused(2, plane, {"--search-cells needs --contact exhaustive"}, {"--search-cells", "flooded"});
  expect_refused(2, plane, {"--search-limit needs --contact exhaustive"}, {"--search-limit", "none"});
  for (const char* bad : {"0", "-1", "1.5", "nan", "inf", "none"})
    expect_refused(2, plane, {"--tolerance", "(0,1]", bad}, {"--contact", "dichotomic", "--tolerance", bad});
  expect_refused(2, plane, {"--sweep", "three_segments|triangle|faces"}, {"--sweep", "circle"});
  EXPECT_EQ(query(plane, {"--kernel", "exact", "--contact", "dichotomic", "--tolerance", "1"}).size(), 0u);
  always_ = {};
  const std::string moves = "ax,ay,bx,by\n";
  for (const auto& option : std::vector<std::vector<std::string>>{{"--sweep", "triangle"},
                                                                  {"--contact", "exact"},
                                                                  {"--tolerance", "0.5"},
                                                                  {"--search-cells", "flooded"},
                                                                  {"--search-limit", "below"}})
    expect_refused(2, moves, {option[0] + " needs --mode sweep"}, option);
}

}  // namespace
}  // namespace cellwalk::test
