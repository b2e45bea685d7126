// SPDX-License-Identifier: LGPL-3.0-or-later
// The log of long work (--log).
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class Log : public Program {
 protected:
  std::vector<json> lines(const std::string& name) const {
    std::istringstream in(text(name));
    std::vector<json> all;
    for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
    return all;
  }
};

TEST_F(Log, SaysWhereLongWorkIs) {
  succeed({"generate", "hexes", "--cells", "4", "-o", "env.ovm"});
  write("scene.json",
        R"({"environment": "env.ovm", "particles": [{"count": 2000, "speed": 0.9}], "steps": 2000})");
  succeed({"run", "scene.json", "-o", "out", "--log", "log", "--log-interval", "0.001"});
  const std::vector<json> all = lines("log");
  double done = 0;
  std::size_t during = 0;
  double seconds = 0;
  for (const json& line : all) {
    EXPECT_GT(line.at("memory_bytes"), 1'000'000);
    EXPECT_EQ(line.at("at").get<std::string>().size(), 20u);
    if (line.at("stage") != "running scene.json") continue;
    EXPECT_EQ(line.at("total"), 2000);
    EXPECT_GE(line.at("done"), done);
    EXPECT_GE(line.at("seconds"), seconds);
    done = line["done"];
    seconds = line["seconds"];
    if (done > 0) {
      EXPECT_NEAR(line.at("per_second").get<double>(), done / seconds, 1e-6 * done / seconds);
    }
    if (line.contains("ended")) continue;
    ++during;
    if (done > 0) {
      EXPECT_NEAR(line.at("seconds_left").get<double>(), (2000. - done) * seconds / done, 1e-3);
    }
  }
  EXPECT_EQ(done, 2000) << "the last line is of the end";
  EXPECT_GT(during, 2u);
  EXPECT_TRUE(all.back().at("ended"));
  EXPECT_TRUE(text("out/run.json").find("log") == std::string::npos) << "results do not depend on it";
}

TEST_F(Log, GoesOnWhereItWas) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm", "--log", "log"});
  const std::string first = text("log");
  EXPECT_FALSE(first.empty());
  write("moves.csv", "ax,ay,bx,by\n0.5,0.5,1.5,0.5\n");
  succeed({"query", "env.ovm", "moves.csv", "-o", "answers.csv", "--log", "log"});
  EXPECT_EQ(text("log").substr(0, first.size()), first);
  const std::vector<json> all = lines("log");
  EXPECT_EQ(all.back().at("stage"), "walking");
  EXPECT_EQ(all.back().at("done"), 1);
}

TEST_F(Log, OverwritesNothing) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  const std::string before = text("env.ovm");
  expect_failure(2, {"generate", "squares", "-o", "e.ovm", "--log", "env.ovm"},
                 {"env.ovm: exists and is no log"});
  EXPECT_EQ(text("env.ovm"), before);
}

TEST_F(Log, GoesOnAfterALineThatWasCut) {
  const auto generate = [this] {
    succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm", "--log", "log"});
  };
  generate();
  const std::string whole = text("log");
  for (const std::size_t length : {std::size_t{1}, std::size_t{4}, std::size_t{6}, whole.size() - 1}) {
    write("log", whole.substr(0, length));
    generate();
    const std::string both = text("log");
    EXPECT_TRUE(both.starts_with(whole.substr(0, length) + "\n{\"at\":")) << both;
  }
  write("log", "{\"a ");
  expect_failure(2, {"check", "env.ovm", "--log", "log"}, {"log: exists and is no log"});
}

TEST_F(Log, AnIntervalMayBeLong) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm", "--log", "log", "--log-interval", "1e6"});
  for (const json& line : lines("log")) EXPECT_TRUE(line.contains("ended"));
  expect_failure(2, {"check", "env.ovm", "--log", "log", "--log-interval", "1e12"},
                 {"takes a number from 0.001 to 1000000, not 1e12"});
}

TEST_F(Log, WorkGoesOnWithoutItsLog) {
  const Outcome outcome = run({"generate", "squares", "--cells", "2", "-o", "env.ovm", "--log", "/dev/full",
                               "--log-interval", "0.001"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "cellwalk: /dev/full: writing failed; the work goes on without a log\n");
  EXPECT_TRUE(exists("env.ovm"));
}

}  // namespace
}  // namespace cellwalk::test
