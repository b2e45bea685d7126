// SPDX-License-Identifier: LGPL-3.0-or-later
// Elastic tissue that is cut, excavated and filled.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "simulation/tissue_lab.h"

namespace cellwalk {
namespace {

using test::Tissue_lab;

/// Points that a cut parted are further apart later if the tissue is under tension, and not if it is not.
template <int D>
void gape() {
  double widest[2];
  for (const int is_tense : {0, 1}) {
    Tissue_lab<D> lab({.tension = 0.4 * is_tense});
    const Cut_report report = lab.cut(0.05);
    EXPECT_GT(report.opened, 0u);
    lab.tissue.follow_changes(report.points);
    lab.steps(15);
    widest[is_tense] = 0;
    for (const Cut_point& made : report.points)
      if (made.between[0] == made.between[1])
        widest[is_tense] =
            std::max(widest[is_tense], std::abs(lab.environment.snapshot().point(made.point)[0] -
                                                lab.environment.snapshot().point(made.between[0])[0]));
  }
  EXPECT_LT(widest[0], 0.1);
  EXPECT_GT(widest[1], 0.3);
}

TEST(TissueChanges, ACutGapesUnderTension) {
  gape<2>();
  gape<3>();
}

/// What a cut hardly opens hardly moves: points that it made are at rest where they lie on their edges, or
/// where they were taken back from.
template <int D>
void rest_after_cut() {
  Tissue_lab<D> lab({.compliance = 0});
  const Cut_report report = lab.cut(1e-6);
  ASSERT_GT(report.points.size(), 1u);
  lab.tissue.follow_changes(report.points);
  const auto before = lab.points();
  lab.step();
  for (std::uint32_t v = 0; v < before.size(); ++v)
    EXPECT_LT(length(lab.environment.snapshot().point(v) - before[v]), 1e-5) << v;
}

TEST(TissueChanges, IsAtRestAfterACut) {
  rest_after_cut<2>();
  rest_after_cut<3>();
}

TEST(TissueChanges, KnowsOfCutsBeforeItGoesOn) {
  Tissue_lab<2> lab({.tension = 0.3});
  const Cut_report report = lab.cut(0.05);
  EXPECT_THROW(lab.tissue.targets(lab.world), Error);
  // Points of which nothing is said are at rest where they are, not anywhere else.
  lab.tissue.follow_changes({});
  const auto before = lab.points();
  std::size_t made = 0;
  for (const auto& [point, target] : lab.tissue.targets(lab.world)) {
    EXPECT_LT(length(target - before[point]), 1) << point;
    made += std::ranges::any_of(report.points, [p = point](const Cut_point& cut) { return cut.point == p; });
  }
  EXPECT_GT(made, 0u);
}

/// A vertex that moves when it is parted goes on as two.
TEST(TissueChanges, PartsOfACutGoOnMoving) {
  Tissue_lab<2> lab({.compliance = 1e12, .incompressible = 0, .damping = 0});
  const std::uint32_t v = lab.on_wall();
  lab.tissue.targets(lab.world);
  lab.move(v, 0.1);
  lab.tissue.follow();
  const Cut_report report = lab.cut(0.01);
  lab.tissue.follow_changes(report.points);
  std::set<std::uint32_t> parts{v};
  for (const Cut_point& made : report.points)
    if (made.between[0] == v && made.between[1] == v) parts.insert(made.point);
  ASSERT_EQ(parts.size(), 2u) << "the cut passes the vertex";
  std::size_t moved = 0;
  for (const auto& [point, target] : lab.tissue.targets(lab.world)) {
    if (!parts.contains(point)) continue;
    EXPECT_NEAR(target[1] - lab.height_of(point), 0.1, 1e-9);
    ++moved;
  }
  EXPECT_EQ(moved, 2u);
}

/// Contacts of the step before name facets that a cut replaced.
TEST(TissueChanges, IsNotPressedThroughFacetsThatAreGone) {
  const auto [scene, rod] = test::rod_into_tissue<3>();
  Tissue_lab<3> lab({.yield = 1}, scene, {rod});
  while (lab.world.contacts().empty()) lab.step();
  std::size_t named = 0;
  for (const auto& met : lab.world.contacts()) named += met.contact.facet != Half_facet::none;
  ASSERT_GT(named, 0u);
  const Cut_report report = lab.cut(0.05);
  for (const auto& met : lab.world.contacts()) {
    EXPECT_EQ(met.contact.facet, Half_facet::none);
    EXPECT_EQ(met.contact.cell, Cell::none);
  }
  lab.tissue.follow_changes(report.points);
  EXPECT_NO_THROW(lab.steps(5));
}

/// Where all solid cells are excavated, nothing is elastic any more, and nothing is wrong.
TEST(TissueChanges, MayBeExcavated) {
  Tissue_lab<3> lab({.tension = 0.3});
  lab.steps(2);
  {
    Reshaping<3> reshaping(lab.environment, {});
    const Snapshot<3>& snapshot = lab.environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      if (snapshot.is_solid(snapshot.cell(i))) reshaping.excavate(snapshot.cell(i));
  }
  World<3> world(lab.environment.snapshot(), {});
  ASSERT_NO_THROW(lab.tissue.follow_changes({}));
  EXPECT_EQ(lab.tissue.edge_count(), 0u);
  EXPECT_EQ(lab.tissue.largest_stretch(), 0);
  ASSERT_NO_THROW(lab.tissue.targets(world));
}

/// A gap that is filled again has edges of no length at rest.
TEST(TissueChanges, StretchIsFiniteWhereACutIsFilled) {
  Tissue_lab<2> lab({.tension = 0.2});
  const Cut_report report = lab.cut(0.05);
  std::set<std::uint32_t> parted;
  for (const Cut_point& made : report.points)
    if (made.between[0] == made.between[1]) parted.insert(made.point);
  ASSERT_FALSE(parted.empty());
  std::size_t filled = 0;
  {
    Reshaping<2> reshaping(lab.environment, {});
    const Snapshot<2>& snapshot = lab.environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell cell = snapshot.cell(i);
      if (cell == Cell::none || snapshot.is_solid(cell)) continue;
      double top = 0;
      for (const std::uint32_t v : snapshot.view(cell).vertices) top = std::max(top, snapshot.point(v)[1]);
      if (top < 3.2) filled += reshaping.fill(cell).is_made;
    }
  }
  ASSERT_GT(filled, 1u);
  lab.tissue.follow_changes(report.points);
  EXPECT_TRUE(std::isfinite(lab.tissue.largest_stretch())) << lab.tissue.largest_stretch();
  EXPECT_GT(lab.tissue.largest_stretch(), 1);
}

TEST(TissueChanges, IsTheSameEachTime) {
  std::vector<Point<3>> places[2];
  for (auto& found : places) {
    Tissue_lab<3> lab({.tension = 0.3});
    const Cut_report report = lab.cut(0.05);
    lab.tissue.follow_changes(report.points);
    lab.steps(5);
    found = lab.points();
  }
  EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace cellwalk
