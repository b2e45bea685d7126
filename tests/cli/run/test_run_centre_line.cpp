// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run with an environment that is imported, and a catheter from one group to another.
#include <cellwalk/io/mesh_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// A duct of hexahedra along x, with a group of facets at each end.
void write_duct(const std::filesystem::path& path) {
  constexpr std::uint32_t along = 12, across = 4;
  Cell_soup<3> soup;
  const auto point = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return x + (along + 1) * (y + (across + 1) * z);
  };
  for (std::uint32_t z = 0; z <= across; ++z)
    for (std::uint32_t y = 0; y <= across; ++y)
      for (std::uint32_t x = 0; x <= along; ++x)
        soup.points.push_back({static_cast<double>(x), 0.5 * y - 1, 0.5 * z - 1});
  Soup_groups groups;
  for (std::uint32_t z = 0; z < across; ++z)
    for (std::uint32_t y = 0; y < across; ++y)
      for (std::uint32_t x = 0; x < along; ++x) {
        const auto first = static_cast<std::uint32_t>(soup.facet_count());
        add_hexahedron(soup, {point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z), point(x, y + 1, z),
                              point(x, y, z + 1), point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1),
                              point(x, y + 1, z + 1)});
        if (x == 0) groups["cap_1"].facets.push_back(first + 5);
        if (x + 1 == along) groups["cap_2"].facets.push_back(first + 3);
      }
  io::write_ovm(path, soup, groups);
}

constexpr const char* two_keys = R"({"environment": {"import": "meshes/duct.ovm"},
  "catheter": {"from": "cap_1", "to": "cap_2"}, "steps": 100, "output": {"frame_every": 0}})";

class CentreLineRun : public Program {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(path("scenes/meshes"));
    write_duct(path("scenes/meshes/duct.ovm"));
    write("scenes/s.json", two_keys);
  }
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }
  std::vector<std::string> kept() const {
    std::vector<std::string> names = files();
    std::erase_if(names, [](const std::string& name) { return !name.ends_with(".cellwalk"); });
    return names;
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(CentreLineRun, ArrivesByTwoKeys) {
  const std::string said = succeed({"run", "scenes/s.json", "-o", "out"});
  EXPECT_TRUE(contains(said,
                       "  imported    scenes/meshes/duct.ovm, kept for the next run: "
                       "scenes/.cellwalk-cache/"))
      << said;
  EXPECT_TRUE(contains(said, "read: scenes/meshes/duct.ovm: ")) << said;
  EXPECT_TRUE(contains(said, ", arrived at the last of ")) << said;
  const json pushed = report("out")["catheter"];
  EXPECT_TRUE(pushed["arrived"]);
  EXPECT_EQ(pushed["travelled"], 1);
  EXPECT_FALSE(pushed.contains("held_by"));
  EXPECT_NEAR(pushed["tip"][0], 12, 1);
  ASSERT_GE(pushed["path"].size(), 12u);
  for (const json& place : pushed["path"]) {
    EXPECT_NEAR(place[1], 0, 0.05) << "beside the axis";
    EXPECT_NEAR(place[2], 0, 0.05);
  }
  EXPECT_TRUE(report("out")["validated"]);

  const std::string again = succeed({"run", "scenes/s.json", "-o", "again"});
  EXPECT_TRUE(contains(again, "  imported    scenes/meshes/duct.ovm, from the cache: ")) << again;
  EXPECT_EQ(text("again/run.json"), text("out/run.json"));
  ASSERT_EQ(kept().size(), 1u);
  EXPECT_TRUE(kept().front().starts_with("scenes/.cellwalk-cache/")) << kept().front();
}

TEST_F(CentreLineRun, ArrivesWithARadius) {
  succeed({"run", "scenes/s.json", "-o", "thick", "--set", "catheter.radius=0.6"});
  const json pushed = report("thick")["catheter"];
  EXPECT_TRUE(pushed["arrived"]) << pushed;
  // The base is as far from the group as the radius, and the tip cannot come nearer to the other.
  EXPECT_GE(pushed["path"].front()[0], 0.6);
  EXPECT_GE(pushed["tip"][0], 10);
  EXPECT_LE(pushed["tip"][0], 11.4);
}

TEST_F(CentreLineRun, SaysHowFarItCame) {
  const std::string few = succeed({"run", "scenes/s.json", "-o", "few", "--steps", "15"});
  EXPECT_TRUE(contains(few, "; the steps were over: it needs about 33 more")) << few;
  json pushed = report("few")["catheter"];
  EXPECT_FALSE(pushed["arrived"]);
  EXPECT_EQ(pushed["held_by"], "steps");
  EXPECT_NEAR(pushed["travelled"], 15 * 0.25 / 12, 0.05);
  const std::string said = succeed({"run", "scenes/s.json", "-o", "short", "--set", "catheter.particles=9"});
  EXPECT_TRUE(contains(said, " % of the path, at (")) << said;
  EXPECT_TRUE(contains(said, "; all of it is inside: it needs more particles")) << said;
  pushed = report("short")["catheter"];
  EXPECT_EQ(pushed["held_by"], "length");
  EXPECT_NEAR(pushed["travelled"], 8 * 0.5 / 12, 0.05);
}

TEST_F(CentreLineRun, TakesPointsAndGroupsOfTheScene) {
  succeed({"run", "scenes/s.json", "-o", "back", "--set", "catheter.from=[11, 0.5, 0.5]", "--set",
           R"(groups={"near": {"ball": [[1.5, 0, 0], 0.6]}})", "--set", "catheter.to=near"});
  const json pushed = report("back")["catheter"];
  EXPECT_TRUE(pushed["arrived"]);
  EXPECT_EQ(pushed["path"][0], json({11, 0.5, 0.5}));
  EXPECT_NEAR(pushed["tip"][0], 1.5, 1);
}

TEST_F(CentreLineRun, ReplacesCellsOnlyWithAMap) {
  // Walls that open need the map of the environment, from the cache as well.
  const std::vector<std::string> arguments{
      "run", "scenes/s.json", "--set",
      R"(changes=[{"step": 3, "close": {"plane": [[6, 0, 0], [1, 0, 0]]}}])"};
  for (const char* folder : {"first", "second"}) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"-o", folder});
    succeed(all);
    const json run = report(folder);
    EXPECT_EQ(run["changes"]["closed"], 16);
    EXPECT_FALSE(run["catheter"]["arrived"]);
    EXPECT_NEAR(run["catheter"]["tip"][0], 6, 0.5) << "at the wall that came";
    EXPECT_EQ(run["catheter"]["held_by"], "walls");
  }
  EXPECT_EQ(text("first/run.json"), text("second/run.json"));
}

TEST_F(CentreLineRun, IsRefusedWithTheReason) {
  const auto refuse = [&](int code, const std::vector<std::string>& changes, const std::string& message) {
    std::vector<std::string> arguments{"run", "scenes/s.json", "-o", "out"};
    for (const std::string& change : changes) arguments.insert(arguments.end(), {"--set", change});
    expect_failure(code, arguments, {message});
  };
  succeed({"run", "scenes/s.json", "-o", "cached", "--steps", "1"});
  refuse(3, {"catheter.from=inlet"},
         "scenes/s.json: catheter.from: there is no group \"inlet\"; there are cap_1, cap_2");
  refuse(5, {"catheter.to=[50, 0, 0]"},
         "scenes/s.json: catheter.to: (50, 0, 0) lies in no free cell; put it into free space");
  refuse(3, {"environment.qualty=2"}, "scenes/s.json: environment: qualty: unknown key; known here: ");
  refuse(3, {"environment.quality=2"}, "scenes/s.json: environment: --quality goes with a surface");
  refuse(3, {"environment.import=none.ovm"}, "scenes/s.json: environment: scenes/none.ovm: ");
}

#ifdef CELLWALK_TEST_MESHING
TEST_F(CentreLineRun, ASurfaceIsMeshedOnce) {
  write("scenes/tube.off", tube_off());
  const std::vector<std::string> arguments{
      "run",   "scenes/s.json",           "--set", R"(environment={"import": "tube.off", "cell_size": 0.4})",
      "--set", "catheter.from=[0,0,0.1]", "--set", "catheter.to=[0,0,3.9]",
      "-o"};
  std::vector<std::string> first = arguments, second = arguments;
  first.push_back("first");
  second.push_back("second");
  EXPECT_TRUE(contains(succeed(first), "meshed: "));
  EXPECT_TRUE(report("first")["catheter"]["arrived"]);
  const std::string said = succeed(second);
  EXPECT_TRUE(contains(said, "from the cache")) << said;
  EXPECT_FALSE(contains(said, "meshed: ")) << said;
  EXPECT_EQ(text("second/run.json"), text("first/run.json"));
}
#endif

}  // namespace
}  // namespace cellwalk::test
