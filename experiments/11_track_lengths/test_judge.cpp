// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge accepts rows of the library, and finds what was changed in them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "judge.h"
#include "rays.h"

namespace cellwalk::track_lengths {
namespace {

/// Rows of a small world, each changed if that is possible; counts those that the judge refuses.
struct Refused {
  std::size_t changed = 0, refused = 0;
};

Refused judge_changed(const World& world, Ray_kind kind, const std::function<bool(Traces&)>& change) {
  const Judge judge(world.snapshot());
  const Tracer<3> tracer(world.snapshot());
  Rays rays = draw(world, kind, 100, 7);
  Refused seen;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Traces traces;
    Walk_counts counts;
    Particle<3> particle = rays.starts[i];
    tracer.trace(std::span(&particle, 1), std::span(&rays.targets[i], 1), traces, counts);
    if (!change(traces)) continue;
    ++seen.changed;
    seen.refused += !judge.fault(rays.starts[i].position, rays.targets[i], row_of(traces, 0)).empty();
  }
  return seen;
}

void expect_all_refused(const std::function<bool(Traces&)>& change) {
  const auto world = random_points(500, 3);
  const Refused seen = judge_changed(*world, Ray_kind::chords, change);
  EXPECT_GT(seen.changed, 50u);
  EXPECT_EQ(seen.refused, seen.changed);
}

TEST(Judge, AcceptsRows) {
  for (const auto& world : {random_points(500, 3), lattice(500), jittered_grid(500, 3)})
    for (const Ray_kind kind : ray_kinds) {
      const Refused seen = judge_changed(*world, kind, [](Traces&) { return true; });
      EXPECT_EQ(seen.changed, 100u);
      EXPECT_EQ(seen.refused, 0u);
    }
}

TEST(Judge, FindsLengthsThatAreAnUlpOff) {
  for (const double towards : {0.0, std::numeric_limits<double>::infinity()})
    expect_all_refused([&](Traces& traces) {
      double& length = traces.lengths[traces.lengths.size() / 2];
      length = std::nextafter(length, towards);
      return true;
    });
}

TEST(Judge, FindsMissingPieces) {
  expect_all_refused([](Traces& traces) {
    traces.cells.pop_back();
    traces.lengths.pop_back();
    --traces.offsets.back();
    return traces.ends.back().status == Walk_status::arrived;
  });
  expect_all_refused([](Traces& traces) {
    if (traces.cells.size() < 2) return false;
    traces.cells.erase(traces.cells.begin());
    traces.lengths.erase(traces.lengths.begin());
    --traces.offsets.back();
    return true;
  });
}

TEST(Judge, FindsOtherCells) {
  expect_all_refused([](Traces& traces) {
    if (traces.cells.size() < 2) return false;
    std::swap(traces.cells[0], traces.cells[1]);
    return true;
  });
}

TEST(Judge, FindsOtherWalls) {
  const auto world = random_points(500, 3);
  const Snapshot<3>& snapshot = world->snapshot();
  const Refused seen = judge_changed(*world, Ray_kind::chords, [&](Traces& traces) {
    Trace_end& end = traces.ends.back();
    if (end.status != Walk_status::contact) return false;
    end.wall = Snapshot<3>::half_facet(end.cell, (snapshot.facet_of(end.wall) + 1) % 4);
    return true;
  });
  EXPECT_GT(seen.changed, 0u);
  EXPECT_EQ(seen.refused, seen.changed);
}

}  // namespace
}  // namespace cellwalk::track_lengths
