// SPDX-License-Identifier: LGPL-3.0-or-later
// The tip of a wall that moves in its own plane, through a face of a body: the wall sweeps nothing, and the
// face is passed by the tip alone.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "edge/relisted.h"
#include "reshape/grids.h"
#include "reshape/octahedron.h"

namespace cellwalk {
namespace {

/// A grid of unit cubes with walls, (2,2,2) (2,2,1) (1,2,1) or (2,2,2) (2,2,3) (3,2,3), and a body that is a
/// face.
struct Flap {
  /// \param points three corners, and then the ends of edges of their own
  /// \param has_first, has_second which walls
  explicit Flap(const std::vector<Point<3>>& points, bool has_first = true, bool has_second = false)
      : environment(test::simplex_grid<3>(4)),
        body((add_walls(has_first, has_second), environment.snapshot()), Locator<3>(environment.snapshot()),
             soup_of(points)) {}

  static Body_soup<3> soup_of(const std::vector<Point<3>>& points) {
    Body_soup<3> soup{points, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    for (std::uint32_t k = 3; k < points.size(); k += 2) soup.edges.push_back({k, k + 1});
    return soup;
  }
  void add_walls(bool has_first, bool has_second) {
    if (has_first) add_wall({Point<3>{2, 2, 2}, Point<3>{2, 2, 1}, Point<3>{1, 2, 1}});
    if (has_second) add_wall({Point<3>{2, 2, 2}, Point<3>{2, 2, 3}, Point<3>{3, 2, 3}});
  }
  void add_wall(const std::array<Point<3>, 3>& corners) {
    const Snapshot<3>& snapshot = environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
        const auto loop = snapshot.loop(f);
        if (std::ranges::all_of(
                loop, [&](std::uint32_t v) { return std::ranges::count(corners, snapshot.point(v)) != 0; }))
          environment.set_impassable(f, true);
      }
  }
  Vertex_result<3> move(const Point<3>& from, const Point<3>& to, At_contact at_contact = At_contact::hold) {
    Reshaping<3> reshaping(environment, {{&body}, {}}, {.at_contact = at_contact});
    const auto result = reshaping.move(test::point_at<3>(environment, from), to);
    reshaping.finish();
    EXPECT_NO_THROW(body.validate());
    EXPECT_EQ(reshaping.counts().touches, 0u);
    return result;
  }

  Environment<3> environment;
  Body<3> body;
};

const std::vector<Point<3>> above_rim{{1.25, 1.25, 2.25}, {3.25, 1.25, 2.25}, {1.25, 3.25, 2.25}};

void expect_time(const Vertex_result<3>& result, int numerator, int denominator) {
  ASSERT_EQ(result.end, Move_end::contact);
  ASSERT_TRUE(result.hit.has_value());
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(numerator), Ring(denominator)));
  EXPECT_EQ(result.hit->kind, Contact_kind::vertex);
  EXPECT_EQ(result.hit->weights, (std::array<double, 3>{1, 0, 0}));
}

TEST(RimThroughFace, IsAHitWithItsTimeAndPlace) {
  Flap flap(above_rim);
  const auto result = flap.move({2, 2, 2}, {2, 2, 2.75});
  expect_time(result, 1, 3);
  EXPECT_EQ(result.hit->point, (Point<3>{2, 2, 2.25}));
  EXPECT_EQ(result.hit->normal, (Vector<3>{0, 0, 1}));
  EXPECT_EQ(result.hit->resident.feature, Body_feature::face);
  EXPECT_EQ(result.hit->resident_weights, (std::array<double, 3>{0.25, 0.375, 0.375}));
  EXPECT_EQ(result.position, (Point<3>{2, 2, 2}));
}

TEST(RimThroughFace, MayTouchItAndGoBack) {
  Flap flap(above_rim);
  EXPECT_EQ(flap.move({2, 2, 2}, {2, 2, 2.25}).end, Move_end::reached);
  expect_time(flap.move({2, 2, 2.25}, {2, 2, 2.5}), 0, 1);
  EXPECT_EQ(flap.move({2, 2, 2.25}, {2.125, 2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(flap.move({2.125, 2, 2.25}, {2, 2, 2}).end, Move_end::reached);
}

TEST(RimThroughFace, PassesBesideTheFace) {
  Flap flap({{2.25, 1.25, 2.25}, {3.25, 1.25, 2.25}, {2.25, 3.25, 2.25}});
  EXPECT_EQ(flap.move({2, 2, 2}, {2, 2, 2.75}).end, Move_end::reached);
}

TEST(RimThroughFace, StopsThere) {
  Flap flap(above_rim);
  const auto result = flap.move({2, 2, 2}, {2, 2, 2.75}, At_contact::stop);
  expect_time(result, 1, 3);
  EXPECT_NEAR(result.position[2], 2.25, 1e-12);
  EXPECT_LE(result.position[2], 2.25);
}

TEST(RimThroughFace, PushesTheFace) {
  Flap flap(above_rim);
  EXPECT_EQ(flap.move({2, 2, 2}, {2, 2, 2.75}, At_contact::push).end, Move_end::reached);
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k)
    height += std::array{0.25, 0.375, 0.375}[k] * flap.body.positions()[k][2];
  EXPECT_GE(height, 2.75);
  EXPECT_LT(height, 2.75 + 1e-12) << "no further than needed";
  EXPECT_EQ(flap.move({2, 2, 2.75}, {2, 2, 2.875}).end, Move_end::contact) << "it is still on that side";
}

// Whatever else is hit: an edge of the body, later.
TEST(RimThroughFace, IsTheFirstOfAllHits) {
  Flap flap({above_rim[0], above_rim[1], above_rim[2], {1.75, 1.5, 2.28125}, {1.75, 2.5, 2.28125}});
  const auto result = flap.move({2, 2, 2}, {2, 2, 2.75});
  expect_time(result, 1, 3);
  EXPECT_EQ(result.hit->resident.feature, Body_feature::face);
}

// The tip of two walls, one below the face and one above it.
TEST(RimThroughFace, IsThatOfTheWallDrawnThrough) {
  std::vector<Point<3>> level = above_rim;
  for (Point<3>& x : level) x[2] = 2;
  Flap flap(level, true, true);
  for (const double height : {2.5, 1.5}) {
    const auto result = flap.move({2, 2, 2}, {2, 2, height});
    expect_time(result, 0, 1);
    const Point<3> drawn{height > 2 ? 1.0 : 3.0, 2, height > 2 ? 1.0 : 3.0};
    const auto loop = flap.environment.snapshot().loop(result.hit->facet);
    EXPECT_EQ(std::ranges::count(loop, test::point_at<3>(flap.environment, drawn)), 1);
  }
}

// The tip (2,2,1) goes round the edge of the face in one point, and at once the wall stands in all that is
// between that point and its corner (2,2,2), on which the face rests.
TEST(RimThroughFace, OverItsEdge) {
  Flap flap({{2.5, 1, 1.5}, {2.5, 3, 1.5}, {1.5, 2, 2.5}});
  const auto result = flap.move({2, 2, 1}, {2.75, 2, 1.75});
  expect_time(result, 2, 3);
  EXPECT_EQ(result.hit->resident.feature, Body_feature::edge);
  EXPECT_EQ(result.hit->resident.number, 0u);
  EXPECT_EQ(result.hit->resident_weights, (std::array<double, 3>{0.5, 0.5, 0}));
  EXPECT_EQ(flap.move({2, 2, 1}, {2.5, 2, 1.5}).end, Move_end::reached) << "it may end there";
  expect_time(flap.move({2.5, 2, 1.5}, {2.75, 2, 1.75}), 0, 1);
}

// The tip leaves a corner of the face at once; later the wall hits an edge of the face as well.
TEST(RimThroughFace, OverItsCornerBeforeAnEdgeIsHit) {
  for (std::uint64_t order = 0; order < 6; ++order)
    for (const double sense : {1., -1.}) {
      Cell_soup<3> soup = test::octahedron({{0, 3, 6}});
      soup.points[0] = {0, 3, 7};
      // Mirrored: the wall lies in the plane of the mirror.
      const std::vector<Point<3>> face{{0, 3, 7}, {-10 * sense, 1, 3}, {8 * sense, 1, -2}};
      std::uint32_t vertex = 0;
      if (order != 0) {
        auto other = test::relisted(soup, order);
        soup = std::move(other.soup);
        vertex = other.new_point[0];
      }
      auto environment = Environment<3>::build(soup);
      Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()), Flap::soup_of(face));
      Reshaping<3> reshaping(environment, {{&body}, {}}, {.at_contact = At_contact::hold});
      for (const Point<3>& to : {Point<3>{0, -2, 5}, {0, 2, 7}, {0, 2, 6}})
        expect_time(reshaping.move(vertex, to), 0, 1);
    }
}

// The corner behind the face, (2,2,3), lies on the way of the tip, and (3,2,3) in the plane of the face:
// towards that one the wall is drawn into the face. Later it hits an edge.
TEST(RimThroughFace, TowardsACornerInItsPlane) {
  Flap flap(
      {{2, 1.25, 1.75}, {2, 2.75, 1.75}, {3.25, 2, 3.3125}, {2.0625, 1.5, 1.6875}, {2.0625, 2.5, 1.6875}},
      false, true);
  expect_time(flap.move({2, 2, 2}, {2, 2, 1.5}), 1, 2);
  EXPECT_EQ(flap.move({2, 2, 2}, {2, 2, 1.75}).end, Move_end::reached) << "it may end there";
}

}  // namespace
}  // namespace cellwalk
