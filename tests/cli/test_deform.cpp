// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of walls among bodies, as `cellwalk deform` makes, reports and refuses them.
#include <cmath>
#include <random>
#include <sstream>

#include "cli/deform_program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// Two triangles, the second beside the first.
constexpr const char* islands_ovm =
    "OVM ASCII\nVertices\n6\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n3 0 0\n2 1 0\nEdges\n6\n0 1\n1 2\n2 0\n3 4\n4 5\n"
    "5 3\nFaces\n2\n3 0 2 4\n3 6 8 10\nPolyhedra\n0\nMProp int \"dimension\"\n2\n";

TEST_F(Deform, MovesPointsInTheOrderOfTheRows) {
  make_plane();
  const auto before = points("env.ovm");
  // The second is possible after the first only. Other columns are ignored.
  const auto rows = deform("y,point,x,note\n1,7,2.5,a\n 0x1p0,6,9/4,b\n2,12,2,\"stays, so\"\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], (Row{"0", "reached", "1", "2.5", "1", "", "", "", "", "", "", "", "", ""}));
  EXPECT_EQ(rows[1], (Row{"1", "reached", "1", "2.25", "1", "", "", "", "", "", "", "", "", ""}));
  EXPECT_EQ(rows[2], (Row{"2", "reached", "1", "2", "2", "", "", "", "", "", "", "", "", ""}));
  auto expected = before;
  expected[7] = {2.5, 1, 0};
  expected[6] = {2.25, 1, 0};
  EXPECT_EQ(points("out.ovm"), expected);
  EXPECT_EQ(points("env.ovm"), before);
  EXPECT_NE(said_.find("out.ovm: certified, 2D\n  cells       16 (0 solid)\n"), std::string::npos) << said_;
  EXPECT_NE(said_.find("  moves       3: 3 reached\n  work        3 moves tried, with "), std::string::npos)
      << said_;
  EXPECT_EQ(said_.find("bodies"), std::string::npos) << said_;
  EXPECT_EQ(report_["counts"]["made"], 2) << "the last stays";
  EXPECT_EQ(report_["bodies"]["count"], 0);
  EXPECT_EQ(deform("point,x,y\n6,2.25,1\n7,2.5,1\n").at(0)[1], "cell");
}

TEST_F(Deform, AMembraneStopsAtARod) {
  make_plane({{0, 1}, {4, 5}});
  write("rod.csv", "x,y\n1.5,0.75\n1.5,1.25\n");
  const auto rows = deform("point,x,y\n6,1.75,1\n6,1.25,1\n", {"--body", "rod.csv"});
  EXPECT_EQ(report_["certificate"]["membranes"], 2);
  ASSERT_EQ(rows.size(), 2u);
  const Row& row = rows[0];
  EXPECT_EQ(row[1], "contact");
  EXPECT_EQ(row[2], "0.6666666666666666") << "of the way from 1 to 1.75, rounded down";
  EXPECT_EQ(std::stod(row[3]), 1.5) << "where it touches the rod, which it may";
  EXPECT_EQ(row[4], "1");
  EXPECT_EQ(Row(row.begin() + 5, row.begin() + 13), (Row{"vertex", "0", "edge", "0", "1.5", "1", "1", "0"}));
  // The cell is one of the two behind the membrane.
  write("points.csv", "ax,ay,bx,by\n1.126,0.5,1.126,0.5\n1.126,1.5,1.126,1.5\n");
  succeed({"query", "out.ovm", "points.csv", "-o", "cells.csv"});
  const auto behind = read_table(path("cells.csv"));
  EXPECT_TRUE(row[13] == behind.at(1).at(11) || row[13] == behind.at(2).at(11)) << row[13];
  EXPECT_EQ(rows[1], (Row{"1", "reached", "1", "1.25", "1", "", "", "", "", "", "", "", "", ""}))
      << "away from the rod again";
  EXPECT_EQ(points("out.ovm")[6], (std::vector<double>{1.25, 1, 0}));
  EXPECT_NE(said_.find("  moves       2: 1 reached, 1 contact\n"), std::string::npos) << said_;
  EXPECT_NE(said_.find("  bodies      1 with 2 vertices, 1 edges, 0 faces\n  near        "),
            std::string::npos)
      << said_;
  EXPECT_EQ(report_["counts"]["hits"].get<int>() > 0, true);
  EXPECT_GT(report_["counts"]["walk"]["orientations"].get<int>(), 0) << report_["counts"]["walk"];
}

TEST_F(Deform, TheMiddleOfAWallMeetsAVertex) {
  make_plane({{0, 1}, {4, 5}});
  write("bow.csv", "x,y\n1.75,0.375\n1.25,0.5\n1.75,0.625\n");
  const Row row = deform("point,x,y\n6,1.75,1\n", {"--body", "bow.csv"}).at(0);
  EXPECT_EQ(Row(row.begin() + 1, row.begin() + 3), (Row{"contact", "0.6666666666666666"}));
  EXPECT_EQ(Row(row.begin() + 5, row.begin() + 9), (Row{"facet", "0", "vertex", "1"}));
  EXPECT_EQ(Row(row.begin() + 9, row.begin() + 11), (Row{"1.25", "0.5"}));
  EXPECT_NEAR(std::stod(row[11]), 2 / std::sqrt(5), 1e-15);
  EXPECT_NEAR(std::stod(row[12]), -1 / std::sqrt(5), 1e-15);
}

TEST_F(Deform, HoldLeavesItWhereItWas) {
  make_plane({{0, 1}, {4, 5}});
  write("rod.csv", "x,y\n1.5,0.75\n1.5,1.25\n");
  const auto before = points("env.ovm");
  const auto rows = deform("point,x,y\n6,1.75,1\n", {"--body", "rod.csv", "--at-contact", "hold"});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][1], "contact");
  EXPECT_EQ(rows[0][2], "0.6666666666666666");
  EXPECT_EQ(Row(rows[0].begin() + 3, rows[0].begin() + 5), (Row{"1", "1"}));
  EXPECT_EQ(points("out.ovm"), before);
  // Without the body, or with it behind the wall that moves, nothing is in the way.
  EXPECT_EQ(deform("point,x,y\n6,1.75,1\n").at(0)[1], "reached");
  write("rod.csv", "x,y\n0.5,0.75\n0.5,1.25\n");
  EXPECT_EQ(deform("point,x,y\n6,1.75,1\n", {"--body", "rod.csv"}).at(0)[1], "reached");
}

TEST_F(Deform, EveryEndHasItsStatus) {
  make_plane();
  write("rod.csv", "x,y\n0.25,0.75\n0.25,1.25\n");
  // The wall at the left arrives exactly at the rod, which it may; then a cell would be flat.
  const auto rows = deform("point,x,y\n5,0.25,1\n6,1,-1\n", {"--body", "rod.csv"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], (Row{"0", "reached", "1", "0.25", "1", "", "", "", "", "", "", "", "", ""}));
  EXPECT_EQ(rows[1][1], "cell");
  EXPECT_EQ(rows[1][2], "0.5") << "of the way from y = 1 to -1";
  EXPECT_EQ(Row(rows[1].begin() + 3, rows[1].begin() + 13), (Row{"1", "1", "", "", "", "", "", "", "", ""}));
  EXPECT_FALSE(rows[1][13].empty());
  EXPECT_NE(said_.find("  moves       2: 1 reached, 1 cell\n"), std::string::npos) << said_;

  write("env.ovm", islands_ovm);
  const auto apart = deform("point,x,y\n1,2.5,0.25\n");
  EXPECT_EQ(apart.at(0), (Row{"0", "boundary", "", "1", "0", "", "", "", "", "", "", "", "", ""}));
}

TEST_F(Deform, FacesAreInTheWay) {
  make_space();
  write("far.off", "OFF\n3 1 0\n1.75 0.5 0.5\n1.75 1.5 0.5\n1.75 1 1.5\n3 0 1 2\n");
  write("face.off", "OFF\n3 1 0\n0.25 0.25 0.5\n0.25 1.75 0.5\n0.25 1 1.75\n3 0 1 2\n");
  const auto rows = deform("point,x,y,z\n12,0.5,1,1\n", {"--body", "far.off", "--body", "face.off"});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(Row(rows[0].begin() + 1, rows[0].begin() + 3), (Row{"contact", "0.5"}));
  EXPECT_EQ(std::stod(rows[0][3]), 0.25);
  EXPECT_EQ(Row(rows[0].begin() + 6, rows[0].begin() + 16),
            (Row{"vertex", "1", "face", "0", "0.25", "1", "1", "1", "0", "0"}));
  EXPECT_EQ(report_["bodies"], (json{{"count", 2}, {"vertices", 6}, {"edges", 6}, {"faces", 2}}));
  // A quadrilateral is two triangles, and says so.
  write("quad.off", "OFF\n4 1 0\n0.25 0 0.5\n0.25 2 0.5\n0.25 2 1.5\n0.25 0 1.5\n4 0 1 2 3\n");
  EXPECT_EQ(deform("point,x,y,z\n12,0.5,1,1.25\n", {"--body", "quad.off"}).at(0)[8], "face");
  EXPECT_EQ(report_["bodies"]["faces"], 2);
  EXPECT_NE(report_["bodies"]["notes"].at(0).get<std::string>().find("quad.off: 1 polygons cut"),
            std::string::npos);
  EXPECT_NE(said_.find("  note        quad.off: 1 polygons cut"), std::string::npos) << said_;
}

TEST_F(Deform, NoBodyEndsUpInAWall) {
  succeed({"generate", "hexes", "--cells", "4", "--solid", "0.1", "--seed", "5", "-o", "hexes.ovm"});
  succeed({"import", "hexes.ovm", "--simplicial", "-o", "env.ovm"});
  std::vector<std::string> bodies;
  std::mt19937 random(7);
  const auto number = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  // Rods at random places, those that fit.
  write("moves.csv", "point,x,y,z\n");
  for (int i = 0; i < 200 && bodies.size() < 60; ++i) {
    const std::string name = "rod" + std::to_string(i) + ".csv";
    std::ostringstream rod;
    rod << "x,y,z\n";
    const double x = number(0, 4), y = number(0, 4), z = number(0, 4);
    rod << x << ',' << y << ',' << z << '\n';
    rod << x + number(-0.5, 0.5) << ',' << y + number(-0.5, 0.5) << ',' << z + number(-0.5, 0.5) << '\n';
    write(name, rod.str());
    if (run(arguments({"--body", name})).exit_code != 0) continue;
    bodies.insert(bodies.end(), {"--body", name});
  }
  ASSERT_GE(bodies.size(), 40u);
  const auto before = points("env.ovm");
  std::ostringstream moves;
  moves.precision(17);
  moves << "point,x,y,z\n";
  for (int i = 0; i < 600; ++i) {
    const std::size_t point = random() % before.size();
    moves << point;
    for (const double x : before[point]) moves << ',' << x + number(-0.6, 0.6);
    moves << '\n';
  }
  const auto rows = deform(moves.str(), bodies);
  const json ends = report_["status"];
  EXPECT_GT(ends["reached"], 50) << ends;
  EXPECT_GT(ends["contact"], 20) << ends;
  EXPECT_GT(ends["cell"], 50) << ends;
  // Each point is where its last row says.
  auto expected = before;
  std::istringstream lines(moves.str());
  std::string line;
  std::getline(lines, line);
  for (const Row& row : rows) {
    std::getline(lines, line);
    for (std::size_t k = 0; k < 3; ++k) expected[std::stoul(line)][k] = std::stod(row[3 + k]);
    EXPECT_EQ(row[1] == "contact", !row[6].empty());
    if (row[1] != "contact") continue;
    EXPECT_NEAR(std::hypot(std::stod(row[13]), std::stod(row[14]), std::stod(row[15])), 1, 1e-14);
  }
  EXPECT_EQ(points("out.ovm"), expected);
  // All bodies can be registered where the walls are now.
  std::filesystem::rename(path("out.ovm"), path("env.ovm"));
  deform("point,x,y,z\n", bodies);
  EXPECT_EQ(text("out.ovm"), text("env.ovm"));
}

TEST_F(Deform, RefusesRowsThatAreNoMoves) {
  make_plane();
  refuse(3, "x,y\n1,1\n", {"moves.csv: has no column 'point': its header names x,y"});
  refuse(3, "point,x\n1,1\n", {"moves.csv: has no column 'y'"});
  refuse(3, "point,x,y,z\n1,1,1,1\n", {"moves.csv: has a column 'z', and the environment is 2D"});
  refuse(3, "", {"moves.csv: "});
  // The first move is one, and is not made either.
  const auto second = [this](const std::string& row, const std::string& what) {
    refuse(3, "point,x,y\n# a comment\n6,1.25,1\n" + row + "\n", {"cellwalk: moves.csv:4: " + what});
  };
  second("6,1", "2 fields, where the header has 3");
  second("6,1,1,1", "4 fields, where the header has 3");
  second("6,one,1", "x: 'one' is not a number that a double can hold");
  second("6,1,nan", "y: 'nan' is not finite");
  second("6,1,1e999", "y: ");
  second("six,1,1", "point: 'six' is not a number that a double can hold");
  second("15,1,1", "there is no point 15: those of the environment are 0 to 14");
  second("-1,1,1", "there is no point -1: those");
  second("0.5,1,1", "there is no point 0.5: those");
  second("1e30,1,1", "there is no point 1e+30: those");
  refuse(3, "point,x,y\n6,1.25,1\n", {"missing.csv: cannot be opened"}, {"--body", "missing.csv"});
}

TEST_F(Deform, RefusesCellsThatAreNotSimplices) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  refuse(3, "point,x,y\n4,1,1\n",
         {"moves.csv:2: point 4 cannot be moved: cell 0 at it is not a triangle; split all cells of the "
          "environment with `cellwalk import --simplicial`"});
  succeed({"generate", "hexes", "--cells", "1", "-o", "env.ovm"});
  refuse(3, "point,x,y,z\n7,1,1,2\n", {"moves.csv:2: point 7 ", "is not a tetrahedron"});
  EXPECT_TRUE(deform("point,x,y,z\n").empty()) << "they do not matter where nothing moves";
}

TEST_F(Deform, RefusesBodiesThatStandInWalls) {
  make_plane({{0, 1}, {4, 5}});
  write("outside.csv", "x,y\n3.5,1\n4.5,1\n");
  write("across.csv", "x,y\n0.5,0.5\n1.5,0.5\n");
  write("space.csv", "x,y,z\n0.5,0.5,0\n0.25,0.5,0\n");
  write("fine.csv", "x,y\n0.25,0.5\n0.75,0.5\n");
  const char* const moves = "point,x,y\n7,2.25,1\n";
  refuse(5, moves, {"outside.csv: vertex 1 of the body"}, {"--body", "fine.csv", "--body", "outside.csv"});
  refuse(5, moves, {"across.csv: edge 0 of the body", "crosses a wall"}, {"--body", "across.csv"});
  refuse(3, moves, {"space.csv"}, {"--body", "space.csv"});
  EXPECT_EQ(deform(moves, {"--body", "fine.csv"}).at(0)[1], "reached");
}

TEST_F(Deform, RefusesEnvironmentsWithOtherNumbers) {
  std::string unused = islands_ovm;
  unused.replace(unused.find("6\n0 0 0\n"), 8, "7\n9 9 0\n0 0 0\n");
  for (const char* const edge : {"4 5\n", "3 4\n", "5 3\n", "1 2\n", "0 1\n", "2 0\n"}) {
    const std::size_t at = unused.find(edge, unused.find("Edges"));
    for (const std::size_t k : {at, at + 2}) ++unused[k];
  }
  write("env.ovm", unused);
  refuse(3, "point,x,y\n1,0.1,0.1\n",
         {"env.ovm: 1 of its points belong to no cell, so the numbers of others may change: write it "
          "without them by `cellwalk import`"});
}

TEST_F(Deform, KeepsSlits) {
  std::string touching = islands_ovm;
  touching.replace(touching.find("2 0 0\n3 0 0\n"), 12, "1 0 0\n3 0 0\n");
  write("env.ovm", touching);
  refuse(4, "point,x,y\n3,1.5,0.125\n", {"env.ovm: points 1 and 3 lie in the same place"});
  refuse(2, "point,x,y\n3,1.5,0.125\n", {"--duplicates: takes refuse|keep, not merge"},
         {"--duplicates", "merge"});
  const auto rows = deform("point,x,y\n3,1.5,0.125\n", {"--duplicates", "keep"});
  EXPECT_EQ(rows.at(0)[1], "reached");
  EXPECT_EQ(points("out.ovm")[1], (std::vector<double>{1, 0, 0})) << "its double stays";
}

TEST_F(Deform, RefusesWhatIsNotThere) {
  make_plane();
  refuse(2, "point,x,y\n", {"--at-contact: takes stop|hold|push|test, not pull"}, {"--at-contact", "pull"});
  expect_failure(2, {"deform", "env.ovm", "-o", "out.ovm"}, {"moves is required"});
  expect_failure(2, {"deform", "env.ovm", "moves.csv"}, {"--output is required"});
}

}  // namespace
}  // namespace cellwalk::test
