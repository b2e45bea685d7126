// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces recorded by `run --record` and replayed.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// Hexahedra thrown about among solid cells.
constexpr const char* boxes = R"({
  "environment": {"generate": "hexes", "cells": [6, 5, 4], "solid": 0.06, "seed": 3},
  "bodies": [{"shape": "hexahedron", "side": 0.6, "count": 20, "seed": 7, "speed": 5, "spin": [0.5, 2, 0.3]}],
  "time_step": 0.02, "steps": 150, "gravity": [0, 0, -1], "output": {"frame_every": 0}
})";

class Replay : public Program {
 protected:
  Replay() { write("boxes.json", boxes); }

  std::string record(const std::string& trace, const std::string& folder) const {
    return succeed({"run", "boxes.json", "-o", folder, "--record", trace});
  }
  /// The report of a replay.
  json replay(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "replay");
    arguments.insert(arguments.end(), {"--repeat", "3", "--warmup", "0", "--json", "out.json"});
    succeed(arguments);
    return json::parse(text("out.json"));
  }
  /// Refuses a scene as one that cannot be recorded.
  void expect_unrecordable(const std::string& from, const std::string& to,
                           const std::vector<std::string>& texts) const {
    std::string scene = boxes;
    const std::size_t at = scene.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write("other.json", scene.replace(at, from.size(), to));
    succeed({"run", "other.json", "-o", "plain", "--force", "--steps", "1"});
    expect_failure(3, {"run", "other.json", "-o", "out", "--steps", "2", "--record", "t.bin"}, texts);
  }
};

constexpr std::size_t trace_moves = 150 * 20 * 8;

TEST_F(Replay, GivesTheRecordedAnswers) {
  const std::string said = record("t.bin", "out");
  EXPECT_NE(said.find("recorded    t.bin"), std::string::npos) << said;
  const json run = json::parse(text("out/run.json"));
  EXPECT_EQ(run["manifest"]["recorded"], true);
  EXPECT_EQ(run["manifest"]["sweep"], "three_segments");
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
    EXPECT_EQ(counts["held"], run["body_counts"]["held"]);
    EXPECT_GT(counts["in_region"], 0.5 * trace_moves);
    EXPECT_GT(counts["walks"], trace_moves / 100);
    EXPECT_GT(counts["crossings"], 100);
    EXPECT_TRUE(counts["exact_fallbacks"].is_number());
    double shares = 0;
    for (const char* certificate : {"same_cell", "convex_pair", "same_chain"})
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
    EXPECT_EQ(manifest["trace"]["obstacles"], 7);
    EXPECT_EQ(manifest["trace"]["seed"], 7);
    EXPECT_EQ(manifest["trace"]["body_side"], 0.6);
    EXPECT_EQ(manifest["trace"]["speed"], 0.02 * 5);
  }
  const json leaning = replay({"t.bin", "--shear"});
  EXPECT_EQ(leaning["mismatches"], 0);
  EXPECT_EQ(leaning["manifest"]["sheared"], true);
  EXPECT_EQ(leaning["manifest"]["sweep"], "triangle");
  const std::string summary = succeed({"replay", "t.bin", "--repeat", "1", "--sweep", "three_segments"});
  for (const char* part : {"6 x 5 x 4 cells, 7 of them solid, 20 bodies, 150 steps", "ns per vertex move",
                           "by three_segments (median of 1 rounds", "0 answer bits differ"})
    EXPECT_NE(summary.find(part), std::string::npos) << summary;
}

TEST_F(Replay, RecordsTheSameBytesAgain) {
  record("a.bin", "a");
  record("b.bin", "b");
  EXPECT_TRUE(text("a.bin") == text("b.bin"));
  EXPECT_EQ(text("a.bin").size(), 64 + 4 * 8 + 20 * 192 + trace_moves * 25);
}

TEST_F(Replay, CountsAnswersThatDiffer) {
  record("t.bin", "out");
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
  expect_failure(3, {"replay", "boxes.json"}, {"boxes.json: is no trace"});
  expect_failure(2, {"replay", "t.bin", "--sweep", "faces"}, {"--sweep", "three_segments|triangle"});
  expect_failure(2, {"replay", "t.bin", "--repeat", "0"}, {"--repeat"});
  expect_failure(2, {"replay", "t.bin", "--warmup", "-1"}, {"--warmup"});
  record("t.bin", "out");
  const std::string bytes = text("t.bin");
  write("short.bin", bytes.substr(0, bytes.size() - 1));
  expect_failure(3, {"replay", "short.bin"}, {"short.bin: announces 7 obstacles, 20 bodies and 150 steps"});
  std::string idle = bytes.substr(0, bytes.size() - trace_moves * 25);
  idle.replace(24, 4, std::string(4, '\0'));  // no steps
  write("idle.bin", idle);
  expect_failure(3, {"replay", "idle.bin"}, {"idle.bin: 20 bodies and 0 steps: there is nothing to replay"});
  std::string outside = bytes;
  outside[64 + 32 + 192 + 7] ^= '\x80';  // the sign of the first coordinate of body 1
  write("outside.bin", outside);
  expect_failure(5, {"replay", "outside.bin"}, {"outside.bin: body 1: vertex 0 of the body"});
  std::string huge = bytes;
  for (std::size_t at : {10, 14}) huge[at] = 1;  // 65536 more cells along x and y
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: a grid of 65542 x 65541 x 4 cells"});
  huge[14] = 0, huge[13] = 8;  // fewer along y: their points are still too many
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: grid: too large for 32-bit indices"});
  expect_failure(1, {"replay", "t.bin", "--repeat", "1", "--json", "nowhere/out.json"}, {"nowhere"});
}

TEST_F(Replay, RecordsOnlyWhatATraceCanHold) {
  expect_failure(2, {"run", "boxes.json", "-o", "out", "--record", "t.bin", "--sweep", "triangle"},
                 {"leave --sweep out"});
  expect_failure(1, {"run", "boxes.json", "-o", "out", "--record", "nowhere/t.bin"}, {"nowhere/t.bin"});
  succeed({"run", "boxes.json", "-o", "done", "--record", "t.bin", "--sweep", "three_segments"});
  expect_unrecordable(R"("hexes", "cells": [6, 5, 4], "solid": 0.06)", R"("tets", "cells": [6, 5, 4])",
                      {"other.json: environment:", "\"hexes\""});
}

TEST_F(Replay, RecordsOnlyCubes) {
  expect_unrecordable("\"seed\": 3", "\"scale\": 2", {"other.json: environment:", "leave scale"});
  expect_unrecordable("\"seed\": 3", "\"sheared\": 1", {"other.json: environment:", "leave scale"});
}

TEST_F(Replay, RecordsOnlyHexahedra) {
  expect_unrecordable("\"side\": 0.6", "\"side\": 0.6, \"faces\": true",
                      {"other.json: bodies[0]:", "8 vertices and 12 edges"});
  expect_unrecordable("\"bodies\": [",
                      "\"bodies\": [{\"shape\": \"tetrahedron\", \"side\": 0.1, \"count\": 1},",
                      {"other.json: bodies[0]:", "8 vertices and 12 edges"});
  expect_unrecordable("\"bodies\"", "\"particles\": [{\"count\": 2}], \"bodies\"",
                      {"other.json: particles:", "bodies only"});
  expect_unrecordable(
      "\"bodies\"",
      "\"catheter\": {\"path\": [[0.5, 0.5, 0.5], [0.6, 0.6, 0.6]], \"spacing\": 0.1}, \"bodies\"",
      {"other.json: catheter:", "bodies only"});
}

TEST_F(Replay, RecordsTouchesAsHits) {
  write("resting.json", R"({
    "environment": {"generate": "hexes", "cells": 3},
    "bodies": [{"shape": "box", "size": [0.5, 0.5, 0.5], "position": [0.25, 1, 1]}], "steps": 3})");
  expect_failure(3, {"run", "resting.json", "-o", "out", "--record", "t.bin"},
                 {"resting.json: body 0: its edge from vertex 0 to vertex 1 touches a wall at the start"});
  write("arriving.json", R"({
    "environment": {"generate": "hexes", "cells": 3},
    "bodies": [{"shape": "box", "size": [0.5, 0.5, 0.5], "position": [0.75, 1, 1],
                "velocity": [-0.25, 0, 0]}],
    "time_step": 1, "steps": 3})");
  succeed({"run", "arriving.json", "-o", "out", "--record", "t.bin"});
  EXPECT_EQ(json::parse(text("out/run.json"))["body_counts"]["held"], 4) << "it ends on the wall";
  const json counts = replay({"t.bin"})["counts"];
  EXPECT_EQ(counts["vertex_hits"], 4);
  EXPECT_EQ(counts["held"], 4);
  EXPECT_EQ(replay({"t.bin"})["mismatches"], 0);
}

TEST_F(Replay, RecordsBodiesOfSpaceOnly) {
  write("flat.json", R"({
    "dimension": 2, "environment": {"generate": "squares", "cells": 3},
    "bodies": [{"shape": "quad", "side": 0.5, "position": [1, 1]}], "steps": 3})");
  expect_failure(3, {"run", "flat.json", "-o", "out", "--record", "t.bin"}, {"flat.json: dimension:"});
}

}  // namespace
}  // namespace cellwalk::test
