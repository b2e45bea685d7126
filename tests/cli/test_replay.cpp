// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays of traces in a grid of unit cubes.
#include <cellwalk/internal/io/trace_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

#include "cli/program.h"
#include "simulation/random_trace.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class Replay : public Program {
 protected:
  /// Writes t.bin, in which hexahedra are thrown about among solid cells.
  Replay() { io::write_trace(path("t.bin"), trace()); }

  static const Trace& trace() {
    static const Trace trace = random_trace({{6, 5, 4}, 20, 150, 0.06, 0.6, 0.1, 7});
    return trace;
  }
  /// The report of a replay.
  json replay(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "replay");
    arguments.insert(arguments.end(), {"--repeat", "3", "--warmup", "0", "--json", "out.json"});
    succeed(arguments);
    return json::parse(text("out.json"));
  }
};

constexpr std::size_t trace_moves = 150 * 20 * 8;

TEST_F(Replay, GivesTheRecordedAnswers) {
  for (const char* sweep : {"three_segments", "triangle"}) {
    SCOPED_TRACE(sweep);
    const json report = replay({"t.bin", "--sweep", sweep});
    EXPECT_EQ(report["mismatches"], 0);
    ASSERT_EQ(report["ns_per_vertex_move_rounds"].size(), 3u);
    std::vector<double> rounds = report["ns_per_vertex_move_rounds"];
    std::sort(rounds.begin(), rounds.end());
    EXPECT_EQ(report["ns_per_vertex_move"], rounds[1]);
    EXPECT_GT(rounds[0], 0);
    const json& counts = report["counts"];
    EXPECT_EQ(counts["moves"], trace_moves);
    EXPECT_GT(counts["vertex_hits"], 100);
    EXPECT_GT(counts["edge_hits"], 20);
    EXPECT_GT(counts["held"], 100);
    EXPECT_GT(counts["in_region"], 0.5 * trace_moves);
    EXPECT_GT(counts["walks"], trace_moves / 100);
    EXPECT_GT(counts["crossings"], 100);
    EXPECT_TRUE(counts["exact_fallbacks"].is_number());
    double shares = 0;
    for (const char* certificate : {"same_cell", "same_chain"})
      shares += counts["body"]["shares"][certificate].get<double>();
    EXPECT_GT(shares, 0.6);
    EXPECT_LE(shares, 1);
    const json& manifest = report["manifest"];
    EXPECT_EQ(manifest["sweep"], sweep);
    for (const char* key : {"cellwalk", "compiler", "flags", "cpu"}) EXPECT_NE(manifest[key], "") << key;
    EXPECT_EQ(manifest["trace"]["file"], "t.bin");
    EXPECT_EQ(manifest["trace"]["cells"], (std::vector<int>{6, 5, 4}));
    EXPECT_EQ(manifest["trace"]["bodies"], 20);
    EXPECT_EQ(manifest["trace"]["steps"], 150);
    EXPECT_EQ(manifest["trace"]["obstacles"], trace().obstacles.size());
    EXPECT_EQ(manifest["trace"]["seed"], 7);
    EXPECT_EQ(manifest["trace"]["body_side"], 0.6);
    EXPECT_EQ(manifest["trace"]["speed"], 0.1);
  }
  const json leaning = replay({"t.bin", "--shear"});
  EXPECT_EQ(leaning["mismatches"], 0);
  EXPECT_EQ(leaning["manifest"]["sheared"], true);
  EXPECT_EQ(leaning["manifest"]["sweep"], "triangle");
  const std::string summary = succeed({"replay", "t.bin", "--repeat", "1", "--sweep", "three_segments"});
  const std::string cells =
      "6 x 5 x 4 cells, " + std::to_string(trace().obstacles.size()) + " of them solid, ";
  for (const std::string& part :
       {cells + "20 bodies, 150 steps", std::string("ns per vertex move"),
        std::string("by three_segments (median of 1 rounds"), std::string("0 answer bits differ")})
    EXPECT_NE(summary.find(part), std::string::npos) << summary;
}

TEST_F(Replay, CountsAnswersThatDiffer) {
  std::string bytes = text("t.bin");
  bytes[bytes.size() - trace_moves + 1000] ^= 0x04;
  write("false.bin", bytes);
  EXPECT_EQ(replay({"false.bin"})["mismatches"], 1);
  bytes[bytes.size() - 1] ^= 0x10;
  write("false.bin", bytes);
  EXPECT_EQ(replay({"false.bin"})["mismatches"], 2);
  EXPECT_EQ(replay({"false.bin", "--sweep", "three_segments"})["mismatches"], 1);
}

TEST_F(Replay, RefusesWhatIsNoTrace) {
  expect_failure(2, {"replay"}, {"trace is required"});
  expect_failure(3, {"replay", "nothing.bin"}, {"nothing.bin: cannot be opened"});
  write("hello.txt", "hello");
  expect_failure(3, {"replay", "hello.txt"}, {"hello.txt: is no trace"});
  expect_failure(2, {"replay", "t.bin", "--environment", "grid.ovm"}, {"t.bin holds its grid"});
  expect_failure(2, {"replay", "t.bin", "--sweep", "faces"}, {"--sweep", "three_segments|triangle"});
  expect_failure(2, {"replay", "t.bin", "--repeat", "0"}, {"--repeat"});
  expect_failure(2, {"replay", "t.bin", "--warmup", "-1"}, {"--warmup"});
  const std::string bytes = text("t.bin");
  write("short.bin", bytes.substr(0, bytes.size() - 1));
  expect_failure(3, {"replay", "short.bin"},
                 {"short.bin: announces ", " obstacles, 20 bodies and 150 steps"});
  std::string idle = bytes.substr(0, bytes.size() - trace_moves * 25);
  idle.replace(24, 4, std::string(4, '\0'));  // no steps
  write("idle.bin", idle);
  expect_failure(3, {"replay", "idle.bin"}, {"idle.bin: 20 bodies and 0 steps: there is nothing to replay"});
  std::string outside = bytes;
  const std::size_t obstacles = trace().obstacles.size(), starts_at = 64 + 4 * (obstacles + obstacles % 2);
  outside[starts_at + 192 + 7] ^= '\x80';  // the sign of the first coordinate of body 1
  write("outside.bin", outside);
  expect_failure(5, {"replay", "outside.bin"}, {"outside.bin: body 1: vertex 0 of the body"});
  std::string huge = bytes;
  for (std::size_t at : {10, 14}) huge[at] = 1;  // 65536 more cells along x and y
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: a grid of 65542 x 65541 x 4 cells"});
  huge[14] = 0, huge[13] = 8;  // fewer along y: their points are still too many
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: announces a grid of 538230904 cells"});
  expect_failure(1, {"replay", "t.bin", "--repeat", "1", "--json", "nowhere/out.json"}, {"nowhere"});
}

}  // namespace
}  // namespace cellwalk::test
