// SPDX-License-Identifier: LGPL-3.0-or-later
// The public meshes: each is read with the counts that its entry in SOURCES.txt states, or refused for a
// stated reason.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <regex>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

const std::filesystem::path data = CELLWALK_TEST_DATA;

struct Entry {
  std::string path;                    ///< relative to the folder of the data
  std::optional<std::size_t> points;   ///< `V=` of volumes, `v=` of surfaces
  std::optional<std::size_t> members;  ///< `C=` cells or `f=` facets
};

std::optional<std::size_t> fact(const std::string& line, const char* key) {
  std::smatch match;
  if (!std::regex_search(line, match, std::regex(std::string("[| ]") + key + "=(\\d+)"))) return std::nullopt;
  return std::stoul(match[1]);
}

std::vector<Entry> entries(const std::string& folder) {
  std::vector<Entry> found;
  std::ifstream in(data / "SOURCES.txt");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(folder + "/")) continue;
    const auto points = fact(line, "V"), cells = fact(line, "C");
    found.push_back(
        {line.substr(0, line.find(' ')), points ? points : fact(line, "v"), cells ? cells : fact(line, "f")});
  }
  return found;
}

void expect_counts(const Entry& entry, const Mesh_file& file) {
  const Read_report& report = file.report;
  EXPECT_EQ(report.points, entry.points.value());
  if (const auto* soup = std::get_if<Cell_soup<3>>(&file.mesh)) {
    EXPECT_EQ(soup->points.size(), report.points);
    EXPECT_EQ(soup->cell_count(), entry.members.value());
  } else {
    EXPECT_EQ(std::get<Surface_soup>(file.mesh).facets.size(), entry.members.value());
  }
}

class PublicMesh : public testing::TestWithParam<Entry> {};

TEST_P(PublicMesh, HasTheStatedCounts) {
  const Entry& entry = GetParam();
  const Mesh_file file = read_mesh(data / entry.path);
  EXPECT_EQ(kind_name(file.mesh),
            entry.path.starts_with("surface") || entry.path.starts_with("body") ? "surface" : "volume");
  expect_counts(entry, file);
}

std::string test_name(const testing::TestParamInfo<Entry>& info) {
  return std::regex_replace(info.param.path, std::regex("\\W"), "_");
}

INSTANTIATE_TEST_SUITE_P(Tet, PublicMesh, testing::ValuesIn(entries("tet")), test_name);
INSTANTIATE_TEST_SUITE_P(HexPoly, PublicMesh, testing::ValuesIn(entries("hex_poly")), test_name);
INSTANTIATE_TEST_SUITE_P(Surface, PublicMesh, testing::ValuesIn(entries("surface")), test_name);
INSTANTIATE_TEST_SUITE_P(Body, PublicMesh, testing::ValuesIn(entries("body")), test_name);

TEST(PublicMeshes, AreAsManyAsExpected) {
  EXPECT_EQ(entries("tet").size(), 9u);
  EXPECT_EQ(entries("hex_poly").size(), 5u);
  EXPECT_EQ(entries("surface").size(), 7u);
  EXPECT_EQ(entries("body").size(), 2u);
  EXPECT_EQ(entries("bad").size(), 10u);
}

/// What is wrong with a bad mesh shows here only where its file is broken. Open, inverted and crossing
/// surfaces are read as they are: meshing and certification refuse them.
TEST(BadMeshes, AreReadAsTheyAreOrRefusedForAReason) {
  const std::map<std::string, std::string> refused{
      {"bad/Armadillo_Tetra_4406_for_test_broken.vtu",
       ": broken or cut short: VTK cannot read it as VTK XML UnstructuredGrid ("}};
  std::size_t read = 0;
  for (const Entry& entry : entries("bad")) {
    SCOPED_TRACE(entry.path);
    const auto path = data / entry.path;
    if (const auto expected = refused.find(entry.path); expected != refused.end()) {
      EXPECT_TRUE(refusal([&] { read_mesh(path); }).starts_with(path.string() + expected->second));
      continue;
    }
    const Mesh_file file = read_mesh(path);
    if (entry.points) expect_counts(entry, file);
    ++read;
  }
  EXPECT_EQ(read, 9u);
}

/// Cut at every twentieth, each file is read or refused: OBJ may end anywhere, most others may not.
TEST(PublicMeshes, CutShortNeverCrash) {
  constexpr std::uintmax_t largest = 200000;  // bytes: larger files only take longer
  const Folder folder;
  std::size_t files = 0, refused = 0;
  for (const char* part : {"tet", "hex_poly", "surface", "bad"})
    for (const Entry& entry : entries(part)) {
      const auto path = data / entry.path;
      if (std::filesystem::file_size(path) > largest) continue;
      SCOPED_TRACE(entry.path);
      ++files;
      refused += static_cast<std::size_t>(refused_truncations(content_of(path), [&](const std::string& text) {
        read_mesh(folder.write(path.filename().string(), text));
      }));
    }
  EXPECT_GE(files, 15u);
  EXPECT_GE(refused, files * 15);
}

}  // namespace
}  // namespace cellwalk::io
