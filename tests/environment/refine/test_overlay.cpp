// SPDX-License-Identifier: LGPL-3.0-or-later
// Rectangles and triangles on a lattice, divided by others, against areas in whole numbers.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "environment/refine/overlay.h"
#include "environment/refine/random_blocks.h"

namespace cellwalk::detail {
namespace {

/// The double of the area, counterclockwise.
double doubled_area(const std::vector<Point<2>>& points, const Overlay_loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point<2>&a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

bool is_convex(const std::vector<Point<2>>& points, const Overlay_loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point<2>&a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]],
          &c = points[loop[(i + 2) % loop.size()]];
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0) return false;
  }
  return true;
}

/// Rectangles with all points on their sides as vertices.
class Rectangles {
 public:
  explicit Rectangles(const std::vector<test::Block<2>>& blocks) : blocks_(blocks) {
    for (const auto& block : blocks)
      for (const Point<2>& p :
           {block.low, {block.high[0], block.low[1]}, block.high, {block.low[0], block.high[1]}})
        if (indices_.try_emplace(p, points_.size()).second) points_.push_back(p);
  }

  const std::vector<Point<2>>& points() const { return points_; }

  Overlay_loop loop(std::size_t i) const {
    const auto& [low, high, is_there] = blocks_[i];
    const std::vector<Point<2>> corners{low, {high[0], low[1]}, high, {low[0], high[1]}};
    Overlay_loop loop;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point<2>&a = corners[k], &b = corners[(k + 1) % 4];
      std::map<double, std::uint32_t> along;
      for (std::uint32_t v = 0; v < points_.size(); ++v) {
        const Vector<2> x = points_[v] - a, side = b - a;
        const double share = dot(x, side) / dot(side, side);
        if (x[0] * side[1] == x[1] * side[0] && share >= 0 && share < 1) along[share] = v;
      }
      for (const auto& at : along) loop.push_back(at.second);
    }
    return loop;
  }

 private:
  const std::vector<test::Block<2>>& blocks_;
  std::vector<Point<2>> points_;
  std::map<Point<2>, std::uint32_t> indices_;
};

TEST(Overlay, RectanglesAreWholeAndTheRemainderIsConvex) {
  Random random(1);
  int with_remainder = 0, without = 0;
  for (int trial = 0; trial < 400; ++trial) {
    auto blocks = test::random_blocks<2>(random, 16, 2 + random.below(20), 0.4);
    const Rectangles rectangles = [&] {
      std::erase_if(blocks, [](const auto& block) { return !block.is_there; });
      blocks.push_back({{0, 0}, {16, 16}});
      return Rectangles(blocks);
    }();
    std::vector<Overlay_loop> others;
    double covered = 0;
    for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
      others.push_back(rectangles.loop(i));
      covered += 2 * blocks[i].volume();
    }
    const auto pieces = overlay(rectangles.points(), rectangles.loop(blocks.size() - 1), others, 0);
    ASSERT_GE(pieces.size(), others.size());
    double area = 0;
    std::size_t whole = 0;
    for (Overlay_loop piece : pieces) {
      EXPECT_TRUE(is_convex(rectangles.points(), piece));
      const double own = doubled_area(rectangles.points(), piece);
      EXPECT_GT(own, 0);
      area += own;
      const auto same = [&](Overlay_loop other) {
        std::rotate(other.begin(), std::find(other.begin(), other.end(), piece[0]), other.end());
        return other == piece;
      };
      whole += std::any_of(others.begin(), others.end(), same);
    }
    EXPECT_EQ(area, 2 * 16 * 16);
    EXPECT_EQ(whole, others.size());
    ++(covered < area ? with_remainder : without);
    EXPECT_EQ(pieces.size() > others.size(), covered < area);
  }
  EXPECT_GT(with_remainder, 300);
  EXPECT_GT(without, 5);
}

TEST(Overlay, AHoleIsCutOpen) {
  const std::vector<Point<2>> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {1, 3}};
  const auto pieces = overlay(points, {0, 1, 2, 3}, std::vector<Overlay_loop>{{4, 5, 6, 7}}, 0);
  EXPECT_EQ(pieces.size(), 5u) << "the hole and four trapezoids, without a new point";
}

TEST(Overlay, PolygonsThatOverlapEachOtherHaveNone) {
  const std::vector<Point<2>> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_TRUE(overlay(points, {0, 1, 2, 3}, std::vector<Overlay_loop>{{0, 1, 2}, {0, 1, 2}}, 0).empty());
}

TEST(Overlay, ThePartOfATriangleWithin) {
  // The triangle leaves the square at two points of its sides.
  const std::vector<Point<2>> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 1}, {2, 2}, {4, 3}, {8, 1}, {8, 3}};
  const auto pieces = overlay(points, {0, 1, 4, 6, 2, 3}, std::vector<Overlay_loop>{{4, 7, 8, 6, 5}}, 0);
  double area = 0;
  std::size_t triangles = 0;
  for (const Overlay_loop& piece : pieces) {
    EXPECT_TRUE(is_convex(points, piece));
    area += doubled_area(points, piece);
    triangles += piece.size() == 3 && std::find(piece.begin(), piece.end(), 5) != piece.end() &&
                 std::find(piece.begin(), piece.end(), 4) != piece.end();
  }
  EXPECT_EQ(area, 32);
  EXPECT_GE(triangles, 1u);
  EXPECT_GE(pieces.size(), 3u);
}

}  // namespace
}  // namespace cellwalk::detail
