// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells made better by flips, smoothing, collapses and splits, among bodies.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk {
namespace {

/// A grid whose inner vertices were moved far about, with a body across it.
template <int D>
struct Bad_cells {
  Bad_cells() : environment(test::simplex_grid<D>(4)) {
    Random random(7);
    const std::size_t count = environment.snapshot().points().size();
    for (std::uint32_t v = 0; v < count; ++v) points.push_back(v);
    const Residents<D> none;
    Reshaping<D> reshaping(environment, none);
    for (int round = 0; round < 3; ++round)
      for (const std::uint32_t v : points) {
        Point<D> x = environment.snapshot().point(v);
        if (std::ranges::any_of(x, [](double c) { return c == 0 || c == 4; })) continue;
        for (double& c : x) c += random.real(-0.9, 0.9);
        reshaping.move(v, x);
      }
  }
  Environment<D> environment;
  std::vector<std::uint32_t> points;
};

template <int D>
Body_soup<D> line() {
  Body_soup<D> soup;
  for (int k = 0; k < 8; ++k) {
    Point<D> x;
    for (std::size_t i = 0; i < D; ++i) x[i] = 0.5 + 0.4 * k + (i == 1 ? 0.25 : 0) * (k % 2);
    soup.points.push_back(x);
    if (k > 0) soup.edges.push_back({static_cast<std::uint32_t>(k - 1), static_cast<std::uint32_t>(k)});
  }
  return soup;
}

template <int D>
void relax_all(double least_wanted) {
  Relax_report reports[2];
  std::vector<Point<D>> places[2];
  for (int turn = 0; turn < 2; ++turn) {
    Bad_cells<D> bad;
    Body<D> body(bad.environment.snapshot(), Locator<D>(bad.environment.snapshot()), line<D>());
    const Certificate before = bad.environment.certify();
    Reshaping<D> reshaping(bad.environment, {{&body}, {}});
    Relax_report& report = reports[turn];
    report = reshaping.relax(bad.points);
    reshaping.finish();
    EXPECT_NO_THROW(body.validate());
    const Certificate after = bad.environment.certify();
    EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
    EXPECT_EQ(after.boundary_facets, before.boundary_facets);
    EXPECT_GT(report.least_after, least_wanted);
    EXPECT_GT(report.least_after, 2 * report.least_before);
    EXPECT_GT(report.smoothed, 0u);
    EXPECT_GT(report.flipped, 0u);
    places[turn].assign(bad.environment.snapshot().points().begin(),
                        bad.environment.snapshot().points().end());
  }
  EXPECT_EQ(places[0], places[1]) << "the same each time";
  EXPECT_EQ(reports[0].operations(), reports[1].operations());
  std::printf(
      "%dD: least quality %.4f, then %.4f; %u smoothed, %u flipped, %u edges removed, %u split, %u "
      "collapsed\n",
      D, reports[0].least_before, reports[0].least_after, reports[0].smoothed, reports[0].flipped,
      reports[0].edges_removed, reports[0].split, reports[0].collapsed);
}

TEST(Relax, MakesBadCellsBetter2D) { relax_all<2>(0.2); }
TEST(Relax, MakesBadCellsBetter3D) { relax_all<3>(0.05); }

TEST(Relax, KeepsToItsBudget) {
  Bad_cells<3> bad;
  Reshaping<3> reshaping(bad.environment, {});
  EXPECT_EQ(reshaping.relax(bad.points, {.most_operations = 5}).operations(), 5u);
  const Relax_report none =
      reshaping.relax(bad.points, {.smooth = false, .flip = false, .split = false, .collapse = false});
  EXPECT_EQ(none.operations(), 0u);
  EXPECT_EQ(none.least_before, none.least_after);
  EXPECT_GT(none.tried, 0u);
  EXPECT_EQ(reshaping.relax({}).tried, 0u);
  const std::vector<std::uint32_t> unknown{9999};
  EXPECT_THROW(reshaping.relax(unknown), Error);
}

/// Points that are kept stay where they are and keep their indices; the others make up for it.
template <int D>
void keep_some() {
  Bad_cells<D> bad;
  const Snapshot<D>& snapshot = bad.environment.snapshot();
  Relax_options options{.good_enough = 0.6, .shortest = 0.8};
  for (std::uint32_t v = 0; v < bad.points.size(); v += 2) options.keep.push_back(v);
  const std::vector<Point<D>> before(snapshot.points().begin(), snapshot.points().end());
  Reshaping<D> reshaping(bad.environment, {});
  const Relax_report report = reshaping.relax(bad.points, options);
  for (const std::uint32_t v : options.keep) {
    EXPECT_TRUE(snapshot.is_point(v)) << v;
    EXPECT_EQ(snapshot.point(v), before[v]) << v;
  }
  EXPECT_GT(report.smoothed, 0u);
  EXPECT_GT(report.collapsed, 0u);
  // Without it, points of both kinds go.
  Bad_cells<D> other;
  Reshaping<D> all(other.environment, {});
  std::vector<std::uint32_t> kept;
  options.keep.swap(kept);
  all.relax(other.points, options);
  std::size_t gone = 0, moved = 0;
  for (const std::uint32_t v : kept) {
    gone += !other.environment.snapshot().is_point(v);
    moved += other.environment.snapshot().is_point(v) && other.environment.snapshot().point(v) != before[v];
  }
  EXPECT_GT(gone, 0u);
  EXPECT_GT(moved, 0u);
  options.keep = {9999};
  EXPECT_THROW(all.relax({}, options), Error);
}

TEST(Relax, KeepsPointsThatOthersKnow2D) { keep_some<2>(); }
TEST(Relax, KeepsPointsThatOthersKnow3D) { keep_some<3>(); }

/// An edge of a tenth of the others is collapsed, one that is too long is split.
TEST(Relax, CollapsesShortEdgesAndSplitsLongOnes) {
  Environment<2> environment = test::simplex_grid<2>(4);
  const Snapshot<2>& snapshot = environment.snapshot();
  Reshaping<2> reshaping(environment, {});
  const std::uint32_t v = test::point_at<2>(environment, {2, 2});
  const Replacement in = reshaping.split_edge(v, test::point_at<2>(environment, {3, 2}), {2.0625, 2});
  ASSERT_TRUE(in.is_made);
  const std::vector<std::uint32_t> points{v, in.point};
  const Relax_report report = reshaping.relax(points, {.good_enough = 0.6, .smooth = false, .flip = false});
  EXPECT_EQ(report.collapsed, 1u);
  EXPECT_EQ(report.operations(), 1u);
  EXPECT_EQ(snapshot.is_point(v) + snapshot.is_point(in.point), 1);
  EXPECT_NO_THROW(environment.certify());
}

}  // namespace
}  // namespace cellwalk
