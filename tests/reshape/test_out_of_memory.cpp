// SPDX-License-Identifier: LGPL-3.0-or-later
// Memory that runs out at the first allocation of a change, at the second, and so on until the change is
// made: each time the state is that before or that after it, and never one in between.
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "oracle/seed.h"
#include "reshape/grids.h"
#include "reshape/random_change.h"
#include "reshape/state_digest.h"
#include "walk/oracle_trial.h"

namespace {

/// So many allocations succeed; negative: all do.
long allocations_left = -1;

void* allocate(std::size_t size) {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left > 0) --allocations_left;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
// Arrays are those of CGAL's numbers, which do not stand it.
void* operator new[](std::size_t size) { return std::malloc(size == 0 ? 1 : size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace cellwalk {
namespace {

/// Facets that open and close, cells that are filled and excavated, and questions about moves. Where memory
/// runs out while cells are replaced, bodies that were listed refuse to go on.
bool is_of_walls(std::size_t kind) { return kind < 4 || kind == 11; }

template <int D>
void run_out(std::size_t worlds) {
  std::size_t changes = 0, failures = 0, before_made = 0, made = 0;
  for (std::uint64_t number = 0; number < std::max(oracle::scaled_count(worlds), worlds / 2); ++number) {
    SCOPED_TRACE("world " + std::to_string(number));
    test::Toggle_world<D> world(number, number % 3 == 0);
    world.populate(6, 6);
    for (int phase = 0; phase < 2; ++phase) {
      Body_counts uncounted;
      for (const auto& body : world.bodies) body->leave_region(uncounted);
      Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
      for (int k = 0; k < 15; ++k) {
        const test::Random_change<D> change(world);
        if (!is_of_walls(change.kind)) continue;
        ++changes;
        EXPECT_THROW(reshaping.merge_vertices(change.u, change.u), Error);  // restores certificates
        const auto residents = world.residents();
        const std::string before = test::digest(world.environment, residents);
        for (long n = 0;; ++n) {
          bool has_failed = false, is_made = false;
          allocations_left = n;
          try {
            is_made = change.make(reshaping);
          } catch (const std::bad_alloc&) {
            has_failed = true;
          }
          allocations_left = -1;
          EXPECT_THROW(reshaping.merge_vertices(change.u, change.u), Error);
          if (!has_failed) {
            made += is_made;
            break;
          }
          ++failures;
          if (test::digest(world.environment, residents) == before) {
            ++before_made;
            continue;
          }
          // It was made, but for what it returns: then nothing is left to be done.
          const std::string after = test::digest(world.environment, residents);
          ASSERT_TRUE(change.make(reshaping)) << change.names[change.kind] << " " << n;
          EXPECT_THROW(reshaping.merge_vertices(change.u, change.u), Error);
          ASSERT_EQ(test::digest(world.environment, residents) == after, true)
              << change.names[change.kind] << " in between, at allocation " << n;
          break;
        }
        ASSERT_NO_THROW(world.environment.certify()) << change.names[change.kind];
      }
      reshaping.finish();
      for (const auto& body : world.bodies) ASSERT_NO_THROW(body->validate());
      world.step_bodies();
    }
  }
  std::printf("%dD: %zu changes, %zu made; memory ran out %zu times, %zu of these before the change\n", D,
              changes, made, failures, before_made);
  EXPECT_GT(changes, 5 * worlds);
  EXPECT_GT(failures, 10 * changes);
  EXPECT_GT(made, changes / 5);
}

/// Particles above a membrane, whose middle vertex pushes them into other cells; another one far away is
/// first looked at in a later change.
template <int D>
void push_out() {
  int failures = 0, moved = 0;
  for (long n = 0;; ++n) {
    SCOPED_TRACE("allocation " + std::to_string(n));
    Environment<D> environment = test::simplex_grid<D>(4);
    test::add_membrane<D>(environment, 2);
    const Snapshot<D>& snapshot = environment.snapshot();
    const auto all = [](double coordinate) {
      Point<D> x;
      x.fill(coordinate);
      return x;
    };
    const auto at = [&](double height) {
      Point<D> x = all(2);
      x[D - 1] = height;
      return x;
    };
    const auto located = [&](const Point<D>& x) { return Locator<D>(snapshot).particles_at(x).front(); };
    std::vector<Particle<D>> pushed, far{located(all(0.4375))};
    std::vector<Point<D>> start;
    for (const double side : {-0.25, 0.25}) {
      Point<D> x = at(2.125);
      x[0] += side;
      start.push_back(x);
      pushed.push_back(located(x));
    }
    const std::uint32_t middle = test::point_at<D>(environment, at(2)),
                        low = test::point_at<D>(environment, all(1));
    const std::vector<std::span<Particle<D>>> particles{pushed, far};
    Reshaping<D> reshaping(environment, {{}, particles}, {.at_contact = At_contact::push});
    bool has_failed = false;
    allocations_left = n;
    try {
      reshaping.move(middle, at(2.5));
    } catch (const std::bad_alloc&) {
      has_failed = true;
    }
    allocations_left = -1;
    failures += has_failed;
    moved += has_failed && (pushed[0].position != start[0] || pushed[1].position != start[1]);
    EXPECT_EQ(reshaping.move(low, all(1.03125)).end, Move_end::reached);
    for (const double height : {2.25, 2.5, 2.75}) reshaping.move(middle, at(height));
    reshaping.finish();
    for (Particle<D>& particle : pushed) {
      Vector<D> up{};
      up[D - 1] = 3.9375 - particle.position[D - 1];
      std::vector<Contact<D>> met;
      Walk_counts uncounted;
      ASSERT_TRUE(in_closure(snapshot, particle.cell, particle.position));
      advance(snapshot, particle, up, Wall_response{}, met, uncounted);
      ASSERT_TRUE(met.empty()) << "the wall passed over it, and is above it now";
    }
    if (!has_failed) break;
  }
  EXPECT_GT(failures, 10);
  EXPECT_GT(moved, 0);
}

TEST(OutOfMemory, PushedParticlesAreStillMet2D) { push_out<2>(); }
TEST(OutOfMemory, PushedParticlesAreStillMet3D) { push_out<3>(); }

TEST(OutOfMemory, NeverInBetween2D) { run_out<2>(10); }
TEST(OutOfMemory, NeverInBetween3D) { run_out<3>(5); }

}  // namespace
}  // namespace cellwalk
