// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// Hexahedra, spheres with faces and a rod that is led through a grid with solid cells; and a few particles.
constexpr const char* grid_scene = R"({
  "title": "A grid", "environment": {"generate": "hexes", "cells": [5, 4, 3], "solid": 0.1},
  "particles": [{"count": 4, "speed": 5}],
  "bodies": [{"shape": "hexahedron", "side": 0.4, "count": 12, "seed": 3, "speed": 3, "spin": [1, 0, 0.5]},
             {"shape": "icosphere", "radius": 0.2, "subdivisions": 0, "count": 2, "speed": 2},
             {"file": "rod.csv", "motion": {"path": [[0.5, 0.3, 0.3], [9, 0.3, 0.3]], "speed": 2}}],
  "time_step": 0.05, "steps": 100, "output": {"frame_every": 25, "picture": {"width": 160, "height": 120}}
})";
constexpr const char* rod = "x,y,z\n0,0,0\n0,0,0.3\n";

constexpr const char* flat = R"({
  "dimension": 2, "environment": {"generate": "squares", "cells": 8, "solid": 0.1},
  "bodies": [{"shape": "polygon", "radius": 0.3, "count": 20, "speed": 5, "spin": 1}],
  "gravity": [0, -1], "time_step": 0.05, "steps": 100, "output": {"frame_every": 0, "picture": true}
})";

class RunBodies : public Program {
 protected:
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }
  std::string run_grid() const {
    write("rod.csv", rod);
    write("grid.json", grid_scene);
    return succeed({"run", "grid.json", "-o", "out"});
  }
};

const std::vector<std::string> contacts_header{"step", "particle", "time",   "x",       "y",
                                               "z",    "kind",     "nx",     "ny",      "nz",
                                               "cell", "body",     "vertex", "feature", "number"};

/// Contacts of a table by feature of the body and kind of the wall; checks each row.
std::map<std::string, std::map<std::string, std::size_t>> count_contacts(
    const std::vector<std::vector<std::string>>& table, std::size_t dimension, std::size_t bodies,
    std::size_t& of_particles) {
  EXPECT_EQ(table.at(0), contacts_header);
  std::map<std::string, std::map<std::string, std::size_t>> contacts;
  of_particles = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& row = table[i];
    EXPECT_EQ(row.size(), contacts_header.size());
    EXPECT_EQ(row[5].empty(), dimension == 2);
    EXPECT_EQ(row[9].empty(), dimension == 2);
    const double nz = dimension == 2 ? 0 : std::stod(row[9]);
    EXPECT_NEAR(std::hypot(std::stod(row[7]), std::stod(row[8]), nz), 1, 1e-14);
    if (!row[1].empty()) {
      ++of_particles;
      for (std::size_t column = 11; column < 15; ++column) EXPECT_EQ(row[column], "") << "a particle's";
      continue;
    }
    EXPECT_LT(std::stoul(row[11]), bodies);
    if (row[13] == "vertex") {
      EXPECT_EQ(row[12], row[14]);
    }
    ++contacts[row[13]][row[6]];
  }
  return contacts;
}

TEST_F(RunBodies, WritesWhatTheyMet) {
  const std::string said = run_grid();
  for (const char* part :
       {"15, with 122 vertices, 205 edges, 40 faces", "4 free", "of vertices, ", "% in one cell",
        "0 of 1 bodies at the end of their paths", "no edge crosses a wall"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;

  const json run = report("out");
  std::size_t of_particles = 0;
  auto contacts = count_contacts(read_table(path("out/contacts.csv")), 3, 15, of_particles);
  EXPECT_GT(of_particles, 10u);
  std::map<std::string, std::size_t> of_feature;
  std::size_t sum = of_particles;
  for (const char* feature : {"vertex", "edge", "face"})
    for (const char* kind : {"vertex", "edge", "facet"}) {
      EXPECT_EQ(run["bodies"]["contacts"][feature][kind], contacts[feature][kind]) << feature << " " << kind;
      of_feature[feature] += contacts[feature][kind];
      sum += contacts[feature][kind];
    }
  EXPECT_GT(of_feature["vertex"], 100u);
  EXPECT_GT(of_feature["edge"], 10u);
  std::size_t reported = 0;
  for (const auto& count : run["contacts"]) reported += count.get<std::size_t>();
  EXPECT_EQ(reported, sum);

  EXPECT_EQ(run["bodies"]["count"], 15);
  EXPECT_EQ(run["bodies"]["vertices"], 12 * 8 + 2 * 12 + 2);
  EXPECT_EQ(run["bodies"]["edges"], 12 * 12 + 2 * 30 + 1);
  EXPECT_EQ(run["bodies"]["faces"], 2 * 20);
  EXPECT_EQ(run["bodies"]["guided"], json::parse(R"({"count": 1, "arrived": 0})"));
  EXPECT_EQ(run["validated"], true);
  EXPECT_EQ(run["manifest"]["sweep"], "triangle");
  const json& counts = run["body_counts"];
  EXPECT_EQ(counts["moves"], 122 * 100);
  EXPECT_EQ(counts["contacts"], sum - of_particles);
  const double moves = counts["moves"], edges = counts["edges"]["checked"];
  EXPECT_EQ(counts["shares"]["in_region"].get<double>(), counts["in_region"].get<double>() / moves);
  double decided = 0;
  for (const char* key : {"same_cell", "same_chain", "relinked", "event_sweeps"}) {
    EXPECT_EQ(counts["shares"][key].get<double>(), counts["edges"][key].get<double>() / edges);
    decided += counts["shares"][key].get<double>();
  }
  EXPECT_GT(decided, 0.95);
  EXPECT_LE(decided, 1.05);
}

TEST_F(RunBodies, InThePlane) {
  write("flat.json", flat);
  succeed({"run", "flat.json", "-o", "out"});
  std::size_t of_particles = 0;
  auto contacts = count_contacts(read_table(path("out/contacts.csv")), 2, 20, of_particles);
  EXPECT_EQ(of_particles, 0u);
  EXPECT_GT(contacts["vertex"]["facet"], 100u);
  EXPECT_GT(contacts["edge"]["vertex"], 10u);
  EXPECT_EQ(report("out")["bodies"]["contacts"]["edge"]["vertex"], contacts["edge"]["vertex"]);
  EXPECT_GT(text("out/picture.png").size(), 10000u);
}

TEST_F(RunBodies, GiveTheSameBytesEveryTime) {
  write("rod.csv", rod);
  for (const char* scene : {grid_scene, flat}) {
    write("scene.json", scene);
    for (const char* folder : {"a", "b"}) succeed({"run", "scene.json", "-o", folder, "--force"});
    std::size_t compared = 0;
    for (const std::string& file : files()) {
      if (!file.starts_with("a/") || !std::filesystem::is_regular_file(path(file))) continue;
      EXPECT_EQ(text(file), read_text(path("b") / file.substr(2))) << file;
      ++compared;
    }
    EXPECT_EQ(compared, scene == grid_scene ? 21u : 4u);
  }
}

TEST_F(RunBodies, ThreeSegmentsAreTheOtherSweep) {
  write("flat.json", flat);
  succeed({"run", "flat.json", "-o", "triangle"});
  succeed({"run", "flat.json", "-o", "paper", "--sweep", "three_segments"});
  EXPECT_EQ(report("paper")["manifest"]["sweep"], "three_segments");
  const auto events = [&](const std::string& run) {
    return report(run)["body_counts"]["edges"]["event_sweeps"].get<int>();
  };
  EXPECT_GT(events("triangle"), events("paper") + 5) << "looks at no swept triangle";
  // In the plane there are no faces to sweep.
  succeed({"run", "flat.json", "-o", "faces", "--sweep", "faces"});
  EXPECT_EQ(text("faces/contacts.csv"), text("triangle/contacts.csv"));
  expect_failure(2, {"run", "flat.json", "-o", "out", "--sweep", "none"}, {"--sweep"});
}

TEST_F(RunBodies, ThreadsChangeNothing) {
  run_grid();
  for (const char* threads : {"1", "3", "0"}) {
    succeed({"run", "grid.json", "-o", threads, "--threads", threads});
    for (const char* file : {"/contacts.csv", "/run.json"})
      EXPECT_EQ(text(std::string(threads) + file), text(std::string("out") + file)) << file;
  }
  expect_failure(2, {"run", "grid.json", "-o", "none", "--threads", "2000"}, {"--threads"});
}

TEST_F(RunBodies, FacesAreSweptOnRequest) {
  run_grid();
  succeed({"run", "grid.json", "-o", "faces", "--sweep", "faces"});
  EXPECT_FALSE(report("out")["body_counts"].contains("faces"));
  EXPECT_GT(report("faces")["body_counts"]["faces"]["swept"], 0);
  EXPECT_EQ(report("faces")["validated"], true);
}

TEST_F(RunBodies, TheShippedScenesRun) {
  // Those with deformable bodies for fewer steps.
  const std::pair<const char*, const char*> scenes[] = {
      {"bodies.json", "400"}, {"bodies_2d.json", "300"}, {"hexahedra.json", "150"}, {"soft.json", "100"}};
  for (const auto& [scene, steps] : scenes) {
    succeed({"run", std::string(CELLWALK_SHIPPED_DATA "/").append(scene), "-o", "out", "--force", "--steps",
             steps});
    const json run = report("out");
    EXPECT_EQ(run["validated"], true) << scene;
    std::size_t edges = 0, vertices = 0;
    for (const auto& count : run["bodies"]["contacts"]["edge"]) edges += count.get<std::size_t>();
    for (const auto& count : run["bodies"]["contacts"]["vertex"]) vertices += count.get<std::size_t>();
    EXPECT_GT(edges, 50u) << scene;
    EXPECT_GT(vertices, 500u) << scene;
  }
}

TEST_F(RunBodies, AreRefusedWithTheKeyAndThePlace) {
  const auto refuse = [this](int exit_code, const std::string& bodies,
                             const std::vector<std::string>& texts) {
    write("s.json",
          R"({"environment": {"generate": "hexes", "cells": 3}, "steps": 1, "bodies": [)" + bodies + "]}");
    expect_failure(exit_code, {"run", "s.json", "-o", "out"}, texts);
  };
  refuse(5,
         R"({"shape": "hexahedron", "position": [1.5, 1.5, 1.5]},)"
         R"( {"shape": "tetrahedron", "position": [3, 1, 1]})",
         {"s.json: bodies[1]: vertex 0 of the body, at (3.3", "is outside the environment"});
  refuse(5, R"({"shape": "catheter", "length": 9, "count": 2})",
         {"s.json: bodies[0]: no room for copy 1 of 2", "1000 random places"});
  refuse(5, R"({"shape": "polyline", "points": [[0, 0, 0], [1, 0, 0]],
                "motion": {"path": [[2.5, 0, 0], [0, 0, 0]], "speed": 1}})",
         {"s.json: bodies[0]: vertex 1 of the body, at (3.5, 0, 0), is outside the environment"});
  refuse(3, R"({"shape": "hexahedron", "scale": 1e300, "side": 1e300})", {"s.json: bodies[0]: "});
  refuse(3, R"({"shape": "polygon"})", {"s.json: bodies[0].shape: "});
  refuse(3, R"({"file": "missing.obj"})", {"missing.obj"});
  write("broken.csv", "x,y,z\n1,2\n");
  refuse(3, R"({"file": "broken.csv"})", {"broken.csv:2"});
}

TEST_F(RunBodies, ACrossedWallIsNamed) {
  write("s.json", R"({"dimension": 2, "environment": {"generate": "squares", "cells": [9, 9], "solid": 0.2},
    "steps": 1, "bodies": [{"shape": "catheter", "length": 8.5, "vertices": 2, "position": [4.5, ROW]}]})");
  const std::string scene = text("s.json");
  std::size_t crossed = 0;
  for (const char* row : {"0.5", "1.5", "2.5", "3.5", "4.5", "5.5", "6.5", "7.5", "8.5"}) {
    write("s.json", std::string(scene).replace(scene.find("ROW"), 3, row));
    const Outcome outcome = run({"run", "s.json", "-o", "rows", "--force"});
    if (outcome.err.find("edge 0 of the body") == std::string::npos) continue;
    EXPECT_EQ(outcome.exit_code, 5);
    for (const std::string& part :
         {"cellwalk: s.json: bodies[0]: edge 0 of the body, from vertex 0 at (0.25, " + std::string(row) +
              ")",
          std::string("crosses a wall at ("), std::string(", in cell ")})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    ++crossed;
  }
  EXPECT_GE(crossed, 3u);
}

}  // namespace
}  // namespace cellwalk::test
