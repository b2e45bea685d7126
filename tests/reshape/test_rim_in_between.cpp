// SPDX-License-Identifier: LGPL-3.0-or-later
// A rim that passes a vertex of a body twice, so that the vertex is inside a wall in between, but neither
// before nor after: on which side it is then is a choice.
#include <gtest/gtest.h>

#include <cstdint>

#include "edge/relisted.h"
#include "reshape/octahedron.h"
#include "reshape/star_scene.h"

namespace cellwalk {
namespace {

/// The wall (v, (16,0,0), (0,16,0)), whose v goes from (0,-8,0) to (-8,0,0), and a body whose middle,
/// (-2,-2,0), its rims pass.
/// \param heights of the two ends of the body
/// \param order of the lists; 0 if as they are
Vertex_result<3> pass(const std::array<double, 2>& heights, std::uint64_t order) {
  Cell_soup<3> soup = test::octahedron({{0, 1, 3}});
  soup.points[0] = {0, -8, 0};
  std::uint32_t vertex = 0;
  if (order != 0) {
    const auto other = test::relisted(soup, order);
    soup = other.soup;
    vertex = other.new_point[0];
  }
  test::Star_scene<3> scene(soup);
  scene.add_body({{-2, -2, heights[0]}, {-2, -2, 0}, {-3, -3, heights[1]}});
  return scene.move({-8, 0, 0}, vertex);
}

TEST(RimInBetween, ABodyOnOneSideIsFree) {
  for (std::uint64_t order = 0; order < 6; ++order) {
    EXPECT_EQ(pass({4, 4}, order).end, Move_end::reached) << "above, order " << order;
    EXPECT_EQ(pass({-4, -4}, order).end, Move_end::reached) << "below, order " << order;
  }
}

TEST(RimInBetween, ABodyOnBothSidesIsHit) {
  for (std::uint64_t order = 0; order < 3; ++order)
    for (const double height : {4., -4.}) {
      const auto result = pass({height, -height}, order);
      ASSERT_EQ(result.end, Move_end::contact);
      EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(3), Ring(10)));
    }
}

}  // namespace
}  // namespace cellwalk
