// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays of traces that hold their grid.
#include <cellwalk/internal/io/trace_file.h>

#include <nlohmann/json.hpp>

#include <string>

#include "cli/program.h"
#include "simulation/random_trace.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class Replay : public Program {
 protected:
  /// Writes t.bin, in which hexahedra are thrown about among solid cells.
  Replay() { write_trace("t.bin", trace()); }

  void write_trace(const std::string& name, const Body_trace& trace) const {
    io::Atomic_file file(path(name));
    io::write_trace(file, trace);
    file.commit();
  }
  static const Body_trace& trace() {
    static const Body_trace trace = random_trace({{6, 5, 4}, 20, 150, 0.06, 0.6, 0.1, 7});
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
    EXPECT_EQ(report["registered_anew"], 0);
    EXPECT_EQ(report["moves"], trace_moves);
    EXPECT_GT(report["blocked"], 100);
    EXPECT_GT(report["counts"]["in_region"], 0.5 * trace_moves);
    const json& manifest = report["manifest"];
    EXPECT_EQ(manifest["sweep"], sweep);
    EXPECT_EQ(manifest["trace"],
              (json{{"file", "t.bin"}, {"bodies", 20}, {"vertices", 160}, {"steps", 150}}));
    EXPECT_EQ(
        manifest["environment"],
        (json{
            {"grid", {6, 5, 4}}, {"solid", trace().grid->solid.size()}, {"sheared", false}, {"cells", 120}}));
  }
  const json leaning = replay({"t.bin", "--shear"});
  EXPECT_EQ(leaning["mismatches"], 0);
  EXPECT_EQ(leaning["manifest"]["environment"]["sheared"], true);
  EXPECT_EQ(leaning["manifest"]["sweep"], "triangle");
  const std::string summary = succeed({"replay", "t.bin", "--shear", "--repeat", "1"});
  EXPECT_NE(summary.find("20 bodies with 160 vertices, 150 steps, among 120 cells, sheared\n"),
            std::string::npos)
      << summary;
}

TEST_F(Replay, TouchesCountAsTheTraceHasIt) {
  Body_trace touching = trace();
  touching.bodies = {hexahedron()};
  touching.steps = 1;
  touching.grid = {{1, 1, 1}, {}};
  Random random(1);
  const Corners corners = box({0.5, 0.5, 0.5}, 0.5, 0, random);
  touching.before.assign(corners.begin(), corners.end());
  touching.before.insert(touching.before.end(), corners.begin(), corners.end());
  touching.targets.assign(corners.begin(), corners.end());
  touching.targets[6] = {0.25, 1, 0.75};
  touching.answers.clear();
  write_trace("stop.bin", touching);
  EXPECT_EQ(replay({"stop.bin"})["blocked"], 1);
  touching.touch_blocks = false;
  write_trace("pass.bin", touching);
  EXPECT_EQ(replay({"pass.bin"})["blocked"], 0);
}

TEST_F(Replay, CountsAnswersThatDiffer) {
  std::string bytes = text("t.bin");
  bytes[bytes.size() - 4 * trace_moves + 1000] ^= 0x01;
  bytes[bytes.size() - 1] ^= 0x02;
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
  expect_failure(3, {"replay", "short.bin"}, {"short.bin: the file ends within the answers"});
  Body_trace other = trace();
  other.before[8][0] *= -1;  // the first coordinate of body 1
  write_trace("outside.bin", other);
  expect_failure(5, {"replay", "outside.bin"}, {"outside.bin: body 1 before step 0: vertex 0 of the body"});
  std::string huge = bytes;
  for (std::size_t at : {18, 22}) huge[at] = 1;  // 65536 more cells along x and y
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: a grid of 65542 x 65541 x 4 cells"});
  huge[22] = 0, huge[21] = 8;  // fewer along y: their points are still too many
  write("huge.bin", huge);
  expect_failure(3, {"replay", "huge.bin"}, {"huge.bin: announces a grid of 538230904 cells"});
  expect_failure(1, {"replay", "t.bin", "--repeat", "1", "--json", "nowhere/out.json"}, {"nowhere"});
}

}  // namespace
}  // namespace cellwalk::test
