// SPDX-License-Identifier: LGPL-3.0-or-later
// Folders of runs that somebody else made, or that were moved: whatever they hold and their checkpoints name,
// `run --resume` writes in its own folder, and elsewhere only where an option says so now.
#include <cellwalk/internal/io/checkpoint_folder.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/kernel/error.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <map>
#include <string>
#include <vector>

#include "cli/run/stopped_run.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What a trap is made of, in the place of a file or folder.
const std::vector<std::string> kinds_of_trap{
    "link to a file",   "link to no file", "relative link", "link to a folder",
    "link to a device", "hard link",       "pipe",          "socket"};

class Foreign_runs : public Stopped_run {
 protected:
  void SetUp() override {
    write("scene.json", R"({
      "environment": {"generate": "tets", "cells": [3, 3, 3]},
      "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 3, "seed": 3, "speed": 4}],
      "time_step": 0.02, "steps": 60, "output": {"frame_every": 20, "picture": {"width": 16, "height": 16}}
    })");
    for (const char* folder : {"outside", "outside/frames"}) fs::create_directory(path(folder));
    for (const char* file : {"outside/precious", "outside/frames/precious", "outside/step-9.checkpoint"})
      write(file, "mine");
    run_whole({"../scene.json", "--record", "../outside/b.trace", "--json", "../outside/report.json"});
    for (const char* file : {"b.trace", "report.json"}) {
      fs::copy(path("outside") / file, path(file));
      write(std::string("outside/") + file, "precious");
    }
    ASSERT_NO_FATAL_FAILURE(stop_between_checkpoints());
    for (const auto& entry : fs::directory_iterator(path("outside")))  // those of a process that was killed
      if (entry.path().extension() == ".tmp") fs::remove(entry.path());
    outside_ = contents(path("outside"));
  }

  /// Kills the run, which may end before on a busy machine: then it is begun again.
  void stop_between_checkpoints() {
    constexpr int tries = 30;
    for (int i = 0; i < tries; ++i) {
      const Outcome stopped =
          stop_program(begin(7), parts(), SIGKILL, [&] { return newest_step(parts()) >= 21; });
      if (stopped.exit_code == -1 && newest_step(parts()) >= 21 && !fs::exists(out())) return;
      for (const fs::path& folder : {out(), part()}) fs::remove_all(folder);
      for (const char* file : {"b.trace", "report.json"}) write(std::string("outside/") + file, "precious");
    }
    FAIL() << "it ended before each time";
  }

  fs::path out() const { return parts() / "out"; }
  fs::path part() const { return parts() / "out.part"; }

  static std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const std::string& name : names_below(folder))
      all[name] = fs::is_regular_file(folder / name) ? read_text(folder / name) : "folder";
    return all;
  }
  void expect_outside_untouched() const { EXPECT_EQ(contents(path("outside")), outside_); }

  /// Runs it, for some seconds at most.
  Outcome run_briefly(const std::vector<std::string>& arguments) const {
    const auto began = Clock::now();
    constexpr std::chrono::seconds most{20};
    return stop_program(arguments, parts(), SIGKILL, [&] { return Clock::now() - began > most; });
  }

  /// Puts a trap in the place of a file or folder, which may not be there.
  void set(const std::string& kind, const fs::path& place) const {
    fs::remove_all(place);
    fs::create_directories(place.parent_path());
    const fs::path precious = path("outside") / "precious";
    if (kind == "link to a file") fs::create_symlink(precious, place);
    if (kind == "link to no file") fs::create_symlink(path("outside") / "new", place);
    if (kind == "relative link") fs::create_symlink(fs::relative(precious, place.parent_path()), place);
    if (kind == "link to a folder") fs::create_symlink(path("outside"), place);
    if (kind == "link to a device") fs::create_symlink("/dev/zero", place);
    if (kind == "hard link") fs::create_hard_link(precious, place);
    if (kind == "pipe") {
      ASSERT_EQ(mkfifo(place.c_str(), 0600), 0);
    }
    if (kind == "socket") make_socket(place);
  }
  static void make_socket(const fs::path& place) {
    const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
    const fs::path before = fs::current_path();
    fs::current_path(place.parent_path());  // names of sockets are short
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    place.filename().string().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    fs::current_path(before);
    close(descriptor);
  }

  /// All that lies in the folder, and what else a run makes there before it ends.
  std::vector<std::string> places() const {
    std::vector<std::string> names = names_below(part());
    for (const char* name :
         {"ended", "ended.tmp", "results.before", "checkpoints.before",
          "checkpoints/environment.cellwalk.tmp", "checkpoints/step-0000000060.checkpoint",
          "checkpoints/step-0000000060.checkpoint.tmp", "results/run.json", "results/run.pvd",
          "results/picture.png", "results/motion.gz", "results/record.trace",
          "results/frames/bodies_00003.vtu", "results/frames/contacts_00003.vtu"})
      if (std::ranges::count(names, name) == 0) names.emplace_back(name);
    return names;
  }

  std::map<std::string, std::string> outside_;
};

TEST_F(Foreign_runs, WriteThroughNoLink) {
  int members = 0, by_name = 0;
  for (const std::string& place : places())
    for (const std::string& kind : kinds_of_trap) {
      SCOPED_TRACE(place + ": " + kind);
      std::error_code none;
      fs::rename(part() / place, path("aside"), none);
      set(kind, part() / place);
      const Outcome refused = run_briefly(resume());
      EXPECT_EQ(refused.exit_code, place == "lock" && kind != "hard link" ? 2 : 3) << refused.err;
      EXPECT_EQ(refused.out, "");
      EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
      by_name += refused.err.find("out.part: holds " + place + ", a ") != std::string::npos;
      EXPECT_FALSE(fs::exists(out()));
      expect_outside_untouched();
      fs::remove(part() / place);
      fs::rename(path("aside"), part() / place, none);
      ++members;
    }
  EXPECT_GE(members, 200);
  EXPECT_EQ(by_name, members - static_cast<int>(kinds_of_trap.size()) + 1);
  EXPECT_EQ(run_briefly(resume()).exit_code, 0);
}

/// A new run in the place of such a folder.
TEST_F(Foreign_runs, WriteThroughNoLinkWhereTheyAreReplaced) {
  fs::rename(part(), path("kept"));
  for (const char* place : {"ended.tmp", "results", "checkpoints", "results/contacts.csv", "lock"})
    for (const std::string& kind : kinds_of_trap) {
      SCOPED_TRACE(place + (": " + kind));
      fs::remove_all(part());
      fs::copy(path("kept"), part(), fs::copy_options::recursive);
      set(kind, part() / place);
      const Outcome last = run_briefly(
          {"run", "../scene.json", "-o", "out", "--steps", "2", "--checkpoint-every", "20", "--force"});
      EXPECT_TRUE(last.exit_code == 2 || last.exit_code == 3) << last.err;
      expect_outside_untouched();
    }
}

/// The folder itself may be a link, or none.
TEST_F(Foreign_runs, AreNoLinks) {
  fs::rename(part(), path("kept"));
  for (const std::string& kind : kinds_of_trap) {
    set(kind, part());
    EXPECT_EQ(run_briefly(resume()).exit_code, 2) << kind;
    fs::remove(part());
  }
  fs::create_symlink(path("kept"), part());
  const auto before = contents(path("kept"));
  EXPECT_EQ(run_briefly(resume()).exit_code, 2);
  EXPECT_EQ(run_briefly(begin(20)).exit_code, 2);
  EXPECT_EQ(contents(path("kept")), before);
  expect_outside_untouched();
}

TEST_F(Foreign_runs, AreWrittenElsewhereOnlyWhereAnOptionSaysSo) {
  fs::rename(part(), path("kept"));
  int members = 0;
  for (const char* name : {"out", "moved", "deeper/moved"})
    for (const bool has_record : {false, true})
      for (const bool has_json : {false, true}) {
        SCOPED_TRACE(std::string(name) + (has_record ? ", record" : "") + (has_json ? ", json" : ""));
        fs::remove_all(parts());
        fs::create_directories((parts() / name).parent_path());
        fs::copy(path("kept"), parts() / (std::string(name) + ".part"), fs::copy_options::recursive);
        std::vector<std::string> arguments{"run", "--resume", name};
        if (has_record) arguments.insert(arguments.end(), {"--record", "here.trace"});
        if (has_json) arguments.insert(arguments.end(), {"--json", "here.json"});
        const Outcome last = run_program(arguments, parts());
        EXPECT_EQ(last.exit_code, 0) << last.err;
        expect_outside_untouched();
        const fs::path folder = parts() / name;
        const fs::path trace = has_record ? parts() / "here.trace" : folder / "record.trace";
        EXPECT_TRUE(read_text(trace) == read_text(path("b.trace")));
        EXPECT_EQ(read_text(has_json ? parts() / "here.json" : folder / "run.json"), text("report.json"));
        EXPECT_EQ(fs::exists(folder / "record.trace"), !has_record);
        EXPECT_EQ(fs::exists(parts() / "here.json"), has_json);
        const auto says = [&](const std::string& file, const char* option, const char* inside) {
          return last.out.find("not written ../outside/" + file + ": lies outside of " + name + ", and " +
                               option + " was not given again; copy " + name + "/" + inside + "\n") !=
                 std::string::npos;
        };
        EXPECT_NE(says("b.trace", "--record", "record.trace"), has_record) << last.out;
        EXPECT_NE(says("report.json", "--json", "run.json"), has_json) << last.out;
        EXPECT_FALSE(fs::exists(parts() / (std::string(name) + ".part")));
        ++members;
      }
  EXPECT_EQ(members, 12);
}

TEST_F(Foreign_runs, WithATraceAreReplacedByForce) {
  EXPECT_EQ(run_program(resume(), parts()).exit_code, 0);
  ASSERT_TRUE(fs::exists(out() / "record.trace"));
  const Outcome again = run_program({"run", "../scene.json", "-o", "out", "--force"}, parts());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  expect_same_files(out(), path("whole") / "out");
}

TEST_F(Foreign_runs, GoOnWhereTheyBeganAsIfTheyHadNotStopped) {
  fs::copy(path("b.trace"), path("whole") / "b.trace");
  const Outcome last = run_program(
      {"run", "--resume", "out", "--record", "../outside/b.trace", "--json", "../outside/report.json"},
      parts());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  for (const char* file : {"b.trace", "report.json"})
    EXPECT_TRUE(read_text(path("outside") / file) == text(file)) << file;
  expect_same_files(out(), path("whole") / "out");
}

/// The parts of a checkpoint that name files or count.
struct Forged {
  std::string scene, scene_text, record, json;
  std::uint32_t steps = 0, every = 0;
  std::string replaced;
  std::int32_t sweep = 0;
  std::vector<std::string> notes;
  std::map<std::string, std::uint64_t> lengths;

  template <class Archive>
  void archive(Archive& a) {
    a(scene, scene_text, record, json, steps, every, replaced, sweep, notes, lengths);
  }
};

TEST_F(Foreign_runs, WithAForgedCheckpointLeaveAllElseAlone) {
  const std::string said = run_program({"--version"}, parts()).out;
  const std::string program = said.substr(0, said.find('\n'));
  fs::rename(part(), path("kept"));
  int refused = 0, members = 0;
  const std::string evil[] = {path("outside/precious").string(),
                              "../../outside/precious",
                              "/etc/passwd",
                              "results/../../../outside/precious",
                              "..",
                              "/",
                              "a/../../b"};
  const auto forge = [&](auto change) {
    fs::remove_all(parts());
    fs::create_directory(parts());
    fs::copy(path("kept"), part(), fs::copy_options::recursive);
    io::Checkpoint_folder folder(part() / "checkpoints", program);
    const io::Checkpoint kept = folder.newest();
    detail::Byte_reader in(kept.state);
    auto parts_of = in.next<Forged>();
    change(parts_of);
    detail::Byte_writer state;
    state(parts_of);
    state.put_bytes(in.take_rest());
    folder.keep(kept.step, state.bytes());
    const Outcome outcome = run_briefly(resume());
    EXPECT_GE(outcome.exit_code, 0) << "ended by signal " << outcome.signal;
    EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    refused += outcome.exit_code == 3;
    ++members;
    expect_outside_untouched();
    EXPECT_EQ(names_below(parts()).front().substr(0, 3), "out");
  };
  for (const std::string& name : evil) {
    for (const std::uint64_t length : {0, 4, 1000})
      forge([&](Forged& forged) { forged.lengths[name] = length; });
    forge([&](Forged& forged) { forged.record = name; });
    forge([&](Forged& forged) { forged.json = name; });
    forge([&](Forged& forged) { forged.replaced = name; });
    forge([&](Forged& forged) { forged.scene = name; });
  }
  EXPECT_EQ(refused, 21);
  forge([](Forged& forged) { forged.every = 0; });
  for (const std::int32_t sweep : {-1, 3, 1 << 30}) forge([&](Forged& forged) { forged.sweep = sweep; });
  forge([](Forged& forged) { forged.scene_text = "{"; });
  EXPECT_EQ(refused, 26);
  EXPECT_EQ(members, 54);
}

}  // namespace
}  // namespace cellwalk::test
