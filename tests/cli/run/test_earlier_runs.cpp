// SPDX-License-Identifier: LGPL-3.0-or-later
// What an earlier process left of a run stays until there is something better, and is taken for what it is.
#include <csignal>
#include <string>
#include <vector>

#include "cli/run/stopped_boxes.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

class Earlier_runs : public Stopped_boxes {
 protected:
  void stop_at(std::int64_t step, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = begin(20);
    arguments.insert(arguments.end(), more.begin(), more.end());
    Stopped_boxes::stop_at(step, arguments);
  }
  /// Runs another scene to its end, with more frames.
  void run_another(const fs::path& folder) const {
    const Outcome another = run_program(
        {"run", "../scene.json", "-o", folder.string(), "--set", "time_step=0.03", "--steps", "200"},
        parts());
    ASSERT_EQ(another.exit_code, 0) << another.err;
  }
};

TEST_F(Earlier_runs, OneStaysWhereAForcedRunCannotBegin) {
  stop_at(40);
  const std::vector<std::string> names = names_below(part());
  const auto forced = [](const std::string& file, const std::string& change) {
    return std::vector<std::string>{"run", file,      "-o",    "out", "--checkpoint-every",
                                    "20",  "--force", "--set", change};
  };
  expect_refusal(forced("typo.json", "steps=4"), 3,
                 "typo.json: cannot be opened: check that it exists and may be read");
  // Changes are looked at when there are files already.
  expect_refusal(
      forced("../scene.json", R"(changes=[{"step":1,"open":"valve"}])"), 3,
      "../scene.json: changes[0].open: there is no such group: name it in \"groups\", or in the file "
      "of the environment");
  EXPECT_EQ(names_below(part()), names);
  expect_same(run_program(resume(), parts()));
}

TEST_F(Earlier_runs, OneIsBroughtBackWhereAForcedRunIsKilledAtOnce) {
  for (const bool has_both : {false, true}) {
    fs::remove_all(parts());
    fs::create_directory(parts());
    stop_at(40);
    fs::rename(part() / "checkpoints", part() / "checkpoints.before");
    if (has_both) {
      fs::rename(part() / "results", part() / "results.before");
      for (const char* name : {"checkpoints", "results"}) fs::create_directory(part() / name);
      write_text(part() / "results" / "contacts.csv", "step");
    }
    const Outcome refused = run_program(begin(20), parts());
    EXPECT_NE(refused.err.find("out.part: holds a run that did not end"), std::string::npos) << refused.err;
    expect_same(run_program(resume(), parts()));
  }
}

TEST_F(Earlier_runs, OneIsGoneOnceAForcedRunHasACheckpoint) {
  for (const char* folder : {"checkpoints", "results"}) fs::create_directories(part() / folder);
  write_text(part() / "lock", "");
  write_text(part() / "checkpoints" / "step-0000000001.checkpoint", "of another run");
  stop_at(40, {"--force"});
  for (const std::string& name : names_below(part()))
    EXPECT_EQ(name.find(".before"), std::string::npos) << name;
  fs::create_directory(part() / "results.before");  // it could not be removed
  expect_same(run_program(resume(), parts()));
}

TEST_F(Earlier_runs, ResultsWithoutCheckpointsStay) {
  stop_at(40);
  fs::rename(part() / "checkpoints", path("aside"));
  const std::vector<std::string> names = names_below(part());
  expect_refusal(
      resume(), 3,
      (fs::canonical(part()) / "checkpoints").string() + ": holds no checkpoint: begin the run again");
  EXPECT_EQ(names_below(part()), names);
  fs::rename(path("aside"), part() / "checkpoints");
  expect_same(run_program(resume(), parts()));
}

/// What a forced run leaves that is killed once it has replaced another one. Both folders are copies, as on
/// another machine.
TEST_F(Earlier_runs, TheResultsOfOneAreNotGoneOnWith) {
  stop_at(40, {"--force"});
  fs::remove_all(part() / "results");
  run_another("out.part/results");
  fs::copy(path("whole") / "out", out(), fs::copy_options::recursive);
  fs::copy(out() / "run.json", part() / "ended");
  const Outcome last = run_program(resume(), parts());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(last.out, "out: the run had ended, and its results are there\n");
  expect_same_files(parts(), path("whole"));
}

/// The same, if another one began after it, and could not go on.
TEST_F(Earlier_runs, NothingComesBackOfOneThatHasEnded) {
  stop_at(40, {"--force"});
  fs::remove_all(part() / "results");
  run_another("out.part/results");
  fs::copy(path("whole") / "out", out(), fs::copy_options::recursive);
  fs::copy(out() / "run.json", part() / "ended");
  const Outcome failed = run_program({"run", "../scene.json", "-o", "out", "--checkpoint-every", "20",
                                      "--force", "--set", R"(changes=[{"step":1,"open":"valve"}])"},
                                     parts());
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  expect_same_files(parts(), path("whole"));
}

/// It was killed before it replaced another run that had the same results.
TEST_F(Earlier_runs, TheSameResultsAreNotTakenForTheEnd) {
  stop_at(40, {"--force"});
  fs::copy(path("whole") / "out" / "run.json", part() / "ended");
  fs::copy(path("whole") / "out" / "run.json", part() / "results" / "run.json");
  fs::copy(path("whole") / "out", out(), fs::copy_options::recursive);
  fs::remove(out() / "contacts.csv");
  expect_same(run_program(resume(), parts()));
}

TEST_F(Earlier_runs, ACopyOfAForcedRunReplacesNone) {
  run_another("copy");
  const std::string before = read_text(parts() / "copy" / "run.json");
  run_another("out");
  stop_at(40, {"--force"});
  fs::copy(part(), parts() / "copy.part", fs::copy_options::recursive);
  expect_refusal(
      {"run", "--resume", "copy"}, 2,
      "copy: is there, and this run is not to replace it: move it away, and go on by `cellwalk run "
      "--resume copy`");
  EXPECT_EQ(read_text(parts() / "copy" / "run.json"), before);
  for (const char* name : {"copy", "copy.part"}) fs::remove_all(parts() / name);
  expect_same(run_program(resume(), parts()));
}

TEST_F(Earlier_runs, FramesThatWereChangedAreNoticed) {
  stop_at(100);
  ASSERT_TRUE(fs::exists(part() / "results" / "frames" / "bodies_00002.vtu"));
  for (const char* name :
       {"frames/bodies_00000.vtu", "frames/bodies_00002.vtu", "frames/contacts_00001.vtu", "walls.vtu"}) {
    const fs::path file = part() / "results" / name;
    const std::string where = (fs::canonical(part()) / "results" / name).string();
    fs::rename(file, path("aside"));
    expect_refusal(resume(), 3, where + ": is missing, and was there at the checkpoint: begin the run again");
    fs::copy(path("aside"), file);
    fs::resize_file(file, 10);
    expect_refusal(resume(), 3, where + ": has another length than at the checkpoint: it was changed");
    fs::rename(path("aside"), file);
  }
  // Also by the next process but one.
  const auto resumed = stop_program(resume(), parts(), SIGKILL, [&] { return newest_step(parts()) >= 120; });
  if (resumed.exit_code == -1) {
    const fs::path file = part() / "results" / "frames" / "bodies_00001.vtu";
    fs::rename(file, path("aside"));
    EXPECT_EQ(run_program(resume(), parts()).exit_code, 3);
    fs::rename(path("aside"), file);
    expect_same(run_program(resume(), parts()));
  } else {
    expect_same(resumed);
  }
}

TEST_F(Earlier_runs, MessagesNameTheFolder) {
  const std::string none =
      ": is no folder of a run that did not end: only one with --checkpoint-every leaves it";
  for (const char* name : {"out", "out/", "out//"})
    expect_refusal({"run", "--resume", name}, 2, "out.part" + none);
  const std::string here = fs::canonical(parts()).string() + ".part";
  for (const char* name : {".", "./", "../parts/."})
    expect_refusal({"run", "--resume", name}, 2, here + none);
}

}  // namespace
}  // namespace cellwalk::test
