// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <sstream>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

class Import : public Program {
 protected:
  /// Imports `mesh` to env.ovm, expects that it is certified, and returns the report.
  nlohmann::json import(const std::string& mesh, std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments{"import", mesh, "-o", "env.ovm", "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    said_ = succeed(arguments);
    const auto report = nlohmann::json::parse(text("report.json"));
    succeed({"check", "env.ovm", "--json", "check.json"});
    expect_same_certificate(path("report.json"), path("check.json"));
    return report;
  }

  mutable std::string said_;  // by the last import
};

TEST_F(Import, SplitsACellThatIsNotPlanarAndSaysSo) {
  write("bulged.ovm", hexahedron_ovm(0.25));
  const auto report = import("bulged.ovm");
  EXPECT_EQ(report.at("changed").at("cells_split"), 1);
  EXPECT_EQ(report.at("changed").at("not_planar"), 1);
  EXPECT_EQ(report.at("changed").at("cells_made"), report.at("certificate").at("cells"));
  EXPECT_GE(report.at("changed").at("facets_triangulated"), 3);
  EXPECT_NE(said_.find("1 of 1 cells split into"), std::string::npos) << said_;
  EXPECT_NE(said_.find("env.ovm: certified, 3D"), std::string::npos) << said_;
  expect_failure(4, {"import", "bulged.ovm", "-o", "out.ovm", "--no-split"},
                 {"bulged.ovm: ", "cell 0", "planar"});
}

TEST_F(Import, LeavesExactCellsAsTheyAre) {
  succeed({"generate", "lattice", "--cells", "3", "-o", "lattice.ovm"});
  const auto report = import("lattice.ovm");
  EXPECT_EQ(report.at("changed").at("cells_split"), 0);
  EXPECT_NE(said_.find("nothing: every cell is exact as it is"), std::string::npos) << said_;
  const auto points = [](const std::string& ovm) { return ovm.substr(0, ovm.find("Edges")); };
  EXPECT_EQ(points(text("env.ovm")), points(text("lattice.ovm"))) << "every coordinate bit by bit";
}

TEST_F(Import, SplitsAllCellsIntoSimplicesIfAsked) {
  succeed({"generate", "hexes", "--cells", "2", "-o", "hexes.ovm"});
  const auto report = import("hexes.ovm", {"--simplicial"});
  EXPECT_EQ(report.at("changed").at("not_simplices"), 8);
  EXPECT_EQ(report.at("changed").at("not_convex"), 0);
  EXPECT_NE(said_.find("8 no simplices"), std::string::npos) << said_;
  succeed({"import", "env.ovm", "-o", "again.ovm", "--simplicial", "--json", "again.json"});
  EXPECT_EQ(nlohmann::json::parse(text("again.json")).at("changed").at("cells_split"), 0);
}

TEST_F(Import, TurnsInvertedCellsRoundAndSaysSo) {
  std::string inverted = hexahedron_ovm(0);
  inverted.replace(inverted.find("6 0 2 4 6 8 10"), 14, "6 1 3 5 7 9 11");
  write("inverted.ovm", inverted);
  expect_failure(4, {"check", "inverted.ovm"}, {"inverted", "import"});
  EXPECT_EQ(import("inverted.ovm").at("changed").at("flipped"), true);
  EXPECT_NE(said_.find("every cell was inverted"), std::string::npos) << said_;
}

TEST_F(Import, LeavesNothingBehindWhereItFails) {
  expect_failure(3, {"import", "missing.msh", "-o", "env.ovm"}, {"missing.msh"});
  write("words.ovm", "no mesh at all\n");
  expect_failure(3, {"import", "words.ovm", "-o", "env.ovm", "--json", "report.json"}, {"words.ovm"});
  write("fine.ovm", hexahedron_ovm(0));
  expect_failure(1, {"import", "fine.ovm", "-o", "nowhere/env.ovm"}, {"nowhere"});
  expect_failure(2, {"import", "fine.ovm", "-o", "env.off"}, {"*.ovm"});
  write("obstacle.off", cube_off());
  expect_failure(2, {"import", "fine.ovm", "--obstacle", "obstacle.off", "-o", "env.ovm"},
                 {"--obstacle", "surface"});
}

#ifdef CELLWALK_TEST_MESHING
TEST_F(Import, FillsAClosedSurface) {
  write("cube.off", cube_off(2));
  for (const char* mesher : {"tetgen", "mesh3"}) {
    const auto report = import("cube.off", {"--mesher", mesher});
    EXPECT_EQ(report.at("meshed").at("mesher"), mesher);
    EXPECT_NEAR(report.at("certificate").at("volume").get<double>(), 8, 1);
    const std::string bytes = text("env.ovm");
    import("cube.off", {"--mesher", mesher});
    EXPECT_EQ(text("env.ovm"), bytes);
  }
  EXPECT_EQ(import("cube.off").at("certificate").at("volume"), 8) << "TetGen keeps the surface";
}

TEST_F(Import, ObstaclesBecomeWalls) {
  write("cube.off", cube_off(4));
  write("inner.off", cube_off(1, 0.5));
  write("other.off", cube_off(1, 2.25));
  const std::vector<std::string> obstacles{"--obstacle", "inner.off", "--obstacle", "other.off"};
  const auto report = import("cube.off", obstacles);
  EXPECT_EQ(report.at("meshed").at("obstacles").size(), 2u);
  EXPECT_EQ(report.at("certificate").at("volume"), 62);
  auto keeping = obstacles;
  keeping.push_back("--keep-obstacles");
  const auto kept = import("cube.off", keeping);
  EXPECT_EQ(kept.at("certificate").at("volume"), 64);
  EXPECT_EQ(kept.at("certificate").at("free_volume"), 62);

  write("open.off", open_cube_off());
  expect_failure(3,
                 {"import", "cube.off", "--obstacle", "inner.off", "--obstacle", "open.off", "-o", "out.ovm"},
                 {"cube.off: obstacle open.off is open"});
  write("outside.off", cube_off(1, 9));
  expect_failure(3, {"import", "cube.off", "--obstacle", "outside.off", "-o", "out.ovm", "--mesher", "mesh3"},
                 {"cube.off: obstacle outside.off does not lie inside the surface"});
  expect_failure(
      3, {"import", "cube.off", "--obstacle", "inner.off", "--obstacle", "inner.off", "-o", "out.ovm"},
      {"cube.off: obstacle inner.off meets obstacle inner.off"});

  write("env2.ovm", hexahedron_ovm(0));
  expect_failure(3, {"import", "cube.off", "--obstacle", "env2.ovm", "-o", "out.ovm"},
                 {"env2.ovm", "obstacle"});
}

TEST_F(Import, SizesAtWhichMeshingWouldNotEndAreRefused) {
  write("cube.off", cube_off(2));
  const auto refuse = [this](const char* option, const char* value, const std::vector<std::string>& texts) {
    SCOPED_TRACE(value);
    expect_failure(2, {"import", "cube.off", "-o", "env.ovm", "--mesher", "mesh3", option, value}, texts);
  };
  const std::string of_the_volume =
      "is too small for a surface that holds a volume of 8: give at least 0.0057";
  refuse("--cell-size", "1e-300", {"cube.off: Mesh_3: a cell size of 1e-300 " + of_the_volume});
  refuse("--cell-size", "0.005", {"cube.off: Mesh_3: a cell size of 0.005 " + of_the_volume});
  refuse("--distance", "1e-9", {"Mesh_3: a distance of 1e-09 is too small for a surface of diagonal 3.4641"});
  for (const char* value : {"0", "-1", "nan", "inf", "x", "-0.0"}) {
    refuse("--cell-size", value, {"--cell-size: takes a number greater than 0, not ", value});
    refuse("--distance", value, {"--distance: takes a number greater than 0, not ", value});
  }
  refuse("--quality", "", {"argument 8, after --quality, is empty"});
  refuse("--quality", "inf", {"--quality: takes a number of at least 0, not inf"});
  import("cube.off", {"--mesher", "mesh3", "--cell-size", "1e300"});
}

TEST_F(Import, MeshesSoThatWalksAreShort) {
  // The wall is cut more finely than the tube is wide: without a bound, slivers lie across.
  write("tube.off", tube_off());
  const auto edges = [this](std::vector<std::string> options) {
    options.insert(options.end(), {"--edge-length", "1"});
    const auto report = import("tube.off", options);
    EXPECT_EQ(report.at("meshed").at("boundary_facets"), report.at("certificate").at("boundary_facets"));
    return report.at("edge_cells").at("mean_cells").get<double>();
  };
  const double by_default = edges({});
  const std::string bytes = text("env.ovm");
  EXPECT_LT(by_default, 0.8 * edges({"--quality", "0"}));
  EXPECT_NE(text("env.ovm"), bytes);
  EXPECT_EQ(edges({"--quality", "3"}), by_default) << "the default that the help names";
  EXPECT_EQ(text("env.ovm"), bytes);
}

TEST_F(Import, BoundsCellsByTetGenToo) {
  write("tube.off", tube_off());
  const auto cells = [this](const std::string& size) {
    const auto report = import("tube.off", {"--cell-size", size});
    const auto violations = report.at("meshed").at("out_of_bounds").get<int>();
    EXPECT_EQ(report.at("meshed").at("cell_size"), std::stod(size));
    EXPECT_GT(violations, 0);
    const std::string line =
        std::to_string(violations) + " tetrahedra violate the bound of quality 3 or size " + size;
    EXPECT_NE(said_.find(line), std::string::npos) << said_;
    return report.at("certificate").at("cells").get<int>();
  };
  EXPECT_GT(cells("0.1"), 5 * cells("10"));
}

TEST_F(Import, OptionsWithoutEffectAreRefused) {
  write("cube.off", cube_off());
  write("room.poly", room_poly());
  write("cells.ovm", hexahedron_ovm(0));
  const auto refuse = [this](const char* mesh, std::vector<std::string> options, const char* text) {
    options.insert(options.begin(), {"import", mesh, "-o", "env.ovm"});
    expect_failure(2, options, {text});
  };
  refuse("cube.off", {"--distance", "1"}, "cube.off: --distance goes with --mesher mesh3");
  refuse("cube.off", {"--mesher", "mesh3", "--quality", "2"},
         "cube.off: --quality goes with --mesher tetgen");
  refuse("cube.off", {"--mesher", "mesh3", "--keep-obstacles"}, "--keep-obstacles goes with --mesher tetgen");
  refuse("room.poly", {"--quality", "2"},
         "--quality goes with a surface, and room.poly holds a planar domain");
  refuse("cells.ovm", {"--cell-size", "2"}, "--cell-size goes with a surface, and cells.ovm holds a ");
  refuse("cells.ovm", {"--distance", "2"}, "--distance goes with a surface, and cells.ovm holds a ");
}

TEST_F(Import, SurroundsCellsByTissue) {
  write("cube.off", cube_off(2));
  write("inner.off", cube_off(0.5, 0.5));
  for (const char* mesher : {"tetgen", "mesh3"}) {
    SCOPED_TRACE(mesher);
    const auto alone = import("cube.off", {"--mesher", mesher, "--obstacle", "inner.off"});
    const auto report =
        import("cube.off", {"--mesher", mesher, "--obstacle", "inner.off", "--tissue", "0.75"});
    EXPECT_EQ(report.at("meshed"), alone.at("meshed")) << "the cells are the same";
    const auto& before = alone.at("certificate");
    const auto& after = report.at("certificate");
    EXPECT_EQ(after.at("cells").get<int>() - after.at("solid_cells").get<int>(),
              before.at("cells").get<int>());
    EXPECT_EQ(report.at("tissue").at("solid_cells"), after.at("solid_cells"));
    EXPECT_EQ(report.at("tissue").at("inner_facets"), before.at("walls"));
    EXPECT_EQ(report.at("tissue").at("thickness"), 0.75);
    EXPECT_NEAR(after.at("free_volume").get<double>(), before.at("volume").get<double>(), 1e-12);
    EXPECT_EQ(after.at("walls").get<int>() - after.at("boundary_facets").get<int>(),
              before.at("walls").get<int>());
    EXPECT_NEAR(after.at("volume").get<double>(), 3.5 * 3.5 * 3.5,
                mesher == std::string("tetgen") ? 1e-12 : 1);
    const std::string bytes = text("env.ovm");
    import("cube.off", {"--mesher", mesher, "--obstacle", "inner.off", "--tissue", "0.75"});
    EXPECT_EQ(text("env.ovm"), bytes);
  }
  write("cells.ovm", hexahedron_ovm(0));
  expect_failure(3, {"import", "cells.ovm", "--tissue", "1", "-o", "out.ovm"},
                 {"not a triangle", "--simplicial"});
  EXPECT_GT(import("cells.ovm", {"--simplicial", "--tissue", "1"}).at("tissue").at("solid_cells").get<int>(),
            11);
  write("open.off", open_cube_off());
  expect_failure(3, {"import", "open.off", "--strict", "--tissue", "1", "-o", "out.ovm"},
                 {"surface is open"});
  EXPECT_GT(import("open.off", {"--tissue", "1"}).at("tissue").at("solid_cells").get<int>(), 11);
}

/// Groups are found again among cells that are surrounded by others.
TEST_F(Import, KeepsGroupsInTissue) {
  succeed({"generate", "tets", "--cells", "2", "-o", "tets.ovm"});
  const auto before = import("tets.ovm").at("certificate");
  const int cells = before.at("cells"), facets = before.at("facets");
  std::string all, first = "1";
  for (int i = 0; i < facets; ++i) all += "1 ";
  for (int i = 1; i < cells; ++i) first += " 0";
  write("named.ovm", text("tets.ovm") + "FProp bool \"group all\"\n" + all + "\nCProp bool \"group plug\"\n" +
                         first + "\n");
  const int solid = import("named.ovm", {"--tissue", "1"}).at("certificate").at("solid_cells");
  write("changes.json", R"({"changes": [{"close": "all"}, {"fill": "plug"}]})");
  succeed({"edit", "env.ovm", "changes.json", "-o", "out.ovm", "--json", "edit.json"});
  const auto report = nlohmann::json::parse(text("edit.json"));
  EXPECT_EQ(report.at("changes").at("closed"), facets - before.at("boundary_facets").get<int>());
  EXPECT_EQ(report.at("changes").at("filled"), 1);
  EXPECT_EQ(report.at("certificate").at("solid_cells"), solid + 1);
}

TEST_F(Import, TurnsAnInsideOutSurfaceRoundAndSaysSo) {
  write("cube.off", cube_off(1, 0, true));
  EXPECT_EQ(import("cube.off").at("meshed").at("surface").at("inside_out"), true);
}

TEST_F(Import, CapsAnOpenSurfaceUnlessItIsStrict) {
  write("open.off", open_cube_off());
  expect_failure(3, {"import", "open.off", "-o", "out.ovm", "--strict"}, {"open.off: surface is open"});
  const auto report = import("open.off");
  EXPECT_EQ(report.at("certificate").at("volume"), 1);
  const auto& parts = report.at("repaired").at("parts");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].at("name"), "cap_1");
  EXPECT_EQ(parts[0].at("area"), 0.5);
  EXPECT_NE(text("env.ovm").find("group cap_1"), std::string::npos);
  EXPECT_NE(said_.find("cap_1: 3 edges, area 0.5, "), std::string::npos) << said_;
}

TEST_F(Import, NamesCapsByTheirPlaces) {
  // Both ends of a box of 4 quadrangles.
  write("duct.off",
        "OFF\n8 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 3\n1 0 3\n1 1 3\n0 1 3\n"
        "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  write("names.json", R"({"outlet": [0, 0, 9], "inlet": [0, 0, -1]})");
  const auto report = import("duct.off", {"--names", "names.json"});
  EXPECT_EQ(report.at("certificate").at("volume"), 3);
  for (const auto& part : report.at("repaired").at("parts"))
    EXPECT_EQ(part.at("name"), part.at("centre")[2] == 3 ? "outlet" : "inlet");
  EXPECT_NE(text("env.ovm").find("group inlet"), std::string::npos);
  EXPECT_EQ(text("env.ovm").find("group cap"), std::string::npos);
  write("same.json", R"({"outlet": [0, 0, 9], "inlet": [0, 0, 8]})");
  expect_failure(2, {"import", "duct.off", "-o", "out.ovm", "--names", "same.json"},
                 {"inlet and outlet are nearest to the same cap or mouth"});
}

/// What is accepted as it is gives the same cells with and without repairs.
TEST_F(Import, RepairsNothingThatIsSound) {
  write("cube.off", cube_off());
  import("cube.off", {"--strict"});
  const std::string bytes = text("env.ovm");
  const auto report = import("cube.off");
  EXPECT_FALSE(report.contains("repaired"));
  EXPECT_EQ(text("env.ovm"), bytes);
}

TEST_F(Import, MeshesTheSpaceAroundAPoint) {
  // A cube in a cube, as one surface: hollow between them, and a room within.
  std::string both = cube_off(4);
  both.replace(both.find("8 12 0"), 6, "16 24 0");
  const std::string inner = cube_off(1, 0.5);
  std::istringstream in(inner);
  std::string line, points, facets;
  std::getline(in, line), std::getline(in, line);
  for (int i = 0; i < 8; ++i) std::getline(in, line), points += line + "\n";
  while (in >> line) {
    std::uint32_t a = 0, b = 0, c = 0;
    in >> a >> b >> c;
    facets += "3 " + std::to_string(a + 8) + " " + std::to_string(b + 8) + " " + std::to_string(c + 8) + "\n";
  }
  both.insert(both.find("\n3 ") + 1, points);
  write("both.off", both + facets);
  EXPECT_NEAR(import("both.off").at("certificate").at("volume").get<double>(), 63, 1e-12);
  EXPECT_NEAR(import("both.off", {"--inside", "1,1,1"}).at("certificate").at("volume").get<double>(), 1,
              1e-12);
  EXPECT_NEAR(import("both.off", {"--inside", "3,3,3"}).at("certificate").at("volume").get<double>(), 63,
              1e-12);
}

TEST_F(Import, FillsAPlanarDomainWithHoles) {
  write("room.poly", room_poly());
  const auto report = import("room.poly");
  EXPECT_EQ(report.at("certificate").at("dimension"), 2);
  EXPECT_EQ(report.at("certificate").at("volume"), 15);
  const auto kept = import("room.poly", {"--keep-obstacles"});
  EXPECT_EQ(kept.at("certificate").at("volume"), 16);
  EXPECT_EQ(kept.at("certificate").at("free_volume"), 15);
}
#endif

}  // namespace
}  // namespace cellwalk::test
