// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies in one environment on several threads, each moved by one of them: clusters of cells are made by the
// thread that first asks for them, and read by all.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/environment/cell_cluster.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <barrier>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "body/rooms.h"
#include "body/with_regions.h"

namespace cellwalk::test {
namespace {

constexpr std::uint32_t rooms_a_side = 8, vertices = 40;
constexpr std::size_t threads = 4, bodies_a_thread = 3, rounds = 4;
constexpr int steps = 12;

Snapshot<3> many_rooms() {
  // The thread sanitizer does not see how TBB, which it did not compile, hands work over.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Random random(4);
  std::vector<std::uint32_t> solid;
  for (std::uint32_t cell = 0; cell < rooms_a_side * rooms_a_side * rooms_a_side; ++cell)
    if (random.chance(0.15)) solid.push_back(cell);
  return rooms<3>({rooms_a_side, rooms_a_side, rooms_a_side}, solid);
}

struct Flight {
  std::vector<Point<3>> positions;
  std::size_t contacts = 0;
  std::uint64_t in_region = 0, region_walls = 0;
};

/// A rod that swings from a room that is free.
Flight fly(const Snapshot<3>& snapshot, const Locator<3>& locator, std::uint64_t number) {
  Random random(number);
  Body_soup<3> rod;
  Point<3> first;
  do
    for (double& x : first) x = 0.25 + static_cast<double>(random.below(rooms_a_side));
  while (!locator.particle_at(first));
  for (std::uint32_t v = 0; v < vertices; ++v) {
    rod.points.push_back(first + Vector<3>{0.0125 * v, 0.0125 * v, 0.005 * v});
    if (v > 0) rod.edges.push_back({v - 1, v});
  }
  Body<3> body(snapshot, locator, rod);
  have_regions(body);
  Flight flight;
  Body_counts counts;
  for (int k = 0; k < steps; ++k) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t i = 0; i < 3; ++i)
        targets[v][i] +=
            0.2 * std::sin(0.2 * static_cast<double>(v) + 0.5 * k + static_cast<double>(i + number));
    Step_report<3> report;
    body.step(targets, {}, report, counts);
    flight.contacts += report.contacts.size();
  }
  flight.positions.assign(body.positions().begin(), body.positions().end());
  flight.in_region = counts.in_region;
  flight.region_walls = counts.region_walls;
  return flight;
}

/// Calls use(thread) on all threads at once.
template <class Use>
void on_all_threads(const Use& use) {
  std::barrier<> start(threads);
  std::vector<std::thread> running;
  for (std::size_t t = 0; t < threads; ++t)
    running.emplace_back([&, t] {
      start.arrive_and_wait();
      use(t);
    });
  for (std::thread& thread : running) thread.join();
}

TEST(BodyThreads, MakeEachClusterOnce) {
  const Snapshot<3> original = many_rooms();
  for (std::size_t round = 0; round < rounds; ++round) {
    const Snapshot<3> snapshot = original;  // which has no clusters yet
    std::array<std::vector<const detail::Cell_cluster<3>*>, threads> seen;
    on_all_threads([&](std::size_t t) {
      const detail::Cell_clusters<3>& clusters = snapshot.clusters();
      const std::uint32_t count = clusters.size(snapshot);
      for (std::uint32_t number = 0; number < count; ++number)
        seen[t].push_back(&clusters.cluster(snapshot, number));
    });
    EXPECT_GT(seen[0].size(), 10u);
    for (const auto& of_thread : seen) EXPECT_EQ(of_thread, seen[0]);
  }
}

TEST(BodyThreads, StepAtOnceInOneEnvironment) {
  const Snapshot<3> original = many_rooms();
  constexpr std::size_t bodies = threads * bodies_a_thread;
  std::vector<Flight> expected;
  for (std::size_t b = 0; b < bodies; ++b) expected.push_back(fly(original, Locator<3>(original), b));
  std::size_t contacts = 0, in_region = 0, walls = 0;
  for (const Flight& flight : expected) {
    contacts += flight.contacts;
    in_region += flight.in_region;
    walls += flight.region_walls;
  }
  EXPECT_GT(contacts, 100u);
  EXPECT_GT(in_region, 500u);
  EXPECT_GT(walls, 1000u) << "clusters are asked for";
  for (std::size_t round = 0; round < rounds; ++round) {
    const Snapshot<3> snapshot = original;  // which has no clusters yet
    const Locator<3> locator(snapshot);
    std::vector<Flight> flights(bodies);
    on_all_threads([&](std::size_t t) {
      for (std::size_t b = t; b < bodies; b += threads) flights[b] = fly(snapshot, locator, b);
    });
    for (std::size_t b = 0; b < bodies; ++b) {
      EXPECT_EQ(flights[b].positions, expected[b].positions) << b;
      EXPECT_EQ(flights[b].contacts, expected[b].contacts) << b;
      EXPECT_EQ(flights[b].in_region, expected[b].in_region) << b;
    }
  }
}

}  // namespace
}  // namespace cellwalk::test
