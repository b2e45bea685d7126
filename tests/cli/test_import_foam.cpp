// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes of OpenFOAM become environments: certified, with the volume of the block, and with walls where a
// brute-force look at the motion finds them.
#include <nlohmann/json.hpp>

#include <random>

#include "cli/query/query_table.h"
#include "io/mesh/foam_mesh.h"

namespace cellwalk::test {
namespace {

class ImportFoam : public Query_table {
 protected:
  enum Column { row, status, time };

  ImportFoam()
      : Query_table({"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"}) {}

  void write_mesh(const Foam_mesh& mesh, const Foam_encoding& encoding = {}) const {
    write_foam(path("case/constant/polyMesh"), Foam_writer(encoding).files(mesh));
  }

  nlohmann::json import(const std::string& name) {
    said_ = succeed({"import", name, "-o", "env.ovm", "--json", "report.json"});
    return nlohmann::json::parse(text("report.json"));
  }
};

TEST_F(ImportFoam, ABlockWithAPolyhedronIsCertifiedAsItIs) {
  std::string first;
  for (const Foam_encoding& encoding : {Foam_encoding{}, Foam_encoding{true, 64, 64}}) {
    write_mesh(foam_block(3), encoding);
    const auto report = import("case");
    EXPECT_EQ(report.at("changed").at("cells_split"), 0);
    const auto& certificate = report.at("certificate");
    EXPECT_EQ(certificate.at("cells"), 26);
    EXPECT_EQ(certificate.at("volume"), 27);
    EXPECT_EQ(certificate.at("walls"), 54);
    EXPECT_EQ(certificate.at("membranes"), 0);
    EXPECT_EQ(certificate.at("components"), 1);
    EXPECT_NE(text("env.ovm").find("FProp bool \"group inlet\""), std::string::npos);
    if (first.empty()) first = text("env.ovm");
    EXPECT_EQ(text("env.ovm"), first);
  }
}

/// A cube of side 2 beside four of side 1, as local refinement makes them: corners of the small cells lie
/// within sides of the large one's facets.
Foam_mesh refined() {
  Foam_mesh mesh;
  std::map<std::array<int, 3>, std::int64_t> numbers;
  using Corners = std::vector<std::array<int, 3>>;
  const auto add = [&](const Corners& corners, std::int64_t owner, std::int64_t neighbour) {
    std::vector<std::int64_t> loop;
    for (const auto& p : corners) {
      const auto [number, is_new] = numbers.try_emplace(p, std::int64_t(numbers.size()));
      if (is_new) mesh.points.push_back({double(p[0]), double(p[1]), double(p[2])});
      loop.push_back(number->second);
    }
    mesh.faces.push_back(loop);
    mesh.owner.push_back(owner);
    if (neighbour >= 0) mesh.neighbour.push_back(neighbour);
  };
  const auto facing_x = [](int x, int j, int k) {
    return Corners{{x, j, k}, {x, j + 1, k}, {x, j + 1, k + 1}, {x, j, k + 1}};
  };
  const auto facing_y = [](int y, int k) {
    return Corners{{2, y, k}, {2, y, k + 1}, {3, y, k + 1}, {3, y, k}};
  };
  const auto facing_z = [](int z, int j) {
    return Corners{{2, j, z}, {3, j, z}, {3, j + 1, z}, {2, j + 1, z}};
  };
  const auto turned = [](const Corners& c) { return Corners(c.rbegin(), c.rend()); };
  for (int c = 0; c < 4; ++c) add(facing_x(2, c % 2, c / 2), 0, 1 + c);
  add(facing_y(1, 0), 1, 2);
  add(facing_z(1, 0), 1, 3);
  add(facing_z(1, 1), 2, 4);
  add(facing_y(1, 1), 3, 4);
  add({{0, 0, 0}, {0, 0, 2}, {0, 2, 2}, {0, 2, 0}}, 0, -1);
  add({{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 1, 0}, {2, 0, 0}}, 0, -1);
  add({{0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {2, 2, 2}, {0, 2, 2}}, 0, -1);
  add({{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {2, 0, 2}, {0, 0, 2}}, 0, -1);
  add({{0, 2, 0}, {0, 2, 2}, {2, 2, 2}, {2, 2, 1}, {2, 2, 0}}, 0, -1);
  for (int c = 0; c < 4; ++c) {
    const int j = c % 2, k = c / 2;
    add(facing_x(3, j, k), 1 + c, -1);
    add(j == 0 ? turned(facing_y(0, k)) : facing_y(2, k), 1 + c, -1);
    add(k == 0 ? turned(facing_z(0, j)) : facing_z(2, j), 1 + c, -1);
  }
  mesh.patches = {{"walls", "wall", mesh.neighbour.size(), mesh.faces.size() - mesh.neighbour.size()}};
  return mesh;
}

TEST_F(ImportFoam, LocallyRefinedCellsAreCertifiedAsTheyAre) {
  write_mesh(refined());
  const auto report = import("case/constant/polyMesh");
  EXPECT_EQ(report.at("changed").at("cells_split"), 0);
  EXPECT_EQ(report.at("certificate").at("cells"), 5);
  EXPECT_EQ(report.at("certificate").at("volume"), 12);
  EXPECT_EQ(report.at("certificate").at("walls"), 17);
  EXPECT_EQ(report.at("certificate").at("components"), 1);
}

TEST_F(ImportFoam, ACellThatIsNotPlanarIsSplit) {
  Foam_mesh mesh = foam_block(3);
  mesh.points[21] = {1.25, 1, 1};  // a corner inside the block
  write_mesh(mesh);
  const auto report = import("case");
  EXPECT_GT(report.at("changed").at("cells_split"), 0);
  EXPECT_NEAR(report.at("certificate").at("volume").get<double>(), 27, 1e-12);
  EXPECT_EQ(report.at("certificate").at("membranes"), 0);
  EXPECT_EQ(report.at("certificate").at("components"), 1);
}

TEST_F(ImportFoam, MotionsStopAtABaffleAndPassAllOtherFaces) {
  Foam_mesh mesh = foam_block(3);
  make_baffle(mesh, 12, 13);  // x = 2, 1 <= y <= 2, 1 <= z <= 2; cell c is the cube c + 1
  make_baffle(mesh, 20, 23, "cyclic");
  write_mesh(mesh);
  const auto report = import("case");
  EXPECT_EQ(report.at("certificate").at("membranes"), 2);
  EXPECT_EQ(report.at("certificate").at("walls"), 56);
  EXPECT_NE(said_.find("2 pairs of boundary faces with the same points, read as walls (baffles)"),
            std::string::npos)
      << said_;
  EXPECT_NE(said_.find("cyclic patches are walls, not passages: front, back (2 faces)"), std::string::npos)
      << said_;

  struct Motion {
    std::array<double, 3> from, to;
  };
  std::mt19937 random(7);
  std::vector<Motion> motions;
  std::string table = "ax,ay,az,bx,by,bz\n";
  for (int i = 0; i < 2000; ++i) {
    Motion m;
    for (auto* p : {&m.from, &m.to})
      for (double& x : *p) {
        x = 3 * (static_cast<double>(random() % 1024) + 0.5) / 1024;
        table += std::to_string(x) + (p == &m.to && &x == &p->back() ? "\n" : ",");
      }
    motions.push_back(m);
  }
  const auto rows = query(table);
  ASSERT_EQ(rows.size(), motions.size());
  // Where the motion passes x = 2, between cubes 13 and 14, and y = 2, between cubes 21 and 24.
  const auto time_through = [](const Motion& m, std::size_t axis, double at,
                               const std::array<double, 3>& low) {
    const double t = (at - m.from[axis]) / (m.to[axis] - m.from[axis]);
    if (!(t > 0 && t < 1)) return 2.;
    for (std::size_t k = 0; k < 3; ++k)
      if (const double x = m.from[k] + t * (m.to[k] - m.from[k]); k != axis && (x < low[k] || x > low[k] + 1))
        return 2.;
    return t;
  };
  std::size_t free = 0, stopped = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double expected =
        std::min(time_through(motions[i], 0, 2, {2, 1, 1}), time_through(motions[i], 1, 2, {0, 0, 2}));
    if (expected > 1) {
      ++free;
      EXPECT_EQ(rows[i][status], "free") << i;
    } else {
      ++stopped;
      EXPECT_EQ(rows[i][status], "contact") << i;
      EXPECT_NEAR(std::stod(rows[i][time]), expected, 1e-5) << i;
    }
  }
  EXPECT_GT(free, 1500u);
  EXPECT_GT(stopped, 100u);
}

TEST_F(ImportFoam, IsReadWhereverCellsAre) {
  write_mesh(foam_block(2));
  succeed({"check", "case"});
  succeed({"check", "case/constant/polyMesh/points"});
  write("case/constant/polyMesh/owner", "not a list\n");
  expect_failure(3, {"check", "case"}, {"polyMesh/owner:1: not a file of OpenFOAM"});
  std::filesystem::remove(path("case/constant/polyMesh/owner"));
  expect_failure(3, {"check", "case"}, {"polyMesh/owner: is missing"});
}

}  // namespace
}  // namespace cellwalk::test
