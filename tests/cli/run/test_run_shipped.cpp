// SPDX-License-Identifier: LGPL-3.0-or-later
// The scenes of data/ whose walls come and go, as they are shipped: they end valid, and are the same for any
// number of threads.
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class RunShipped : public Program {
 protected:
  /// Runs a scene on one, two and three threads, and compares all that is written. Returns the report.
  json run_on_threads(const std::string& scene) const {
    for (const char* threads : {"1", "2", "3"})
      succeed({"run", CELLWALK_SHIPPED_DATA "/" + scene, "-o", threads, "--threads", threads, "--set",
               "output.picture=false"});
    std::size_t compared = 0;
    std::set<std::string> walls;
    for (const std::string& file : files()) {
      if (!file.starts_with("1/") || !std::filesystem::is_regular_file(path(file))) continue;
      const std::string name = file.substr(2), expected = text(file);
      for (const char* folder : {"2/", "3/"}) EXPECT_EQ(text(folder + name), expected) << folder << name;
      ++compared;
      if (name.starts_with("frames/walls_")) walls.insert(expected);
    }
    EXPECT_GE(compared, 5u + walls.size()) << "tables, report and recording, too";
    EXPECT_GE(walls.size(), 3u) << "frames show the walls that change";
    return json::parse(text("1/run.json"));
  }
};

TEST_F(RunShipped, AValveShutsRoundACatheter) {
  const json run = run_on_threads("valve.json");
  EXPECT_TRUE(run["validated"].get<bool>());
  const json& changes = run["changes"];
  EXPECT_EQ(changes["opened"], 141);
  EXPECT_EQ(changes["closed"].get<int>() + changes["left"].get<int>(), 2 * 141);
  EXPECT_GE(changes["left"], 1) << "the catheter holds some facet open to the end";
  EXPECT_LE(changes["left"], 8);
}

TEST_F(RunShipped, ATunnelIsExcavatedAndFilled) {
  const json run = run_on_threads("excavation.json");
  EXPECT_TRUE(run["validated"].get<bool>());
  const json& changes = run["changes"];
  EXPECT_EQ(changes["excavated"], 2 * 2 * 2);
  EXPECT_EQ(changes["filled"], 2 * 6 * 6 + 4) << "the slab, and the lower half of the tunnel";
  EXPECT_EQ(changes["left"], 0);
  EXPECT_GT(changes["refusals"], 100) << "boxes are in the way";
}

TEST_F(RunShipped, ACutGapes) {
  const json run = run_on_threads("cut.json");
  EXPECT_TRUE(run["validated"].get<bool>());
  EXPECT_EQ(run["changes"]["made"], 1);
  EXPECT_EQ(run["changes"]["left"], 0);
  EXPECT_GT(run["walls"]["tissue"]["largest_stretch"], 1.5);
  EXPECT_EQ(run["contacts"]["facet"], 0) << "the catheter passes through the cut";
  EXPECT_GT(run["catheter"]["length_inside"], 8) << "beyond the septum, which ends 7 from the start";
}

TEST_F(RunShipped, ACutIsSewnUpRoundACatheter) {
  const json run = run_on_threads("suture.json");
  EXPECT_TRUE(run["validated"].get<bool>());
  const json& changes = run["changes"];
  EXPECT_EQ(changes["made"], 1);
  EXPECT_EQ(changes["sewn"].get<int>() + changes["left"].get<int>(), changes["cuts"]["parted"]);
  EXPECT_GE(changes["sewn"], 12);
  EXPECT_GE(changes["left"], 1) << "the catheter holds some stitch open to the end";
}

}  // namespace
}  // namespace cellwalk::test
