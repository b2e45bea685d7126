// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "body/region/clear_region.h"
#include "body/rooms.h"

namespace cellwalk::test {
namespace {

using detail::Clear_region;
using detail::find_clear_region;
using detail::Open_box;
using detail::Region_effort;
using detail::Region_request;

/// A point of a region, somewhere in its box; near its border as often as not.
template <int D>
Point<D> point_in(const Clear_region<D>& region, const Point<D>& low, const Point<D>& high, Random& random) {
  for (;;) {
    Point<D> x;
    for (int k = 0; k < D; ++k) {
      const double from = std::max(low[k], region.box().low(k)), to = std::min(high[k], region.box().high(k));
      const double where = random.real(0, 1);
      x[k] = where < 0.2   ? std::nextafter(from, to)
             : where > 0.8 ? std::nextafter(to, from)
                           : random.real(from, to);
    }
    if (region.holds(x)) return x;
  }
}

struct Found {
  int regions = 0, whole = 0, with_planes = 0, none = 0;
};

/// Regions about small clouds of points: whatever is spanned by points of them is free.
template <int D>
Found expect_free(const Snapshot<D>& snapshot, const Point<D>& low, const Point<D>& high, double size,
                  int trials, std::size_t most_cells = 64) {
  Random random(11);
  const Locator<D> locator(snapshot);
  Walk_counts counts;
  Found result;
  for (int trial = 0; trial < trials; ++trial) {
    Point<D> middle;
    for (int k = 0; k < D; ++k) middle[k] = random.real(low[k], high[k]);
    std::vector<Point<D>> positions, targets;
    Vector<D> step;
    for (double& c : step) c = random.real(-0.2 * size, 0.2 * size);
    for (int v = 0; v < 6; ++v) {
      Point<D> x = middle;
      for (double& c : x) c += random.real(-size, size);
      positions.push_back(x);
      targets.push_back(x + step);
    }
    const Particle<D> anchor = locator.particle_at(positions[0]).value_or(Particle<D>{});
    if (anchor.cell == Cell::none) continue;
    Region_effort effort;
    Region_request<D> request;
    request.positions = positions;
    request.targets = targets;
    request.most_cells = most_cells;
    const auto region = find_clear_region(snapshot, anchor, request, effort);
    result.regions += region.has_value();
    result.none += !region;
    if (!region) continue;
    EXPECT_TRUE(region->holds(positions[0]));
    result.with_planes += region->plane_count() > 0;
    result.whole += region->holds_all(positions) && region->holds_all(targets);
    for (int k = 0; k < 10; ++k) {
      Particle<D> p = anchor;
      const Point<D> x = point_in(*region, low, high, random), y = point_in(*region, low, high, random);
      EXPECT_EQ(move(snapshot, p, x, counts).status, Walk_status::arrived);
      EXPECT_EQ(move(snapshot, p, y, counts).status, Walk_status::arrived);
    }
  }
  return result;
}

TEST(ClearRegion, HoldsNoWallOfAGrid) {
  const Found in_plane = expect_free<2>(rooms<2>({6, 6}, {8, 14, 27}), {0, 0}, {6, 6}, 0.3, 2000);
  EXPECT_GT(in_plane.whole, 800);
  EXPECT_GT(in_plane.regions, in_plane.whole + 300);
  EXPECT_GT(in_plane.with_planes, 5);
  const Found in_space =
      expect_free<3>(rooms<3>({4, 4, 4}, {21, 42, 5, 58}), {0, 0, 0}, {4, 4, 4}, 0.3, 2000);
  EXPECT_GT(in_space.whole, 500);
  EXPECT_GT(in_space.regions, in_space.whole + 300);
  EXPECT_GT(in_space.with_planes, 20);
}

TEST(ClearRegion, HoldsNoWallOfAVessel) {
  const Snapshot<3> snapshot = compile(branching_vessel({}));
  Point<3> low = snapshot.point(0), high = low;
  for (const Point<3>& x : snapshot.points())
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  const Found found = expect_free<3>(snapshot, low, high, 0.006 * length(high - low), 4000, 2000);
  EXPECT_GT(found.whole, 50);
  EXPECT_GT(found.regions, found.whole);
  EXPECT_GT(found.with_planes, 50);
}

TEST(ClearRegion, ReachesWallsAndWhereTheMotionLeads) {
  const Snapshot<2> snapshot = rooms<2>({6, 6}, {14});  // solid at x from 2 to 3, y from 2 to 3
  const std::vector<Point<2>> positions{{1.5, 2.5}, {1.6, 2.6}}, targets{{1.54, 2.5}, {1.64, 2.6}};
  Region_request<2> request;
  request.positions = positions;
  request.targets = targets;
  Region_effort effort;
  const auto region =
      find_clear_region(snapshot, Locator<2>(snapshot).particle_at(positions[0]).value(), request, effort);
  ASSERT_TRUE(region);
  EXPECT_EQ(region->box().high(0), 2) << "the wall";
  EXPECT_TRUE(region->holds({std::nextafter(2.0, 0.0), 2.5}));
  EXPECT_FALSE(region->holds({2, 2.5}));
  EXPECT_FALSE(region->holds({1.5, 3})) << "it leads not there";
}

TEST(ClearRegion, LooksAtTheCellOfTheAnchorAtLeast) {
  const Snapshot<2> snapshot = rooms<2>({6, 6});
  const Locator<2> locator(snapshot);
  const std::vector<Point<2>> positions{{2.5, 2.5}}, targets{{2.75, 2.5}};
  Region_request<2> request;
  request.positions = positions;
  request.targets = targets;
  for (const std::size_t most : {std::size_t{0}, std::size_t{1}}) {
    Region_effort effort;
    request.most_cells = most;
    const auto region = find_clear_region(snapshot, locator.particle_at({2.5, 2.5}).value(), request, effort);
    ASSERT_TRUE(region);
    EXPECT_EQ(effort.cells, 1u);
    EXPECT_TRUE(effort.is_exhausted);
    EXPECT_TRUE(region->holds({2.75, 2.5}));
    EXPECT_FALSE(region->holds({3, 2.5}));
  }
}

TEST(ClearRegion, IsNoneAtAWall) {
  const Snapshot<2> snapshot = rooms<2>({6, 6}, {14});
  const Locator<2> locator(snapshot);
  const std::vector<Point<2>> on_wall{{2, 2.5}}, aside{{1.9, 2.4}};
  Region_effort effort;
  Region_request<2> request;
  request.positions = on_wall;
  request.targets = aside;
  EXPECT_FALSE(find_clear_region(snapshot, locator.particle_at({2, 2.5}).value(), request, effort));
  const std::vector<Point<2>> infinite{{1e308, 2.5}}, start{{-1e308, 2.5}};
  request.positions = start;
  request.targets = infinite;
  EXPECT_FALSE(find_clear_region(snapshot, locator.particle_at({1.5, 2.5}).value(), request, effort));
}

/// Regions are those of the same world at another scale, or smaller.
TEST(ClearRegion, IsNotEnlargedByUnderflowOrOverflow) {
  int found = 0, with_planes = 0;
  Random random(7);
  for (int k = 0; k < 100; ++k) {
    std::array<Point<3>, 4> corners;
    for (Point<3>& x : corners)
      for (double& c : x) c = random.real(-1, 1);
    const double volume =
        dot(cross(corners[1] - corners[0], corners[2] - corners[0]), corners[3] - corners[0]);
    if (std::abs(volume) < 0.01) continue;
    if (volume < 0) std::swap(corners[0], corners[1]);
    for (const int scale : {0, -100, -262, -266, -268, -300, -340, 100, 260, 330, 500}) {
      const auto scaled = [scale](Point<3> x) {
        for (double& c : x) c = std::ldexp(c, scale);
        return x;
      };
      Cell_soup<3> soup;
      for (const Point<3>& x : corners) soup.points.push_back(scaled(x));
      for (const auto& f : {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {1u, 2u, 3u}, {0u, 3u, 2u}})
        soup.add_facet({f[0], f[1], f[2]}, true);
      soup.end_cell();
      const Snapshot<3> snapshot = compile(soup);
      const Locator<3> locator(snapshot);
      const Point<3> middle = scaled(0.25 * (corners[0] + corners[1] + corners[2] + corners[3]));
      const std::vector<Point<3>> positions{middle}, targets{scaled({1, 0.9, 0.8})};
      Region_effort effort;
      Region_request<3> request;
      request.positions = positions;
      request.targets = targets;
      const auto region = find_clear_region(snapshot, locator.particle_at(middle).value(), request, effort);
      if (!region) continue;
      ++found;
      with_planes += region->plane_count() > 0;
      for (int i = 0; i < 200; ++i) {
        Point<3> x;
        for (double& c : x) c = random.real(-1, 1);
        if (region->holds(scaled(x))) {
          EXPECT_TRUE(locator.particle_at(scaled(x))) << scale;
        }
      }
    }
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(with_planes, 100);
}

/// The box of a search ends beyond a wall, by less than single precision can tell.
TEST(ClearRegion, HoldsNoWallThatItsBoxHardlyMeets) {
  Random random(8);
  int trials = 0;
  while (trials < 400) {
    std::array<Point<2>, 3> corners;
    for (Point<2>& x : corners)
      for (double& c : x) c = random.real(-1, 1);
    const Vector<2> u = corners[1] - corners[0], v = corners[2] - corners[0];
    if (u[0] * v[1] - u[1] * v[0] < 0.1) continue;
    Cell_soup<2> soup;
    soup.points.assign(corners.begin(), corners.end());
    for (std::uint32_t k = 0; k < 3; ++k) soup.add_facet({k, (k + 1) % 3}, true);
    soup.end_cell();
    const Snapshot<2> snapshot = compile(soup);
    const Locator<2> locator(snapshot);
    // A step to beyond the middle of a side, which is the corner of the box that is furthest out.
    const Point<2> end = corners[0] + 0.5 * u + 1e-9 * Vector<2>{u[1], -u[0]};
    const Point<2> start = end - 0.01 * Vector<2>{u[1], -u[0]};
    const auto anchor = locator.particle_at(start);
    if (!anchor || locator.particle_at(end)) continue;
    ++trials;
    const std::vector<Point<2>> positions{start}, targets{end};
    Region_request<2> request;
    request.positions = positions;
    request.targets = targets;
    request.steps_ahead = request.steps_around = 1e-9;
    Region_effort effort;
    const auto region = find_clear_region(snapshot, *anchor, request, effort);
    EXPECT_FALSE(region && region->holds(end));
  }
}

/// Where coordinates are too large for planes in single precision, nothing is known of any lane, also of
/// those without a facet.
TEST(ClearRegion, IsFoundWherePlanesSayNothing) {
  for (const double scale : {1.0, 0x1p330, 0x1p500}) {
    Cell_soup<2> soup;
    for (const Point<2>& x : {Point<2>{0, 0}, {scale, 0}, {0, scale}}) soup.points.push_back(x);
    for (std::uint32_t k = 0; k < 3; ++k) soup.add_facet({k, (k + 1) % 3}, true);
    soup.end_cell();
    const Snapshot<2> snapshot = compile(soup);
    const std::vector<Point<2>> positions{{0.25 * scale, 0.25 * scale}},
        targets{{0.27 * scale, 0.26 * scale}};
    Region_request<2> request;
    request.positions = positions;
    request.targets = targets;
    Region_effort effort;
    const auto region =
        find_clear_region(snapshot, Locator<2>(snapshot).particle_at(positions[0]).value(), request, effort);
    ASSERT_TRUE(region) << scale;
    EXPECT_EQ(effort.cells, 1u);
    EXPECT_TRUE(region->holds_all(targets));
    EXPECT_FALSE(region->holds({scale, scale}));
  }
}

TEST(OpenBox, HoldsWhatEachComparisonSays) {
  Random random(5);
  int all = 0, some = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Open_box<3> box({0, 0, 0}, {8, 8, 8});
    box.cut_above(trial % 3, 6);
    box.cut_below((trial + 1) % 3, 1);
    std::vector<Point<3>> points(static_cast<std::size_t>(trial % 9));
    for (Point<3>& x : points)
      for (double& c : x) c = random.chance(0.03) ? random.real(-1, 9) : random.real(2, 5);
    bool expected = true;
    for (const Point<3>& x : points) {
      bool inside = true;
      for (int k = 0; k < 3; ++k)
        inside = inside && x[k] > (k == (trial + 1) % 3 ? 1 : 0) && x[k] < (k == trial % 3 ? 6 : 8);
      EXPECT_EQ(box.holds(x), inside);
      expected = expected && inside;
    }
    EXPECT_EQ(box.holds_all(points), expected);
    ++(expected ? all : some);
  }
  EXPECT_GT(all, 500);
  EXPECT_GT(some, 150);
  EXPECT_FALSE(Open_box<2>({0, 0}, {1, 1}).holds({std::numeric_limits<double>::quiet_NaN(), 0.5}));
}

/// One coordinate of many points is not a number in the box, each in turn: minima and maxima may lose NaNs.
template <int D>
void expect_not_held(double outside) {
  Random random(6);
  Point<D> low, high;
  low.fill(-1);
  high.fill(2);
  const Open_box<D> box(low, high);
  int refused = 0;
  for (std::size_t count = 1; count <= 12; ++count) {
    std::vector<Point<D>> points(count);
    for (Point<D>& x : points)
      for (double& c : x) c = random.real(-0.5, 1.5);
    ASSERT_TRUE(box.holds_all(points));
    for (Point<D>& x : points)
      for (double& c : x) {
        const double kept = std::exchange(c, outside);
        EXPECT_FALSE(box.holds(x)) << outside;
        EXPECT_FALSE(box.holds_all(points)) << outside << " among " << count;
        ++refused;
        c = kept;
      }
  }
  EXPECT_EQ(refused, 78 * D);
}

TEST(OpenBox, HoldsNoNumberOutside) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const double outside : {nan, -nan, inf, -inf, -1.0, 2.0}) {
    expect_not_held<2>(outside);
    expect_not_held<3>(outside);
  }
}

}  // namespace
}  // namespace cellwalk::test
