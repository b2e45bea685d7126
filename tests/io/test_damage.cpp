// SPDX-License-Identifier: LGPL-3.0-or-later
// Files damaged at random: whatever the damage, they are read or refused with a reason.
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/internal/io/planar_file.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <set>

#include "damaged.h"
#include "io_fixture.h"
#include "records/body_checks.h"

namespace cellwalk::io {
namespace {

struct Damage {
  std::size_t read = 0, refused = 0;
  std::set<std::string> reasons;
};

template <class Read>
Damage damage(const std::string& text, Read read) {
  std::mt19937 random(42);
  Damage result;
  for (int i = 0; i < 3000; ++i) {
    const std::string broken = damaged(text, random);
    try {
      read(broken);
      ++result.read;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::input) << e.what();
      ++result.refused;
      result.reasons.insert(e.what());
    }
  }
  return result;
}

/// Most damage is seen, some hits comments or makes another good file, and the reasons are many.
void expect_both_outcomes(const Damage& damage) {
  EXPECT_GT(damage.read, 30u);
  EXPECT_GT(damage.refused, 500u);
  EXPECT_GT(damage.reasons.size(), 50u);
}

TEST(DamagedFiles, Ovm) {
  const std::string text =
      "OVM ASCII\nVertices\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nEdges\n6\n0 1\n1 2\n2 0\n0 3\n1 3\n2 "
      "3\nFaces\n4\n3 0 2 4\n3 0 8 7\n"
      "3 2 10 9\n3 4 6 11\nPolyhedra\n1\n4 1 2 4 6\nFProp bool \"impassable\"\n1\n0\n0\n0\nCProp bool "
      "\"solid\"\n0\n"
      "VProp float \"weight\"\n1\n2\n3\n4\n";
  expect_both_outcomes(damage(text, [](const std::string& t) { parse_ovm("t.ovm", t); }));
}

TEST(DamagedFiles, Surfaces) {
  const std::string off =
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n# facets\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  expect_both_outcomes(damage(off, [](const std::string& t) { parse_surface("t", t, Surface_format::off); }));
  const std::string obj =
      "# four\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/2 4/4\nf -3 -2 -1\nf 3 1 4\n";
  expect_both_outcomes(damage(obj, [](const std::string& t) { parse_surface("t", t, Surface_format::obj); }));
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid a\n";
  expect_both_outcomes(damage(stl, [](const std::string& t) { parse_surface("t", t, Surface_format::stl); }));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_both_outcomes(damage(ply, [](const std::string& t) { parse_surface("t", t, Surface_format::ply); }));
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
  binary += std::string(36, '\0') + std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0", 16);
  expect_both_outcomes(
      damage(binary, [](const std::string& t) { parse_surface("t", t, Surface_format::ply); }));
}

TEST(DamagedFiles, Bodies) {
  const Folder folder;
  const auto expect_bodies_or_reasons = [&](const std::string& name, const std::string& text) {
    SCOPED_TRACE(name);
    const Damage result = damage(text, [&](const std::string& t) {
      ASSERT_EQ(test::flaw(read_body<2>(folder.write(name, t)).body), "");
    });
    expect_both_outcomes(result);
  };
  expect_bodies_or_reasons("b.off",
                           "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 3 0\n3 0 2 1\n2 0 3\n1 2\n# no more\n");
  expect_bodies_or_reasons("b.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 \\\n 3 -1\nf 1/1 2/2 3\nl 3 2\n# no more\n");
  expect_bodies_or_reasons("b.ply",
                           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n"
                           "property float radius\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 1 0.5\n2 1 1e2\n");
  expect_bodies_or_reasons("b.csv",
                           "x,y,name,radius\n0,1,a,0.5\n1/2,0x1p-3,b,0x1p-3\n-1e5,+3,c,\n# no more\n");
}

TEST(DamagedFiles, DomainsOfThePlane) {
  const std::string wkt = "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1))\n# an end\n";
  expect_both_outcomes(damage(wkt, [](const std::string& t) { parse_wkt("t.wkt", t); }));
  const std::string poly =
      "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 1.5 1.5\n# end\n";
  expect_both_outcomes(damage(poly, [](const std::string& t) { parse_poly("t.poly", t); }));
}

TEST(DamagedFiles, Tables) {
  const std::string text = "ax,ay,bx,by\n1,2,3,4\n\"1/2\",0x1p-3,-0,1e5\n5,6,7,8\n";
  const Damage tables = damage(text, [](const std::string& t) {
    const Csv_table table = Csv_table::parse("t.csv", t);
    for (std::size_t r = 0; r < table.row_count(); ++r)
      for (std::size_t c = 0; c < table.columns().size(); ++c) table.number(r, c);
  });
  EXPECT_GT(tables.read, 500u);
  EXPECT_GT(tables.refused, 50u);
}

}  // namespace
}  // namespace cellwalk::io
