// SPDX-License-Identifier: LGPL-3.0-or-later
// `cellwalk query --picture`: pictures of single motions.
#include "cli/program.h"

namespace cellwalk::test {
namespace {

class QueryPicture : public Program {
 protected:
  QueryPicture() {
    succeed({"generate", "squares", "--cells", "6", "4", "--solid", "0.2", "--seed", "7", "-o", "env.ovm"});
    write_text(path("moves.csv"),
               "ax,ay,bx,by\n0.25,0.25,3.75,3.75\n0.5,1.375,5.5,2.625\n1.5,0.5,1,1\nx,1,2,2\n2.25,1,2.5,1\n");
    write_text(path("edges.csv"),
               "px,py,tx,ty,qx,qy\n0.5,3.5,0.5,3.25,2.5,3.25\n2.5,3.25,2.5,1.5,4.5,3.5\n0.5,0.5,0.75,0.5,3."
               "5,2.5\n");
  }
  std::vector<std::string> query(const std::string& table, const std::string& row) const {
    std::vector<std::string> words{"query",     "env.ovm", table,   "-o", "out.csv",
                                   "--picture", "p.png",   "--row", row};
    if (table == "edges.csv") words.insert(words.end(), {"--mode", "sweep"});
    return words;
  }
  std::string picture(const std::string& table, const std::string& row) const {
    run(query(table, row));
    const std::string png = text("p.png");
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    return png;
  }
  /// Of a point with a radius.
  std::string thick(const std::string& environment, const std::string& motion,
                    const std::string& radius) const {
    const char* const columns = environment == "env.ovm" ? "ax,ay,bx,by\n" : "ax,ay,az,bx,by,bz\n";
    write_text(path("one.csv"), columns + motion + "\n");
    succeed({"query", environment, "one.csv", "-o", "out.csv", "--radius", radius, "--picture", "p.png",
             "--row", "0"});
    return text("p.png");
  }
};

void expect_different(const std::vector<std::string>& pictures) {
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(pictures[i] == pictures[j]) << i << " and " << j;
}

TEST_F(QueryPicture, DrawsWhateverTheAnswerIs) {
  std::vector<std::string> pictures;
  for (const char* row : {"0", "1", "2", "4"}) pictures.push_back(picture("moves.csv", row));
  EXPECT_EQ(read_table(path("out.csv")).at(1).at(1), "free");
  EXPECT_EQ(read_table(path("out.csv")).at(2).at(1), "contact");
  EXPECT_EQ(read_table(path("out.csv")).at(3).at(1), "outside");
  EXPECT_EQ(read_table(path("out.csv")).at(5).at(1), "free");  // along a facet
  for (const char* row : {"0", "1", "2"}) pictures.push_back(picture("edges.csv", row));
  EXPECT_EQ(read_table(path("out.csv")).at(1).at(1), "free");
  EXPECT_EQ(read_table(path("out.csv")).at(2).at(1), "contact");
  EXPECT_EQ(read_table(path("out.csv")).at(3).at(1), "outside");
  expect_different(pictures);
}

TEST_F(QueryPicture, IsTheSameEveryTime) { EXPECT_EQ(picture("moves.csv", "0"), picture("moves.csv", "0")); }

TEST_F(QueryPicture, DrawsWhatHasARadius) {
  write_text(path("thick.csv"),
             "px,py,tx,ty,qx,qy,radius\n0.5,3.5,0.5,3,2.5,3.25,0\n0.5,3.5,0.5,3,2.5,3.25,0.2\n"
             "0.5,3.5,0.5,3,2.5,3.25,0.1\n2.5,3.25,2.5,1.5,4.5,3.5,0.2\n0.1,3.5,0.5,3.25,2.5,3.25,0.2\n"
             "0.5,3.5,0.5,3.25,2.5,3.25,0.05\n");
  std::vector<std::string> pictures;
  for (const char* row : {"0", "1", "2", "3", "4", "5"}) {
    succeed({"query", "env.ovm", "thick.csv", "-o", "out.csv", "--mode", "sweep", "--picture", "p.png",
             "--row", row});
    pictures.push_back(text("p.png"));
  }
  const auto rows = read_table(path("out.csv"));
  EXPECT_EQ(rows.at(2).at(6), "facet");
  EXPECT_EQ(rows.at(4).at(6), "vertex");
  EXPECT_EQ(rows.at(5).at(1), "close");
  EXPECT_EQ(rows.at(6).at(1), "free");
  expect_different(pictures);
  expect_different(
      {thick("env.ovm", "0.5,3.5,0.5,3.25", "0.05"), thick("env.ovm", "0.5,3.5,0.5,3.25", "0.06")});
  write_text(path("edges.csv"), "px,py,tx,ty,qx,qy\n0.5,3.5,0.5,3,2.5,3.25\n");
  EXPECT_TRUE(picture("edges.csv", "0") == pictures[0]) << "radius 0";
}

TEST_F(QueryPicture, DrawsMotionsInSpace) {
  succeed({"generate", "hexes", "--cells", "2", "-o", "space.ovm"});
  write_text(path("space.csv"),
             "ax,ay,az,bx,by,bz,radius\n0.5,0.5,0.5,2.5,0.5,0.5,0.25\n0.5,0.5,0.5,2.5,0.5,0.5,0\n"
             "0.125,0.5,0.5,1.5,0.5,0.5,0.25\n-1,0.5,0.5,1.5,0.5,0.5,0\n");
  std::vector<std::string> pictures;
  for (const char* row : {"0", "1", "2", "3"}) {
    succeed({"query", "space.ovm", "space.csv", "-o", "out.csv", "--picture", "p.png", "--row", row});
    pictures.push_back(text("p.png"));
    EXPECT_EQ(pictures.back().substr(0, 8), "\x89PNG\r\n\x1a\n");
  }
  expect_different(pictures);
  const char* const motion = "0.5,0.5,0.5,1.5,0.5,0.5";
  expect_different({thick("space.ovm", motion, "0.05"), thick("space.ovm", motion, "0.06")});
}

TEST_F(QueryPicture, RefusesRowsThatAreNotThere) {
  expect_failure(2, query("moves.csv", "3"), {"--row 3", "no such valid row"});
  expect_failure(2, query("moves.csv", "5"), {"--row 5", "no such valid row"});
  expect_failure(2, query("edges.csv", "3"), {"--row 3", "no such valid row"});
  expect_failure(2, {"query", "env.ovm", "moves.csv", "-o", "out.csv", "--picture", "p.png"}, {"give both"});
}

}  // namespace
}  // namespace cellwalk::test
