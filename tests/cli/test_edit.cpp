// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of facets and cells among bodies, as `cellwalk edit` makes, reports and refuses them.
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;

const Row header{"step", "change", "kind", "status",   "cell",    "facet",  "x",
                 "y",    "z",      "body", "particle", "feature", "number", "reason"};

class Edit : public Program {
 protected:
  /// Makes the changes in env.ovm, expects that what is written is certified as reported, and returns the
  /// rows of the report.
  std::vector<Row> edit(const std::string& changes, const std::vector<std::string>& options = {}) const {
    write("changes.json", changes);
    std::vector<std::string> all{"edit",     "env.ovm",    "changes.json", "-o",         "out.ovm",
                                 "--report", "report.csv", "--json",       "report.json"};
    all.insert(all.end(), options.begin(), options.end());
    said_ = succeed(all);
    report_ = json::parse(text("report.json"));
    succeed({"check", "out.ovm", "--json", "check.json"});
    expect_same_certificate(path("report.json"), path("check.json"));
    std::vector<Row> rows = read_table(path("report.csv"));
    EXPECT_EQ(rows.at(0), header);
    rows.erase(rows.begin());
    return rows;
  }

  mutable std::string said_;  // by the last command
  mutable json report_;
};

constexpr const char* close_door =
    R"({"groups": {"door": {"plane": [[2, 0], [1, 0]]}}, "changes": [{"close": "door"}]})";

TEST_F(Edit, ClosesADoorRoundARod) {
  succeed({"generate", "squares", "--cells", "4", "3", "-o", "env.ovm"});
  write("rod.csv", "x,y\n1.5,1.5\n2.5,1.5\n");
  write("rod.obj", "v 1.5 1.5 0\nv 2.5 1.5 0\nl 1 2\n");
  const auto rows = edit(close_door, {"--body", "rod.obj"});
  ASSERT_EQ(rows.size(), 3u);
  std::size_t made = 0;
  for (const Row& row : rows) {
    EXPECT_EQ(row[0], "") << "no step";
    EXPECT_EQ(row[1], "0");
    EXPECT_EQ(row[2], "close");
    EXPECT_EQ(row[6], "2");
    EXPECT_EQ(row[8], "") << "no third coordinate";
    if (row[3] == "made") {
      ++made;
      EXPECT_EQ(row[13], "");
      continue;
    }
    EXPECT_EQ(row[3], "refused");
    EXPECT_EQ(row[7], "1.5");
    EXPECT_EQ(row[9], "0");
    EXPECT_EQ(row[11], "edge");
    EXPECT_EQ(row[12], "0");
    EXPECT_NE(row[13], "");
  }
  EXPECT_EQ(made, 2u);
  EXPECT_EQ(report_["changes"]["closed"], 2);
  EXPECT_EQ(report_["changes"]["refusals"], 1);
  EXPECT_EQ(report_["changes"]["left"], 1);
  EXPECT_EQ(report_["bodies"]["vertices"], 2);
  EXPECT_EQ(report_["certificate"]["membranes"], 2);
  EXPECT_NE(said_.find("2 facets closed; 1 refused, 1 of them to the end"), std::string::npos) << said_;
  // Without the rod the whole door closes, and the free space falls apart.
  EXPECT_EQ(edit(close_door).size(), 3u);
  EXPECT_EQ(report_["certificate"]["components"], 2);
}

TEST_F(Edit, OpensWhatItClosed) {
  succeed({"generate", "squares", "--cells", "4", "3", "-o", "env.ovm"});
  edit(
      R"({"groups": {"door": {"plane": [[2, 0], [1, 0]]}}, 
    "changes": [{"close": "door"}, {"open": "door"}]})");
  EXPECT_EQ(report_["changes"]["closed"], 3);
  EXPECT_EQ(report_["changes"]["opened"], 3);
  EXPECT_EQ(text("out.ovm"), text("env.ovm"));
}

TEST_F(Edit, ExcavatesAndFillsInSpace) {
  succeed({"generate", "hexes", "--cells", "5", "--solid", "0.05", "-o", "env.ovm"});
  write("all.json", "");
  const auto rows = edit(R"({"changes": [{"excavate": {"box": [[0, 0, 0], [5, 5, 5]]}},
                                         {"fill": {"ball": [[2.5, 2.5, 2.5], 0.5]}}]})");
  EXPECT_EQ(report_["certificate"]["solid_cells"], 1);
  EXPECT_EQ(report_["changes"]["filled"], 1);
  EXPECT_EQ(rows.size(), report_["changes"]["excavated"].get<std::size_t>() + 1);
  EXPECT_EQ(rows.back()[2], "fill");
  EXPECT_EQ(rows.back()[5], "") << "no facet";
  EXPECT_EQ(rows.back()[8], "2.5");
}

TEST_F(Edit, RefusesToFillACellInWhichABodyLies) {
  succeed({"generate", "hexes", "--cells", "3", "-o", "env.ovm"});
  write("body.off", "OFF 3 1 0\n1.25 1.25 1.25\n1.75 1.25 1.25\n1.25 1.75 1.25\n3 0 1 2\n");
  const auto rows =
      edit(R"({"changes": [{"fill": {"ball": [[1.5, 1.5, 1.5], 0.5]}}]})", {"--body", "body.off"});
  ASSERT_GE(rows.size(), 3u) << "at least its vertices";
  for (const Row& row : rows) EXPECT_EQ(row[3], "refused");
  EXPECT_EQ(report_["certificate"]["solid_cells"], 0);
}

TEST_F(Edit, CutsAndSewsUp) {
  succeed({"generate", "triangles", "--cells", "8", "-o", "env.ovm"});
  const std::string cut = R"({"fill": {"box": [[0, 0], [8, 4]]}}, {"cut": {"blade": [[4.1, 5], [4.3, 1]]}})";
  // The last cell far from the cut has a name, which outlives gaps in the numbers before it.
  const std::string plain = text("env.ovm");
  std::string last;
  for (int i = 1; i < 128; ++i) last += "0 ";
  write("env.ovm", plain + "FProp bool \"group last\"\n" + last + "1\n");
  edit(R"({"changes": [)" + cut + "]}");
  EXPECT_GT(report_["certificate"]["free_volume"], 32.001) << "the gap";
  const auto rows = edit(R"({"changes": [)" + cut + R"(, {"sew": {"box": [[0, 0], [8, 8]]}}]})");
  const std::size_t sewn = report_["changes"]["sewn"];
  EXPECT_GE(sewn, 3u);
  ASSERT_GT(rows.size(), sewn);
  for (std::size_t i = rows.size() - sewn; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][2], "sew");
    EXPECT_EQ(rows[i][3], "made");
    EXPECT_EQ(rows[i][4], "");
    EXPECT_NEAR(std::stod(rows[i][6]), 4.2, 0.7) << "where it is";
  }
  EXPECT_EQ(report_["changes"]["left"], 0);
  EXPECT_NEAR(report_["certificate"]["free_volume"].get<double>(), 32, 1e-9);
  std::filesystem::rename(path("out.ovm"), path("env.ovm"));
  const auto named = edit(R"({"changes": [{"fill": "last"}]})");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_GT(std::stod(named[0][6]), 7);
  EXPECT_GT(std::stod(named[0][7]), 7);
}

/// The edges of a 2D .ovm file whose ends have the same first coordinate, as flags.
std::string edges_at(const std::string& ovm, const std::string& x) {
  std::istringstream in(ovm);
  std::string word;
  std::vector<std::string> first;
  std::size_t count = 0;
  while (in >> word && word != "Vertices") {
  }
  in >> count;
  for (std::size_t i = 0; i < count; ++i) {
    std::string y, z;
    in >> first.emplace_back() >> y >> z;
  }
  in >> word >> count;
  std::string flags;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t u = 0, v = 0;
    in >> u >> v;
    flags += first.at(u) == x && first.at(v) == x ? " 1" : " 0";
  }
  return flags + "\n";
}

TEST_F(Edit, ChangesGroupsOfTheFileAndKeepsThem) {
  succeed({"generate", "squares", "--cells", "4", "3", "-o", "env.ovm"});
  const std::string plain = text("env.ovm");
  write("env.ovm", plain + "EProp bool \"group door\"\n" + edges_at(plain, "2") +
                       "FProp bool \"group plug\"\n1 1 0 0 0 0 0 0 0 0 0 0\n");
  auto rows = edit(R"({"changes": [{"close": "door"}, {"fill": "plug"}]})");
  ASSERT_EQ(rows.size(), 5u);
  for (const Row& row : rows) EXPECT_EQ(row[3], "made");
  EXPECT_EQ(report_["certificate"]["solid_cells"], 2);
  // The environment written has them, too; so has that which `import` and `deform` write.
  succeed({"import", "out.ovm", "-o", "env.ovm"});
  rows = edit(R"({"changes": [{"excavate": "plug"}, {"open": "door"}]})");
  EXPECT_EQ(rows.size(), 2u + 2u) << "one facet of the door opens as its cell becomes free";
  EXPECT_EQ(report_["certificate"]["solid_cells"], 0);
  EXPECT_EQ(report_["certificate"]["membranes"], 0);
  succeed({"import", "out.ovm", "--simplicial", "-o", "env.ovm"});
  rows = edit(R"({"changes": [{"close": "door"}, {"fill": "plug"}]})");
  EXPECT_EQ(rows.size(), 3u + 4u) << "a square is two triangles";
  write("moves.csv", "point,x,y\n0,0,0.125\n");
  succeed({"deform", "out.ovm", "moves.csv", "-o", "env.ovm"});
  EXPECT_EQ(edit(R"({"changes": [{"excavate": "plug"}]})").size(), 4u);
  // A scene has them as well.
  write("s.json",
        R"({"dimension": 2, "environment": "env.ovm", "particles": [{"position": [3.5, 2.5]}],
                      "steps": 2, "changes": [{"step": 1, "open": "door"}]})");
  succeed({"run", "s.json", "-o", "out"});
  EXPECT_EQ(read_table(path("out/changes.csv")).size(), 1u + 2u);
  // A group twice, and one that nobody has.
  const auto refuse = [&](const std::string& changes, const std::string& said) {
    write("changes.json", changes);
    expect_failure(3, {"edit", "env.ovm", "changes.json", "-o", "other.ovm"}, {said});
  };
  refuse(R"({"groups": {"door": {"plane": [[2, 0], [1, 0]]}}, "changes": [{"close": "door"}]})",
         "changes.json: groups.door: the file of the environment has a group of that name: rename one");
  refuse(R"({"changes": [{"close": "gate"}]})",
         "changes.json: changes[0].close: there is no such group: name it in \"groups\", or in the file of");
}

TEST_F(Edit, RefusesWhatIsWrongAndWritesNothing) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  const auto refuse = [&](int code, const std::string& changes, const std::vector<std::string>& said) {
    write("changes.json", changes);
    expect_failure(code, {"edit", "env.ovm", "changes.json", "-o", "out.ovm"}, said);
    EXPECT_FALSE(exists("out.ovm"));
  };
  refuse(3, "{", {"changes.json:1:"});
  refuse(3, R"({"changes": [{"close": "door"}]})",
         {"changes.json: changes[0].close: there is no such group"});
  refuse(3, R"({"changes": [{"close": {"ball": [[9, 9], 1]}}]})",
         {"changes.json: changes[0].close: no facet between two cells of the environment lies there"});
  refuse(3, R"({"changes": [{"sew": {"ball": [[1, 1], 1]}}]})",
         {"changes.json: changes[0].sew: no cut comes before it: cut first, or let it last"});
}

/// Before anything is changed, also by changes that come first.
TEST_F(Edit, RefusesBladesThatAreNone) {
  succeed({"generate", "tets", "--cells", "2", "-o", "env.ovm"});
  const auto refuse = [&](const std::string& blade, const std::string& said) {
    write("changes.json", R"({"changes": [{"fill": {"box": [[-9, -9, -9], [9, 9, 9]]}}, {"cut": {"blade": )" +
                              blade + "}}]}");
    expect_failure(3, {"edit", "env.ovm", "changes.json", "-o", "out.ovm"},
                   {"changes.json: changes[1].cut: " + said});
    EXPECT_FALSE(exists("out.ovm"));
  };
  refuse("[[0, 0.3, 0], [2, 0.3, 2], [2, 0.3, 0], [0, 0.3, 2]]", "the blade is not convex at corner");
  refuse("[[0, 0.3, 0], [2, 0.3, 0], [2, 0.3, 2], [0, 1.7, 2]]", "corner 1 of the blade lies off the plane");
  refuse("[[0, 0.3, 0], [2, 0.3, 2], [1, 0.3, 1]]", "the corners of the blade lie in line");
  refuse("[[0, 0.3, 0], [2, 0.3, 2]], \"sweep\": [1, 0, 1]", "a piece of the blade has no extent");
}

}  // namespace
}  // namespace cellwalk::test
