// SPDX-License-Identifier: LGPL-3.0-or-later
// Random replacements among bodies that move in between; and the same moves of walls and bodies in a twin
// world whose cells are not replaced.
#include <cellwalk/internal/walk/signs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "oracle/seed.h"
#include "reshape/level_world.h"
#include "reshape/replacing.h"
#include "reshape/restless_world.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <class World>
void expect_valid(World& world) {
  Body_counts uncounted;
  for (const auto& body : world.bodies) {
    body->refresh(uncounted);
    ASSERT_NO_THROW(body->validate());
  }
  for (const auto& p : world.particles) {
    ASSERT_TRUE(world.snapshot.is_cell(p.cell) && !world.snapshot.is_solid(p.cell));
    ASSERT_TRUE(in_closure(world.snapshot, p.cell, p.position));
  }
  ASSERT_NO_THROW(world.environment.certify());
  // Cells that are gone accept nothing.
  for (std::uint32_t b = 0; b < world.snapshot.half_facet_slots() / 4; ++b) {
    const Cell gone{b};
    if (world.snapshot.is_cell(gone)) continue;
    for (int lane = 0; lane < 4; ++lane)
      ASSERT_GT(world.snapshot.blocks(gone)->offset[lane], 0) << "cell " << b << " is gone";
  }
}

template <int D>
void soak(bool generic, std::size_t worlds) {
  test::Replacement_tally tally;
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 4 + 1);
  std::uint64_t moved = 0;
  for (std::uint64_t number = 0; number < 2 * count; number += 2) {
    test::Restless_world<D> world(number, generic);
    world.populate(D == 2 ? 10 : 6, D == 2 ? 8 : 6);
    Random random(oracle::reseeded(number));
    const std::size_t most_cells = world.snapshot.cell_count() * 3 / 2 + 20;
    SCOPED_TRACE(world.name());
    for (int phase = 0; phase < 8; ++phase) {
      Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::stop});
      for (int k = 0; k < 6; ++k) {
        Replacement made;
        for (int tries = 0; tries < 3 && !made.is_made; ++tries)
          made = test::replace_at(reshaping, world.snapshot, test::cell_near_residents(world, random), random,
                                  most_cells, tally);
        if (made.is_made) {
          ASSERT_NO_THROW(world.environment.certify()) << number << " " << phase << " " << k;
        }
        if (random.chance(0.3)) {
          const std::uint32_t v = world.vertex();
          if (!world.snapshot.is_point(v)) continue;
          moved += reshaping.move(v, world.target(v)).end == Move_end::reached;
        }
      }
      reshaping.finish();
      expect_valid(world);
      if (testing::Test::HasFatalFailure()) return;
      world.step_bodies();
    }
  }
  std::printf("%dD %s, %llu made in %zu worlds, %llu vertices moved: ", D, generic ? "generic" : "degenerate",
              static_cast<unsigned long long>(tally.all()), count, static_cast<unsigned long long>(moved));
  tally.print();
  for (std::size_t k = 0; k < tally.made.size(); ++k)
    if (D == 3 || k != 3) {
      EXPECT_GT(tally.made[k], count / 4) << tally.names[k];
    }
  EXPECT_GT(moved, count / 2);
}

TEST(ReplacementSoak, Generic2D) { soak<2>(true, 40); }
TEST(ReplacementSoak, Degenerate2D) { soak<2>(false, 40); }
TEST(ReplacementSoak, Generic3D) { soak<3>(true, 10); }
TEST(ReplacementSoak, Degenerate3D) { soak<3>(false, 10); }

/// Faces, edges and vertices in the plane of pieces of a membrane.
TEST(ReplacementSoak, AtTheLevelOfAMembrane) {
  test::Replacement_tally tally;
  const std::size_t count = std::max<std::size_t>(oracle::scaled_count(8), 4);
  for (std::uint64_t number = 0; number < count; ++number) {
    test::Level_world world(number);
    world.populate(6, 8);
    Random random(oracle::reseeded(number));
    SCOPED_TRACE(world.name());
    for (int phase = 0; phase < 8; ++phase) {
      Reshaping<3> reshaping(world.environment, world.residents());
      for (int k = 0; k < 8; ++k)
        test::replace_at(reshaping, world.snapshot, test::cell_near_residents(world, random), random, 600,
                         tally);
      reshaping.finish();
      expect_valid(world);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tally.all(), 20 * count);
}

template <int D>
bool is_same(const Vertex_result<D>& x, const Vertex_result<D>& y) {
  return x.end == y.end && x.hit.has_value() == y.hit.has_value() &&
         (!x.hit || x.hit->exact_time() == y.hit->exact_time());
}

/// What a replacement does to other vertices of cells: nothing but that they may be in the way of each other.
template <int D>
bool is_about_residents(const Vertex_result<D>& x) {
  return x.end != Move_end::cell && x.end != Move_end::boundary;
}

/// The walls at a particle on its own side, each seen from there.
template <int D>
std::vector<std::vector<std::uint32_t>> walls_at(const Snapshot<D>& snapshot, const Particle<D>& p) {
  std::vector<Cell> cells{p.cell};
  std::vector<std::vector<std::uint32_t>> walls;
  Walk_counts uncounted;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (std::size_t i = 0; i <= D; ++i) {
      const Half_facet f = Snapshot<D>::half_facet(cells[k], i);
      const Cell_view<D> view = snapshot.view(cells[k]);
      if (detail::side<Exact>(view, i, p.position, uncounted) != 0 || !detail::in_facet(view, i, p.position))
        continue;
      if (!snapshot.is_impassable(f)) {
        if (std::ranges::find(cells, snapshot.neighbour(f)) == cells.end())
          cells.push_back(snapshot.neighbour(f));
        continue;
      }
      walls.push_back(snapshot.loop(f));
      if (D == 3)
        std::rotate(walls.back().begin(), std::ranges::min_element(walls.back()), walls.back().end());
    }
  std::sort(walls.begin(), walls.end());
  return walls;
}

struct Twins {
  int in_walls = 0, on_other_side = 0;
  int asked = 0, contacts = 0, different = 0, steps = 0, apart = 0;
};

/// The same questions and steps in a world and in one that was replaced.
template <int D, class World>
void compare(World& one, World& other, const std::vector<std::pair<std::uint32_t, Point<D>>>& moves,
             bool generic, Twins& twins) {
  {
    Reshaping<D> here(one.environment, one.residents()), there(other.environment, other.residents());
    for (const auto& [v, target] : moves) {
      if (!other.snapshot.is_point(v) || one.snapshot.point(v) != other.snapshot.point(v)) continue;
      const auto followed = [&] { return here.counts().followed + there.counts().followed; };
      const std::uint64_t before = followed();
      const auto x = here.test_move(v, target), y = there.test_move(v, target);
      // Where something is touched, there may be a choice.
      if (!is_about_residents(x) || !is_about_residents(y) || (!generic && followed() != before)) continue;
      ++twins.asked;
      twins.contacts += x.end == Move_end::contact;
      twins.different += !is_same(x, y);
    }
  }
  Body_counts counts;
  // Edges of walls that were split have other loops.
  const bool has_same_walls = one.environment.certify().walls == other.environment.certify().walls;
  for (std::size_t b = 0; has_same_walls && b < one.bodies.size(); ++b) {
    one.bodies[b]->refresh(counts);
    other.bodies[b]->refresh(counts);
    for (std::size_t v = 0; v < one.bodies[b]->vertex_count(); ++v) {
      const auto before = walls_at<D>(one.snapshot, one.bodies[b]->particles()[v]);
      twins.in_walls += !before.empty();
      twins.on_other_side += before != walls_at<D>(other.snapshot, other.bodies[b]->particles()[v]);
    }
  }
  Step_report<D> here, there;
  for (std::size_t b = 0; b < one.bodies.size(); ++b) {
    Body_options options;
    options.sweep.sweep = D == 3 && !one.bodies[b]->faces().empty() ? Sweep::faces : Sweep::triangle;
    std::vector<Point<D>> targets(one.bodies[b]->positions().begin(), one.bodies[b]->positions().end());
    for (Point<D>& x : targets)
      for (double& c : x)
        c += generic ? one.random.real(-0.5, 0.5) : (static_cast<double>(one.random.below(5)) - 2) / 8;
    one.bodies[b]->step(targets, options, here, counts);
    other.bodies[b]->step(targets, options, there, counts);
    ++twins.steps;
    twins.apart += !std::ranges::equal(one.bodies[b]->positions(), other.bodies[b]->positions());
  }
}

template <int D>
void twins(bool generic, std::size_t worlds) {
  Twins seen;
  test::Replacement_tally tally;
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds);
  for (std::uint64_t number = 0; number < 2 * count; number += 2) {
    test::Restless_world<D> one(number, generic), other(number, generic);
    one.populate(8, 8);
    other.populate(8, 8);
    Random random(oracle::reseeded(number));
    {
      Reshaping<D> reshaping(other.environment, other.residents());
      for (int k = 0; k < 40; ++k)
        test::replace_at(reshaping, other.snapshot, test::cell_near_residents(other, random), random,
                         2 * one.snapshot.cell_count() + 20, tally);
    }
    std::vector<std::pair<std::uint32_t, Point<D>>> moves;
    for (int k = 0; k < 30; ++k) {
      const std::uint32_t v = one.vertex();
      moves.emplace_back(v, one.target(v));
    }
    compare<D>(one, other, moves, generic, seen);
  }
  std::printf(
      "%dD %s: %d asked, %d contacts, %d different; %d vertices in walls, %d on another side; %d steps, %d "
      "elsewhere; ",
      D, generic ? "generic" : "degenerate", seen.asked, seen.contacts, seen.different, seen.in_walls,
      seen.on_other_side, seen.steps, seen.apart);
  tally.print();
  EXPECT_EQ(seen.different, 0);
  EXPECT_EQ(seen.on_other_side, 0);
  if (!generic) {
    EXPECT_GT(seen.in_walls, static_cast<int>(count));
  }
  // A body with edges of no length at a rim may be blocked in one world and slide in the other.
  EXPECT_LE(seen.apart, generic ? 0 : seen.steps / 2000);
  EXPECT_GT(seen.contacts, generic ? seen.asked / 50 : 0);
  EXPECT_GT(tally.all(), 8 * count);
}

TEST(ReplacementTwins, Generic2D) { twins<2>(true, 30); }
TEST(ReplacementTwins, Degenerate2D) { twins<2>(false, 30); }
TEST(ReplacementTwins, Generic3D) { twins<3>(true, 10); }
TEST(ReplacementTwins, Degenerate3D) { twins<3>(false, 25); }

}  // namespace
}  // namespace cellwalk
