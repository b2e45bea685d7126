// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions recorded by `run --record`, and replayed in their environments.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <string>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// Soft bodies with faces, and rigid ones without, fall among solid cells.
constexpr const char* soft = R"({
  "environment": "rooms.ovm",
  "bodies": [{"shape": "hexahedron", "side": 0.5, "count": 10, "seed": 7, "speed": 4, "spin": [0.5, 2, 0.3]},
             {"shape": "icosphere", "radius": 0.3, "subdivisions": 1, "count": 5, "seed": 5, "speed": 2,
              "material": {"mode": "quadratic", "stiffness": 0.4, "deformation": 0.7}}],
  "time_step": 0.02, "steps": 80, "gravity": [0, 0, -3], "output": {"frame_every": 0}
})";
constexpr std::size_t soft_bodies = 15, soft_vertices = 10 * 8 + 5 * 42, soft_steps = 80;

/// A catheter in a vessel of tetrahedra.
constexpr const char* catheter = R"({
  "environment": "vessel.ovm",
  "catheter": {"path": [[0, 0, 0.2], [-1.56, 1.07, 11.49]], "spacing": 0.25, "advance": 0.15, "particles": 50,
               "steering": "none", "stiffness": 0.8},
  "steps": 90, "output": {"frame_every": 0}
})";

class Replay_bodies : public Program {
 protected:
  Replay_bodies() {
    write("soft.json", soft);
    write("catheter.json", catheter);
    succeed(
        {"generate", "hexes", "--cells", "6", "5", "4", "--solid", "0.06", "--seed", "3", "-o", "rooms.ovm"});
  }

  std::string record(const std::string& scene, const std::string& trace,
                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", scene, "-o", trace + ".out", "--record", trace};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return succeed(arguments);
  }
  /// The report of a replay.
  json replay(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "replay");
    arguments.insert(arguments.end(), {"--repeat", "3", "--warmup", "1", "--json", "out.json"});
    succeed(arguments);
    return json::parse(text("out.json"));
  }
  /// Refuses a scene, which runs, as one that cannot be recorded.
  void expect_unrecordable(const std::string& scene, const std::vector<std::string>& texts) const {
    write("other.json", scene);
    succeed({"run", "other.json", "-o", "plain", "--force", "--steps", "1"});
    expect_failure(3, {"run", "other.json", "-o", "out", "--steps", "2", "--record", "t.bin"}, texts);
  }
};

void expect_times(const json& report, std::size_t rounds) {
  std::vector<double> times = report["ns_per_vertex_move_rounds"];
  ASSERT_EQ(times.size(), rounds);
  std::sort(times.begin(), times.end());
  EXPECT_EQ(report["ns_per_vertex_move"], times[times.size() / 2]);
  EXPECT_GT(times[0], 0);
  const json& us = report["step_us"];
  EXPECT_GT(us["median"], 0);
  EXPECT_LE(us["median"], us["p99"]);
  EXPECT_LE(us["p99"], us["p999"]);
  EXPECT_LE(us["p999"], us["max"]);
}

TEST_F(Replay_bodies, GivesTheAnswersOfSoftBodies) {
  const std::string said = record("soft.json", "t.bin");
  EXPECT_NE(said.find("recorded    t.bin"), std::string::npos) << said;
  for (const char* sweep : {"three_segments", "triangle"}) {
    SCOPED_TRACE(sweep);
    const json report = replay({"t.bin", "--environment", "rooms.ovm", "--sweep", sweep});
    EXPECT_EQ(report["mismatches"], 0);
    EXPECT_EQ(report["moves"], soft_vertices * soft_steps);
    EXPECT_GT(report["blocked"], 100);
    EXPECT_EQ(report["blocked"], report["counts"]["held"]);
    EXPECT_EQ(report["counts"]["moves"], report["moves"]);
    expect_times(report, 3);
    EXPECT_TRUE(report["registered_anew"].is_number());
    const json& manifest = report["manifest"];
    for (const char* key : {"cellwalk", "compiler", "flags", "cpu"}) EXPECT_NE(manifest[key], "") << key;
    EXPECT_EQ(
        manifest["trace"],
        (json{
            {"file", "t.bin"}, {"bodies", soft_bodies}, {"vertices", soft_vertices}, {"steps", soft_steps}}));
    EXPECT_EQ(manifest["environment"], (json{{"file", "rooms.ovm"}, {"cells", 120}}));
    EXPECT_EQ(manifest["sweep"], sweep);
    EXPECT_EQ(manifest["rounds"], 3);
    EXPECT_EQ(manifest["warmup"], 1);
  }
  // Other walls give other answers.
  succeed({"generate", "hexes", "--cells", "6", "5", "4", "-o", "empty.ovm"});
  EXPECT_GT(replay({"t.bin", "--environment", "empty.ovm"})["mismatches"], 10);
  const std::string summary = succeed({"replay", "t.bin", "--environment", "rooms.ovm", "--repeat", "1"});
  for (const char* part : {"15 bodies with 290 vertices, 80 steps, among 120 cells", "ns per vertex move",
                           "by triangle (median of 1 rounds", "us in the median", "0 answer bits differ"})
    EXPECT_NE(summary.find(part), std::string::npos) << summary;
}

TEST_F(Replay_bodies, GivesTheAnswersOfACatheter) {
  succeed({"generate", "vessel", "--generations", "1", "--cell-size", "0.4", "-o", "vessel.ovm"});
  record("catheter.json", "t.bin");
  const json report = replay({"t.bin", "--environment", "vessel.ovm"});
  EXPECT_EQ(report["mismatches"], 0);
  EXPECT_EQ(report["moves"], 50 * 90);
  EXPECT_GT(report["blocked"], 10);
}

TEST_F(Replay_bodies, GivesTheAnswersOfBodiesWithARadius) {
  record("soft.json", "soft.bin",
         {"--set", "bodies[0].edge_radius=0.05", "--set", "bodies[1].edge_radius=0.02"});
  EXPECT_EQ(text("soft.bin").substr(0, 8), "ECCDTRC4");
  succeed({"generate", "vessel", "-o", "vessel.ovm"});
  record("catheter.json", "catheter.bin", {"--set", "catheter.radius=0.15"});
  for (const char* sweep : {"three_segments", "triangle"}) {
    const json of_soft = replay({"soft.bin", "--environment", "rooms.ovm", "--sweep", sweep});
    EXPECT_EQ(of_soft["mismatches"], 0);
    EXPECT_GT(of_soft["blocked"], 50);
    const json of_catheter = replay({"catheter.bin", "--environment", "vessel.ovm", "--sweep", sweep});
    EXPECT_EQ(of_catheter["mismatches"], 0);
    EXPECT_GT(of_catheter["blocked"], 20);
  }
}

TEST_F(Replay_bodies, RecordsTheSameBytesAgain) {
  record("soft.json", "a.bin", {"--threads", "1"});
  record("soft.json", "b.bin", {"--threads", "2"});
  record("soft.json", "c.bin", {"--threads", "7"});
  EXPECT_TRUE(text("a.bin") == text("b.bin"));
  EXPECT_TRUE(text("a.bin") == text("c.bin"));
  succeed({"run", "soft.json", "-o", "plain"});
  EXPECT_TRUE(text("plain/contacts.csv") == text("a.bin.out/contacts.csv")) << "recording changes nothing";
  constexpr std::size_t edges = 10 * 12 + 5 * 120, faces = 5 * 80;
  EXPECT_EQ(text("a.bin").size(), 16 + soft_bodies * 12 + edges * 8 + faces * 12 +
                                      (2 * soft_steps + 1) * soft_vertices * 24 + 1 +
                                      soft_steps * (soft_vertices + 2 * edges));
}

TEST_F(Replay_bodies, CountsAnswersThatDiffer) {
  record("soft.json", "t.bin");
  std::string bytes = text("t.bin");
  bytes[bytes.size() - 1000] ^= 1;
  bytes[bytes.size() - 1] ^= 2;
  write("false.bin", bytes);
  EXPECT_EQ(replay({"false.bin", "--environment", "rooms.ovm"})["mismatches"], 2);
  EXPECT_EQ(replay({"false.bin", "--environment", "rooms.ovm", "--sweep", "three_segments"})["mismatches"],
            1);
  constexpr std::size_t answers = soft_steps * (soft_vertices + 2 * (10 * 12 + 5 * 120));
  bytes.resize(bytes.size() - answers);
  bytes.back() = 0;
  write("unknown.bin", bytes);
  EXPECT_TRUE(replay({"unknown.bin", "--environment", "rooms.ovm"})["mismatches"].is_null());
  const std::string summary =
      succeed({"replay", "unknown.bin", "--environment", "rooms.ovm", "--repeat", "1"});
  EXPECT_NE(summary.find("not known: the trace holds no answers"), std::string::npos) << summary;
}

TEST_F(Replay_bodies, RefusesWhatItCannotReplay) {
  record("soft.json", "t.bin", {"--steps", "2"});
  expect_failure(2, {"replay", "t.bin"}, {"--environment is missing", "t.bin"});
  expect_failure(2, {"replay", "t.bin", "--environment", "rooms.ovm", "--shear"}, {"--shear", "t.bin"});
  expect_failure(2, {"replay", "t.bin", "--environment", "rooms.ovm", "--json", "rooms.ovm"}, {"rooms.ovm"});
  expect_failure(3, {"replay", "t.bin", "--environment", "nothing.ovm"}, {"nothing.ovm: cannot be opened"});
  expect_failure(
      1, {"replay", "t.bin", "--environment", "rooms.ovm", "--repeat", "1", "--json", "nowhere/out.json"},
      {"nowhere"});
  succeed({"generate", "squares", "--cells", "3", "-o", "flat.ovm"});
  expect_failure(3, {"replay", "t.bin", "--environment", "flat.ovm"}, {"flat.ovm: is 2D", "t.bin"});
  succeed({"generate", "hexes", "--cells", "2", "-o", "small.ovm"});
  expect_failure(5, {"replay", "t.bin", "--environment", "small.ovm"},
                 {"t.bin: body ", " before step 0: vertex "});
  const std::string bytes = text("t.bin");
  write("short.bin", bytes.substr(0, bytes.size() - 1));
  expect_failure(3, {"replay", "short.bin", "--environment", "rooms.ovm"},
                 {"short.bin: the file ends within the answers"});
  write("idle.bin", bytes.substr(0, 8) + std::string(9, '\0'));
  expect_failure(3, {"replay", "idle.bin", "--environment", "rooms.ovm"},
                 {"idle.bin: 0 bodies and 0 steps: there is nothing to replay"});
}

TEST_F(Replay_bodies, RecordsOnlyWhatATraceCanHold) {
  const std::string with_particles = R"({"environment": "rooms.ovm", "particles": [{"count": 2}], )";
  expect_unrecordable(
      with_particles + R"("bodies": [{"shape": "hexahedron", "side": 0.2, "count": 1}], "steps": 3})",
      {"other.json: particles:", "bodies only"});
  expect_unrecordable(with_particles + R"("steps": 3})", {"other.json: particles:", "bodies only"});
  succeed({"generate", "squares", "--cells", "3", "-o", "flat.ovm"});
  expect_unrecordable(R"({"dimension": 2, "environment": "flat.ovm",
                          "bodies": [{"shape": "quad", "side": 0.5, "position": [1, 1]}], "steps": 3})",
                      {"other.json: dimension:"});
  std::string fan;
  for (int v = 0; v < 66; ++v)
    fan += "v " + std::to_string(0.01 * v) + " " + std::to_string(v % 7 * 0.01) + " 0\n";
  for (int v = 2; v <= 66; ++v) fan += "l 1 " + std::to_string(v) + "\n";
  write("fan.obj", fan);
  expect_unrecordable(
      R"({"environment": "rooms.ovm", "steps": 3,
          "bodies": [{"file": "fan.obj", "position": [2.5, 2.5, 2.5]}]})",
      {"other.json: body 0: vertex 0 has 65 edges", "leave the body out"});
  expect_failure(1, {"run", "soft.json", "-o", "out", "--record", "nowhere/t.bin"}, {"nowhere/t.bin"});
}

/// Whatever is swept in the run, and whatever its vertices do at walls, answers follow the rule of traces.
TEST_F(Replay_bodies, RecordsRunsOfAnySweep) {
  for (const char* sweep : {"three_segments", "faces"}) {
    const std::string trace = std::string(sweep) + ".bin";
    record("soft.json", trace, {"--sweep", sweep, "--steps", "40"});
    EXPECT_EQ(replay({trace, "--environment", "rooms.ovm"})["mismatches"], 0);
  }
}

}  // namespace
}  // namespace cellwalk::test
