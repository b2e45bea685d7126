// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments from files and recipes, as the library gives them.
#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/loading/environment_file.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace cellwalk {
namespace {

class Loading : public testing::Test {
 protected:
  Loading()
      : folder_(std::filesystem::temp_directory_path() / ("cellwalk_loading_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Loading() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }

  std::filesystem::path folder_;
};

const char* const two_triangles = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST_F(Loading, AnImportReportsItsStages) {
  const std::string path = write("square.off", two_triangles);
  std::vector<std::string> begun;
  Import_options options;
  options.on_stage = [&begun](const std::string& stage) { begun.push_back(stage); };
  const Imported_environment imported = import_environment(path, options);
  EXPECT_EQ(of_dimension<2>(imported.environment).snapshot().cell_count(), 2u);
  EXPECT_EQ(begun, (std::vector<std::string>{"reading " + path, "splitting, gluing and certifying " + path}));
  ASSERT_EQ(imported.report.stages.size(), 2u);
  EXPECT_EQ(imported.report.stages[0].title, "read");
  EXPECT_EQ(imported.report.stages[1].title, "changed");
  EXPECT_EQ(imported.report.json["certificate"]["cells"], 2);
}

TEST_F(Loading, CellsTakeNoObstacles) {
  Import_options options;
  options.obstacles = {"other.off"};
  try {
    import_environment(write("square.off", two_triangles), options);
    FAIL() << "an obstacle of what is no surface was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::usage);
    EXPECT_NE(std::string(error.what()).find("square.off"), std::string::npos);
  }
}

TEST_F(Loading, LoadingRepairsNothing) {
  const std::string inverted = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 2 1\n";
  const std::string path = write("inverted.off", inverted);
  const Imported_environment imported = import_environment(path, {});
  EXPECT_EQ(of_dimension<2>(imported.environment).snapshot().cell_count(), 1u);
  EXPECT_THROW(of_dimension<3>(imported.environment), Error);
  try {
    load_environment(path, {});
    FAIL() << "an inverted mesh was loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    EXPECT_EQ(std::string(error.what()).find(path), 0u);
  }
}

TEST_F(Loading, EveryRecipeIsCertifiedAsItStands) {
  for (const Generator& generator : generators()) {
    Generator_values values;
    if (generator.name == "vessel") values["generations"] = {1};
    std::visit(
        [&](auto soup) {
          constexpr int D = std::tuple_size_v<typename decltype(soup.points)::value_type>;
          Build_report report;
          Environment<D>::build(std::move(soup), {.split = false, .keep_map = false}, &report);
          EXPECT_GE(report.certificate.cells, 8u) << generator.name;
        },
        generate(generator.name, values));
  }
  EXPECT_GE(generators().size(), 9u);
  EXPECT_THROW(generate("hexes", {{"cells", {2, 3}}}), Error);
}

/// Unit cubes whose corners are joined, as solvers write prisms, pyramids and tetrahedra.
TEST_F(Loading, CollapsedHexahedraAreTheCellsThatTheyAre) {
  const std::vector<std::pair<std::string, double>> cells{{"1 2 3 3 5 6 7 7", 1. / 2},
                                                          {"1 2 3 4 5 5 5 5", 1. / 3},
                                                          {"1 2 3 3 5 5 5 5", 1. / 6},
                                                          {"1 2 3 4 5 6 3 4", 1. / 2},
                                                          {"1 2 3 4 5 6 3 8", 2. / 3}};
  for (const auto& [corners, volume] : cells) {
    const std::string path = write("m.mesh",
                                   "MeshVersionFormatted 1\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 "
                                   "0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n"
                                   "1 1 1 0\n0 1 1 0\nHexahedra\n1\n" +
                                       corners + " 0\nEnd\n");
    const Imported_environment imported = import_environment(path, {});
    EXPECT_DOUBLE_EQ(imported.built.certificate.volume, volume) << corners;
    EXPECT_EQ(imported.built.certificate.components, 1u);
  }
}

}  // namespace
}  // namespace cellwalk
