// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells by parts of space, and changes of them at steps.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/change_schedule.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cellwalk {
namespace {

/// Unit squares, 4 in a row and 3 high; those of `solid` are so. Cell x + 4 y is [x,x+1] x [y,y+1].
Environment<2> squares(std::vector<std::uint32_t> solid = {}) {
  Grid_options<2> options;
  options.cells = {4, 3};
  options.solid_cells = std::move(solid);
  return Environment<2>::build(square_grid(options));
}

Environment_part<2> in_ball(const Point<2>& centre, double radius) {
  Environment_part<2> part;
  part.shape = Scene_ball<2>{centre, radius};
  return part;
}

/// The facet between cells 0 and 1, and cells 4 and 5, as the file of an environment may name them.
Groups<2> groups_of_file(const Snapshot<2>& snapshot) {
  Groups<2> groups;
  for (std::size_t k = 0; k < 4; ++k)
    if (const Half_facet f = Snapshot<2>::half_facet(snapshot.cell(0), k);
        snapshot.neighbour(f) == snapshot.cell(1))
      groups["valve"].facets.push_back(f);
  groups["plug"].cells = {snapshot.cell(4), snapshot.cell(5)};
  return groups;
}

std::vector<Change_outcome> apply(Environment<2>& environment, Change_schedule<2>& schedule,
                                  std::uint32_t step, const Residents<2>& residents = {}) {
  Reshaping<2> reshaping(environment, residents);
  auto outcomes = schedule.apply(environment.snapshot(), reshaping, step);
  reshaping.finish();
  return outcomes;
}

std::size_t walls_inside(const Snapshot<2>& snapshot) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t f = 0; f < snapshot.facet_count(snapshot.cell(i)); ++f) {
      const Half_facet facet = snapshot.half_facet(snapshot.cell(i), f);
      count += snapshot.is_impassable(facet) && snapshot.neighbour(facet) != Cell::none;
    }
  return count / 2;
}

TEST(ChangeSchedule, ClosesAndOpensAGroup) {
  auto environment = squares();
  const Snapshot<2>& snapshot = environment.snapshot();
  Environment_changes<2> changes;
  changes.groups["door"].plane = Scene_plane<2>{{2, 0}, {1, 0}};
  for (const auto& [kind, step] : {std::pair(Change_kind::close, 3u), std::pair(Change_kind::open, 5u)}) {
    Environment_change<2>& change = changes.list.emplace_back();
    change.kind = kind;
    change.part.group = "door";
    change.step = change.until = step;
  }
  Change_schedule<2> schedule(snapshot, changes);
  EXPECT_FALSE(schedule.is_due(2));
  EXPECT_TRUE(apply(environment, schedule, 2).empty());
  ASSERT_TRUE(schedule.is_due(3));
  const auto closed = apply(environment, schedule, 3);
  ASSERT_EQ(closed.size(), 3u);
  for (const Change_outcome& outcome : closed) {
    EXPECT_TRUE(outcome.result.is_made);
    EXPECT_EQ(outcome.kind, Change_kind::close);
    EXPECT_TRUE(snapshot.is_impassable(outcome.facet));
    EXPECT_EQ(outcome.cell, snapshot.cell_of(outcome.facet));
  }
  EXPECT_EQ(walls_inside(snapshot), 3u);
  EXPECT_FALSE(schedule.is_due(4));
  const auto opened = apply(environment, schedule, 5);
  ASSERT_EQ(opened.size(), 3u);
  EXPECT_EQ(opened[0].change, 1u);
  EXPECT_EQ(walls_inside(snapshot), 0u);
  environment.certify();
}

TEST(ChangeSchedule, TriesAgainWhatABodyHolds) {
  auto environment = squares();
  const Snapshot<2>& snapshot = environment.snapshot();
  Body_soup<2> rod;
  rod.points = {{1.5, 1.5}, {2.5, 1.5}};
  rod.edges = {{0, 1}};
  Body<2> body(snapshot, Locator<2>(snapshot), rod);
  const Residents<2> residents{{&body}, {}};
  Environment_changes<2> changes;
  Environment_change<2>& change = changes.list.emplace_back();
  change.kind = Change_kind::close;
  change.part.plane = Scene_plane<2>{{2, 0}, {1, 0}};
  change.step = 1;
  change.until = 3;
  Change_schedule<2> schedule(snapshot, changes);
  const auto first = apply(environment, schedule, 1, residents);
  ASSERT_EQ(first.size(), 3u);
  EXPECT_TRUE(first[0].result.is_made && first[2].result.is_made);
  ASSERT_FALSE(first[1].result.is_made);
  ASSERT_EQ(first[1].result.held_by.size(), 1u);
  EXPECT_EQ(first[1].result.held_by[0].feature, Body_feature::edge);
  const auto second = apply(environment, schedule, 2, residents);
  ASSERT_EQ(second.size(), 1u) << "only what is left";
  EXPECT_FALSE(second[0].result.is_made);
  Body_counts counts;
  Step_report<2> report;
  body.step(std::vector<Point<2>>{{0.5, 1.5}, {1.5, 1.5}}, {}, report, counts);
  const auto third = apply(environment, schedule, 3, residents);
  ASSERT_EQ(third.size(), 1u);
  EXPECT_TRUE(third[0].result.is_made);
  EXPECT_FALSE(schedule.is_due(4));
  EXPECT_NO_THROW(body.validate());
}

TEST(ChangeSchedule, ExcavatesAndFillsCellsThatAreNotSoYet) {
  auto environment = squares({5, 6});
  const Snapshot<2>& snapshot = environment.snapshot();
  Environment_changes<2> changes;
  for (const Change_kind kind : {Change_kind::excavate, Change_kind::fill}) {
    Environment_change<2>& change = changes.list.emplace_back();
    change.kind = kind;
    change.part.shape = Scene_box<2>{{1, 1}, {4, 2}};
    change.step = change.until = kind == Change_kind::fill ? 2 : 1;
  }
  Change_schedule<2> schedule(snapshot, changes);
  const auto freed = apply(environment, schedule, 1);
  ASSERT_EQ(freed.size(), 2u) << "cell 7 is free";
  EXPECT_EQ(freed[0].facet, Half_facet::none);
  EXPECT_EQ(environment.certify().solid_cells, 0u);
  EXPECT_EQ(walls_inside(snapshot), 0u);
  const auto filled = apply(environment, schedule, 2);
  EXPECT_EQ(filled.size(), 3u);
  EXPECT_EQ(environment.certify().solid_cells, 3u);
}

TEST(ChangeSchedule, RefusesAChangeOfNothing) {
  const auto environment = squares();
  for (const auto& [kind, message] :
       {std::pair(Change_kind::open,
                  "changes[1].open: no facet between two cells of the environment lies there"),
        std::pair(Change_kind::fill, "changes[1].fill: no cell of the environment lies there")}) {
    Environment_changes<2> changes;
    changes.list.resize(2);
    changes.list[0].part = in_ball({1, 1}, 1);
    changes.list[1].kind = kind;
    changes.list[1].part = in_ball({9, 9}, 1);
    try {
      Change_schedule<2>(environment.snapshot(), changes);
      ADD_FAILURE();
    } catch (const Error& e) {
      EXPECT_STREQ(e.what(), message);
      EXPECT_EQ(e.code(), Error_code::input);
    }
  }
}

TEST(ChangeSchedule, KnowsTheGroupsOfTheFile) {
  auto environment = squares();
  const Snapshot<2>& snapshot = environment.snapshot();
  const Groups<2> groups = groups_of_file(snapshot);
  Environment_changes<2> changes;
  changes.groups["corner"] = in_ball({3.5, 2.5}, 0.1);
  changes.list.resize(3);
  changes.list[0].kind = Change_kind::close;
  changes.list[0].part.group = "valve";
  changes.list[1].kind = changes.list[2].kind = Change_kind::fill;
  changes.list[1].part.group = "plug";
  changes.list[2].part.group = "corner";
  Change_schedule<2> schedule(snapshot, changes, groups);
  const auto outcomes = apply(environment, schedule, 1);
  ASSERT_EQ(outcomes.size(), 4u);
  EXPECT_EQ(outcomes[0].facet, groups.at("valve").facets[0]);
  EXPECT_TRUE(snapshot.is_impassable(groups.at("valve").facets[0]));
  for (const std::size_t i : {4, 5, 11}) EXPECT_TRUE(snapshot.is_solid(snapshot.cell(i)));

  const auto refusal = [&](const Groups<2>& of_file) {
    try {
      Change_schedule<2>(snapshot, changes, of_file);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(
      refusal({}),
      "changes[0].close: there is no such group: name it in \"groups\", or in the file of the environment");
  Groups<2> twice = groups;
  twice["corner"];
  EXPECT_EQ(refusal(twice),
            "groups.corner: the file of the environment has a group of that name: rename one");
  Groups<2> empty = groups;
  empty["valve"].facets.clear();
  EXPECT_EQ(refusal(empty), "changes[0].close: no facet between two cells of the environment lies there");
}

}  // namespace
}  // namespace cellwalk
