// SPDX-License-Identifier: LGPL-3.0-or-later
// The folders of cellwalk run: what others put there stays, whatever this run or another one does.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/run/stopped_boxes.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

class Run_folders : public Stopped_boxes {
 protected:
  static std::vector<std::string> with(std::vector<std::string> arguments, const char* more) {
    arguments.emplace_back(more);
    return arguments;
  }
  std::vector<std::string> plain() const { return {"run", "../scene.json", "-o", "out"}; }

  /// Runs it, and makes the destination once it is time.
  Outcome run_with_another(const std::vector<std::string>& arguments,
                           const std::function<bool()>& is_time) const {
    return stop_program(arguments, parts(), SIGKILL, [&] {
      if (!fs::exists(out()) && is_time()) make_precious(out());
      return false;
    });
  }
  static void make_precious(const fs::path& folder) {
    fs::create_directories(folder);
    write_text(folder / "thesis.txt", "mine");
  }
  static void expect_precious(const fs::path& folder) {
    EXPECT_EQ(names_below(folder), std::vector<std::string>{"thesis.txt"});
    EXPECT_EQ(read_text(folder / "thesis.txt"), "mine");
  }
  std::vector<fs::path> beside(const std::string& prefix) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(parts()))
      if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
    return found;
  }
};

TEST_F(Run_folders, ARefusedRunLeavesThatOfTheOther) {
  for (const char* folder : {"results", "checkpoints"}) fs::create_directories(part() / folder);
  write_text(part() / "results" / "contacts.csv", "step\n");
  const int lock = open((part() / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  for (const auto& arguments : {begin(20), with(begin(20), "--force"), resume()}) {
    expect_refusal(arguments, 2, "out.part: another process runs there: wait until it ends");
    EXPECT_EQ(names_below(part()),
              (std::vector<std::string>{"checkpoints", "lock", "results", "results/contacts.csv"}));
  }
  close(lock);
  expect_same(run_program(begin(20), parts()));
}

TEST_F(Run_folders, WhatAppearsMeanwhileStays) {
  for (const auto& arguments : {plain(), with(plain(), "--force")}) {
    const Outcome last = run_with_another(arguments, [this] { return !beside("out.tmp-").empty(); });
    EXPECT_EQ(last.exit_code, 1);
    EXPECT_EQ(last.out, "");
    expect_precious(out());
    const std::vector<fs::path> kept = beside("out.ended-");
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(last.err,
              "cellwalk: out: was made by another program while this one ran, and stays; the results "
              "are in " +
                  fs::canonical(kept[0]).string() + "\n");
    EXPECT_TRUE(beside("out.tmp-").empty());
    expect_same_files(kept[0], path("whole") / "out");
    fs::remove_all(kept[0]);
    fs::remove_all(out());
  }
}

TEST_F(Run_folders, WhatAppearsMeanwhileStaysWithCheckpoints) {
  const std::string message =
      "out: is there, and this run is not to replace it: move it away, and go on by `cellwalk run --resume "
      "out`";
  const Outcome last = run_with_another(begin(20), [this] { return newest_step(parts()) >= 20; });
  EXPECT_EQ(last.exit_code, 1);
  EXPECT_EQ(last.err, "cellwalk: " + message + "\n");
  expect_precious(out());
  expect_refusal(resume(), 2, message);
  expect_precious(out());
  fs::remove_all(out());
  expect_same(run_program(resume(), parts()));
}

TEST_F(Run_folders, ResultsOfAnotherRunStay) {
  stop_at(40, begin(20));
  ASSERT_EQ(run_program({"run", "../scene.json", "-o", "out", "--steps", "3"}, parts()).exit_code, 0);
  const std::string before = read_text(out() / "run.json");
  expect_refusal(resume(), 2,
                 "out: is there, and this run is not to replace it: move it away, and go on by `cellwalk run "
                 "--resume out`");
  EXPECT_EQ(read_text(out() / "run.json"), before);
  fs::remove_all(out());
  expect_same(run_program(resume(), parts()));
}

TEST_F(Run_folders, AForcedRunThatWasStoppedReplacesThem) {
  ASSERT_EQ(run_program({"run", "../scene.json", "-o", "out", "--steps", "3"}, parts()).exit_code, 0);
  stop_at(40, with(begin(20), "--force"));
  expect_same(run_program(resume(), parts()));
}

TEST_F(Run_folders, AForcedRunReplacesNothingThatNoRunWrites) {
  ASSERT_EQ(run_program(plain(), parts()).exit_code, 0);
  for (const char* name : {"notes.txt", "frames/notes.txt"}) {
    write_text(out() / name, "mine");
    for (const auto& arguments : {with(plain(), "--force"), with(begin(20), "--force")})
      expect_refusal(
          arguments, 2,
          std::string("out: holds out/") + name +
              ", which no run writes, and would be replaced; move it away, or give another folder");
    EXPECT_EQ(read_text(out() / name), "mine");
    fs::remove(out() / name);
  }
  fs::remove_all(out());
  fs::create_symlink("nowhere", out());
  expect_refusal(plain(), 2, "out: exists already; give another folder, or --force to replace it");
}

TEST_F(Run_folders, AFolderThatNoRunMadeStays) {
  for (const char* folder : {"results", "checkpoints"}) fs::create_directories(part() / folder);
  write_text(part() / "checkpoints" / "model.bin", "mine");
  const auto names = names_below(part());
  for (const auto& arguments : {begin(20), with(begin(20), "--force")})
    expect_refusal(arguments, 2, "out.part: was not made by a run: remove it, or give another folder");
  expect_refusal(
      resume(), 2,
      "out.part: is no folder of a run that did not end: only one with --checkpoint-every leaves it");
  EXPECT_EQ(names_below(part()), names);
  fs::remove_all(part());
  write_text(part(), "mine");
  expect_refusal(begin(20), 2, "out.part: was not made by a run: remove it, or give another folder");
  EXPECT_EQ(read_text(part()), "mine");
}

/// What a run leaves that is killed before, between and after it makes its two folders.
TEST_F(Run_folders, ARunThatWasKilledAtOnceBeginsAnew) {
  const std::vector<std::vector<std::string>> made{
      {}, {"lock"}, {"lock", "results/"}, {"lock", "checkpoints/step-0000000099.checkpoint/"}};
  for (const auto& names : made)
    for (const bool resumes : {false, true}) {
      fs::remove_all(parts());
      fs::create_directories(part());
      for (const std::string& name : names)
        if (name.ends_with('/'))
          fs::create_directories(part() / name);
        else
          write_text(part() / name, "");
      if (resumes)
        expect_refusal(
            resume(), 3,
            (fs::canonical(part()) / "checkpoints").string() + ": holds no checkpoint: begin the run again");
      expect_same(run_program(begin(20), parts()));
    }
}

/// What a run leaves that is killed while it removes what nobody needs any more.
TEST_F(Run_folders, ARunThatWasKilledAtItsEndHasEnded) {
  expect_same(run_program(plain(), parts()));
  const std::vector<std::vector<std::string>> left{
      {"ended", "lock", "checkpoints"}, {"ended", "lock"}, {"ended"}, {}};
  for (const auto& names : left) {
    fs::create_directory(part());
    for (const std::string& name : names)
      if (name == "checkpoints")
        fs::create_directory(part() / name);
      else if (name == "lock")
        write_text(part() / name, "");
      else
        write_text(part() / name, read_text(out() / "run.json"));
    const Outcome again = run_program(resume(), parts());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, "out: the run had ended, and its results are there\n");
    EXPECT_EQ(again.err, "");
    expect_same_files(parts(), path("whole"));
  }
}

TEST_F(Run_folders, FilesThatAreMissingAreNoticed) {
  stop_at(40, begin(20));
  for (const char* name : {"results/contacts.csv", "results/frames", "checkpoints/motion.gz.content"}) {
    fs::rename(part() / name, path("aside"));
    expect_refusal(resume(), 3,
                   (fs::canonical(part()) / name).string() +
                       ": is missing, and was there at the checkpoint: begin the run again");
    fs::rename(path("aside"), part() / name);
  }
  expect_same(run_program(resume(), parts()));
}

TEST_F(Run_folders, ACopySaysItsOwnName) {
  stop_at(40, begin(20));
  fs::copy(part(), parts() / "copy.part", fs::copy_options::recursive);
  const Outcome last = run_program({"run", "--resume", "copy"}, parts());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_NE(last.out.find(" copy: run.json"), std::string::npos) << last.out;
  expect_same_files(parts() / "copy", path("whole") / "out");
}

TEST_F(Run_folders, WhatKilledRunsLeftIsRemoved) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  const auto folder = [&](const std::string& name) {
    fs::create_directories(parts() / name / "frames");
    write_text(parts() / name / ".run.json.1.0.tmp", "half");
    return parts() / name;
  };
  const std::string dead = "out.tmp-" + std::to_string(child);
  const fs::path running = folder("out.tmp-" + std::to_string(getpid())), other = folder("other.tmp-" + dead),
                 similar = folder(dead + "x"), left = folder(dead);
  const int lock = open(left.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);  // it runs where its process cannot be seen
  const auto again = [this] { return run_program(with(plain(), "--force"), parts()).exit_code; };
  EXPECT_EQ(again(), 0);
  EXPECT_TRUE(fs::exists(left));
  close(lock);
  make_precious(left);
  EXPECT_EQ(again(), 0);
  EXPECT_TRUE(fs::exists(left)) << "no run writes a thesis";
  fs::remove(left / "thesis.txt");
  EXPECT_EQ(again(), 0);
  EXPECT_FALSE(fs::exists(left));
  for (const fs::path& stays : {running, other, similar}) EXPECT_TRUE(fs::exists(stays)) << stays;
}

}  // namespace
}  // namespace cellwalk::test
