// SPDX-License-Identifier: LGPL-3.0-or-later
// What an edit leaves of the geometry of cells: loops by whose first vertices a side can be told, and the
// count of planes.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "snapshot_checks.h"

namespace cellwalk {
namespace {

/// Loops whose first three vertices lie on one line: nothing is on either side of their facets.
std::size_t blind_loops(const Snapshot<3>& snapshot) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const auto loop = snapshot.loop(snapshot.half_facet(snapshot.cell(i), k));
      n += are_collinear(snapshot.point(loop[0]), snapshot.point(loop[1]), snapshot.point(loop[2]));
    }
  return n;
}

/// Facets whose stored planes certify nothing.
template <int D>
std::size_t blind_planes(const Snapshot<D>& snapshot) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Plane_block<D>& block = snapshot.blocks(c)[k / 4];
      bool is_blind = block.offset[k % 4] == 0;
      for (int d = 0; d < D; ++d) is_blind = is_blind && block.normal[d][k % 4] == 0;
      n += is_blind;
    }
  }
  return n;
}

/// Two pyramids on the two sides of a square in the plane z = 0.
Cell_soup<3> octahedron() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 3}, {2, 2, -3}};
  add_pyramid(soup, {0, 1, 2, 3, 4});
  add_pyramid(soup, {3, 2, 1, 0, 5});
  return soup;
}

/// The facet of a cell in the plane z = 0.
std::size_t base_of(const Snapshot<3>& snapshot, Cell c) {
  std::size_t k = 0;
  while (snapshot.loop(snapshot.half_facet(c, k)).size() != 4) ++k;
  return k;
}

TEST(EditGeometry, TurnsLoopsWhoseFirstVerticesComeToLieOnOneLine) {
  std::size_t turned = 0;
  for (std::uint32_t v = 0; v < 4; ++v) {
    SCOPED_TRACE(v);
    Environment<3> environment = Environment<3>::build(octahedron());
    const Snapshot<3>& snapshot = environment.snapshot();
    const std::array<Cell, 2> cells{snapshot.cell(0), snapshot.cell(1)};
    std::array<std::size_t, 2> base;
    std::array<std::vector<std::uint32_t>, 2> before;
    for (std::size_t i = 0; i < 2; ++i) {
      base[i] = base_of(snapshot, cells[i]);
      before[i] = snapshot.loop(snapshot.half_facet(cells[i], base[i]));
    }
    // Into the diagonal of the square: the vertex and its two neighbours lie on one line then.
    environment.move_vertex(v, {2, 2, 0});
    EXPECT_EQ(blind_loops(snapshot), 0u);
    EXPECT_NO_THROW(environment.certify());
    test::expect_planes_hold(snapshot, v);
    for (std::size_t i = 0; i < 2; ++i) {
      // The half-facet keeps its name; at most another vertex of its loop comes first.
      std::vector<std::uint32_t> loop = snapshot.loop(snapshot.half_facet(cells[i], base[i]));
      turned += loop != before[i];
      std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), before[i][0]), loop.end());
      EXPECT_EQ(loop, before[i]);
      const double out = i == 0 ? -1 : 1;
      EXPECT_EQ(test::exact_side(snapshot.view(cells[i]), base[i], {2, 2, out}), 1);
      EXPECT_EQ(test::exact_side(snapshot.view(cells[i]), base[i], {2, 2, -out}), -1);
    }
    // And back: what is certified then is what was before.
    environment.move_vertex(v, octahedron().points[v]);
    const auto built = Environment<3>::build(octahedron());
    EXPECT_EQ(test::facts(snapshot), test::facts(built.snapshot()));
  }
  EXPECT_EQ(turned, 2u) << "of each cell, the loop in which one of the vertices came second";
}

TEST(EditGeometry, CertifyNoticesALoopByWhichNoSideCanBeTold) {
  // A point moved behind the environment's back: all cells are sound, but walks could not see the wall.
  std::size_t refused = 0;
  for (std::uint32_t v = 0; v < 4; ++v) {
    const auto environment = Environment<3>::build(octahedron());
    Snapshot<3> snapshot = environment.snapshot();
    snapshot.move_point(v, {2, 2, 0});
    if (blind_loops(snapshot) == 0) continue;
    ++refused;
    try {
      certify(snapshot);
      ADD_FAILURE() << "certified";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::not_certified);
      EXPECT_NE(std::string(error.what()).find("first three vertices on one line"), std::string::npos)
          << error.what();
    }
    snapshot.update_geometry(std::vector<Cell>{snapshot.cell(0), snapshot.cell(1)});
    EXPECT_EQ(blind_loops(snapshot), 0u);
    EXPECT_NO_THROW(certify(snapshot));
  }
  EXPECT_EQ(refused, 2u);
}

template <int D>
void expect_planes_certified() {
  Simplex_grid_options<D> grid;
  grid.cells.fill(3);
  Environment<D> environment = [&] {
    if constexpr (D == 2)
      return Environment<D>::build(triangle_grid(grid));
    else
      return Environment<D>::build(tetrahedral_grid(grid));
  }();
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(11);
  std::size_t moved = 0, frames = 0;
  for (int i = 0; i < 200; ++i) {
    const std::size_t before = snapshot.uncertified_planes();
    const double scale = snapshot.frame().scale;
    const auto p = static_cast<std::uint32_t>(random.below(snapshot.points().size()));
    Point<D> target = snapshot.point(p);
    // Far out of the frame, for which planes are made anew then, or back.
    const bool is_out = std::abs(target[0]) > 5;
    target[0] += is_out               ? (target[0] > 0 ? -8 : 8)
                 : random.chance(0.2) ? (target[0] > 1.5 ? 8 : -8)
                                      : random.real(-0.2, 0.2);
    try {
      environment.move_vertex(p, target);
      ++moved;
    } catch (const Error&) {
      EXPECT_EQ(snapshot.uncertified_planes(), before);
    }
    if (i % 20 == 0)
      environment.insert_point(snapshot.cell(i / 20),
                               test::mean_of_vertices(snapshot.view(snapshot.cell(i / 20))));
    EXPECT_EQ(snapshot.uncertified_planes(), blind_planes(snapshot));
    EXPECT_EQ(snapshot.uncertified_planes(), 0u);
    frames += snapshot.frame().scale != scale;
    Float_point<D> mapped;
    for (const Point<D>& x : snapshot.points()) EXPECT_TRUE(snapshot.frame().map(x, mapped));
  }
  EXPECT_GT(moved, 50u);
  EXPECT_GT(frames, 0u);
}

TEST(EditGeometry, CertifiesPlanesOutOfTheFrame2) { expect_planes_certified<2>(); }
TEST(EditGeometry, CertifiesPlanesOutOfTheFrame3) { expect_planes_certified<3>(); }

}  // namespace
}  // namespace cellwalk
