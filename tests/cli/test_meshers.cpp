// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces that kill meshers, and programs that are killed while one works: nothing dies with the former, and
// no mesher outlives the latter.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <regex>
#include <thread>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

class Meshers : public Program {
 protected:
  /// An environment with a note on the tolerance, or one line with the reason and the place. Returns true if
  /// it is the former.
  bool is_answered(const std::string& mesher) const {
    static const std::regex place("(vertices|facets) [0-9]+ and [0-9]+.* are .* of the size apart, at \\(");
    const Outcome outcome =
        run({"import", "m.off", "--mesher", mesher, "--time-limit", "20", "-o", "env.ovm"});
    const std::string& said = outcome.exit_code == 0 ? outcome.out : outcome.err;
    EXPECT_TRUE(std::regex_search(said, place)) << said;
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 4) << outcome.exit_code;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), outcome.exit_code == 0 ? 0 : 1);
    const std::vector<std::string> left = outcome.exit_code == 0
                                              ? std::vector<std::string>{"env.ovm", "m.off"}
                                              : std::vector<std::string>{"m.off"};
    EXPECT_EQ(files(), left);
    if (outcome.exit_code != 0) return false;
    succeed({"check", "env.ovm"});
    fs::remove(path("env.ovm"));
    return true;
  }

  /// The process that meshes here, or 0.
  pid_t mesher() const {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::error_code gone;
      const pid_t id = std::atoi(entry.path().filename().c_str());
      if (id == 0 || fs::read_symlink(entry.path() / "exe", gone).filename() != "cellwalk-mesh3") continue;
      if (fs::read_symlink(entry.path() / "cwd", gone) == fs::canonical(path(""))) return id;
    }
    return 0;
  }
};

TEST_F(Meshers, AnswerWhereTheyCrashed) {
  // Two points 1e-12 apart in a unit cube: an assertion of TetGen.
  write(
      "m.off",
      "OFF\n9 14 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n1e-12 0 0\n3 0 2 8\n3 8 2 1\n3 0 "
      "3 2\n"
      "3 0 8 5\n3 8 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n3 4 5 6\n3 4 6 7\n");
  EXPECT_TRUE(is_answered("tetgen"));
  // A coordinate of 1e8 beside 1: TetGen crashes.
  write("m.off", "OFF\n4 4 0\n0 0 0\n1e8 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_TRUE(is_answered("tetgen"));
  // A crack 2e-8 wide: the same.
  write(
      "m.off",
      "OFF\n14 9 0\n0 0 0\n4 0 0\n4 0 2\n2.00000001 0 2\n2 0 1\n1.99999999 0 2\n0 0 2\n0 2 0\n4 2 0\n4 2 2\n"
      "2.00000001 2 2\n2 2 1\n1.99999999 2 2\n0 2 2\n7 0 1 2 3 4 5 6\n7 13 12 11 10 9 8 7\n4 0 7 8 1\n4 1 8 "
      "9 2\n"
      "4 2 9 10 3\n4 3 10 11 4\n4 4 11 12 5\n4 5 12 13 6\n4 6 13 7 0\n");
  EXPECT_TRUE(is_answered("tetgen"));
  // A corner at 1e12: an assertion of CGAL, and dumps.
  write("m.off",
        "OFF\n8 12 0\n0 0 0\n0 0 1\n0 1 0\n0 1 1\n1 0 0\n1 0 1\n1 1 0\n1 1 1e12\n3 0 1 3\n3 0 3 2\n3 4 6 "
        "7\n3 4 7 5\n"
        "3 0 4 5\n3 0 5 1\n3 2 3 7\n3 2 7 6\n3 0 2 6\n3 0 6 4\n3 1 5 7\n3 1 7 3\n");
  EXPECT_FALSE(is_answered("mesh3"));
}

TEST_F(Meshers, EndWithTheProgram) {
  write("cube.off", cube_off(2));
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    pid_t id = 0;
    const auto is_meshing = [&] { return (id = mesher()) != 0; };
    const Outcome outcome =
        stop_program({"import", "cube.off", "--mesher", "mesh3", "--cell-size", "0.01", "-o", "env.ovm"},
                     path(""), signal, is_meshing);
    ASSERT_NE(id, 0) << outcome.err;
    EXPECT_EQ(outcome.exit_code, -1);
    for (int i = 0; i < 100 && mesher() != 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(mesher(), 0) << signal;
    if (signal != SIGKILL) {  // which leaves the file that was begun
      EXPECT_EQ(files(), std::vector<std::string>{"cube.off"});
    }
  }
}

TEST_F(Meshers, EndWhereTheirTimeIsUp) {
  write("cube.off", cube_off(2));
  expect_failure(4,
                 {"import", "cube.off", "--mesher", "mesh3", "--cell-size", "0.01", "--time-limit", "0.5",
                  "-o", "e.ovm"},
                 {"cube.off: Mesh_3 did not end within 0.5 s, the limit of time; "});
  // It is no defect to be repaired.
  expect_failure(4, {"import", "cube.off", "--time-limit", "1e-3", "-o", "e.ovm"},
                 {"cube.off: TetGen did not end within 0.001 s, the limit of time; "});
  expect_failure(2, {"import", "cube.off", "--time-limit", "0", "-o", "e.ovm"}, {"--time-limit"});
}

}  // namespace
}  // namespace cellwalk::test
