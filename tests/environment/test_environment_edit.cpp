// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/flatten.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <limits>

#include "map_checks.h"
#include "sample_soups.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

template <int D>
std::vector<unsigned int> counts(const Environment<D>& environment) {
  std::vector<unsigned int> dimensions;
  for (unsigned int i = 0; i <= D; ++i) dimensions.push_back(i);
  return environment.storage().map.count_cells(dimensions);
}

/// Map valid, in step with the snapshot, certified; and the snapshot is what compiling the map from scratch
/// gives.
template <int D>
void expect_sound(const Environment<D>& environment, std::uint64_t seed) {
  EXPECT_TRUE(environment.storage().map.is_valid());
  ASSERT_NO_THROW(environment.certify());
  const Flat_cells<D> flat = flatten(environment.storage());
  const Snapshot<D> from_scratch = Snapshot<D>::compile(flat.soup, flat.gluing);
  EXPECT_EQ(test::facts(environment.snapshot()), test::facts(from_scratch));
  EXPECT_EQ(glue(flat.soup).opposite, flat.gluing.opposite);
  test::expect_planes_hold(environment.snapshot(), seed);
}

template <int D>
Half_facet random_half_facet(const Snapshot<D>& snapshot, Random& random) {
  const Cell c = snapshot.cell(random.below(snapshot.cell_count()));
  return snapshot.half_facet(c, random.below(snapshot.facet_count(c)));
}

/// Edges of a cell (vertices in 2D), which inserting a point turns into facets.
template <int D>
std::size_t ridge_count(const Cell_view<D>& cell) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) n += cell.loop(i).size();
  return n / 2;
}

struct Tally {
  std::size_t walls_made = 0, walls_removed = 0, walls_refused = 0;
  std::size_t moved_inside = 0, moved_on_boundary = 0, moves_refused = 0, overlaps_refused = 0;
  std::size_t inserted = 0, inserts_refused = 0;
};

template <int D>
void edit_wall(Environment<D>& environment, Random& random, Tally& tally) {
  const Half_facet f = random_half_facet(environment.snapshot(), random);
  const bool wall = !environment.snapshot().is_impassable(f);
  try {
    environment.set_impassable(f, wall);
    EXPECT_EQ(environment.snapshot().is_impassable(f), wall);
    EXPECT_EQ(environment.snapshot().is_impassable(environment.snapshot().opposite(f)), wall);
    ++(wall ? tally.walls_made : tally.walls_removed);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    EXPECT_FALSE(wall);
    ++tally.walls_refused;
  }
}

template <int D>
void edit_point(Environment<D>& environment, Random& random, Tally& tally) {
  const Snapshot<D>& snapshot = environment.snapshot();
  auto point = static_cast<std::uint32_t>(random.below(snapshot.points().size()));
  // The latest point is often one that was inserted, which has room to move.
  if (random.chance(0.3)) point = static_cast<std::uint32_t>(snapshot.points().size() - 1);
  Point<D> target = snapshot.point(point);
  for (double& x : target) x += random.real(-1, 1) * (random.chance(0.2) ? 2 : 0.25);
  bool on_boundary = false;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = snapshot.half_facet(snapshot.cell(i), k);
      const auto loop = snapshot.loop(f);
      on_boundary |= snapshot.neighbour(f) == Cell::none && std::count(loop.begin(), loop.end(), point) > 0;
    }
  try {
    environment.move_vertex(point, target);
    EXPECT_EQ(snapshot.point(point), target);
    EXPECT_NO_THROW(environment.certify());
    ++(on_boundary ? tally.moved_on_boundary : tally.moved_inside);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    ++tally.moves_refused;
    tally.overlaps_refused += std::string(error.what()).find("reaches across") != std::string::npos;
    // Certification from scratch would have refused it too.
    Cell_soup<D> moved = environment.soup();
    moved.points[point] = target;
    EXPECT_THROW(certify(Snapshot<D>::compile(moved, glue(moved))), Error) << error.what();
  }
}

template <int D>
void edit_cell(Environment<D>& environment, Random& random, Tally& tally) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const std::uint32_t index = static_cast<std::uint32_t>(random.below(snapshot.cell_count()));
  const Cell cell = snapshot.cell(index);
  const std::size_t facets = snapshot.facet_count(cell), ridges = ridge_count(snapshot.view(cell)),
                    vertices = snapshot.view(cell).vertex_count(), cells = snapshot.cell_count();
  Point<D> target = test::mean_of_vertices(snapshot.view(cell));
  // Some points lie on a facet, an edge or beyond: they must be refused.
  if (random.chance(0.2)) target = snapshot.view(cell).point(0);
  const auto before = counts(environment);
  try {
    const std::vector<Cell> added = environment.insert_point(cell, target);
    ++tally.inserted;
    ASSERT_EQ(added.size(), facets);
    for (std::size_t i = 0; i < added.size(); ++i)
      EXPECT_EQ(snapshot.index(added[i]), i == 0 ? index : cells + i - 1);
    auto expected = before;
    expected[0] += 1;
    if (D == 3) expected[1] += static_cast<unsigned int>(vertices);
    expected[D - 1] += static_cast<unsigned int>(ridges);
    expected[D] += static_cast<unsigned int>(facets - 1);
    EXPECT_EQ(counts(environment), expected);
    EXPECT_THROW(environment.insert_point(cell, target), Error) << "the old name is gone";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    ++tally.inserts_refused;
  }
}

template <int D>
Tally expect_sound_after_random_edits(int rounds) {
  Tally tally;
  Random random(20 + D);
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> environment = Environment<D>::build(soup);
    for (int round = 0; round < rounds; ++round) {
      SCOPED_TRACE(round);
      const auto before = test::facts(environment.snapshot());
      const Tally done = tally;
      const std::uint64_t kind = random.below(4);
      if (kind == 0) edit_wall(environment, random, tally);
      if (kind == 1) edit_cell(environment, random, tally);
      if (kind > 1) edit_point(environment, random, tally);
      const bool refused = tally.walls_refused + tally.moves_refused + tally.inserts_refused !=
                           done.walls_refused + done.moves_refused + done.inserts_refused;
      EXPECT_EQ(test::facts(environment.snapshot()) == before, refused);
      expect_sound(environment, random.bits());
    }
  }
  return tally;
}

void expect_all_kinds(const Tally& tally) {
  EXPECT_GT(tally.walls_made, 5u);
  EXPECT_GT(tally.walls_removed, 0u);
  EXPECT_GT(tally.walls_refused, 2u);
  EXPECT_GT(tally.moved_inside, 2u);
  EXPECT_GT(tally.moved_on_boundary, 2u);
  EXPECT_GT(tally.moves_refused, 10u);
  EXPECT_GT(tally.inserted, 10u);
  EXPECT_GT(tally.inserts_refused, 2u);
}

TEST(Edit, KeepsMapAndSnapshotSoundAndInStep2) { expect_all_kinds(expect_sound_after_random_edits<2>(60)); }
TEST(Edit, KeepsMapAndSnapshotSoundAndInStep3) { expect_all_kinds(expect_sound_after_random_edits<3>(30)); }

/// Simplices apart from each other, with gaps of half their size.
template <int D>
Cell_soup<D> scattered_simplices() {
  Cell_soup<D> soup;
  for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
    const std::array<double, 3> corner{1.5 * (i % 3), 1.5 * (i / 3 % 3), 1.5 * (i / 9)};
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int k = 0; k <= D; ++k) {
      Point<D> p;
      for (int j = 0; j < D; ++j) p[j] = corner[j] + (k == j + 1);
      soup.points.push_back(p);
    }
    if constexpr (D == 2)
      add_polygon(soup, std::array<std::uint32_t, 3>{first, first + 1, first + 2});
    else
      add_tetrahedron(soup, first, first + 1, first + 2, first + 3);
  }
  return soup;
}

template <int D>
void expect_overlaps_refused() {
  Environment<D> environment = Environment<D>::build(scattered_simplices<D>());
  Random random(7);
  Tally tally;
  for (int i = 0; i < 300; ++i) edit_point(environment, random, tally);
  expect_sound(environment, 1);
  EXPECT_GT(tally.moved_on_boundary, 50u);
  EXPECT_GT(tally.overlaps_refused, 10u);
  EXPECT_GT(tally.moves_refused, tally.overlaps_refused);
}

TEST(Edit, RefusesOverlapsAsCertificationFromScratch2) { expect_overlaps_refused<2>(); }
TEST(Edit, RefusesOverlapsAsCertificationFromScratch3) { expect_overlaps_refused<3>(); }

TEST(Edit, MovesAllPartsOfAPinchedVertex) {
  const Cell_soup<3> soup = test::pinched_tetrahedra();
  Environment<3> environment = Environment<3>::build(soup);
  environment.move_vertex(0, {0.125, 0.0625, 0.0625});
  expect_sound(environment, 1);
  // Beyond what the second of its two cells can bear.
  EXPECT_THROW(environment.move_vertex(0, {-0.9, -0.9, -0.9}), Error);
  EXPECT_EQ(environment.snapshot().point(0), (Point<3>{0.125, 0.0625, 0.0625}));
  expect_sound(environment, 2);
}

TEST(Edit, RefusesABoundaryThatRunsIntoAnotherCell) {
  // Two triangles with a gap between them.
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {0, 1}, {3, 0}, {4, 0}, {4, 1}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(soup, std::array<std::uint32_t, 3>{3, 4, 5});
  Environment<2> environment = Environment<2>::build(soup);
  EXPECT_THROW(environment.move_vertex(1, {3.5, 0.25}), Error);
  EXPECT_THROW(environment.move_vertex(1, {3, 0}), Error) << "two vertices in one place";
  EXPECT_EQ(environment.snapshot().point(1), (Point<2>{1, 0}));
  EXPECT_NO_THROW(environment.move_vertex(1, {2.5, 0.25}));
  expect_sound(environment, 1);
}

TEST(Edit, KeepsFacetsPlanar) {
  Environment<3> environment = Environment<3>::build(hex_grid({.cells = {1, 1, 1}}));
  EXPECT_THROW(environment.move_vertex(0, {-0.5, 0, 0.25}), Error);
  // Pyramids have one quadrangle each, whose corners stay; their apex may go anywhere inside.
  environment.insert_point(environment.snapshot().cell(0), {0.5, 0.5, 0.5});
  EXPECT_NO_THROW(environment.move_vertex(8, {0.25, 0.75, 0.125}));
  EXPECT_THROW(environment.move_vertex(8, {0.25, 0.75, 0}), Error) << "a flat pyramid";
  expect_sound(environment, 1);
}

TEST(Edit, LeavesWallsBetweenSolidAndFreeCells) {
  Grid_options<3> options{.cells = {2, 1, 1}};
  options.solid_cells = {1};
  Environment<3> environment = Environment<3>::build(hex_grid(options));
  const Snapshot<3>& snapshot = environment.snapshot();
  std::size_t refused = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Half_facet f = snapshot.half_facet(snapshot.cell(0), k);
    EXPECT_TRUE(snapshot.is_impassable(f));
    try {
      environment.set_impassable(f, false);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::not_certified);
      ++refused;
    }
    EXPECT_NO_THROW(environment.set_impassable(f, true));
  }
  EXPECT_EQ(refused, 6u);
  // The star of a point in a solid cell is solid, and its inner facets are passable.
  const auto added = environment.insert_point(snapshot.cell(1), {1.5, 0.5, 0.5});
  for (const Cell c : added) EXPECT_TRUE(snapshot.is_solid(c));
  expect_sound(environment, 1);
  EXPECT_EQ(environment.certify().solid_cells, 6u);
}

TEST(Edit, RefusesWhatIsNotThere) {
  Environment<3> environment = Environment<3>::build(hex_grid({.cells = {2, 1, 1}}));
  const auto before = test::facts(environment.snapshot());
  const auto code_of = [](const auto& edit) {
    try {
      edit();
    } catch (const Error& error) {
      return error.code();
    }
    return Error_code::other;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // A hexahedron has two blocks of four facets: slots 6 and 7 are empty, and block 1 is no cell.
  EXPECT_EQ(code_of([&] { environment.set_impassable(Half_facet{6}, true); }), Error_code::usage);
  EXPECT_EQ(code_of([&] { environment.set_impassable(Half_facet::none, true); }), Error_code::usage);
  EXPECT_EQ(code_of([&] { environment.move_vertex(12, {}); }), Error_code::usage);
  EXPECT_EQ(code_of([&] { environment.move_vertex(0, {nan, 0, 0}); }), Error_code::input);
  EXPECT_EQ(code_of([&] { environment.insert_point(Cell{1}, {0.5, 0.5, 0.5}); }), Error_code::usage);
  EXPECT_EQ(code_of([&] { environment.insert_point(Cell::none, {0.5, 0.5, 0.5}); }), Error_code::usage);
  EXPECT_EQ(code_of([&] { environment.insert_point(Cell{0}, {nan, 0.5, 0.5}); }), Error_code::input);
  EXPECT_EQ(test::facts(environment.snapshot()), before);
}

TEST(Edit, CertifyNoticesAMapThatWasEditedAlone) {
  Environment<3> environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  auto& storage = const_cast<Map_storage<3>&>(environment.storage());
  storage.map.point_of_vertex_attribute(storage.vertex_of_point[3]) = Map<3>::Point(9, 9, 9);
  EXPECT_THROW(environment.certify(), Error);
}

}  // namespace
}  // namespace cellwalk
