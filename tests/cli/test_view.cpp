// SPDX-License-Identifier: LGPL-3.0-or-later
// Pages of runs: what is refused, and what is in them. What they show is tested in tests/viewer.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

constexpr const char* scene =
    R"({"environment": {"generate": "hexes", "cells": 3}, "particles": [{"count": 5, "speed": 9}],
  "time_step": 0.1, "steps": 20, "output": {"frame_every": 0}})";

class View : public Program {
 protected:
  void make_run(const std::string& text = scene) {
    write("scene.json", text);
    succeed({"run", "scene.json", "-o", "out", "--force"});
  }
  void expect_refusal(const std::vector<std::string>& texts) {
    expect_failure(3, {"view", "out", "-o", "p.html"}, texts);
  }
};

TEST_F(View, RunsRecordTheirMotion) {
  const auto motion = [this] { return nlohmann::json::parse(text("out/run.json")).at("motion"); };
  make_run();
  EXPECT_EQ(motion(), (nlohmann::json{{"every", 1}, {"records", 21}}));
  std::string other = scene;
  other.replace(other.find("\"frame_every\": 0"), 16, "\"frame_every\": 0, \"motion_every\": 7");
  make_run(other);
  EXPECT_EQ(motion(), (nlohmann::json{{"every", 7}, {"records", 4}}));
  other.replace(other.find("_every\": 7"), 10, "_every\": 0");
  make_run(other);
  EXPECT_FALSE(exists("out/motion.gz"));
  EXPECT_FALSE(nlohmann::json::parse(text("out/run.json")).contains("motion"));
}

#ifdef CELLWALK_TEST_VIEWER

TEST_F(View, APageHoldsTheRunAndNothingElseIsWritten) {
  make_run();
  const std::string said = succeed({"view", "out", "-o", "p.html", "--json", "p.json"});
  EXPECT_NE(said.find("p.html: 21 records of 20 steps"), std::string::npos) << said;
  const auto report = nlohmann::json::parse(text("p.json"));
  EXPECT_EQ(report.at("bytes"), text("p.html").size());
  EXPECT_GT(report.at("contacts"), 10);
  EXPECT_EQ(files().size(), 7u);  // the scene, the run with its three files, the page and its report
  const std::string page = text("p.html");
  for (const char* mark : {"/*RUN*/", "/*CONTACTS*/", "/*MOTION*/", "/*SCRIPT*/", "/*STYLE*/"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
  succeed({"view", "out", "-o", "again.html"});
  EXPECT_EQ(text("again.html"), page);
}

TEST_F(View, RefusesWhatIsNoRun) {
  expect_refusal({"out: is no folder", "cellwalk run"});
  std::filesystem::create_directory(path("out"));
  expect_refusal({"out: holds no run.json"});
  expect_failure(2, {"view", "out"}, {"--output is required"});
  expect_failure(2, {"view"}, {"run is required"});
}

TEST_F(View, RefusesWhatIsDamagedOrMissing) {
  make_run();
  const std::string report = text("out/run.json"), motion = text("out/motion.gz"),
                    contacts = text("out/contacts.csv");
  const auto with = [&](const char* file, const std::string& content, const std::vector<std::string>& texts) {
    const std::string before = text(file);
    write(file, content);
    expect_refusal(texts);
    write(file, before);
  };
  with("out/run.json", report.substr(0, report.size() / 2),
       {"out/run.json: is damaged", "run the scene again"});
  with("out/run.json", "{}", {"out/run.json: is damaged"});
  const std::string deep = std::string(300000, '[') + std::string(300000, ']');
  with("out/run.json", "{\"deep\": " + deep + "," + report.substr(1),
       {"out/run.json: more than 64 lists and objects within each other"});
  with("out/motion.gz", motion.substr(0, motion.size() / 2),
       {"out/motion.gz: the gzip stream is damaged or cut short"});
  with("out/motion.gz", contacts, {"out/motion.gz: is no motion"});
  std::string other = report;
  other.replace(other.find("\"steps\": 20"), 11, "\"steps\": 21");
  with("out/run.json", other, {"out/motion.gz: belongs to another run"});
  with("out/contacts.csv", "step,x\n1,2\n", {"out/contacts.csv", "kind"});
  const std::string header = contacts.substr(0, contacts.find('\n') + 1);
  with("out/contacts.csv", header + "1,0,0.5,1,1,1,wall,0,0,1,0,,,,\n",
       {"out/contacts.csv:2: its kind is none"});
  with("out/contacts.csv", header + "1,0,0.5,1,x,1,facet,0,0,1,0,,,,\n", {"out/contacts.csv:2: "});
  with("out/contacts.csv", header + "21,0,0.5,1,1,1,facet,0,0,1,0,,,,\n", {"out/contacts.csv:2: its step"});
  succeed({"view", "out", "-o", "good.html"});
  std::filesystem::remove(path("out/motion.gz"));
  expect_refusal({"out/motion.gz: is missing", "motion_every"});
  write("out/motion.gz", motion);
  expect_failure(1, {"view", "out", "-o", "no/such/p.html"}, {"no/such/p.html: cannot be written"});
}

#else

TEST_F(View, SaysWhatIsMissingInThisBuild) {
  make_run();
  expect_failure(1, {"view", "out", "-o", "p.html"}, {"install Node.js", "-DCELLWALK_WITH_VIEWER=ON"});
}

#endif

}  // namespace
}  // namespace cellwalk::test
