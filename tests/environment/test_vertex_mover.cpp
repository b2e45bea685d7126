// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of single vertices for layers above: their checks, and certificates withdrawn and restored.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/environment/vertex_mover.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "certify_samples.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

using detail::Star_defect;
using detail::Vertex_mover;

/// True if nothing is certified of a cell.
template <int D>
bool is_withdrawn(const Snapshot<D>& snapshot, Cell c) {
  for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
    for (int k = 0; k < D; ++k)
      if (snapshot.blocks(c)[i / 4].normal[k][i % 4] != 0) return false;
    if (snapshot.blocks(c)[i / 4].offset[i % 4] != 0) return false;
  }
  return true;
}

template <int D>
void withdraw_and_restore(Cell_soup<D> soup, std::uint32_t point) {
  for (const bool keep_map : {true, false}) {
    Environment<D> environment = Environment<D>::build(soup, {.keep_map = keep_map});
    const Snapshot<D>& snapshot = environment.snapshot();
    const auto before = test::facts(snapshot);
    const double certain = test::expect_planes_hold(snapshot, 3);
    const std::size_t uncertified = snapshot.uncertified_planes();
    const std::uint64_t epoch = snapshot.epoch();
    Point<D> target = snapshot.point(point);
    for (double& x : target) x += 0.125;
    {
      Vertex_mover<D> mover(environment);
      ASSERT_EQ(mover.begin(point, target).defect, Star_defect::none);
      EXPECT_EQ(snapshot.epoch(), epoch) << "a question changes nothing";
      mover.place();
      EXPECT_EQ(snapshot.geometry_epoch(), epoch) << "nothing is made yet";
      for (const Cell c : mover.star()) EXPECT_TRUE(is_withdrawn(snapshot, c));
      EXPECT_GT(snapshot.uncertified_planes(), uncertified);
      mover.take_back();
      for (const Cell c : mover.star()) EXPECT_TRUE(is_withdrawn(snapshot, c)) << "until it is restored";
      mover.restore();
      EXPECT_EQ(test::facts(snapshot), before);
      EXPECT_EQ(snapshot.uncertified_planes(), uncertified);
      EXPECT_EQ(test::expect_planes_hold(snapshot, 3), certain);

      ASSERT_EQ(mover.begin(point, target).defect, Star_defect::none);
      mover.place();
      mover.commit();
      EXPECT_GT(snapshot.geometry_epoch(), epoch);
    }  // restores
    Cell_soup<D> moved = soup;
    moved.points[point] = target;
    EXPECT_EQ(test::facts(snapshot), test::facts(Snapshot<D>::compile(moved, glue(moved))));
    EXPECT_EQ(snapshot.uncertified_planes(), uncertified);
    EXPECT_NO_THROW(environment.certify()) << "map and snapshot agree";
  }
}

TEST(VertexMover, WithdrawsAndRestores2) { withdraw_and_restore<2>(triangle_grid({.cells = {4, 4}}), 12); }
TEST(VertexMover, WithdrawsAndRestores3) {
  withdraw_and_restore<3>(tetrahedral_grid({.cells = {4, 4, 4}}), 62);
}

TEST(VertexMover, NamesTheCellThatWouldBeFlatFirst) {
  Environment<2> environment = Environment<2>::build(triangle_grid({.cells = {2, 2}}));
  Vertex_mover<2> mover(environment);
  // The middle of the grid: its star ends at x = 2.
  const detail::Star_check check = mover.begin(4, {5, 1});
  EXPECT_EQ(check.defect, Star_defect::cell);
  EXPECT_EQ(check.share, 0.25);
  const auto vertices = environment.snapshot().view(check.cell).vertices;
  EXPECT_EQ(std::count(vertices.begin(), vertices.end(), 4u), 1);
  EXPECT_EQ(mover.begin(4, {2, 1}).defect, Star_defect::cell) << "flat at the end";
  EXPECT_EQ(mover.begin(4, {1.875, 1}).defect, Star_defect::none);
  EXPECT_EQ(mover.begin(4, {1, 1}).defect, Star_defect::none) << "where it is";
}

TEST(VertexMover, AsksForTheWholeWayOfABoundaryVertex) {
  // The tip of a triangle swings round to the other side, through a thin one that hangs down.
  Cell_soup<2> soup;
  soup.points = {{-1, 0}, {1, 0}, {-4, 1}, {0, 0.5}, {0.125, 8}, {-0.125, 8}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(soup, std::array<std::uint32_t, 3>{3, 4, 5});
  Environment<2> environment = Environment<2>::build(soup);
  Vertex_mover<2> mover(environment);
  EXPECT_EQ(mover.begin(2, {4, 1}).defect, Star_defect::boundary) << "free at its end only";
  EXPECT_EQ(mover.begin(2, {0, 1}).defect, Star_defect::boundary);
  EXPECT_EQ(mover.begin(2, {-1, 1}).defect, Star_defect::boundary) << "touches its tip";
  EXPECT_EQ(mover.begin(2, {-2, 1}).defect, Star_defect::none);
  EXPECT_EQ(mover.begin(2, {0, 0.25}).defect, Star_defect::none) << "below it";
}

TEST(VertexMover, OpensSlitsAndDoesNotCloseThem) {
  // Two triangles on both sides of a slit, of which the upper one has points of its own.
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {4, 0}, {2, -3}, {0, 0}, {4, 0}, {2, 3}, {2, 0}, {2, 0}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 2, 6});
  add_polygon(soup, std::array<std::uint32_t, 3>{2, 1, 6});
  add_polygon(soup, std::array<std::uint32_t, 3>{3, 7, 5});
  add_polygon(soup, std::array<std::uint32_t, 3>{7, 4, 5});
  Environment<2> environment = Environment<2>::build(soup, {.duplicates = Duplicate_vertices::keep});
  Vertex_mover<2> mover(environment);
  EXPECT_EQ(mover.begin(7, {2, 1}).defect, Star_defect::none) << "opens";
  EXPECT_EQ(mover.begin(7, {2, -1}).defect, Star_defect::boundary) << "into the other side";
  EXPECT_EQ(mover.begin(7, {2.5, 0}).defect, Star_defect::boundary) << "along the other side: not told apart";
}

TEST(VertexMover, RefusesWhatItCannotMove) {
  const Cell_soup<2> squares = square_grid({.cells = {2, 2}});
  Environment<2> environment = Environment<2>::build(squares);
  Vertex_mover<2> mover(environment);
  EXPECT_THROW(mover.begin(4, {1.25, 1}), Error) << "no simplices";
  EXPECT_THROW(mover.begin(99, {1, 1}), Error);
  EXPECT_THROW(mover.begin(4, {std::nan(""), 1}), Error);
}

TEST(VertexMover, VerticesMoveWithoutAMap) {
  Environment<3> frozen = Environment<3>::build(tetrahedral_grid({.cells = {3, 3, 3}}), {.keep_map = false});
  Environment<3> other = Environment<3>::build(tetrahedral_grid({.cells = {3, 3, 3}}));
  for (const std::uint32_t p : {0u, 21u, 22u, 63u})
    for (Environment<3>* environment : {&frozen, &other}) {
      Point<3> target = environment->snapshot().point(p);
      target[0] += 0.125;
      environment->move_vertex(p, target);
    }
  EXPECT_EQ(test::facts(frozen.snapshot()), test::facts(other.snapshot()));
  EXPECT_NO_THROW(frozen.certify());
  EXPECT_THROW(frozen.move_vertex(21, {9, 9, 9}), Error) << "inverts a cell";
}

}  // namespace
}  // namespace cellwalk
