// SPDX-License-Identifier: LGPL-3.0-or-later
// Cuts of a schedule that are sewn up: in rigid walls, among bodies, and in elastic tissue.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <vector>

#include "simulation/tissue_lab.h"

namespace cellwalk {
namespace {

using test::tissue_block, test::Tissue_lab;

/// A cut in the middle of the block, across the first axis; moved along it.
template <int D>
Environment_change<D> cut_at(std::uint32_t step, double by = 0) {
  Environment_change<D> change{.kind = Change_kind::cut, .part = {}};
  if constexpr (D == 2)
    change.blade.points = {{3.05 + by, 5}, {3.05 + by, 1}};
  else
    change.blade.points = {
        {3.05 + by, 0.5, 5}, {3.05 + by, 5.5, 5}, {3.05 + by, 5.5, 1}, {3.05 + by, 0.5, 1}};
  change.blade.opening = 0.1;
  change.step = change.until = step;
  return change;
}

/// A suture of all that lies between two values along the first axis.
template <int D>
Environment_change<D> suture(std::uint32_t step, std::uint32_t until, double from = 0, double to = 6) {
  Environment_change<D> change{.kind = Change_kind::sew, .part = {}};
  Scene_box<D> box;
  box.upper.fill(6);
  box.lower[0] = from;
  box.upper[0] = to;
  change.part.shape = box;
  change.step = step;
  change.until = until;
  return change;
}

template <int D>
std::vector<Change_outcome> apply(Environment<D>& environment, Change_schedule<D>& schedule,
                                  std::uint32_t step, const Residents<D>& residents = {}) {
  Reshaping<D> reshaping(environment, residents);
  auto outcomes = schedule.apply(environment.snapshot(), reshaping, step);
  reshaping.finish();
  return outcomes;
}

template <int D>
std::size_t walls_in_solid(const Snapshot<D>& snapshot) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || !snapshot.is_solid(c)) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f);
      const Cell other = snapshot.neighbour(facet);
      count += other != Cell::none && snapshot.is_solid(other) && snapshot.is_impassable(facet);
    }
  }
  return count;
}

/// Two cuts, the second across the gap of the first or beside it, and one suture of both.
template <int D>
void sew_up(double second) {
  auto environment = tissue_block<D>();
  const Certificate before = environment.certify();
  Change_schedule<D> schedule(environment.snapshot(),
                              {{}, {cut_at<D>(1), cut_at<D>(2, second), suture<D>(3, 3)}});
  const std::size_t opened =
      apply(environment, schedule, 1)[0].cut->opened + apply(environment, schedule, 2)[0].cut->opened;
  environment.certify();
  ASSERT_TRUE(schedule.is_due(3));
  const auto sewn = apply(environment, schedule, 3);
  ASSERT_FALSE(sewn.empty());
  EXPECT_GE(sewn.size(), opened);
  for (const Change_outcome& outcome : sewn) {
    EXPECT_EQ(outcome.kind, Change_kind::sew);
    EXPECT_EQ(outcome.change, 2u);
    ASSERT_TRUE(outcome.stitch);
    EXPECT_TRUE(outcome.result.is_made) << outcome.result.reason;
    EXPECT_FALSE(environment.snapshot().is_point(outcome.stitch->point));
  }
  EXPECT_FALSE(schedule.is_due(4));
  const Certificate after = environment.certify();
  EXPECT_NEAR(after.free_volume, before.free_volume, 1e-9 * before.volume);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(walls_in_solid(environment.snapshot()), 0u) << "it heals";
}

TEST(Sutures, JoinWhatCutsParted) {
  sew_up<2>(1);
  sew_up<3>(1);
}

TEST(Sutures, JoinWhatWasPartedTwice) {
  sew_up<2>(0);
  sew_up<3>(0);
}

/// A stitch belongs to a part by its place, and what is left is sewn by a later suture.
TEST(Sutures, JoinInAPartOnly) {
  auto environment = tissue_block<2>();
  Change_schedule<2> schedule(
      environment.snapshot(),
      {{}, {cut_at<2>(1, -1), cut_at<2>(1, 1), suture<2>(1, 1, 0, 3), suture<2>(2, 2), suture<2>(3, 3)}});
  const auto first = apply(environment, schedule, 1);
  std::size_t left = first[0].cut->opened + first[1].cut->opened;
  for (const Change_outcome& outcome : first)
    if (outcome.stitch) {
      EXPECT_TRUE(outcome.result.is_made);
      EXPECT_LT(environment.snapshot().point(outcome.stitch->onto)[0], 3);
      --left;
    }
  EXPECT_EQ(left, first[1].cut->opened);
  const auto second = apply(environment, schedule, 2);
  EXPECT_EQ(second.size(), left);
  for (const Change_outcome& outcome : second) EXPECT_EQ(outcome.change, 3u);
  const auto third = apply(environment, schedule, 3);
  ASSERT_EQ(third.size(), 1u);
  EXPECT_FALSE(third[0].result.is_made);
  EXPECT_FALSE(third[0].stitch);
  EXPECT_EQ(third[0].result.reason, "no cut gapes there");
}

/// A vertical cut, and one across it, sewn up where a stitch of the first lies, then everywhere. What the
/// second took back from a point that the first sewing removes goes to the one that is left.
TEST(Sutures, FollowPointsThatWereJoined) {
  Environment_change<2> across = cut_at<2>(2);
  std::size_t chains = 0;
  for (const double height : {0.8, 1.4, 2.05, 2.5}) {
    across.blade.points = {{1, height}, {5, height}};
    std::vector<Stitch> first, second;
    auto environment = tissue_block<2>();
    Change_schedule<2> schedule(environment.snapshot(), {{}, {cut_at<2>(1), across}});
    const auto note = [&](const Cut_report& report, std::vector<Stitch>& stitches) {
      for (const auto& [point, between, share] : report.points)
        if (between[0] == between[1]) stitches.push_back({point, between[0]});
    };
    note(*apply(environment, schedule, 1)[0].cut, first);
    note(*apply(environment, schedule, 2)[0].cut, second);
    for (const Stitch& s : first) {
      if (std::ranges::none_of(second, [&](const Stitch& t) { return t.onto == s.point; })) continue;
      ++chains;
      const Point<2> x = environment.snapshot().point(s.onto), y = environment.snapshot().point(s.point);
      Environment_change<2> one = suture<2>(3, 3);
      one.part.shape = Scene_ball<2>{x + 0.5 * (y - x), 1e-9};
      auto again = tissue_block<2>();
      Change_schedule<2> sewing(again.snapshot(), {{}, {cut_at<2>(1), across, one, suture<2>(4, 4)}});
      apply(again, sewing, 1);
      apply(again, sewing, 2);
      const auto joined = apply(again, sewing, 3);
      ASSERT_EQ(joined.size(), 1u);
      if (!joined[0].result.is_made) continue;
      const auto rest = apply(again, sewing, 4);
      EXPECT_EQ(rest.size() + 1, first.size() + second.size());
      for (const Change_outcome& outcome : rest)
        EXPECT_NE(outcome.stitch->onto, s.point) << "it is gone, but its stitches are not";
      again.certify();
    }
  }
  EXPECT_GE(chains, 1u);
}

/// A point that others have joined may be named anew by a later cut.
TEST(Sutures, ForgetWhatOthersJoined) {
  auto environment = tissue_block<2>();
  Change_schedule<2> schedule(environment.snapshot(), {{}, {cut_at<2>(1), cut_at<2>(2, 1), suture<2>(3, 3)}});
  const Cut_report first = *apply(environment, schedule, 1)[0].cut;
  {
    Reshaping<2> reshaping(environment, {});
    for (auto made = first.points.rbegin(); made != first.points.rend(); ++made) {
      if (made->between[0] != made->between[1]) continue;
      ASSERT_TRUE(reshaping.merge_vertices(made->point, made->between[0]).is_made);
    }
  }
  const Cut_report second = *apply(environment, schedule, 2)[0].cut;
  const auto sewn = apply(environment, schedule, 3);
  EXPECT_EQ(sewn.size(), second.opened) << "those of the first cut are no stitches any more";
  for (const Change_outcome& outcome : sewn) EXPECT_TRUE(outcome.result.is_made) << outcome.result.reason;
}

TEST(Sutures, ACutThatSlitsAMembraneIsMade) {
  auto environment = tissue_block<2>(0.1, 0);
  Environment_change<2> wall;
  wall.kind = Change_kind::close;
  wall.part.plane = Scene_plane<2>{{0, 3}, {0, 1}};
  Change_schedule<2> schedule(environment.snapshot(), {{}, {wall, cut_at<2>(2)}});
  for (const Change_outcome& outcome : apply(environment, schedule, 1)) EXPECT_TRUE(outcome.result.is_made);
  const auto slit = apply(environment, schedule, 2);
  ASSERT_EQ(slit.size(), 1u);
  EXPECT_GT(slit[0].cut->slit, 0u);
  EXPECT_EQ(slit[0].cut->opened, 0u);
  EXPECT_TRUE(slit[0].result.is_made);
  environment.certify();
}

TEST(Sutures, WaitForWhatLiesInTheGap) {
  auto environment = tissue_block<3>();
  const Snapshot<3>& snapshot = environment.snapshot();
  Change_schedule<3> schedule(snapshot, {{}, {cut_at<3>(1), suture<3>(2, 4)}});
  apply(environment, schedule, 1);
  // A needle that stands in the gap.
  Body_soup<3> needle;
  needle.points = {{0, 0, 3.5}, {0, 0, 5}};
  needle.edges = {{0, 1}};
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || snapshot.is_solid(c)) continue;
    Point<3> mean{};
    const Cell_view<3> view = snapshot.view(c);
    for (std::size_t v = 0; v < 4; ++v) mean = mean + 0.25 * (view.point(v) - Point<3>{});
    if (mean[2] < 2.8 && mean[2] > 2.4 && std::abs(mean[1] - 3) < 1) needle.points[0] = mean;
  }
  needle.points[1] = needle.points[0];
  needle.points[1][2] += 1e-3;
  Body<3> body(snapshot, Locator<3>(snapshot), needle);
  const Residents<3> residents{{&body}, {}};
  const auto count_refused = [&](const std::vector<Change_outcome>& outcomes) {
    std::size_t refused = 0;
    for (const Change_outcome& outcome : outcomes) {
      refused += !outcome.result.is_made;
      EXPECT_EQ(outcome.result.is_made, outcome.result.held_by.empty()) << outcome.result.reason;
    }
    return refused;
  };
  const auto first = apply(environment, schedule, 2, residents);
  const std::size_t refused = count_refused(first);
  EXPECT_GT(refused, 0u);
  EXPECT_LT(refused, first.size());
  EXPECT_NO_THROW(body.validate());
  EXPECT_EQ(count_refused(apply(environment, schedule, 3, residents)), refused) << "only what is left";
  const auto last = apply(environment, schedule, 4);
  EXPECT_EQ(last.size(), refused);
  EXPECT_EQ(count_refused(last), 0u);
  EXPECT_EQ(walls_in_solid(snapshot), 0u);
}

TEST(Sutures, FollowACut) {
  const auto environment = tissue_block<2>();
  for (const auto& list : std::vector<std::vector<Environment_change<2>>>{
           {suture<2>(1, 9)}, {suture<2>(1, 1), cut_at<2>(1)}, {suture<2>(1, 3), cut_at<2>(4)}})
    try {
      Change_schedule<2>(environment.snapshot(), {{}, list});
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      EXPECT_STREQ(error.what(), "changes[0].sew: no cut comes before it: cut first, or let it last");
    }
  EXPECT_NO_THROW(Change_schedule<2>(environment.snapshot(), {{}, {suture<2>(1, 4), cut_at<2>(3)}}));
}

/// What is sewn up at once is at rest as if it had never been cut.
template <int D>
void rest_after_suture() {
  Tissue_lab<D> lab({.compliance = 0});
  const std::size_t edges = lab.tissue.edge_count();
  Change_schedule<D> schedule(lab.environment.snapshot(), {{}, {cut_at<D>(1), suture<D>(1, 1)}});
  const auto outcomes = lab.world.change(lab.environment, schedule, lab.counts);
  ASSERT_GT(outcomes.size(), 2u);
  std::size_t split = 0;
  for (const Cut_point& made : outcomes[0].cut->points) split += made.between[0] != made.between[1];
  lab.tissue.follow_changes(outcomes[0].cut->points);
  EXPECT_GE(lab.tissue.edge_count(), edges + split) << "what was parted is one again";
  EXPECT_NEAR(lab.tissue.largest_stretch(), 1, 1e-9);
  const auto before = lab.points();
  lab.step();
  for (std::uint32_t v = 0; v < before.size(); ++v)
    EXPECT_LT(length(lab.environment.snapshot().point(v) - before[v]), 1e-9) << v;
}

TEST(Sutures, LeaveTissueAtRest) {
  rest_after_suture<2>();
  rest_after_suture<3>();
}

/// A cut that gapes under tension, and is sewn up, gapes no more.
template <int D>
void hold_together() {
  Tissue_lab<D> lab({.tension = 0.2});
  Change_schedule<D> schedule(lab.environment.snapshot(), {{}, {cut_at<D>(1), suture<D>(3, 30)}});
  std::size_t made = 0, refused = 0;
  for (std::uint32_t step = 1; step <= 40; ++step) {
    if (schedule.is_due(step)) {
      std::vector<Cut_point> points;
      refused = 0;
      for (const Change_outcome& outcome : lab.world.change(lab.environment, schedule, lab.counts)) {
        if (outcome.cut) points = outcome.cut->points;
        if (!outcome.stitch) continue;
        made += outcome.result.is_made;
        refused += !outcome.result.is_made;
      }
      lab.tissue.follow_changes(points);
    }
    lab.step();
  }
  lab.environment.certify();
  EXPECT_GE(made, D == 2 ? 2u : 4u);
  EXPECT_EQ(refused, 0u);
  EXPECT_EQ(walls_in_solid(lab.environment.snapshot()), 0u);
}

TEST(Sutures, HoldTissueTogether) {
  hold_together<2>();
  hold_together<3>();
}

}  // namespace
}  // namespace cellwalk
