// SPDX-License-Identifier: LGPL-3.0-or-later
// Vertices of the boundary that move: what they may not run into, and what is not asked.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "certify_samples.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

/// A fan of simplices round the first point, open on one side, beside a grid.
Cell_soup<2> fan_beside_grid() {
  Cell_soup<2> fan;
  fan.points = {{-2, 1}, {-2, -1}, {-4, 0}, {-5, 1}, {-4, 3}, {-2, 4}};
  for (std::uint32_t i = 1; i < 5; ++i) add_polygon(fan, std::array<std::uint32_t, 3>{0, i + 1, i});
  test::append(fan, triangle_grid({.cells = {3, 3}}), false);
  return fan;
}

Cell_soup<3> fan_beside_grid_3() {
  Cell_soup<3> fan;
  fan.points = {{-2, 1, 1}, {-4, 0, 0}, {-4, 3, 0}, {-4, 3, 3}, {-4, 0, 3}, {-3, -1, 4}};
  add_pyramid(fan, {1, 2, 3, 4, 0});
  add_tetrahedron(fan, 0, 4, 1, 5);
  test::append(fan, tetrahedral_grid({.cells = {2, 2, 2}}), false);
  return fan;
}

struct Moves {
  std::size_t accepted = 0, overlaps = 0, same_place = 0, others = 0;
};

/// Moves a vertex to random points of a lattice; each time certification from scratch must say the same.
template <int D>
Moves move_about(Cell_soup<D> soup, std::uint64_t seed, int rounds) {
  Environment<D> environment = Environment<D>::build(std::move(soup));
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(seed);
  Moves moves;
  for (int i = 0; i < rounds; ++i) {
    // The tip of the fan half of the time: it has room.
    const auto p =
        static_cast<std::uint32_t>(random.chance(0.5) ? 0 : random.below(snapshot.points().size()));
    Point<D> target;
    for (double& x : target) x = -4 + 0.5 * static_cast<double>(random.below(16));
    Cell_soup<D> moved = environment.soup();
    moved.points[p] = target;
    const std::string reason = test::refusal_or_none(moved);
    try {
      environment.move_vertex(p, target);
      EXPECT_EQ(reason, "") << "accepted";
      ++moves.accepted;
      EXPECT_EQ(test::facts(snapshot), test::facts(Snapshot<D>::compile(moved, glue(moved))));
    } catch (const Error& error) {
      EXPECT_NE(reason, "") << error.what();
      const std::string said = error.what();
      const bool is_overlap = said.find("reaches across") != std::string::npos;
      const bool is_same_place = said.find("lies in that place") != std::string::npos;
      ++(is_overlap ? moves.overlaps : is_same_place ? moves.same_place : moves.others);
    }
    // Facets of the boundary come and go in the index.
    if (i % 40 == 0) {
      const Cell c = snapshot.cell(random.below(snapshot.cell_count()));
      environment.insert_point(c, test::mean_of_vertices(snapshot.view(c)));
    }
  }
  EXPECT_NO_THROW(environment.certify());
  return moves;
}

void expect_all(const Moves& moves) {
  EXPECT_GT(moves.accepted, 20u);
  EXPECT_GT(moves.overlaps, 20u);
  EXPECT_GT(moves.same_place, 0u);
  EXPECT_GT(moves.others, 20u);
}

TEST(EditBoundary, AgreesWithCertificationFromScratch2) {
  Moves all;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Moves moves = move_about<2>(fan_beside_grid(), seed, 300);
    all.accepted += moves.accepted, all.overlaps += moves.overlaps;
    all.same_place += moves.same_place, all.others += moves.others;
  }
  expect_all(all);
}

TEST(EditBoundary, AgreesWithCertificationFromScratch3) {
  Moves all;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Moves moves = move_about<3>(fan_beside_grid_3(), seed, 200);
    all.accepted += moves.accepted, all.overlaps += moves.overlaps;
    all.same_place += moves.same_place, all.others += moves.others;
  }
  expect_all(all);
}

/// Two simplices, the tip of the second closer to a facet of the first than doubles can tell. That they are
/// apart is not certified then, so a corner of the first may not go on unseen, however far other facets are.
template <int D>
void expect_doubt_of_what_is_almost_touched(const Cell_soup<D>& soup, const Point<D>& aside,
                                            const Point<D>& into) {
  Environment<D> environment = Environment<D>::build(soup);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NO_THROW(environment.move_vertex(0, aside));
    EXPECT_THROW(environment.move_vertex(0, into), Error);
    EXPECT_EQ(environment.snapshot().point(0), aside);
    EXPECT_NO_THROW(environment.move_vertex(0, soup.points[0]));
    EXPECT_THROW(environment.move_vertex(0, into), Error);
  }
  EXPECT_NO_THROW(environment.certify());
}

TEST(EditBoundary, GoesOnAskingWhereNothingIsCertified) {
  Cell_soup<2> flat;
  flat.points = {{0, 0}, {1, 0}, {0, 1}, {0.5, -0x1p-60}, {0, -1}, {1, -1}};
  add_polygon(flat, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(flat, std::array<std::uint32_t, 3>{3, 4, 5});
  expect_doubt_of_what_is_almost_touched<2>(flat, {-0.125, 0}, {0, -0.25});
  Cell_soup<3> solid;
  solid.points = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1}, {0.25, 0.25, -0x1p-60},
                  {0, 0, -1}, {0, 1, -1}, {1, 0, -1}};
  add_tetrahedron(solid, 0, 1, 2, 3);
  add_tetrahedron(solid, 4, 5, 6, 7);
  expect_doubt_of_what_is_almost_touched<3>(solid, {-0.125, -0.125, 0}, {0, 0, -0.25});
}

TEST(EditBoundary, AsksForTheEndOfAMoveOnly) {
  // A triangle, whose tip swings round to the other side, and a thin one that hangs down into its way.
  Cell_soup<2> soup;
  soup.points = {{-1, 0}, {1, 0}, {-4, 1}, {0, 0.5}, {0.125, 8}, {-0.125, 8}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(soup, std::array<std::uint32_t, 3>{3, 4, 5});
  Environment<2> environment = Environment<2>::build(soup);
  EXPECT_THROW(environment.move_vertex(2, {0, 1}), Error) << "half way it reaches across the other one";
  EXPECT_NO_THROW(environment.move_vertex(2, {4, 1})) << "at its end it does not";
  EXPECT_NO_THROW(environment.certify());
}

}  // namespace
}  // namespace cellwalk
