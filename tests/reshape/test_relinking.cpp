// SPDX-License-Identifier: LGPL-3.0-or-later
// A new way of an edge through the cells around a vertex must not leave them, even where the edge lies along
// facets that it may pass: behind walls that do not move it would be another way.
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <vector>

#include "reshape/star_scene.h"

namespace cellwalk {
namespace {

constexpr std::uint32_t moved_vertex = 0, west = 1, line_begin = 2, wall_begin = 3, wall_middle = 4,
                        wall_end = 5, line_end = 6;

// Below the vertex four facets lie in one line: one that is open, two walls, one that is open. One cell lies
// below them all, so that the way behind the walls is shorter than that through the cells at the vertex.
Cell_soup<2> line_of_facets() {
  Cell_soup<2> soup;
  soup.points = {{1.5, 2}, {-2, -1}, {0, 0},   {1, 0},  {1.5, 0}, {2, 0},
                 {3, 0},   {5, 3},   {1.5, 6}, {-4, 3}, {0, -4},  {3, -4}};
  const auto add = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t u = loop[k], v = loop[(k + 1) % loop.size()];
      soup.add_facet({u, v});
      soup.impassable.back() = (u == wall_begin && v == wall_middle) || (u == wall_middle && v == wall_end) ||
                               (v == wall_begin && u == wall_middle) || (v == wall_middle && u == wall_end);
    }
    soup.end_cell();
  };
  for (std::uint32_t k = 1; k <= 9; ++k) add({moved_vertex, k, k % 9 + 1});
  add({line_begin, 10, 11, line_end, wall_end, wall_middle, wall_begin});
  return soup;
}

TEST(Relinking, DoesNotPassBehindWalls) {
  test::Star_scene<2> scene(line_of_facets());
  Body<2>& body = scene.add_body({{-0.5, 0.25}, {2.5, 0.25}});
  Step_report<2> report;
  Body_counts counts;
  body.step(std::vector<Point<2>>{{-0.5, 0}, {2.5, 0}}, {}, report, counts);
  ASSERT_TRUE(report.contacts.empty()) << "it lies on the walls now";
  const Cell before = body.particles()[0].cell;
  ASSERT_EQ(scene.end_of({2.5, 1.5}), Move_end::reached);
  ASSERT_NE(body.particles()[0].cell, before) << "so that its way is a new one";
  body.step(std::vector<Point<2>>{{-0.5, 0.5}, {2.5, 0.25}}, {}, report, counts);
  EXPECT_TRUE(report.contacts.empty()) << "it lay above the walls";
  body.step(std::vector<Point<2>>{{-0.5, 0.5}, {2.5, -1}}, {}, report, counts);
  EXPECT_FALSE(report.contacts.empty()) << "and passes them no more than before";
}

}  // namespace
}  // namespace cellwalk
