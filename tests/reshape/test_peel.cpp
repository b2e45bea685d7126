// SPDX-License-Identifier: LGPL-3.0-or-later
// Solid cells that are taken back from a vertex.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reshape/grids.h"
#include "reshape/tissue_block.h"

namespace cellwalk {
namespace {

/// An inner vertex of tissue, with the solid cells around it that lie in front of it along the first axis,
/// and a target in their inside.
template <int D>
struct Peeled {
  Environment<D> environment = test::tissue<D>(4, 5, 0);
  std::uint32_t vertex = 0;
  std::vector<Cell> front;
  Point<D> target{};

  Peeled() {
    const Snapshot<D>& snapshot = environment.snapshot();
    Point<D> middle;
    middle.fill(2);
    vertex = test::point_at<D>(environment, middle);
    for (const Cell c : environment.cells_around(vertex))
      if (const Point<D> x = test::centroid(snapshot, c);
          std::ranges::all_of(x, [](double y) { return y > 2; }))
        front.push_back(c);
    target = middle;
    for (const Cell c : front)
      target = target + (0.1 / static_cast<double>(front.size())) * (test::centroid(snapshot, c) - middle);
  }

  std::string refusal(const std::vector<Cell>& cells) {
    Reshaping<D> reshaping(environment, {});
    try {
      reshaping.peel(vertex, cells, target);
      return "";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::usage);
      return e.what();
    }
  }
};

template <int D>
void peel_once() {
  Peeled<D> peeled;
  ASSERT_GT(peeled.front.size(), 0u);
  const Certificate before = peeled.environment.certify();
  Reshaping<D> reshaping(peeled.environment, {});
  const Replacement made = reshaping.peel(peeled.vertex, peeled.front, peeled.target);
  reshaping.close();
  EXPECT_TRUE(made.is_made) << made.reason;
  const Certificate after = peeled.environment.certify();
  EXPECT_EQ(after.solid_cells, before.solid_cells);
  EXPECT_EQ(after.vertices, before.vertices + 1);
  EXPECT_GT(after.free_volume, before.free_volume);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
}

TEST(Peel, TakesCellsBackInThePlane) { peel_once<2>(); }
TEST(Peel, TakesCellsBackInSpace) { peel_once<3>(); }

template <int D>
void refuse_cells_named_twice() {
  Peeled<D> peeled;
  const Certificate before = peeled.environment.certify();
  for (const Cell c : peeled.front) {
    std::vector<Cell> cells = peeled.front;
    cells.push_back(c);
    EXPECT_EQ(peeled.refusal(cells), "cell " + std::to_string(peeled.environment.snapshot().index(c)) +
                                         " is named twice: name each cell that is taken back once");
  }
  EXPECT_EQ(peeled.environment.certify().cells, before.cells);
}

TEST(Peel, RefusesCellsNamedTwiceInThePlane) { refuse_cells_named_twice<2>(); }
TEST(Peel, RefusesCellsNamedTwiceInSpace) { refuse_cells_named_twice<3>(); }

TEST(Peel, RefusesWhatItCannotTake) {
  Peeled<3> peeled;
  EXPECT_EQ(peeled.refusal({}), "no cells are to be taken back: name those in front");
  EXPECT_NE(peeled.refusal({Cell::none}), "");
  EXPECT_NE(peeled.refusal({Cell{123456}}), "");
  const std::vector<Cell> all = peeled.environment.cells_around(peeled.vertex);
  Reshaping<3> reshaping(peeled.environment, {});
  const Replacement whole = reshaping.peel(peeled.vertex, all, peeled.target);
  EXPECT_FALSE(whole.is_made);
  EXPECT_EQ(whole.reason, "nothing but these cells has the vertex");
  // Cells that meet in the vertex only have no target inside all of their facets.
  std::vector<Cell> apart = peeled.front;
  for (const Cell c : all)
    if (const Point<3> x = test::centroid(peeled.environment.snapshot(), c); x[0] < 2 && x[1] < 2 && x[2] < 2)
      apart.push_back(c);
  ASSERT_GT(apart.size(), peeled.front.size());
  EXPECT_FALSE(reshaping.peel(peeled.vertex, apart, peeled.target).is_made);
  reshaping.close();
  EXPECT_NO_THROW(peeled.environment.certify());
}

}  // namespace
}  // namespace cellwalk
