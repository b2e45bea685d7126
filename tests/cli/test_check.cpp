// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

using Check = Program;

TEST_F(Check, PrintsWhatAnEnvironmentHolds) {
  succeed({"generate", "hexes", "--cells", "4", "3", "2", "-o", "env.ovm"});
  const std::string text = succeed({"check", "env.ovm", "--json", "report.json"});
  EXPECT_TRUE(text.starts_with("env.ovm: certified, 3D\n")) << text;
  EXPECT_NE(text.find("24 (0 solid)"), std::string::npos) << text;

  const auto certificate = nlohmann::json::parse(this->text("report.json")).at("certificate");
  EXPECT_EQ(certificate.at("dimension"), 3);
  EXPECT_EQ(certificate.at("cells"), 24);
  EXPECT_EQ(certificate.at("facets"), 5 * 6 + 4 * 8 + 3 * 12);
  EXPECT_EQ(certificate.at("walls"), 2 * (6 + 8 + 12));
  EXPECT_EQ(certificate.at("walls"), certificate.at("boundary_facets"));
  EXPECT_EQ(certificate.at("vertices"), 60);
  EXPECT_EQ(certificate.at("ridges"), 4 * 4 * 3 + 5 * 3 * 3 + 5 * 4 * 2);
  EXPECT_EQ(certificate.at("components"), 1);
  EXPECT_EQ(certificate.at("volume"), 24);
  EXPECT_EQ(certificate.at("free_volume"), 24);
}

TEST_F(Check, CountsSolidCellsOfThePlane) {
  succeed({"generate", "squares", "--cells", "8", "--solid", "0.125", "-o", "env.ovm"});
  succeed({"check", "env.ovm", "--json", "report.json"});
  const auto certificate = nlohmann::json::parse(text("report.json")).at("certificate");
  EXPECT_EQ(certificate.at("dimension"), 2);
  EXPECT_EQ(certificate.at("cells"), 64);
  EXPECT_EQ(certificate.at("solid_cells"), 8);
  EXPECT_EQ(certificate.at("volume"), 64);
  EXPECT_EQ(certificate.at("free_volume"), 56);
}

TEST_F(Check, SaysHowManyCellsEdgesLieIn) {
  succeed({"generate", "hexes", "--cells", "12", "12", "6", "-o", "env.ovm"});
  const std::string text = succeed({"check", "env.ovm", "--edge-length", "0.5", "--json", "report.json"});
  const auto edges = nlohmann::json::parse(this->text("report.json")).at("edge_cells");
  EXPECT_EQ(edges.at("length"), 0.5);
  EXPECT_EQ(edges.at("wall_distance"), 6) << "4 * 864 / 576";
  EXPECT_EQ(edges.at("edges"), 4096);
  EXPECT_GT(edges.at("blocked"), 100);
  EXPECT_GT(edges.at("mean_cells"), 1.6);
  EXPECT_LT(edges.at("mean_cells"), 1.75);
  EXPECT_NE(text.find("\n  body edges  of length 0.5 lie in 1."), std::string::npos) << text;
  EXPECT_NE(text.find(" cells on average; walls are 6 apart\n"), std::string::npos) << text;

  succeed({"check", "env.ovm", "--json", "report.json"});
  EXPECT_EQ(nlohmann::json::parse(this->text("report.json")).at("edge_cells").at("length"), 0.1 * 6);
  const std::string too_long = succeed({"check", "env.ovm", "--edge-length", "50"});
  EXPECT_NE(too_long.find("  body edges  of length 50 do not fit; walls are 6 apart\n"), std::string::npos)
      << too_long;
  for (const char* length : {"0", "-1", "nan", "inf"})
    expect_failure(2, {"check", "env.ovm", "--edge-length", length},
                   {"--edge-length: takes a number greater than 0, not ", length});
}

TEST_F(Check, EndsWith3WhereTheFileIsMissingBrokenOrHasNoCells) {
  expect_failure(3, {"check", "missing.ovm"}, {"missing.ovm"});
  write("broken.ovm", "OVM ASCII\nVertices\n2\n0 0 0\n0 zero 0\n");
  expect_failure(3, {"check", "broken.ovm"}, {"broken.ovm:5"});
  write("surface.off", cube_off());
  expect_failure(3, {"check", "surface.off"}, {"surface.off: holds a surface", "cellwalk import"});
}

TEST_F(Check, EndsWith4WhereACellIsNotExact) {
  write("bulged.ovm", hexahedron_ovm(0.25));
  expect_failure(4, {"check", "bulged.ovm"}, {"bulged.ovm: ", "cell 0", "planar"});
  write("flat.ovm", hexahedron_ovm(0));
  succeed({"check", "flat.ovm"});
}

}  // namespace
}  // namespace cellwalk::test
