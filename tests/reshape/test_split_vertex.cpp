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
struct Split {
  Environment<D> environment = test::tissue<D>(4, 5, 0);
  std::uint32_t vertex = 0;
  std::vector<Cell> front;
  Point<D> target{};

  Split() {
    const Snapshot<D>& snapshot = environment.snapshot();
    Point<D> middle;
    middle.fill(2);
    vertex = test::point_at<D>(environment, middle);
    for (const Cell c : environment.cells_around(vertex))
      if (const Point<D> x = test::middle_of(snapshot, c);
          std::ranges::all_of(x, [](double y) { return y > 2; }))
        front.push_back(c);
    target = middle;
    for (const Cell c : front)
      target = target + (0.1 / static_cast<double>(front.size())) * (test::middle_of(snapshot, c) - middle);
  }

  std::string refusal(const std::vector<Cell>& cells) {
    Reshaping<D> reshaping(environment, {});
    try {
      reshaping.split_vertex(vertex, cells, target);
      return "";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::usage);
      return e.what();
    }
  }
};

template <int D>
void split_once() {
  Split<D> split;
  ASSERT_GT(split.front.size(), 0u);
  const Certificate before = split.environment.certify();
  Reshaping<D> reshaping(split.environment, {});
  const Replacement made = reshaping.split_vertex(split.vertex, split.front, split.target);
  reshaping.finish();
  EXPECT_TRUE(made.is_made) << made.reason;
  const Certificate after = split.environment.certify();
  EXPECT_EQ(after.solid_cells, before.solid_cells);
  EXPECT_EQ(after.vertices, before.vertices + 1);
  EXPECT_GT(after.free_volume, before.free_volume);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
}

TEST(SplitVertex, TakesCellsBackInThePlane) { split_once<2>(); }
TEST(SplitVertex, TakesCellsBackInSpace) { split_once<3>(); }

template <int D>
void refuse_cells_named_twice() {
  Split<D> split;
  const Certificate before = split.environment.certify();
  for (const Cell c : split.front) {
    std::vector<Cell> cells = split.front;
    cells.push_back(c);
    EXPECT_EQ(split.refusal(cells), "cell " + std::to_string(split.environment.snapshot().index(c)) +
                                        " is named twice: name each cell that is taken back once");
  }
  EXPECT_EQ(split.environment.certify().cells, before.cells);
}

TEST(SplitVertex, RefusesCellsNamedTwiceInThePlane) { refuse_cells_named_twice<2>(); }
TEST(SplitVertex, RefusesCellsNamedTwiceInSpace) { refuse_cells_named_twice<3>(); }

TEST(SplitVertex, RefusesWhatItCannotTake) {
  Split<3> split;
  EXPECT_EQ(split.refusal({}), "no cells are to be taken back: name those in front");
  EXPECT_NE(split.refusal({Cell::none}), "");
  EXPECT_NE(split.refusal({Cell{123456}}), "");
  const std::vector<Cell> all = split.environment.cells_around(split.vertex);
  Reshaping<3> reshaping(split.environment, {});
  const Replacement whole = reshaping.split_vertex(split.vertex, all, split.target);
  EXPECT_FALSE(whole.is_made);
  EXPECT_EQ(whole.reason, "nothing but these cells has the vertex");
  // Cells that meet in the vertex only have no target inside all of their facets.
  std::vector<Cell> apart = split.front;
  for (const Cell c : all)
    if (const Point<3> x = test::middle_of(split.environment.snapshot(), c); x[0] < 2 && x[1] < 2 && x[2] < 2)
      apart.push_back(c);
  ASSERT_GT(apart.size(), split.front.size());
  EXPECT_FALSE(reshaping.split_vertex(split.vertex, apart, split.target).is_made);
  reshaping.finish();
  EXPECT_NO_THROW(split.environment.certify());
}

}  // namespace
}  // namespace cellwalk
