// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include <vector>

#include "reshape/toggle_cases.h"

namespace cellwalk {
namespace {

using test::body_at, test::expect_held, test::expect_sound, test::level_facets;

TEST(ToggleFaces, EdgesInTheFacetOfAFaceGoWithIt) {
  // A face that stands on the facet, and reaches further; its edge there passed below when it came.
  for (const double tip : {3.5, 0.5}) {
    Environment<3> environment = test::simplex_grid<3>(4);
    Body<3> body = body_at<3>(environment, {{0.5, 1.75, 2}, {3.5, 1.75, 2}, {2, 1.75, tip}}, true);
    const std::vector<Half_facet> square = level_facets<3>(environment, 2, {1, 1});
    {
      Reshaping<3> reshaping(environment, {{&body}, {}});
      for (const Half_facet f : square) EXPECT_TRUE(reshaping.close(f).is_made);
    }
    expect_sound(environment, body);
    Body_counts counts;
    Step_report<3> report;
    body.step(std::vector<Point<3>>{{0.5, 1.75, 2}, {3.5, 1.75, 2}, {2, 1.75, 4 - tip}}, {}, report, counts);
    EXPECT_FALSE(report.contacts.empty()) << "the edge in the facet is on the side of the tip";
  }
  // Two faces, one on each side: the facet would come to lie between them.
  Environment<3> environment = test::simplex_grid<3>(4);
  Body<3> kite(environment.snapshot(), Locator<3>(environment.snapshot()),
               {{{0.5, 1.75, 2}, {3.5, 1.75, 2}, {2, 1.75, 3.5}, {2, 1.75, 0.5}},
                {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}},
                {{0, 1, 2}, {0, 3, 1}}});
  Reshaping<3> reshaping(environment, {{&kite}, {}});
  for (const Half_facet f : level_facets<3>(environment, 2, {1, 1}))
    expect_held<3>(reshaping.close(f),
                   {{false, 0, Body_feature::face, 0}, {false, 0, Body_feature::face, 1}});
}

Body<3> big_face(const Environment<3>& environment, double height) {
  return body_at<3>(environment, {{0.25, 0.25, height}, {3.75, 0.25, height}, {2, 3.75, height}}, true);
}

/// A face that comes from a height, and comes to lie on a membrane inside of it.
Body<3> resting_face(const Environment<3>& environment, double from = 2.5) {
  Body<3> body = big_face(environment, from);
  Body_counts counts;
  Step_report<3> report;
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  body.step(big_face(environment, 2).positions(), options, report, counts);
  EXPECT_TRUE(report.contacts.empty());
  body.refresh(counts);
  return body;
}

TEST(ToggleFaces, FaceBetweenAMembraneAndWhatIsFilled) {
  Environment<3> environment = test::simplex_grid<3>(4);
  const Half_facet w = level_facets<3>(environment, 2, {1, 1}).at(0);
  environment.set_impassable(w, true);
  const Snapshot<3>& snapshot = environment.snapshot();
  Body<3> body = resting_face(environment);
  const Cell below = snapshot.cell_of(w), above = snapshot.neighbour(w);
  {
    Reshaping<3> reshaping(environment, {{&body}, {}});
    expect_held<3>(reshaping.fill(above), {{false, 0, Body_feature::face, 0}});
    EXPECT_FALSE(snapshot.is_solid(above));
    EXPECT_TRUE(reshaping.fill(below).is_made);
    EXPECT_TRUE(reshaping.excavate(below).is_made) << "its facets become passable, the membrane as well";
    EXPECT_FALSE(snapshot.is_impassable(w));
  }
  expect_sound(environment, body);
  {
    Reshaping<3> reshaping(environment, {{&body}, {}});
    EXPECT_TRUE(reshaping.fill(above).is_made) << "it is beside the face, on which nothing else lies";
  }
  expect_sound(environment, body);
}

TEST(ToggleFaces, FaceKeepsTheSideOfWhatItRestsOn) {
  for (const double from : {2.5, 1.5}) {
    Environment<3> environment = test::simplex_grid<3>(4);
    const std::vector<Half_facet> square = level_facets<3>(environment, 2, {1, 1});
    ASSERT_EQ(square.size(), 2u);
    environment.set_impassable(square[0], true);
    Body<3> body = resting_face(environment, from);
    const Snapshot<3>& snapshot = environment.snapshot();
    const auto beside = [&](Half_facet f) { return from > 2 ? snapshot.neighbour(f) : snapshot.cell_of(f); };
    const auto expect_held_by_face = [&](const Outcome& result) {
      ASSERT_FALSE(result.is_made);
      EXPECT_EQ(result.held_by.back(), (Resident{false, 0, Body_feature::face, 0}));
    };
    {
      Reshaping<3> reshaping(environment, {{&body}, {}});
      EXPECT_TRUE(reshaping.close(square[1]).is_made);
      // It is on one side of both, so that nothing can be filled there.
      for (const Half_facet f : square) expect_held_by_face(reshaping.fill(beside(f)));
      // Nothing holds walls that are opened, nor what was behind them.
      EXPECT_TRUE(reshaping.open(square[0]).is_made);
      expect_held_by_face(reshaping.fill(beside(square[1])));
      EXPECT_TRUE(reshaping.open(square[1]).is_made);
      EXPECT_TRUE(reshaping.fill(beside(square[1])).is_made);
    }
    expect_sound(environment, body);
  }
}

TEST(ToggleFaces, FaceHoldsWhatWouldPierceIt) {
  Environment<3> environment = test::simplex_grid<3>(4);
  Body<3> body = big_face(environment, 1.5);
  const Snapshot<3>& snapshot = environment.snapshot();
  Reshaping<3> reshaping(environment, {{&body}, {}});
  const Cell inside = Locator<3>(snapshot).particles_at({2.1, 1.7, 1.5}).at(0).cell;
  std::size_t held = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Outcome result = reshaping.close(Snapshot<3>::half_facet(inside, k));
    if (result.is_made) continue;
    ++held;
    EXPECT_EQ(result.held_by, (std::vector<Resident>{{false, 0, Body_feature::face, 0}}));
  }
  EXPECT_GE(held, 3u) << "those that its plane cuts";
  expect_held<3>(reshaping.fill(inside), {{false, 0, Body_feature::face, 0}});
}

}  // namespace
}  // namespace cellwalk
