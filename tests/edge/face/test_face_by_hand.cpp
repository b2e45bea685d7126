// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces in worlds of unit cubes in which the answers are known.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <sstream>

#include "edge/face_body.h"
#include "edge/two_layers.h"

namespace cellwalk::test {
namespace {

bool place(Face_body& body, const Snapshot<3>& snapshot, const Triangle& corners) {
  const Locator<3> locator(snapshot);
  return body.place({locator.particle_at(corners[0]).value(), locator.particle_at(corners[1]).value(),
                     locator.particle_at(corners[2]).value()});
}

std::string text(const Rational& x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

/// A block whose corner (2,2,1) sticks up in the way of the face.
Snapshot<3> block() {
  Two_layers world(4);
  world.fill(1, 1);
  return world.compile();
}
const Point<3> tip{2, 2, 1};
/// Over the tip the face falls by 1/2 a unit of x = y; p lies at the lower end.
const Triangle over_tip{Point<3>{2.875, 2.875, 0.75}, Point<3>{2.5, 0.5, 1.25}, Point<3>{0.5, 2.5, 1.25}};

TEST(FaceByHand, FindsTheSpikeThatTheEdgesMiss) {
  const Snapshot<3> snapshot = block();
  Face_body body(snapshot);
  ASSERT_TRUE(place(body, snapshot, over_tip));
  const auto outcome = body.move_corner(0, {2.375, 2.375, 0.75});
  ASSERT_TRUE(outcome.is_face_only());  // the paper's figure 6
  const Contact<3>& contact = *outcome.face.contact;
  EXPECT_EQ(text(to_rational(contact.exact_time())), "3/4");  // 2.875 - s/2 = 2.5
  EXPECT_EQ(contact.time, 0.75);
  EXPECT_EQ(contact.point, tip);
  EXPECT_EQ(contact.kind, Contact_kind::vertex);
  EXPECT_EQ(contact.body, Body_feature::face);
  // The face there: through (1.5,1.5,1.25) and (2,2,1), along (1,-1,0).
  EXPECT_NEAR(contact.normal[0], 1 / std::sqrt(18.0), 1e-15);
  EXPECT_NEAR(contact.normal[1], 1 / std::sqrt(18.0), 1e-15);
  EXPECT_NEAR(contact.normal[2], 4 / std::sqrt(18.0), 1e-15);
  EXPECT_TRUE(snapshot.is_impassable(contact.facet));
  EXPECT_EQ(snapshot.cell_of(contact.facet), contact.cell);
}

TEST(FaceByHand, TheOrderOfTheCornersDoesNotMatter) {
  const Snapshot<3> snapshot = block();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const bool mirrored : {false, true}) {
      Triangle corners;
      corners[k] = over_tip[0];
      corners[(k + 1) % 3] = over_tip[mirrored ? 2 : 1];
      corners[(k + 2) % 3] = over_tip[mirrored ? 1 : 2];
      Face_body body(snapshot);
      ASSERT_TRUE(place(body, snapshot, corners));
      const auto outcome = body.move_corner(k, {2.375, 2.375, 0.75});
      ASSERT_TRUE(outcome.is_face_only());
      EXPECT_EQ(text(to_rational(outcome.face.contact->exact_time())), "3/4");
      EXPECT_GT(outcome.face.contact->normal[2], 0.9);
    }
  }
}

TEST(FaceByHand, TouchingASpikeIsFree) {
  const Snapshot<3> snapshot = block();
  Face_body body(snapshot);
  ASSERT_TRUE(place(body, snapshot, over_tip));
  ASSERT_TRUE(body.move_corner(0, {2.5, 2.5, 0.75}).is_made());  // the face lies on the tip
  EXPECT_TRUE(body.supporting_walls().empty());
  EXPECT_EQ(body.registered().piercing, Half_facet::none);
  const auto down = body.move_corner(0, {2.375, 2.375, 0.75});
  ASSERT_TRUE(down.is_face_only());
  EXPECT_EQ(down.face.contact->exact_time(), Exact_time());
  EXPECT_EQ(down.face.contact->point, tip);
  EXPECT_EQ(down.face.contact->body, Body_feature::face);
  EXPECT_TRUE(body.move_corner(1, {2.5, 0.5, 1.5}).is_made());  // off it, by another corner
  EXPECT_TRUE(body.move_corner(0, {2.375, 2.375, 0.875}).is_made());
}

TEST(FaceByHand, StopsWhereThePointIsBlocked) {
  Two_layers world(4);
  world.fill(1, 1);
  world.stand(3, 2, 0);  // x = 3, behind p
  const Snapshot<3> snapshot = world.compile();
  Face_body body(snapshot);
  // From the side of the wall, p goes over into the tip's way: first the tip, then the wall x = 2 of the
  // block.
  ASSERT_TRUE(place(body, snapshot, over_tip));
  const auto hit = body.move_corner(0, {1.875, 1.875, 0.75});
  ASSERT_TRUE(hit.vertex && hit.face.contact);
  EXPECT_EQ(text(to_rational(hit.face.contact->exact_time())), "3/8");
  // Away from the tip, into the wall x = 3 and far beyond: nothing before that.
  const auto away = body.move_corner(0, {3.5, 2.875, 0.75});
  EXPECT_TRUE(away.vertex && !away.face.contact);
}

TEST(FaceByHand, ATipThroughAnEdge) {
  const Snapshot<3> snapshot = block();
  // The edge pq passes the tip at half time, outwards.
  const Point<3> a{0.75, 2.75, 1.25}, b{1.25, 3.25, 0.75}, q{3, 1, 1};
  {
    Face_body body(snapshot);
    ASSERT_TRUE(place(body, snapshot, {a, q, Point<3>{3, 3, 0.5}}));
    EXPECT_TRUE(body.move_corner(0, b).is_made()) << "the face goes away from the block";
  }
  {
    Face_body body(snapshot);
    ASSERT_TRUE(place(body, snapshot, {a, q, Point<3>{1, 1, 1.5}}));
    const auto outcome = body.move_corner(0, b);
    ASSERT_TRUE(outcome.is_face_only()) << "the face is over the block";
    EXPECT_EQ(text(to_rational(outcome.face.contact->exact_time())), "1/2");
    EXPECT_EQ(outcome.face.contact->point, tip);
    EXPECT_EQ(outcome.face.contact->kind, Contact_kind::vertex);
    EXPECT_EQ(outcome.face.contact->body, Body_feature::edge);
  }
}

TEST(FaceByHand, CutsNoCornerOffABlockOnWhichItRests) {
  const Snapshot<3> snapshot = block();
  Face_body body(snapshot);
  // On the side x = 2 of the block, two edges along its edges.
  ASSERT_TRUE(place(body, snapshot, {tip, Point<3>{2, 1.5, 1}, Point<3>{2, 2, 0.5}}));
  ASSERT_EQ(body.supporting_walls().size(), 1u);
  EXPECT_FALSE(snapshot.is_solid(snapshot.cell_of(body.supporting_walls()[0])));
  const auto outcome = body.move_corner(0, {1.5, 2, 1});
  ASSERT_TRUE(outcome.is_face_only()) << "the edges slide on the block, no wall is crossed";
  EXPECT_EQ(outcome.face.contact->exact_time(), Exact_time());
  EXPECT_EQ(outcome.face.contact->facet, body.supporting_walls()[0]);
  EXPECT_TRUE(body.move_corner(0, {2.5, 2, 1}).is_made());
  EXPECT_TRUE(body.supporting_walls().empty());
}

/// A membrane that a large face has strictly inside.
struct Floating {
  static constexpr std::uint32_t side = 5;
  static Snapshot<3> world() {
    Two_layers layers(side);
    layers.lay(2, 2);
    return layers.compile();
  }
  /// The face at a height.
  static Triangle at(double z) {
    return {Point<3>{0.25, 0.25, z}, Point<3>{4.75, 0.25, z}, Point<3>{2.5, 4.75, z}};
  }
};

TEST(FaceByHand, LandsOnAMembraneAndLeavesOnlyUpwards) {
  const Snapshot<3> snapshot = Floating::world();
  for (const double from : {1.5, 0.5}) {
    Face_body body(snapshot);
    ASSERT_TRUE(place(body, snapshot, Floating::at(from)));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(body.supporting_walls().empty());
      ASSERT_TRUE(body.move_corner(k, Floating::at(1)[k]).is_made());
    }
    ASSERT_EQ(body.supporting_walls().size(), 1u);
    const Cell cell = snapshot.cell_of(body.supporting_walls()[0]);
    EXPECT_EQ(snapshot.index(cell), 2 + 5 * (2 + 5 * (from > 1 ? 1 : 0)));
    EXPECT_EQ(body.registered().supporting_walls, body.supporting_walls());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto through = body.move_corner(k, Floating::at(2 - from)[k]);
      ASSERT_TRUE(through.is_face_only());
      EXPECT_EQ(through.face.contact->exact_time(), Exact_time());
      EXPECT_EQ(through.face.contact->normal[2], from > 1 ? 1 : -1);
    }
    // Sliding in the plane keeps the side.
    ASSERT_TRUE(body.move_corner(2, {2.5, 4.875, 1}).is_made());
    EXPECT_EQ(body.supporting_walls().size(), 1u);
    EXPECT_EQ(snapshot.cell_of(body.supporting_walls()[0]), cell);
    ASSERT_TRUE(body.move_corner(0, Floating::at(from)[0]).is_made());
    EXPECT_TRUE(body.supporting_walls().empty());
    EXPECT_GT(body.counts.flat, 0u);
  }
}

TEST(FaceByHand, AMembraneThatPassesWhollyThrough) {
  const Snapshot<3> snapshot = Floating::world();
  Face_body body(snapshot);
  Triangle corners = Floating::at(1);
  corners[2][2] = 1.5;
  ASSERT_TRUE(place(body, snapshot, corners));
  auto outcome = body.move_corner(2, {2.5, 4.75, 0.5});
  ASSERT_TRUE(outcome.is_face_only());
  EXPECT_EQ(text(to_rational(outcome.face.contact->exact_time())), "1/2") << "flat on it";
  // From a tilted start to a tilted end, the membrane on different sides of the face.
  corners = {Point<3>{0.25, 0.25, 1.125}, Point<3>{4.75, 0.25, 1.0625}, Point<3>{2.5, 4.75, 1.5}};
  Face_body tilted(snapshot);
  ASSERT_TRUE(place(tilted, snapshot, corners));
  outcome = tilted.move_corner(2, {2.5, 4.75, 0.125});
  ASSERT_TRUE(outcome.is_face_only());
  EXPECT_GT(outcome.face.contact->time, 0.0);
  EXPECT_LT(outcome.face.contact->time, 1.0);
  EXPECT_EQ(outcome.face.contact->kind, Contact_kind::vertex);
  EXPECT_FALSE(tilted.move_corner(2, {2.5, 4.75, 1.25}).face.contact);
}

TEST(FaceByHand, TakesAFreeSideOfAMembraneThatItsEdgesPassed) {
  const Snapshot<3> snapshot = Floating::world();
  Face_body body(snapshot);
  Triangle corners = Floating::at(1);
  corners[2] = {2.5, 0.5, 1};
  ASSERT_TRUE(place(body, snapshot, corners));
  EXPECT_TRUE(body.supporting_walls().empty());
  ASSERT_TRUE(body.move_corner(2, {2.5, 4.75, 1}).is_made());  // in the plane, over the membrane
  ASSERT_EQ(body.supporting_walls().size(), 1u);
  const auto up = body.move_corner(0, Floating::at(1.5)[0]), down = body.move_corner(0, Floating::at(0.5)[0]);
  EXPECT_NE(up.face.contact.has_value(), down.face.contact.has_value());
}

TEST(FaceByHand, SlidesOnATessellatedFloor) {
  Two_layers world(5);
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 5; ++x) world.lay(x, y);
  const Snapshot<3> snapshot = world.compile();
  Face_body body(snapshot);
  ASSERT_TRUE(
      place(body, snapshot, {Point<3>{0.5, 0.5, 1.5}, Point<3>{2.5, 0.5, 1.5}, Point<3>{0.5, 2.5, 1.5}}));
  for (std::size_t k = 0; k < 3; ++k) {
    Point<3> down = body.corner(k).position;
    down[2] = 1;
    ASSERT_TRUE(body.move_corner(k, down).is_made());
  }
  EXPECT_EQ(body.supporting_walls().size(), 6u);  // tiles (0..2, 0..2) below the diagonal x + y = 3
  const auto expect_above = [&] {
    for (const Half_facet supporting_wall : body.supporting_walls())
      EXPECT_GE(snapshot.index(snapshot.cell_of(supporting_wall)), 25u);
    EXPECT_EQ(body.registered().supporting_walls, body.supporting_walls());
    EXPECT_EQ(body.registered().piercing, Half_facet::none);
  };
  expect_above();
  for (const auto& [k, x, y] :
       {std::tuple{1, 4.5, 0.5}, {2, 0.5, 4.5}, {0, 4.5, 4.5}, {1, 4.0, 2.0}, {2, 3.0, 3.0}}) {
    ASSERT_TRUE(body.move_corner(static_cast<std::size_t>(k), {x, y, 1}).is_made());
    EXPECT_FALSE(body.supporting_walls().empty());
    expect_above();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Point<3> down = body.corner(k).position;
    down[2] = 0.5;
    const auto pushed = body.move_corner(k, down);
    EXPECT_TRUE(pushed.vertex && pushed.vertex->time == 0);
    EXPECT_FALSE(pushed.face.contact) << "the point is blocked first";
  }
  EXPECT_TRUE(body.move_corner(0, {4.5, 4.5, 1.5}).is_made());
}

TEST(FaceByHand, WallsThatMeetInThePlaneOfTheFacePierceItTogether) {
  Two_layers world(4);
  world.stand(2, 1, 0);
  const Triangle flat{Point<3>{0.5, 0.5, 1}, Point<3>{3.5, 0.5, 1}, Point<3>{2, 3.5, 1}};
  {
    const Snapshot<3> snapshot = world.compile();
    Face_body body(snapshot);
    EXPECT_TRUE(place(body, snapshot, flat)) << "a wall stands under the face and touches it";
    const auto down = body.move_corner(0, {0.5, 0.5, 0.875});
    ASSERT_TRUE(down.is_face_only());
    EXPECT_EQ(down.face.contact->exact_time(), Exact_time());
  }
  world.stand(2, 1, 1);
  {
    const Snapshot<3> snapshot = world.compile();
    Face_body body(snapshot);
    EXPECT_FALSE(place(body, snapshot, flat)) << "one above, one below";
  }
  world.lay(2, 1);
  {
    Two_layers corner(4);
    corner.stand(2, 1, 0);
    corner.lay(2, 1);
    const Snapshot<3> snapshot = corner.compile();
    Face_body body(snapshot);
    ASSERT_TRUE(place(body, snapshot, flat));
    ASSERT_EQ(body.supporting_walls().size(), 1u);
    EXPECT_GE(snapshot.index(snapshot.cell_of(body.supporting_walls()[0])), 16u)
        << "a wall stands on the other side";
  }
}

TEST(FaceByHand, AWallAcrossAStandingFacePiercesIt) {
  Two_layers world(4);
  world.stand(2, 1, 0);
  const Snapshot<3> snapshot = world.compile();
  Face_body body(snapshot);
  EXPECT_FALSE(
      place(body, snapshot, {Point<3>{0.5, 0.25, 0.75}, Point<3>{3.5, 0.25, 0.75}, Point<3>{2, 3.5, 0.75}}));
}

}  // namespace
}  // namespace cellwalk::test
