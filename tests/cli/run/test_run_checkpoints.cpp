// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run --checkpoint-every and --resume: what is left where, what is refused, and what goes wrong.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/run/stopped_run.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

/// Bodies and particles among walls that beat.
constexpr const char* kept_scene = R"({
  "environment": {"generate": "tets", "cells": [3, 3, 3]},
  "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 6, "seed": 3, "speed": 4}],
  "particles": [{"count": 20, "seed": 4, "speed": 3}],
  "walls": {"pulsation": {"amplitude": 0.02, "period": 0.4}},
  "time_step": 0.02, "steps": 160, "output": {"frame_every": 10, "picture": {"width": 160, "height": 120}}
})";

class Checkpoints : public Stopped_run {
 protected:
  void SetUp() override {
    fs::create_directory(path("whole"));
    fs::create_directory(path("parts"));
    write("scene.json", kept_scene);
    run_whole({"../scene.json"});
  }
  /// Begins the run and stops it once it has come to a step.
  void stop_at(std::int64_t step, int signal = SIGKILL) const {
    const Outcome stopped =
        stop_program(begin(20), parts(), signal, [&] { return newest_step(parts()) >= step; });
    ASSERT_EQ(stopped.exit_code, -1) << "it ended before: " << stopped.err;
    ASSERT_EQ(stopped.out + stopped.err, "");
    ASSERT_TRUE(fs::is_directory(part()));
  }
  fs::path part() const { return parts() / "out.part"; }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(part() / "checkpoints"))
      if (entry.path().extension() == ".checkpoint") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  Outcome go_on(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = resume();
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, parts());
  }
  /// It is refused in one line, and may go on later.
  void expect_refusal(int exit_code, const std::vector<std::string>& more, const std::string& message) const {
    const Outcome refused = go_on(more);
    EXPECT_EQ(refused.exit_code, exit_code);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(refused.err, "cellwalk: " + message + "\n");
  }
};

TEST_F(Checkpoints, AreGoneWhenTheRunHasEnded) {
  expect_same(run_program(begin(20), parts()));
  expect_same(
      run_program({"run", "../scene.json", "-o", "out", "--force", "--checkpoint-every", "160"}, parts()));
}

TEST_F(Checkpoints, TheLastTwoAreKept) {
  stop_at(60);
  EXPECT_GE(kept().size(), 2u);
  EXPECT_LE(kept().size(), 3u);  // it may have been killed before it removed the oldest
  expect_same(go_on());
}

TEST_F(Checkpoints, ASignalMakesOne) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove_all(parts());
    fs::create_directory(parts());
    stop_at(40, signal);
    expect_same(go_on({"--checkpoint-every", "1000"}));
  }
}

TEST_F(Checkpoints, ADamagedOneIsPassedOver) {
  stop_at(60);
  const fs::path newest = kept().back();
  std::string bytes = read_text(newest);
  bytes[bytes.size() / 2] ^= 1;
  write_text(newest, bytes);
  Outcome last = go_on();
  EXPECT_EQ(last.err,
            "cellwalk: " + newest.string() + ": its checksum differs; going on from the checkpoint before\n");
  last.err.clear();
  expect_same(last);
}

TEST_F(Checkpoints, WhatALossOfPowerLeavesIsNoMatter) {
  stop_at(60);
  // A checkpoint that was not renamed; one that was, without its content; tails of files; half a frame.
  write_text(part() / "checkpoints" / "step-0000000099.checkpoint.tmp", "half");
  write_text(part() / "checkpoints" / "step-0000000299.checkpoint", "");
  write_text(part() / "results" / "frames" / ".bodies_00030.vtu.1.0.tmp", "half");
  for (const char* name : {"results/contacts.csv", "results/walls.csv", "checkpoints/motion.gz.content"})
    write_text(part() / name, read_text(part() / name) + std::string(1000, '\0'));
  Outcome last = go_on();
  EXPECT_EQ(last.err, "cellwalk: " + (part() / "checkpoints" / "step-0000000299.checkpoint").string() +
                          ": it is cut short; going on from the checkpoint before\n");
  last.err.clear();
  expect_same(last);
}

TEST_F(Checkpoints, SayThatNoneIsLeft) {
  stop_at(60);
  for (const fs::path& file : kept()) write_text(file, "");
  expect_refusal(
      3, {},
      kept().back().string() + ": it is cut short, and there is no other checkpoint: begin the run again");
  for (const fs::path& file : kept()) fs::remove(file);
  expect_refusal(3, {}, (part() / "checkpoints").string() + ": holds no checkpoint: begin the run again");
  // What holds none is of no use, and not in the way.
  expect_same(run_program(begin(50), parts()));
}

TEST_F(Checkpoints, FilesThatWereCutShortAreNoticed) {
  stop_at(60);
  const fs::path table = part() / "results" / "walls.csv";
  const std::string whole = read_text(table);
  write_text(table, "step\n");
  expect_refusal(
      3, {}, fs::canonical(table).string() + ": is shorter than it was at the checkpoint: it was changed");
  write_text(table, whole);
  expect_same(go_on());
}

TEST_F(Checkpoints, AnotherRunDoesNotGoOn) {
  stop_at(40);
  const auto message = [](const char* what) {
    return std::string("out: this run began with ") + what + ": leave that out, or begin another run";
  };
  write("other.json", R"({"environment": {"generate": "hexes"}, "particles": [{"count": 1}], "steps": 9})");
  expect_refusal(2, {"../other.json"}, message("another scene"));
  expect_refusal(2, {"../scene.json", "--set", "time_step=0.01"}, message("another scene"));
  expect_refusal(2, {"--steps", "159"}, message("another number of --steps"));
  expect_refusal(2, {"--sweep", "faces"}, message("another --sweep"));
  expect_refusal(2, {"--record", "trace"}, message("another --record"));
  expect_refusal(2, {"--json", "report.json"}, message("another --json"));
  expect_refusal(2, {"-o", "out"}, "--output excludes --resume; see cellwalk run --help");
  expect_refusal(2, {"--force"}, "--force excludes --resume; see cellwalk run --help");
  // The scene may be gone, or another one now: the run goes on with that with which it began.
  write("same.json", kept_scene);
  write("scene.json", "{}");
  expect_same(go_on({"../same.json", "--steps", "160", "--sweep", "triangle", "--threads", "1"}));
}

TEST_F(Checkpoints, ANewRunDoesNotReplaceThemUnasked) {
  stop_at(40);
  const Outcome refused = run_program(begin(20), parts());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(
      refused.err,
      "cellwalk: out.part: holds a run that did not end: go on with it by `cellwalk run --resume out`, or "
      "remove it\n");
  std::vector<std::string> forced = begin(50);
  forced.push_back("--force");
  expect_same(run_program(forced, parts()));
}

TEST_F(Checkpoints, OneProcessUsesThem) {
  stop_at(40);
  const int lock = open((part() / "lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  expect_refusal(2, {}, "out.part: another process runs there: wait until it ends");
  close(lock);
  expect_same(go_on());
}

TEST_F(Checkpoints, AFullDeviceLeavesTheLastOne) {
  stop_at(40);
  // The recording of the motion, which grows, does not fit any more.
  const std::size_t most = fs::file_size(part() / "checkpoints" / "motion.gz.content") + 20000;
  const Outcome full = stop_program(
      resume(), parts(), SIGKILL, [] { return false; }, most);
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(full.out, "");
  EXPECT_TRUE(full.err.ends_with(": writing failed (File too large)\n")) << full.err;
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1);
  EXPECT_FALSE(fs::exists(parts() / "out"));
  expect_same(go_on());
}

TEST_F(Checkpoints, ARunThatHadEndedSaysSo) {
  stop_at(40);
  fs::copy(part(), path("copy"), fs::copy_options::recursive);
  expect_same(go_on());
  // As if it had been killed before its checkpoints were removed.
  fs::rename(path("copy"), part());
  fs::remove_all(part() / "results");
  fs::copy(parts() / "out" / "run.json", part() / "ended");
  for (int k = 0; k < 2; ++k) {
    const Outcome again = go_on();
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, "out: the run had ended, and its results are there\n");
    expect_same_files(parts(), path("whole"));
  }
}

TEST_F(Checkpoints, ARunThatDoesNotBeginLeavesNothing) {
  write("bad.json",
        R"({"environment": {"generate": "hexes"}, "particles": [{"position": [99, 0, 0]}], "steps": 9})");
  expect_failure(5, {"run", "bad.json", "-o", "bad", "--checkpoint-every", "5"}, {"particles[0].position"});
  expect_failure(2, {"run", "--resume", "nothing"}, {"nothing.part: is no folder of a run that did not end"});
  expect_failure(2, {"run", "scene.json"}, {"--output is required"});
  expect_failure(2, {"run", "scene.json", "-o", "o", "--checkpoint-every", "0"},
                 {"from 1 to 100000000, not 0"});
}

}  // namespace
}  // namespace cellwalk::test
