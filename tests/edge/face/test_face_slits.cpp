// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces among walls of one side: slits, and the boundary of the environment.
#include <cellwalk/environment/environment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "edge/face_trial.h"
#include "edge/relisted.h"
#include "edge/slit_worlds.h"
#include "edge/thin_worlds.h"

namespace cellwalk::test {
namespace {

TEST(FaceSlits, WorldsAreCertified) {
  int slits = 0;
  for (std::uint64_t number = 0; number < oracle::world_kinds; ++number) {
    const auto worlds = {oracle::make_world<3>(number), sheets<3>(number), layered_world(number)};
    for (const oracle::World<3>& world : worlds)
      EXPECT_NO_THROW(Environment<3>::build(with_slits(world, number, slits).soup,
                                            {.duplicates = Duplicate_vertices::keep}))
          << world.name;
  }
  EXPECT_GT(slits, 500);
}

/// Faces in worlds that are told to have slits.
template <class Make>
Face_seen sweep_among_slits(const char* what, std::size_t count, Make make) {
  Face_seen seen;
  int slits = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    Edge_world<3> w(with_slits(make(number), number, slits), number, false);
    sweep_faces(w, false, seen);
  }
  report(what, seen);
  return seen;
}

TEST(FaceSlits, NeverMissesAWall) {
  const std::size_t count = oracle::scaled_count(oracle::world_kinds);
  const Face_seen seen = sweep_among_slits("slits", count, oracle::make_world<3>);
  expect_no_fault(seen);
  if (count < oracle::world_kinds) return;
  EXPECT_GT(seen.hits, 40);
  EXPECT_GT(seen.at_once, 15);
  EXPECT_GT(seen.on_one_sided, 40);
}

TEST(FaceSlits, SlidesOnSheets) {
  const std::size_t count = oracle::scaled_count(8);
  const Face_seen seen = sweep_among_slits("sheets of slits", count, sheets<3>);
  expect_no_fault(seen);
  if (count < 8) return;
  EXPECT_GT(seen.hits, 40);
  EXPECT_GT(seen.flat, 100);
  EXPECT_GT(seen.on_one_sided, 40);
}

/// A place on a lattice near the plane between two layers.
Point<3> spot(Random& random) {
  const auto at = [&] { return static_cast<double>(1 + random.below(15)) / 4; };
  const double x = at(), y = at();
  return {x, y, static_cast<double>(3 + random.below(3)) / 4};
}

/// Corners at these places, each on any of its sides; false if one is not in free space.
bool choose_sides(const Locator<3>& locator, Random& random, const Triangle& places,
                  std::array<Particle<3>, 3>& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = locator.particle_at(places[k]).value_or(Particle<3>{});
    if (corners[k].cell == Cell::none) return false;
    const auto cells = locator.locate(places[k]).cells;
    corners[k].cell = cells[random.below(cells.size())];
  }
  return true;
}

bool choose_corners(const Locator<3>& locator, Random& random, std::array<Particle<3>, 3>& corners) {
  Triangle places;
  for (Point<3>& x : places) x = spot(random);
  return choose_sides(locator, random, places, corners);
}

/// Where a corner moves: half of the time up or down.
Point<3> next_spot(Random& random, const Point<3>& from) {
  Point<3> to = spot(random);
  if (random.below(2) == 0) to = {from[0], from[1], to[2]};
  return to;
}

oracle::World<3> layers(bool slit, std::uint64_t number, std::uint64_t one_in) {
  int slits = 0;
  const oracle::World<3> world = layered_world(number, one_in);
  return slit ? with_slits(world, number, slits) : world;
}

/// Faces that land on walls between two layers, slide on them and leave.
Face_seen land(bool slit, std::size_t count) {
  Face_seen seen;
  for (std::uint64_t number = 0; number < count; ++number) {
    Edge_world<3> w(layers(slit, number, 3), number, false);
    Random random(number);
    for (int k = 0; k < 40; ++k) {
      std::array<Particle<3>, 3> corners;
      if (!choose_corners(w.locator, random, corners)) continue;
      Face_body body(w.snapshot);
      const bool is_valid = body.place(corners);
      if (body.counts.faces == 0) continue;  // an edge crosses a wall
      check_piercing(w.walls, body, is_valid, false, seen);
      if (is_valid) {
        Judge judge(w.snapshot, w.world.name, w.walls, body, false, seen);
        for (std::size_t step = 0; step < 30; ++step)
          judge.move(step % 3, next_spot(random, body.corner(step % 3).position));
      }
      seen.counts += body.counts;
    }
  }
  report(slit ? "landing on slits" : "landing on membranes", seen);
  return seen;
}

TEST(FaceSlits, LandsAndLeaves) {
  const std::size_t count = oracle::scaled_count(8);
  for (const bool slit : {false, true}) {
    const Face_seen seen = land(slit, count);
    expect_no_fault(seen);
    if (count < 8) continue;
    EXPECT_GT(seen.landed, 50);
    EXPECT_GT(seen.leaves_through, 50);
    EXPECT_GT(seen.flat, 100);
    EXPECT_GT(seen.inside_hits, 5);
    EXPECT_GT(seen.on_one_sided, slit ? 100 : 20);
  }
}

/// Rests by the cells of the first listing and the points of their walls.
std::set<std::pair<std::uint32_t, std::vector<Point<3>>>> named(const Snapshot<3>& snapshot,
                                                                const Supporting_walls& supporting_walls,
                                                                const std::vector<std::uint32_t>& old_cell) {
  std::set<std::pair<std::uint32_t, std::vector<Point<3>>>> names;
  for (const Half_facet supporting_wall : supporting_walls) {
    auto points = polygon(snapshot, supporting_wall);
    std::sort(points.begin(), points.end());
    names.insert({old_cell[snapshot.index(snapshot.cell_of(supporting_wall))], points});
  }
  return names;
}

/// Wide enough to have a facet strictly inside.
const Triangle large{Point<3>{0.125, 0.125, 1}, Point<3>{3.875, 0.125, 1}, Point<3>{0.125, 3.9375, 1}};

struct Listings_seen {
  int moves = 0, contacts = 0, with_supporting_walls = 0;
};

/// Moves a face in a world and in the same one listed otherwise.
void compare_listings(const oracle::World<3>& world, std::uint64_t number, Listings_seen& seen) {
  const Relisted<3> other = relisted(world.soup, number);
  std::vector<std::uint32_t> same(world.soup.cell_count()), old_cell(same.size());
  std::iota(same.begin(), same.end(), 0);
  for (std::uint32_t c = 0; c < same.size(); ++c) old_cell[other.new_cell[c]] = c;
  const auto snapshot = Snapshot<3>::compile(world.soup, glue(world.soup)),
             relisted = Snapshot<3>::compile(other.soup, glue(other.soup));
  const Locator<3> locator(snapshot);
  Random random(number);
  for (int k = 0; k < 40; ++k) {
    std::array<Particle<3>, 3> corners;
    // One in four lies in the plane between the layers and is large: walls float in it.
    const bool is_large = k % 4 == 0;
    if (is_large ? !choose_sides(locator, random, large, corners) : !choose_corners(locator, random, corners))
      continue;
    Face_body first(snapshot), second(relisted);
    const bool is_valid = first.place(corners);
    for (auto& [position, cell, dimension, aimed] : corners) {
      cell = relisted.cell(other.new_cell[snapshot.index(cell)]);
      aimed = 0;
    }
    ASSERT_EQ(second.place(corners), is_valid) << world.name;
    if (!is_valid) continue;
    for (std::size_t step = 0; step < 30; ++step) {
      const Point<3> to = next_spot(random, first.corner(step % 3).position);
      const auto a = first.move_corner(step % 3, to), b = second.move_corner(step % 3, to);
      ASSERT_EQ(a.vertex.has_value(), b.vertex.has_value()) << world.name;
      ASSERT_EQ(a.edge.has_value(), b.edge.has_value()) << world.name;
      ASSERT_EQ(a.face.contact.has_value(), b.face.contact.has_value()) << world.name;
      if (a.face.contact) {
        EXPECT_EQ(a.face.contact->exact_time(), b.face.contact->exact_time()) << world.name;
        EXPECT_EQ(a.face.contact->kind, b.face.contact->kind) << world.name;
        EXPECT_EQ(a.face.is_edge_on_other_side, b.face.is_edge_on_other_side) << world.name;
      }
      ASSERT_EQ(named(snapshot, first.supporting_walls(), same),
                named(relisted, second.supporting_walls(), old_cell))
          << world.name;
      ++seen.moves;
      seen.contacts += a.face.contact.has_value();
      seen.with_supporting_walls += !first.supporting_walls().empty();
    }
  }
}

TEST(FaceSlits, TheOrderOfTheListMakesNoDifference) {
  Listings_seen seen;
  const std::size_t count = oracle::scaled_count(16);
  for (std::uint64_t number = 0; number < count; ++number)
    for (const bool slit : {false, true}) compare_listings(layers(slit, number, 10), number, seen);
  std::cout << "listed otherwise: " << seen.moves << " moves, " << seen.contacts << " contacts, "
            << seen.with_supporting_walls << " with rests\n";
  if (count < 16) return;
  EXPECT_GT(seen.contacts, 1000);
  EXPECT_GT(seen.with_supporting_walls, 400);
}

}  // namespace
}  // namespace cellwalk::test
