// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk query --record FILE --row N, and --replay-failure FILE.
#include <string>
#include <vector>

#include "cli/ovm_text.h"
#include "cli/query/query_table.h"

namespace cellwalk::test {
namespace {

class ReproWalk : public Query_table {
 protected:
  ReproWalk()
      : Query_table({"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"}) {
    succeed({"generate", "squares", "--cells", "3", "-o", "env.ovm"});
    write("env.ovm", Ovm_text(text("env.ovm")).set_solid(4).text());
  }

  /// Records the only row of a table and replays it.
  std::string replay(const std::string& motion, const std::string& kernel) {
    query("ax,ay,bx,by\n" + motion + "\n", {"--kernel", kernel, "--record", "motion.json", "--row", "0"});
    return succeed({"query", "--replay-failure", "motion.json"});
  }
};

void expect_holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST_F(ReproWalk, ShowsWhereARoundedSignIsWrong) {
  // The target lies beyond x = 1 by less than a float can tell.
  const std::string log = replay("0.5,0.5,1.000000000001,0.5", "float");
  expect_holds(log, {"note: row 0 of a query: free", "cells: 9", "from: 0.5 0.5  = 0x1p-1 0x1p-1",
                     "from cell 0, kernel float:", "target +0 (exactly +1), to cell 1", "arrives in cell 0",
                     "from cell 0, kernel exact:", "goes on in cell 1, which is behind facet",
                     "arrives in cell 1, on a cell of dimension 2", "the walks part after step 1"});
}

TEST_F(ReproWalk, FindsNoDifferenceWhereThereIsNone) {
  for (const char* kernel : {"exact", "lazy", "rational", "double", "double_1e-9", "double_16u", "float"}) {
    const std::string log = replay("0.5,1.5,1.5,1.25", kernel);
    expect_holds(log, {"is blocked in cell 3 at time 0.5 by a wall of cell 3: facet", ", wall;",
                       "compared with the exact walk: no difference"});
  }
  EXPECT_NE(replay("0.5,0.5,1.5,1.25", "double").find("line against its ridges"), std::string::npos);
}

TEST_F(ReproWalk, FollowsAWalkRoundAVertex) {
  expect_holds(replay("0.5,0.5,2.5,0.5", "lazy"), {"step 3: cell 2", "arrives in cell 2"});
  expect_holds(replay("0.5,1.5,1.5,0.5", "lazy"), {"goes on in cell 1, round a ridge or vertex"});
}

TEST_F(ReproWalk, SweepsMotionsWithARadius) {
  // Blocked by a side and by a corner of the solid cell [1,2] x [1,2], free, and close from any cell of the
  // start.
  const auto replay_thick = [this](const std::string& motion) {
    write("thick.csv", "ax,ay,bx,by,radius\n" + motion + "\n");
    succeed({"query", "env.ovm", "thick.csv", "-o", "out.csv", "--record", "motion.json", "--row", "0"});
    return succeed({"query", "--replay-failure", "motion.json"});
  };
  expect_holds(
      replay_thick("0.5,1.5,2.5,1.5,0.25"),
      {"note: row 0 of a query: contact", "radius: 0.25  = 0x1p-2",
       "from cell 3: is blocked at time 0.125 by a wall of cell 3: facet, nearest at 1 1.5", "normal -1 0"});
  expect_holds(replay_thick("0.5,0.5,1.5,0.75,0.25"), {"is free", "cells flooded"});
  expect_holds(replay_thick("0.5,0.5,1.5,1.5,0.5"), {"is blocked at time 0.14", "vertex, nearest at 1 1"});
  const std::string close = "starts at a distance of 0.25 from a wall of cell 1: vertex, nearest at 1 1";
  expect_holds(replay_thick("1,0.75,1.5,0.75,0.5"), {"from cell 0: " + close});
  std::string from_another = text("motion.json");
  write("another.json", from_another.insert(from_another.find("\"points\""), "\"cell\": 1, "));
  expect_holds(succeed({"query", "--replay-failure", "another.json"}), {"from cell 1: " + close});
}

TEST_F(ReproWalk, RefusesWhatItCannotReplay) {
  replay("0.5,0.5,2.5,0.5", "exact");
  const auto refuse = [this](int code, const std::string& part, const std::string& other,
                             const std::vector<std::string>& texts) {
    std::string changed = text("motion.json");
    const std::size_t at = changed.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    write("changed.json", changed.replace(at, part.size(), other));
    expect_failure(code, {"query", "--replay-failure", "changed.json"}, texts);
  };
  refuse(3, "\"kernel\": \"exact\"", "\"kernel\": \"quad\"", {"changed.json", "kernel", "quad"});
  refuse(3, "\"kernel\": \"exact\"", "\"kernel\": \"double\"", {"changed.json", "certified"});
  refuse(5, "\"points\"", "\"cell\": 8, \"points\"", {"changed.json", "does not start in cell 8"});
  refuse(3, "motion 1", "motion 7", {"changed.json", "format"});
  expect_failure(3, {"query", "--replay-failure", "absent.json"}, {"absent.json"});
  expect_failure(2, {"query", "--replay-failure", "motion.json", "--kernel", "float"}, {"no other option"});
  expect_failure(2, {"query", "env.ovm"}, {"queries is required"});
}

TEST_F(ReproWalk, RecordsOnlyRowsThatAreThere) {
  const std::string motions = "ax,ay,bx,by\n0.5,0.5,1,1\nx,0,0,0\n";
  write("motions.csv", motions);
  for (const char* row : {"1", "2"}) {
    const Outcome outcome =
        run({"query", "env.ovm", "motions.csv", "-o", "out.csv", "--record", "motion.json", "--row", row});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(std::string("--row ") + row), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("motion.json"));
  }
  expect_refused(2, motions, {"--record", "--row"}, {"--row", "0"});
  expect_refused(2, motions, {"--record", "--row"}, {"--record", "motion.json"});
}

}  // namespace
}  // namespace cellwalk::test
