// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using Generate = Program;

/// One small environment of every kind.
const std::vector<std::vector<std::string>> kinds = {
    {"hexes", "--cells", "6", "--solid", "0.05"},
    {"tets", "--cells", "3", "--jitter", "0.1"},
    {"lattice", "--cells", "3"},
    {"vessel", "--generations", "1"},
    {"tube", "--cell-size", "0.5"},
    {"room2d", "--rooms", "2", "1"},
    {"squares", "--cells", "9", "7", "--solid", "0.1"},
    {"triangles", "--cells", "5", "--jitter", "0.15"},
    {"lattice2d", "--cells", "6"},
};

std::vector<std::string> with_output(std::vector<std::string> kind, const std::string& output) {
  kind.insert(kind.begin(), "generate");
  kind.insert(kind.end(), {"-o", output});
  return kind;
}

TEST_F(Generate, EveryKindIsCertifiedAndTheSameEveryTime) {
  for (const auto& kind : kinds) {
    SCOPED_TRACE(kind[0]);
    const std::string said = succeed(with_output(kind, "env.ovm"));
    const std::string bytes = text("env.ovm");
    EXPECT_EQ(succeed({"check", "env.ovm"}), said) << "check finds what generate said";
    succeed(with_output(kind, "env.ovm"));
    EXPECT_EQ(text("env.ovm"), bytes);
  }
}

TEST_F(Generate, HelpNamesEveryKindTestedHere) {
  const std::string help = succeed({"generate", "--help"});
  const std::size_t begin = help.find("Subcommands:");
  const std::string list = help.substr(begin, help.find("\n\n", begin) - begin);
  std::size_t listed = 0;
  for (std::size_t at = list.find("\n  "); at != std::string::npos; at = list.find("\n  ", at + 1))
    listed += list[at + 3] != ' ';
  EXPECT_EQ(listed, kinds.size()) << list;
  for (const auto& kind : kinds) EXPECT_NE(list.find("\n  " + kind[0] + " "), std::string::npos) << list;
}

TEST_F(Generate, VesselsLieInTissueOnRequest) {
  succeed(with_output(
      {"vessel", "--generations", "0", "--length", "3", "--tissue", "0.5", "--json", "in.json"}, "env.ovm"));
  succeed(with_output({"vessel", "--generations", "0", "--length", "3", "--json", "alone.json"}, "env.ovm"));
  const auto in = nlohmann::json::parse(text("in.json"))["certificate"],
             alone = nlohmann::json::parse(text("alone.json"))["certificate"];
  EXPECT_EQ(in["cells"].get<int>() - in["solid_cells"].get<int>(), alone["cells"].get<int>());
  EXPECT_GT(in["solid_cells"].get<int>(), 1000);
  EXPECT_NEAR(in["free_volume"].get<double>(), alone["volume"].get<double>(), 1e-6);
  expect_failure(2, with_output({"vessel", "--tissue", "0.1"}, "x.ovm"), {"tissue", "1.25 cell sizes"});
  expect_failure(2, with_output({"tube", "--tissue", "nan"}, "x.ovm"), {"tissue", "finite"});
}

TEST_F(Generate, TheSeedDecides) {
  succeed({"generate", "hexes", "--cells", "8", "--solid", "0.05", "--seed", "1", "-o", "a.ovm"});
  succeed({"generate", "hexes", "--cells", "8", "--solid", "0.05", "--seed", "2", "-o", "b.ovm"});
  EXPECT_NE(text("a.ovm"), text("b.ovm"));
}

TEST_F(Generate, LatticesCanBePlacedAndScaled) {
  for (const char* placement : {"--rotated", "--sheared"}) {
    succeed({"generate", "lattice", "--cells", "3", placement, "--scale", "0.125", "-o", "env.ovm"});
    succeed({"check", "env.ovm"});
  }
}

TEST_F(Generate, SlitsNeedTheirVerticesKept) {
  for (const char* kind : {"lattice", "lattice2d"}) {
    const std::string said = succeed({"generate", kind, "--cells", "5", "--slits", "0.1", "-o", "env.ovm"});
    const std::string checked = succeed({"check", "env.ovm", "--duplicates", "keep"});
    EXPECT_TRUE(checked.starts_with(said)) << checked;
    EXPECT_NE(checked.find("noted       ", said.size()), std::string::npos) << "the slits";
    expect_failure(4, {"check", "env.ovm"}, {"in the same place", "keep"});
  }
}

TEST_F(Generate, RefusesWhatCannotBeMade) {
  const auto refuse = [this](std::vector<std::string> kind, const std::vector<std::string>& texts) {
    expect_failure(2, with_output(std::move(kind), "env.ovm"), texts);
  };
  refuse({"hexes", "--solid", "0.9"}, {"solid"});
  refuse({"hexes", "--cells", "0"}, {"0"});
  refuse({"hexes", "--cells", "4", "3"}, {"cells takes 1 or 3 numbers, not 2"});
  refuse({"hexes", "--cells", "2.5"}, {"cells", "2.5"});
  refuse({"hexes", "--cells", "many"}, {"many"});
  refuse({"tets", "--jitter", "0.5"}, {"jitter"});
  refuse({"hexes", "--rotated", "--sheared"}, {"rotated"});
  refuse({"spheres"}, {"spheres"});
  expect_failure(2, {"generate", "hexes"}, {"--output is required"});
  expect_failure(2, {"generate", "hexes", "-o", "env.vtu"}, {"*.ovm", "env.vtu"});
}

TEST_F(Generate, AnUnwritableFolderEndsWith1) {
  expect_failure(1, {"generate", "squares", "-o", "nowhere/env.ovm"}, {"nowhere"});
}

TEST_F(Generate, AnInterruptedRunLeavesNoPartialFile) {
  write("env.ovm", "older\n");
  int survived = 0;
  for (const int milliseconds : {5, 20, 80, 160, 320}) {
    interrupt_program({"generate", "hexes", "--cells", "40", "-o", "env.ovm"}, path("").parent_path(),
                      milliseconds);
    EXPECT_EQ(files(), std::vector<std::string>{"env.ovm"});
    if (text("env.ovm") == "older\n") {
      ++survived;
    } else {
      succeed({"check", "env.ovm"});
      write("env.ovm", "older\n");
    }
  }
  EXPECT_GT(survived, 0) << "no run was interrupted before it ended";
}

}  // namespace
}  // namespace cellwalk::test
