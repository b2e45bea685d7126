// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshers that misbehave, played by scripts: each becomes one error, and nothing is left of it.
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "meshing/fill/narrow_place.h"
#include "meshing/shapes.h"
#include "meshing/traces.h"

namespace cellwalk {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Scripts instead of the helpers, in a folder that CELLWALK_LIBEXEC names.
class Helpers : public testing::Test {
 protected:
  Helpers() {
    std::string name = (fs::temp_directory_path() / "cellwalk-helpers-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    setenv("CELLWALK_LIBEXEC", folder_.c_str(), 1);
  }
  ~Helpers() override {
    unsetenv("CELLWALK_LIBEXEC");
    fs::remove_all(folder_);
  }

  /// Makes both helpers this script. Each run appends a line to `runs`.
  void play(const std::string& script) const {
    for (const char* program : {"cellwalk-tetgen", "cellwalk-mesh3"}) {
      const fs::path file = folder_ / program;
      std::ofstream(file) << "#!/bin/sh\necho run >> '" << (folder_ / "runs").string() << "'\n"
                          << script << "\n";
      fs::permissions(file, fs::perms::owner_all);
    }
  }

  std::size_t runs() const {
    std::ifstream in(folder_ / "runs");
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) ++count;
    return count;
  }

  fs::path folder_;
};

std::string by_tetgen(const Mesher_limits& limits = {}) {
  Tetrahedralize_options options;
  options.limits = limits;
  return test::refusal([&] { tetrahedralize(test::octahedron(), {}, options); });
}

std::string by_mesh3(const Mesher_limits& limits = {}) {
  Mesh3_options options;
  options.limits = limits;
  return test::refusal([&] { mesh3(test::octahedron(), {}, options); });
}

/// The narrowest place of the octahedron, which ends both messages.
std::string place_of_octahedron() {
  detail::Feature_names names;
  names.add("surface", {0, 1, 2, 3, 4, 5}, 6, {0, 1, 2, 3, 4, 5, 6, 7}, 8);
  return detail::describe(detail::narrow_places({check_surface(test::octahedron())}), names);
}
const std::string place = place_of_octahedron();

struct Part {
  std::string script, message;
};

TEST_F(Helpers, EveryFailureIsAnError) {
  const test::Traces before;
  const std::string few = "wrote half a result (";
  const std::vector<Part> parts{
      {"kill -SEGV $$", "crashed (signal 11, SIGSEGV)"},
      {"kill -KILL $$", "crashed (signal 9, SIGKILL)"},
      {"echo \"x.cxx:7: int f(): Assertion \\`a > 0' failed.\" >&2; kill -ABRT $$",
       "crashed (signal 6, SIGABRT: Assertion `a > 0' failed)"},
      {"exit 1", "crashed (exit code 1)"},
      {"exit 90", "crashed (exit code 90)"},
      {"echo first >&2; echo second >&2; exit 10", "failed: first"},
      {"printf 'a\\033[1mb' >&2; exit 10", "failed: a?[1mb"},
      {"yes | head -c 1000000 >&2; exit 10", "failed: y"},
      {"exit 0", few + "0 bytes)"},
      {"head -c 100 /dev/zero >&3", few + "100 bytes)"},
      {"head -c 5000 /dev/zero | tr '\\0' '\\377' >&3", few + "5000 bytes)"},
      {"head -c 7 /dev/zero >&3; exec 3>&-; kill -KILL $$", "crashed (signal 9, SIGKILL)"},
      {"cat >/dev/null; echo noise; exit 0", few + "0 bytes)"},
  };
  for (const Part& part : parts) {
    SCOPED_TRACE(part.script);
    play(part.script);
    EXPECT_EQ(by_tetgen(), "4: TetGen " + part.message + ", and failed with finer tolerances too; " + place +
                               ": widen or join them, or try Mesh_3, which approximates the surface");
    EXPECT_EQ(by_mesh3(), "4: Mesh_3 " + part.message + "; " + place);
  }
  EXPECT_EQ(runs(), 4 * parts.size()) << "three tolerances, and Mesh_3";
  before.expect_unchanged();
}

TEST_F(Helpers, TheirResultsAreNotTrusted) {
  const test::Traces before;
  play("head -c 40 /dev/zero >&3");  // no points, no tetrahedra
  EXPECT_EQ(
      by_tetgen().rfind("4: TetGen did not keep the surface: vertex 0 is not in its mesh, at (1, 0, 0)", 0),
      0u)
      << by_tetgen();
  EXPECT_EQ(by_mesh3(), "4: Mesh_3 made no tetrahedron; give a smaller cell size and facet size; " + place);
  // One point at 0, and a tetrahedron of points 0, 0, 0 and 2^24.
  play(R"(printf '\001\0\0\0\0\0\0\0' >&3; head -c 24 /dev/zero >&3; printf '\001\0\0\0\0\0\0\0' >&3
          head -c 15 /dev/zero >&3; printf '\001' >&3; head -c 24 /dev/zero >&3)");
  EXPECT_EQ(by_tetgen().rfind("4: TetGen made no mesh: its tetrahedra do not fit together", 0), 0u);
  EXPECT_EQ(by_mesh3().rfind("4: Mesh_3 made no mesh: a tetrahedron lacks a vertex", 0), 0u);
  before.expect_unchanged();
}

/// Finer tolerances would take as much.
TEST_F(Helpers, OneThatRunsOutOfMemoryIsNotTriedAgain) {
  const test::Traces before;
  play("exit 11");
  const std::string why = "ran out of memory; give a smaller surface or larger cells; ";
  EXPECT_EQ(by_tetgen(), "4: TetGen " + why + place);
  EXPECT_EQ(by_mesh3(), "4: Mesh_3 " + why + place);
  EXPECT_EQ(runs(), 2u);
  before.expect_unchanged();
}

/// The limit is that of all tries: the first fails, and the second hangs.
TEST_F(Helpers, AllTriesHaveOneLimitOfTime) {
  play("sleep 1; exit 14");
  EXPECT_EQ(by_tetgen({1.5, {}}), "4: TetGen did not end within 1.5 s, the limit of time; " + place);
  EXPECT_LE(runs(), 2u);
}

TEST_F(Helpers, OneThatHangsIsEnded) {
  const test::Traces before;
  play("sleep 1000");  // a process of its own, too
  const auto start = Clock::now();
  EXPECT_EQ(by_tetgen({0.2, {}}), "4: TetGen did not end within 0.2 s, the limit of time; " + place);
  EXPECT_EQ(by_mesh3({0.2, {}}), "4: Mesh_3 did not end within 0.2 s, the limit of time; " + place);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(100)) << "not a tenth of what it would take";
  EXPECT_LE(runs(), 2u) << "on a busy machine it is ended before it begins";
  for (const double never : {0.0, -1.0, std::nan("")})
    EXPECT_EQ(by_tetgen({never, {}}), "2: TetGen: the limit of time must be greater than 0");
  before.expect_unchanged();
}

TEST_F(Helpers, WhoWaitsMayStopThem) {
  const test::Traces before;
  play("sleep 1000");
  struct Stopped {};
  const auto start = Clock::now();
  int calls = 0;
  const Mesher_limits limits{600, [&calls] {
                               if (++calls == 3) throw Stopped{};
                             }};
  EXPECT_THROW(by_tetgen(limits), Stopped);
  calls = 0;
  EXPECT_THROW(by_mesh3(limits), Stopped);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(100)) << "not a sixth of its limit";
  EXPECT_LE(runs(), 2u) << "no other tolerance is tried";
  before.expect_unchanged();
}

TEST_F(Helpers, OneOfAnotherVersionIsRefused) {
  play("exit 91");
  EXPECT_NE(by_tetgen().find("2: cellwalk-tetgen is of another version of Cellwalk than "),
            std::string::npos);
  EXPECT_NE(by_mesh3().find("2: cellwalk-mesh3 is of another version of Cellwalk than "), std::string::npos);
  EXPECT_EQ(runs(), 2u);
}

TEST_F(Helpers, OneThatIsNoProgramIsRefused) {
  for (const char* program : {"cellwalk-tetgen", "cellwalk-mesh3"}) {
    std::ofstream(folder_ / program) << "\177ELF no program";
    fs::permissions(folder_ / program, fs::perms::owner_all);
  }
  EXPECT_NE(by_tetgen().find("1: " + folder_.string() + "/cellwalk-tetgen: cannot be started: "),
            std::string::npos)
      << by_tetgen();
}

TEST_F(Helpers, AreFoundWhereTheFolderHasNone) {
  EXPECT_TRUE(has_tetgen());
  EXPECT_EQ(by_tetgen(), "");
}

/// A program may ignore the ends of its children, or have closed its standard streams.
TEST(Surroundings, DoNotMatter) {
  signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(by_tetgen(), "");
  signal(SIGCHLD, SIG_DFL);
  const int input = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  EXPECT_EQ(by_tetgen(), "");
  EXPECT_EQ(by_mesh3(), "");
  dup2(input, STDIN_FILENO);
  close(input);
}

TEST(Threads, MeshAtTheSameTime) {
  const test::Traces before;
  const auto alone = tetrahedralize(test::octahedron(2));
  std::atomic<int> same{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      const auto soup = tetrahedralize(test::octahedron(2));
      same += soup.points == alone.points && soup.facet_count() == alone.facet_count();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(same, 8);
  before.expect_unchanged();
}

}  // namespace
}  // namespace cellwalk
