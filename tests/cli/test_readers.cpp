// SPDX-License-Identifier: LGPL-3.0-or-later
// The module that reads by VTK: loaded when a file needs it, found where it is.
#include <nlohmann/json.hpp>

#include <cstdlib>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

const std::string vtk =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0\n1 0 0\n0 1 0\n0 "
    "0 1\n"
    "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";

class Readers : public Program {
 protected:
  /// A shell's exit code; what is said goes to `said`.
  int shell(const std::string& line) const {
    return std::system(("cd '" + path("").string() + "' && { " + line + "; } > said 2>&1").c_str()) >> 8;
  }
};

TEST_F(Readers, NoCommandStartsWithItsLibraries) {
  ASSERT_EQ(shell("LD_TRACE_LOADED_OBJECTS=1 " CELLWALK_PROGRAM), 0);
  const std::string said = text("said");
  EXPECT_NE(said.find("libz.so"), std::string::npos) << said;
  EXPECT_EQ(said.find("libvtk"), std::string::npos) << said;
}

#if defined CELLWALK_TEST_VTK
TEST_F(Readers, IsFoundBesideTheProgramOrWhereAVariableSays) {
  write("t.vtk", vtk);
  succeed({"check", "t.vtk"});
  // A program far from its module, which is installed nowhere.
  fs::create_directories(path("far/bin"));
  fs::copy_file(CELLWALK_PROGRAM, path("far/bin/cellwalk"));
  EXPECT_EQ(shell("far/bin/cellwalk check t.vtk"), 3);
  EXPECT_NE(text("said").find(", which reads it, cannot be loaded (libcellwalk_"), std::string::npos)
      << text("said");
  EXPECT_NE(text("said").find("install cellwalk-readers, or name the folder"), std::string::npos)
      << text("said");
  EXPECT_EQ(shell("CELLWALK_READERS=" CELLWALK_READERS_FOLDER " far/bin/cellwalk check t.vtk"), 0)
      << text("said");
  ASSERT_EQ(shell("far/bin/cellwalk --version --json"), 0);
  EXPECT_FALSE(nlohmann::json::parse(text("said")).at("parts").at("vtk").at("present"));

  const fs::path folder = fs::path(CELLWALK_READERS_FOLDER);
  const fs::path below = folder.parent_path().filename() / folder.filename();  // such as lib/cellwalk
  fs::create_directories(path("far") / below);
  fs::copy(folder, path("far") / below);
  EXPECT_EQ(shell("far/bin/cellwalk check t.vtk"), 0) << text("said");
  ASSERT_EQ(shell("far/bin/cellwalk --version --json"), 0);
  EXPECT_TRUE(nlohmann::json::parse(text("said")).at("parts").at("vtk").at("present"));

  write((fs::path("far") / below / "libcellwalk_vtk.so").string(), "no library");
  EXPECT_EQ(shell("far/bin/cellwalk check t.vtk"), 3);
  EXPECT_NE(text("said").find("VTK, which reads it, cannot be loaded ("), std::string::npos) << text("said");
  EXPECT_NE(text("said").find("far/"), std::string::npos)
      << "the module that is there is named: " << text("said");
}
#endif

}  // namespace
}  // namespace cellwalk::test
