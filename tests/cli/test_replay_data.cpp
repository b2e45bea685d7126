// SPDX-License-Identifier: LGPL-3.0-or-later
// The traces of the published benchmark, replayed as a user does.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using ReplayOfPublicTraces = Program;

TEST_F(ReplayOfPublicTraces, GiveTheRecordedAnswers) {
  const struct {
    const char* file;
    int moves;
  } traces[] = {{"1k.bin", 180000}, {"10k.bin", 108000}};
  for (const auto& t : traces)
    for (const char* sweep : {"three_segments", "triangle"}) {
      const std::string trace = std::string(CELLWALK_TEST_DATA) + "/traces/" + t.file;
      succeed({"replay", trace, "--sweep", sweep, "--repeat", "2", "--json", "out.json"});
      const auto report = nlohmann::json::parse(text("out.json"));
      EXPECT_EQ(report["mismatches"], 0);
      EXPECT_EQ(report["counts"]["moves"], t.moves);
      EXPECT_EQ(report["manifest"]["trace"]["file"], t.file);
      const auto& rounds = report["ns_per_vertex_move_rounds"];
      EXPECT_EQ(report["ns_per_vertex_move"], (rounds[0].get<double>() + rounds[1].get<double>()) / 2);
    }
}

}  // namespace
}  // namespace cellwalk::test
