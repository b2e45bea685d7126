// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/room.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

/// How many free cells can be reached from the first one through passable facets.
std::size_t reachable(const Cell_soup<2>& soup) {
  const Gluing gluing = glue(soup);
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) cell_of[f] = c;
  std::set<std::uint32_t> seen{0};
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const auto c = stack.back();
    stack.pop_back();
    for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      const auto g = gluing.opposite[f];
      if (g != no_facet && !soup.impassable[f] && !soup.impassable[g] && seen.insert(cell_of[g]).second)
        stack.push_back(cell_of[g]);
    }
  }
  return seen.size();
}

TEST(Room, AllRoomsAreJoined) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Room_options options;
    options.seed = seed;
    const auto soup = room_2d(options);
    test::expect_sound(soup);
    EXPECT_EQ(reachable(soup), soup.cell_count()) << "seed " << seed;
  }
}

TEST(Room, ObstaclesAreHolesOrSolid) {
  Room_options options;
  const auto hollow = room_2d(options);
  options.keep_obstacles = true;
  const auto filled = room_2d(options);
  test::expect_sound(filled);
  EXPECT_DOUBLE_EQ(test::volume(filled), 36 * 20);
  EXPECT_LT(test::volume(hollow), 36 * 20 - 6 * 3 * 0.3);
  std::size_t solid = 0;
  for (auto s : filled.solid) solid += s;
  EXPECT_EQ(filled.cell_count() - solid, hollow.cell_count());
  EXPECT_EQ(reachable(filled), hollow.cell_count());
}

TEST(Room, WallsHaveDoors) {
  Room_options options;
  options.rooms = {2, 1};
  options.obstacles = 0;
  const auto soup = room_2d(options);
  std::size_t walls = 0;
  for (auto w : soup.impassable) walls += w;
  EXPECT_EQ(walls, 2u * (10 - 2));  // both sides of all but the door
  EXPECT_EQ(soup.cell_count(), 240u);
}

TEST(Room, IsReproducible) {
  Room_options options;
  options.square = 0.1;
  test::expect_sound(room_2d(options));
  EXPECT_EQ(test::hash(room_2d(options)), 5896806670188246803u);
}

TEST(Room, RefusesOptionsOutOfRange) {
  for (auto set : {+[](Room_options& o) {
                     o.rooms = {0, 1};
                   },
                   +[](Room_options& o) {
                     o.room_size = {2, 9};
                   },
                   +[](Room_options& o) { o.door = 11; }, +[](Room_options& o) { o.obstacles = 100; },
                   +[](Room_options& o) { o.square = -1; }}) {
    Room_options options;
    set(options);
    EXPECT_THROW(room_2d(options), Error);
  }
}

}  // namespace
}  // namespace cellwalk
