// SPDX-License-Identifier: LGPL-3.0-or-later
// Regions for parts of a body, found by clusters of cells: what they hold is free, at an ulp from walls too.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>
#include <vector>

#include "body/region/clear_region.h"
#include "body/rooms.h"
#include "body/with_regions.h"

namespace cellwalk::test {
namespace {

using detail::find_clear_region;
using detail::Region_effort;
using detail::Region_request;

template <int D>
detail::Box<D> bounds_of(const Snapshot<D>& snapshot) {
  detail::Box<D> box;
  for (const Point<D>& x : snapshot.points()) box.extend(x);
  return box;
}

struct Found_beside_walls {
  int regions = 0, none = 0, at_walls = 0, with_planes = 0;
};

/// A point beside the wall that a walk meets: as close to it as numbers go.
template <int D>
std::optional<Point<D>> beside_wall(const Snapshot<D>& snapshot, const Particle<D>& from, double size,
                                    Random& random) {
  Point<D> to = from.position;
  for (double& c : to) c += random.real(-8 * size, 8 * size);
  Particle<D> p = from;
  Walk_counts counts;
  const auto walked = move(snapshot, p, to, counts);
  if (!walked.contact) return {};
  for (int ulps = 1; ulps < 64; ulps *= 2) {
    Point<D> x = walked.contact->point;
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < ulps; ++i) x[k] = std::nextafter(x[k], from.position[k]);
    p = from;
    if (move(snapshot, p, x, counts).status == Walk_status::arrived) return x;
  }
  return {};
}

/// Regions about small clouds of points, some of them beside walls: whatever is spanned by points of them is
/// free.
template <int D>
Found_beside_walls expect_free(const Snapshot<D>& snapshot, double size, int trials) {
  Random random(12);
  const Locator<D> locator(snapshot);
  const detail::Box<D> all = bounds_of(snapshot);
  Walk_counts counts;
  Found_beside_walls result;
  for (int trial = 0; trial < trials; ++trial) {
    Point<D> middle;
    for (int k = 0; k < D; ++k) middle[k] = random.real(all.low[k], all.high[k]);
    const auto start = locator.particle_at(middle);
    if (!start) continue;
    const auto corner = beside_wall(snapshot, *start, size, random);
    Particle<D> anchor = *start;
    if (corner && move(snapshot, anchor, *corner, counts).status != Walk_status::arrived) continue;
    std::vector<Point<D>> positions{anchor.position};
    for (int v = 0; v < 3; ++v) {
      Point<D> x = anchor.position;
      for (double& c : x) c += random.real(-size, size);
      positions.push_back(x);
    }
    Region_effort effort;
    Region_request<D> request;
    request.positions = positions;
    request.margin = random.real(0.1, 4) * size;
    request.keeps_all = trial % 2 == 0;
    request.by_clusters = true;
    const auto region = find_clear_region(snapshot, anchor, request, effort);
    ++(region ? result.regions : result.none);
    if (!region) continue;
    EXPECT_TRUE(region->holds(anchor.position));
    if (request.keeps_all) {
      for (const Point<D>& x : positions) EXPECT_TRUE(region->holds(x));
    }
    result.with_planes += region->plane_count() > 0;
    result.at_walls += corner.has_value();
    for (int k = 0; k < 10; ++k) {
      Point<D> ends[2];
      for (Point<D>& x : ends) {
        for (int i = 0; i < D; ++i) {
          const double low = std::max(all.low[i], region->box().low(i)),
                       high = std::min(all.high[i], region->box().high(i));
          const double where = random.real(0, 1);
          x[i] = where < 0.2   ? std::nextafter(low, high)
                 : where > 0.8 ? std::nextafter(high, low)
                               : random.real(low, high);
        }
        for (int halved = 0; !region->holds(x) && halved < 60; ++halved)
          x = anchor.position + 0.5 * (x - anchor.position);
      }
      if (!region->holds(ends[0]) || !region->holds(ends[1])) continue;
      Particle<D> p = anchor;
      EXPECT_EQ(move(snapshot, p, ends[0], counts).status, Walk_status::arrived);
      EXPECT_EQ(move(snapshot, p, ends[1], counts).status, Walk_status::arrived);
    }
  }
  std::cout << result.regions << " regions, " << result.at_walls << " of them about a vertex beside a wall, "
            << result.with_planes << " with planes; none " << result.none << "\n";
  return result;
}

TEST(RegionPool, RegionsHoldNoWallOfAGrid) {
  const Found_beside_walls in_plane = expect_free<2>(rooms<2>({6, 6}, {8, 14, 27}), 0.2, 4000);
  EXPECT_GT(in_plane.at_walls, 500);
  const Found_beside_walls in_space = expect_free<3>(rooms<3>({4, 4, 4}, {21, 42, 5, 58}), 0.2, 4000);
  EXPECT_GT(in_space.at_walls, 500);
}

TEST(RegionPool, RegionsHoldNoWallOfAVessel) {
  const Snapshot<3> snapshot = compile(branching_vessel({}));
  const detail::Box<3> all = bounds_of(snapshot);
  const Found_beside_walls found = expect_free<3>(snapshot, 0.004 * length(all.high - all.low), 40000);
  EXPECT_GT(found.at_walls, 80);
  EXPECT_GT(found.with_planes, 200);
}

/// Where the environment is so large, or so small, that it has no planes in single precision.
TEST(RegionPool, RegionsHoldNoWallWherePlanesSayNothing) {
  for (const double scale : {1.0, 0x1p400, 0x1p-400}) {
    SCOPED_TRACE(scale);
    Cell_soup<2> soup = square_grid({.cells = {6, 6}, .solid_cells = {8, 14, 27}});
    for (Point<2>& x : soup.points) x = scale * x;
    const Found_beside_walls found = expect_free<2>(compile(soup), 0.2 * scale, 400);
    EXPECT_GT(found.at_walls, 50);
  }
}

/// A straight rod of 40 vertices along x.
Body_soup<3> rod(double y, double z) {
  Body_soup<3> soup;
  for (std::uint32_t v = 0; v < 40; ++v) {
    soup.points.push_back({0.5 + 0.07 * v, y, z});
    if (v > 0) soup.edges.push_back({v - 1, v});
  }
  return soup;
}

Environment<3> hall() {
  Grid_options<3> options;
  options.cells = {4, 1, 2};
  return Environment<3>::build(hex_grid(options));
}

/// Moves a rod up and down in a wave, so that no region holds all of it for long. Returns the contacts.
std::size_t wave(Body<3>& body, int steps, double height, Body_counts& counts) {
  Step_report<3> report;
  for (int k = 0; k < steps; ++k) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (std::size_t v = 0; v < targets.size(); ++v)
      targets[v][2] = 0.55 + height * std::sin(0.3 * static_cast<double>(v) + 0.2 * k);
    body.step(targets, {}, report, counts);
  }
  return report.contacts.size();
}

TEST(RegionPool, IsForgottenWhereAWallIsPutUp) {
  Environment<3> environment = hall();
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  Body<3> body(snapshot, locator, rod(0.5, 0.5));
  have_regions(body);
  Body_counts counts;
  EXPECT_EQ(wave(body, 60, 0.5, counts), 0u) << "there is no wall between the storeys";
  EXPECT_GT(counts.in_region, 2000u);
  // The rod comes back to the lower storey, and a floor is put between.
  EXPECT_EQ(wave(body, 20, 0.1, counts), 0u);
  for (std::size_t c = 0; c < snapshot.cell_slots(); ++c) {
    const Cell cell = snapshot.cell(c);
    for (std::size_t i = 0; i < snapshot.facet_count(cell); ++i) {
      const Half_facet f = Snapshot<3>::half_facet(cell, i);
      const auto loop = snapshot.loop(f);
      if (std::ranges::all_of(loop, [&](std::uint32_t v) { return snapshot.point(v)[2] == 1; }) &&
          !snapshot.is_impassable(f))
        environment.set_impassable(f, true);
    }
  }
  body.register_again(Locator<3>(snapshot));
  EXPECT_GT(wave(body, 60, 0.5, counts), 100u);
  for (const Point<3>& x : body.positions()) EXPECT_LE(x[2], 1);
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

/// A rod that rests on an oblique floor, an ulp from it, is moved along it without a test of its edges.
TEST(RegionPool, HoldsWhatRestsOnAnObliqueFloor) {
  Cell_soup<3> soup = hex_grid({.cells = {4, 1, 2}});
  for (Point<3>& x : soup.points)
    x = {x[0] - 0.25 * x[2], x[1] + 0.125 * x[2], x[2] + 0.25 * x[0] - 0.125 * x[1]};
  const Snapshot<3> snapshot = compile(soup);
  const Locator<3> locator(snapshot);
  Body_soup<3> lying = rod(0.5, 0.3);
  for (Point<3>& x : lying.points) x[2] = 0.25 * x[0] + 0.05;
  Body<3> body(snapshot, locator, lying);
  have_regions(body);
  Body_counts counts;
  Step_report<3> report;
  const auto move_by = [&](const Vector<3>& d, int steps) {
    for (int k = 0; k < steps; ++k) {
      std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
      for (Point<3>& x : targets) x = x + d;
      body.step(targets, {}, report, counts);
    }
  };
  move_by({0, 0, -0.02}, 10);
  EXPECT_GT(report.contacts.size(), 100u) << "it lies on the floor";
  counts = {};
  report.clear();
  move_by({0.003, 0, 0.0007500001}, 50);
  EXPECT_TRUE(report.contacts.empty());
  EXPECT_GT(counts.in_region, 1800u);
}

/// Vertices go along a wall in regions of their own, then round its corner in one of the body, and a last one
/// with them or not. From there, the regions they left do not hold.
TEST(RegionPool, RegionsLeftWithTheBodyDoNotHold) {
  const Snapshot<2> snapshot = rooms<2>({3, 3}, {3});
  const Locator<2> locator(snapshot);
  for (const bool stays_one : {false, true}) {
    SCOPED_TRACE(stays_one);
    Body_soup<2> soup;
    soup.points.push_back({0.5, 2.5});  // behind the solid cell
    for (int v = 1; v < 40; ++v) soup.points.push_back({0.5 + 0x1p-8 * v, 0.5});
    Body<2> body(snapshot, locator, soup);
    have_regions(body);
    Body_counts counts;
    Step_report<2> report;
    std::vector<Point<2>> targets = soup.points;
    if (!stays_one) targets[0] = {1.5, 2.5};
    for (std::size_t v = 1; v < 40; ++v) targets[v][0] += 1;
    body.step(targets, {}, report, counts);
    EXPECT_EQ(counts.in_region, 40u);
    if (!stays_one) targets[0] = {1.5, 0.5};
    for (int k = 0; k < 4; ++k) body.step(targets, {}, report, counts);
    EXPECT_LE(counts.catch_ups, 1u) << "they are not registered yet";
    counts = {};
    for (std::size_t v = stays_one ? 1 : 0; v < 40; ++v) targets[v][1] += 2;
    body.step(targets, {}, report, counts);
    EXPECT_GE(counts.in_region, 39u) << "what stays is not counted";
    EXPECT_TRUE(report.contacts.empty());
    for (std::uint32_t v = 0; v < 40; ++v)
      EXPECT_EQ(body.cell_of(v), locator.particle_at(targets[v])->cell) << v;
    // The solid cell is in the way.
    for (std::size_t v = 1; v < 40; ++v) targets[v] = soup.points[v];
    body.step(targets, {}, report, counts);
    std::set<std::uint32_t> met;
    for (const Contact<2>& contact : report.contacts) met.insert(contact.vertex);
    EXPECT_GE(met.size(), 39u);
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
  }
}

/// Each vertex has a room of its own, and there are more than places for regions.
TEST(RegionPool, RegionsInUseAreKept) {
  constexpr std::uint32_t vertices = 80;
  std::vector<std::uint32_t> solid;
  for (std::uint32_t v = 0; v < vertices; ++v) solid.insert(solid.end(), {4 * v + 2, 4 * v + 3});
  const Snapshot<2> snapshot = rooms<2>({2, 2 * vertices}, solid);
  const Locator<2> locator(snapshot);
  Body_soup<2> soup;
  for (std::uint32_t v = 0; v < vertices; ++v) soup.points.push_back({0.5, 2 * v + 0.5});
  Body<2> body(snapshot, locator, soup);
  have_regions(body);
  Body_counts counts;
  Step_report<2> report;
  std::vector<Point<2>> targets = soup.points;
  for (int k = 0; k < 30; ++k) {
    counts = {};
    for (Point<2>& x : targets) x[0] = 2 - x[0];
    body.step(targets, {}, report, counts);
  }
  EXPECT_GE(counts.in_region, 64u);
  EXPECT_LT(counts.in_region, vertices);
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

}  // namespace
}  // namespace cellwalk::test
