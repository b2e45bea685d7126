// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps of bodies whose targets lie behind walls, however far.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {
namespace {

/// An edge is in the way first, then a wall of its vertex, however far behind: with the paper's sweep the
/// vertex goes as far as with the complete one.
template <int D>
void expect_three_segments_go_on(const Snapshot<D>& snapshot, const Body_soup<D>& soup, int axis) {
  const Locator<D> locator(snapshot);
  for (const double target : {1.4, 2.9, 3.5, 6.0, 100.0, 1e10}) {
    std::vector<Point<D>> ends;
    for (const Sweep sweep : {Sweep::triangle, Sweep::three_segments}) {
      Body<D> body(snapshot, locator, soup);
      Body_options options;
      options.sweep.sweep = sweep;
      Step_report<D> report;
      Body_counts counts;
      for (int k = 0; k < 10; ++k) {
        std::vector<Point<D>> targets = soup.points;
        targets[0][axis] = target;
        body.step(targets, options, report, counts);
      }
      ends.push_back(body.positions()[0]);
      if (target < 2) {
        EXPECT_TRUE(report.contacts.empty());
        continue;
      }
      ASSERT_FALSE(report.contacts.empty());
      EXPECT_EQ(report.contacts[0].body, Body_feature::edge);
      EXPECT_GT(body.positions()[0][axis], soup.points[0][axis] + 0.5) << "it stays";
    }
    EXPECT_EQ(ends[0], ends[1]) << target;
  }
}

TEST(BodyTargets, ThreeSegmentsStopWhereTheEdgeIsInTheWayFirst) {
  expect_three_segments_go_on<2>(rooms<2>({3, 3}, {4}), {{{0.5, 0.75}, {1.5, 0.5}}, {{0, 1}}, {}}, 1);
  expect_three_segments_go_on<3>(rooms<3>({3, 3, 3}, {13}),
                                 {{{0.5, 0.75, 1.25}, {1.5, 0.5, 1.5}}, {{0, 1}}, {}}, 1);
}

/// Targets so far away that differences to them forget all other points: the filters of the signs decide as
/// many as ever.
TEST(BodyTargets, FarTargetsLeaveFiltersOfUse) {
  const Snapshot<3> snapshot = rooms<3>({6, 6, 6}, {43, 86, 100, 129, 172});
  const Locator<3> locator(snapshot);
  Random random(7);
  std::array<Body_counts, 4> counts;
  const std::array<double, 4> distances{10, 1e10, 1e100, 1e200};
  for (int k = 0; k < 30; ++k) {
    Body_soup<3> soup;
    for (std::uint32_t v = 0; v < 4; ++v) {
      soup.points.push_back({random.real(0.1, 5.9), random.real(0.1, 5.9), random.real(0.1, 5.9)});
      for (std::uint32_t u = 0; u < v; ++u) soup.edges.push_back({u, v});
    }
    std::array<int, 4> ways;
    for (int& path : ways) path = static_cast<int>(random.below(6));
    for (std::size_t i = 0; i < distances.size(); ++i) try {
        Body<3> body(snapshot, locator, soup);
        std::vector<Point<3>> targets = soup.points;
        for (std::size_t v = 0; v < 4; ++v)
          targets[v][static_cast<std::size_t>(ways[v] / 2)] = (ways[v] % 2 == 0 ? -1 : 1) * distances[i];
        Step_report<3> report;
        body.step(targets, {}, report, counts[i]);
        body.refresh(counts[i]);
        body.validate();
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), Error_code::outside) << error.what();
      }
  }
  for (const Body_counts& c : counts) {
    EXPECT_GT(c.contacts, 20u);
    EXPECT_GT(c.edges.event_sweeps, 20u);
    const Predicate_counts& signs = c.edges.walk.predicates;
    EXPECT_LT(static_cast<double>(signs.fallbacks), 0.04 * static_cast<double>(signs.orientations));
    std::cout << c.contacts << " contacts, " << c.edges.event_sweeps << " sweeps by events, "
              << signs.fallbacks << " of " << signs.orientations << " signs exact\n";
  }
}

}  // namespace
}  // namespace cellwalk::test
