// SPDX-License-Identifier: LGPL-3.0-or-later
// A move that is blocked on every side of walls on which things may be is blocked at the latest of the times
// that these sides allow: all of the way before it is free, and nothing beyond.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "oracle/seed.h"
#include "reshape/level_world.h"
#include "reshape/reshape_world.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

/// One membrane, and an edge of which an end is on its rim: on the one side the edge would be passed at once.
Environment<3> rim_world() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0.25}, {0, 1, 0},     {1, 1, -0.25}, {1, 2, 0.375},
                 {1, 1, 1}, {2, 1, 1},    {1, 2, 1.125}, {2, 2, 1}};
  const std::array<std::array<std::uint32_t, 4>, 8> cells{{{0, 1, 3, 5},
                                                           {0, 3, 2, 5},
                                                           {1, 3, 6, 5},
                                                           {2, 3, 4, 7},
                                                           {2, 3, 7, 5},
                                                           {3, 4, 7, 8},
                                                           {3, 8, 6, 5},
                                                           {3, 8, 5, 7}}};
  for (const auto& [a, b, c, d] : cells) {
    const Point<3>& x = soup.points[a];
    if (dot(cross(soup.points[b] - x, soup.points[c] - x), soup.points[d] - x) > 0)
      add_tetrahedron(soup, a, b, c, d);
    else
      add_tetrahedron(soup, a, c, b, d);
  }
  auto environment = Environment<3>::build(std::move(soup));
  const Snapshot<3>& s = environment.snapshot();
  for (std::size_t i = 0; i < s.cell_slots(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      auto loop = s.loop(Snapshot<3>::half_facet(s.cell(i), k));
      std::sort(loop.begin(), loop.end());
      if (loop == std::vector<std::uint32_t>{3, 5, 7})
        environment.set_impassable(Snapshot<3>::half_facet(s.cell(i), k), true);
    }
  return environment;
}

TEST(LatestTime, IsThatOfTheSideThatGoesOn) {
  for (const At_contact at : {At_contact::hold, At_contact::stop, At_contact::push}) {
    auto environment = rim_world();
    const Snapshot<3>& s = environment.snapshot();
    Body<3> body(s, Locator<3>(s), {{{0.375, 0.5, 0}, {1, 1, 0}}, {{0, 1}}, {}});
    const Point<3> from = s.point(3), target{1, 0.75, 0};
    Reshaping<3> reshaping(environment, {{&body}, {}}, {.at_contact = at});
    for (int k = 1; k <= 16; ++k) {
      const auto part = reshaping.test_move(3, from + (k / 16.0) * (target - from));
      EXPECT_EQ(part.end, k < 16 * 8 / 11.0 ? Move_end::reached : Move_end::contact) << k;
      if (part.hit) {
        EXPECT_DOUBLE_EQ(part.hit->time, 16 * 8 / 11.0 / k);
      }
    }
    const auto result = reshaping.move(3, target);
    if (at == At_contact::stop) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(result.position[k], from[k] + 8 / 11.0 * (target[k] - from[k]), 1e-12);
    }
    if (at == At_contact::push) {
      EXPECT_GE(from[1] - result.position[1], 8 / 11.0 * (from[1] - target[1]) - 1e-12);
    }
    reshaping.finish();
    EXPECT_NO_THROW(body.validate());
  }
}

struct Latest_tally {
  std::size_t moves = 0, contacts = 0, touches = 0, late = 0, parts = 0, not_free = 0, free_beyond = 0;
};

/// Asks about a move and about parts of its way.
template <int D, class World>
void ask_parts(World& world, Reshaping<D>& reshaping, Latest_tally& tally) {
  const std::uint32_t v = world.vertex();
  const Point<D> from = world.snapshot.point(v), target = world.target(v);
  const auto whole = reshaping.test_move(v, target);
  ++tally.moves;
  tally.contacts += whole.end == Move_end::contact;
  tally.touches += whole.end == Move_end::touch;
  if (whole.end != Move_end::contact) return;
  const double time = whole.hit->time;
  tally.late += time > 0 && time < 1;
  for (int k = 1; k < 8; ++k) {
    const double share = k / 8.0;
    const Point<D> there = from + share * (target - from);
    bool is_exact = true;
    for (std::size_t c = 0; c < D; ++c)
      is_exact &=
          (there[c] - from[c]) * 8 == (target[c] - from[c]) * k && from[c] + (there[c] - from[c]) == there[c];
    // Rounded times are compared off themselves only.
    if (!is_exact || std::abs(share - time) < 1e-9) continue;
    ++tally.parts;
    const auto part = reshaping.test_move(v, there);
    if (share < time && part.end != Move_end::reached) ++tally.not_free;
    if (share > time && part.end == Move_end::reached) ++tally.free_beyond;
  }
}

void expect_consistent(const char* world, const Latest_tally& tally, std::size_t moves) {
  std::printf(
      "%s: %zu moves, %zu contacts (%zu on the way), %zu touches; %zu parts, %zu not free, %zu free beyond\n",
      world, tally.moves, tally.contacts, tally.late, tally.touches, tally.parts, tally.not_free,
      tally.free_beyond);
  EXPECT_EQ(tally.not_free, 0u);
  EXPECT_EQ(tally.free_beyond, 0u);
  EXPECT_GT(tally.contacts, moves / 50);
  EXPECT_GT(tally.parts, tally.contacts);
}

template <int D>
void ask_everywhere(std::size_t worlds) {
  Latest_tally tally;
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 2);
  for (std::uint64_t number = 0; number < count; ++number) {
    test::Reshape_world<D> world(number, false);
    world.populate(10, 8);
    Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
    for (int k = 0; k < 60; ++k) ask_parts<D>(world, reshaping, tally);
  }
  expect_consistent(D == 2 ? "2D" : "3D", tally, 60 * count);
}

TEST(LatestTime, PartsOfTheWay2D) { ask_everywhere<2>(60); }
TEST(LatestTime, PartsOfTheWay3D) { ask_everywhere<3>(20); }

TEST(LatestTime, PartsOfTheWayOfALevel) {
  Latest_tally tally;
  for (std::uint64_t number = 0; number < 6; ++number) {
    test::Level_world world(number);
    world.populate(8, 10);
    Reshaping<3> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
    for (int k = 0; k < 40; ++k) ask_parts<3>(world, reshaping, tally);
  }
  expect_consistent("level", tally, 240);
}

}  // namespace
}  // namespace cellwalk
