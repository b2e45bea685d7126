// SPDX-License-Identifier: LGPL-3.0-or-later
// Hexahedra, prisms and pyramids with corners merged along edges in every way, against the volume of the cell
// as it was before.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "io/io_fixture.h"
#include "io/mesh/collapsed_cells.h"
#include "volumes.h"

namespace cellwalk::io {
namespace {

using Corner = std::uint32_t;
using Merged = std::vector<Corner>;  ///< for each corner the one that stands for it

/// A cell over points that are no cube, so that no two volumes are equal by chance.
Cell_soup<3> cell_of(const Merged& v) {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {7, 1, 0}, {8, 9, 1}, {1, 7, 0}, {0, 1, 8}, {9, 0, 9}, {8, 8, 11}, {1, 9, 7}};
  if (v.size() == 8) add_hexahedron(soup, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
  if (v.size() == 6) add_prism(soup, {v[0], v[1], v[2], v[3], v[4], v[5]});
  if (v.size() == 5) add_pyramid(soup, {v[0], v[1], v[2], v[3], v[4]});
  return soup;
}

/// All ways to merge corners along edges.
std::set<Merged> mergings(std::size_t corners) {
  Merged own(corners);
  std::iota(own.begin(), own.end(), 0u);
  std::set<std::pair<Corner, Corner>> edges;
  const Cell_soup<3> whole = cell_of(own);
  for (std::size_t f = 0; f < whole.facet_count(); ++f)
    for (std::size_t i = 0; i < whole.facet(f).size(); ++i)
      edges.insert(std::minmax(whole.facet(f)[i], whole.facet(f)[(i + 1) % whole.facet(f).size()]));
  std::set<Merged> found{own};
  for (const auto& [a, b] : edges) {
    std::set<Merged> more;
    for (Merged merged : found) {
      const Corner low = std::min(merged[a], merged[b]), high = std::max(merged[a], merged[b]);
      for (Corner& c : merged)
        if (c == high) c = low;
      more.insert(merged);
    }
    found.merge(more);
  }
  return found;
}

bool has_repeated_corner(const Cell_soup<3>& soup) {
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto loop = soup.facet(f);
    if (std::set<Corner>(loop.begin(), loop.end()).size() != loop.size()) return true;
  }
  return false;
}

/// True if some choice of the diagonals of its facets, which may be bent, leaves a cell without volume.
bool may_be_empty(const Cell_soup<3>& cell) {
  const std::size_t facets = cell.facet_count();
  for (std::size_t choice = 0; choice < std::size_t{1} << facets; ++choice) {
    Cell_soup<3> turned = cell;
    for (std::size_t f = 0; f < facets; ++f)
      if (choice >> f & 1)
        std::rotate(turned.vertices.begin() + turned.facet_begin[f],
                    turned.vertices.begin() + turned.facet_begin[f] + 1,
                    turned.vertices.begin() + turned.facet_begin[f + 1]);
    if (six_volumes(turned, 0) == 0) return true;
  }
  return false;
}

struct Outcome {
  int whole = 0, read = 0, without_inside = 0, pinched = 0;
};

Outcome settle_all(std::size_t corners) {
  Outcome outcome;
  for (const Merged& merged : mergings(corners)) {
    const Cell_soup<3> before = cell_of(merged);
    Cell_soup<3> soup = before;
    Collapsed_cells collapsed;
    try {
      collapsed.settle_last(soup, "f", "cell 0");
    } catch (const Error&) {
      ++outcome.without_inside;
      EXPECT_TRUE(may_be_empty(before)) << testing::PrintToString(merged);
      continue;
    }
    EXPECT_EQ(six_volumes(soup, 0), six_volumes(before, 0)) << testing::PrintToString(merged);
    if (!has_repeated_corner(before)) {
      ++outcome.whole;
      EXPECT_EQ(soup.vertices, before.vertices);
    } else if (has_repeated_corner(soup)) {
      ++outcome.pinched;
      EXPECT_EQ(soup.vertices, before.vertices) << "it is refused as it is";
    } else {
      ++outcome.read;
      EXPECT_TRUE(all_closed(soup)) << testing::PrintToString(merged);
      EXPECT_EQ(soup.facet_begin.back(), soup.vertices.size());
      EXPECT_EQ(soup.impassable.size(), soup.facet_count());
      EXPECT_GE(soup.facet_count(), 4u);
    }
  }
  return outcome;
}

TEST(CollapsedCells, HexahedraKeepTheirVolumeInEveryWayToMergeCorners) {
  const Outcome outcome = settle_all(8);
  EXPECT_EQ(outcome.whole, 1);
  EXPECT_GT(outcome.read, 200);
  EXPECT_GT(outcome.without_inside, 50);
  EXPECT_GT(outcome.read + outcome.without_inside + outcome.pinched, 900);
}

TEST(CollapsedCells, PrismsAndPyramidsDoToo) {
  const Outcome prisms = settle_all(6), pyramids = settle_all(5);
  EXPECT_EQ(prisms.whole + pyramids.whole, 2);
  EXPECT_GT(prisms.read, 10);
  EXPECT_GT(pyramids.read, 2);
  EXPECT_GT(prisms.without_inside + pyramids.without_inside, 20);
}

const std::string four_cells =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n"
    "7 1 1 1\n8 0 1 1\n9 2 0.5 0\n10 2 0.5 1\n11 0.5 0.5 2\n$EndNodes\n$Elements\n4\n"
    "1 5 0 1 2 3 4 5 6 7 8\n2 5 0 2 9 9 3 6 10 10 7\n3 5 0 5 6 7 8 11 11 11 11\n4 5 0 6 10 7 7 11 11 11 11\n"
    "$EndElements\n";

TEST(CollapsedCells, AreCountedByTheirShapes) {
  const Mesh_file file = read_mesh("t.msh", four_cells);
  EXPECT_EQ(six_volumes(std::get<Cell_soup<3>>(file.mesh)), (std::vector<double>{6, 3, 2, 1}));
  EXPECT_EQ(shared_facets(std::get<Cell_soup<3>>(file.mesh)), 4u);
  EXPECT_EQ(file.report.collapsed, 3u);
  EXPECT_EQ(file.report.notes,
            (std::vector<std::string>{
                "3 collapsed cells read without repeated corners: 1 wedges, 1 pyramids, 1 tetrahedra"}));
}

TEST(CollapsedCells, CornersInOnePlaceAreOne) {
  // Node 12 is where node 9 is.
  std::string text = with(with(four_cells, "11\n1 0", "12\n12 2 0.5 0\n1 0"), "2 9 9 3", "2 9 12 3");
  const Mesh_file file = read_mesh("t.msh", text);
  EXPECT_EQ(six_volumes(std::get<Cell_soup<3>>(file.mesh)), (std::vector<double>{6, 3, 2, 1}));
  EXPECT_EQ(file.report.collapsed, 3u);
}

TEST(CollapsedCells, WithoutInsideAreRefusedByNumber) {
  EXPECT_EQ(refusal([] { read_mesh("t.msh", with(four_cells, "5 6 7 8 11 11 11 11", "5 6 7 8 5 6 7 8")); }),
            "t.msh: element 3 has no inside: its corners repeat, and 0 facets are left");
}

TEST(CollapsedCells, QuadrilateralsInThePlaneAreTriangles) {
  const Mesh_file file = read_mesh(
      "t.msh", std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 "
                           "1 0\n5 2 0 0\n$EndNodes\n"
                           "$Elements\n3\n1 3 0 1 2 3 4\n2 3 0 2 5 5 3\n3 2 0 1 2 3\n$EndElements\n"));
  const auto& cells = std::get<Cell_soup<2>>(file.mesh);
  EXPECT_EQ(cells.cell_begin, (std::vector<std::uint32_t>{0, 4, 7, 10}));
  EXPECT_EQ(file.report.collapsed, 1u);
  EXPECT_EQ(file.report.notes.front(), "1 collapsed polygons read without repeated corners, as triangles");
}

}  // namespace
}  // namespace cellwalk::io
