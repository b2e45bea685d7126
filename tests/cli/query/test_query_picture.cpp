// SPDX-License-Identifier: LGPL-3.0-or-later
// `cellwalk query --picture`: pictures of motions of the plane.
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
};

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
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(pictures[i], pictures[j]) << i << " and " << j;
}

TEST_F(QueryPicture, IsTheSameEveryTime) { EXPECT_EQ(picture("moves.csv", "0"), picture("moves.csv", "0")); }

TEST_F(QueryPicture, RefusesRowsThatAreNotThereAndSpace) {
  expect_failure(2, query("moves.csv", "3"), {"--row 3", "no such valid row"});
  expect_failure(2, query("moves.csv", "5"), {"--row 5", "no such valid row"});
  expect_failure(2, query("edges.csv", "3"), {"--row 3", "no such valid row"});
  expect_failure(2, {"query", "env.ovm", "moves.csv", "-o", "out.csv", "--picture", "p.png"}, {"give both"});
  succeed({"generate", "hexes", "--cells", "2", "-o", "space.ovm"});
  write_text(path("space.csv"), "ax,ay,az,bx,by,bz\n0.5,0.5,0.5,1.5,0.5,0.5\n");
  expect_failure(2, {"query", "space.ovm", "space.csv", "-o", "out.csv", "--picture", "p.png", "--row", "0"},
                 {"draws 2D motions"});
}

}  // namespace
}  // namespace cellwalk::test
