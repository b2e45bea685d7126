// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells replaced in a snapshot: what removed ones leave, and who gets it.
#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "environment/snapshot_checks.h"

namespace cellwalk {
namespace {

/// A square cut into its triangles along one of its diagonals, or not cut.
Cell_soup<2> square(bool is_cut) {
  Cell_soup<2> soup;
  if (is_cut) {
    add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
    add_polygon(soup, std::array<std::uint32_t, 3>{0, 2, 3});
  } else {
    add_polygon(soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  }
  soup.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return soup;
}

TEST(ReplaceCells, MayLeaveFewerCells) {
  const Cell_soup<2> cut = square(true), whole = square(false);
  Snapshot<2> snapshot = Snapshot<2>::compile(cut, glue(cut));
  const std::array<Cell, 2> triangles{snapshot.cell(0), snapshot.cell(1)};
  const std::vector<Cell> merged = snapshot.replace_cells(triangles, whole, glue(whole));
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(snapshot.cell_count(), 1u);
  EXPECT_EQ(snapshot.cell_slots(), 2u);
  EXPECT_EQ(snapshot.cell(0), merged[0]);
  EXPECT_EQ(snapshot.cell(1), Cell::none) << "an index that is free";
  const Certificate certificate = certify(snapshot);
  EXPECT_EQ(certificate.cells, 1u);
  EXPECT_EQ(certificate.volume, 1);

  // And back: the free index is used again, and so is the room.
  const std::size_t slots = snapshot.half_facet_slots();
  const std::vector<Cell> parted = snapshot.replace_cells(merged, cut, glue(cut));
  EXPECT_EQ(snapshot.cell_slots(), 2u);
  EXPECT_EQ(snapshot.index(parted[0]), 0u);
  EXPECT_EQ(snapshot.index(parted[1]), 1u);
  EXPECT_EQ(snapshot.half_facet_slots(), slots);
  EXPECT_EQ(test::facts(snapshot), test::facts(Snapshot<2>::compile(cut, glue(cut))));
}

TEST(ReplaceCells, GiveFreeIndicesLowestFirst) {
  const Cell_soup<2> soup = triangle_grid({.cells = {3, 3}});
  Snapshot<2> snapshot = Snapshot<2>::compile(soup, glue(soup));
  const std::array<Cell, 3> gone{snapshot.cell(9), snapshot.cell(4), snapshot.cell(7)};
  EXPECT_TRUE(snapshot.replace_cells(gone, Cell_soup<2>{}, Gluing{}).empty());
  EXPECT_EQ(snapshot.cell_count(), 15u);
  for (const std::size_t i : {4, 7, 9}) EXPECT_EQ(snapshot.cell(i), Cell::none);
  const Certificate with_holes = certify(snapshot);
  EXPECT_EQ(with_holes.cells, 15u);
  EXPECT_GT(with_holes.boundary_facets, 12u) << "what was theirs is a wall";
  Cell_soup<2> two;
  for (const std::uint32_t c : {9u, 4u}) {
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      two.add_facet({soup.facet(f)[0], soup.facet(f)[1]});
    two.end_cell();
  }
  const std::vector<Cell> back =
      snapshot.replace_cells({}, two, Gluing{std::vector<std::uint32_t>(6, no_facet)});
  EXPECT_EQ(snapshot.index(back[0]), 4u);
  EXPECT_EQ(snapshot.index(back[1]), 7u);
  EXPECT_EQ(snapshot.cell_slots(), 18u);
}

/// What must hold of the name of a cell that is gone.
template <int D>
void expect_gone(const Snapshot<D>& snapshot, Cell gone, const Point<D>& in_it) {
  EXPECT_FALSE(snapshot.is_cell(gone));
  EXPECT_TRUE(snapshot.is_solid(gone));
  EXPECT_EQ(snapshot.index(gone), to_index(Cell::none));
  std::array<float, static_cast<std::size_t>(D)> y;
  ASSERT_TRUE(snapshot.frame().map(in_it, y));
  for (std::size_t b = 0; b < snapshot.block_count(gone); ++b) {
    const Float4 sides = evaluate<D>(snapshot.blocks(gone)[b], y);
    for (int lane = 0; lane < 4; ++lane) EXPECT_GT(sides[lane], plane_error) << "everything is outside";
  }
  for (std::size_t k = 0; k < 4 * snapshot.block_count(gone); ++k) {
    EXPECT_TRUE(snapshot.is_impassable(snapshot.half_facet(gone, k)));
    EXPECT_EQ(snapshot.neighbour(snapshot.half_facet(gone, k)), Cell::none);
  }
}

template <int D>
void expect_names_gone(Cell_soup<D> soup) {
  Environment<D> environment = Environment<D>::build(std::move(soup));
  const Snapshot<D>& snapshot = environment.snapshot();
  std::set<Cell> names;
  std::size_t used_again = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    const Cell c = snapshot.cell(i % snapshot.cell_count());
    const Point<D> inside = test::mean_of_vertices(snapshot.view(c));
    const std::size_t slots = snapshot.half_facet_slots();
    std::set<Cell> alive;
    for (std::size_t k = 0; k < snapshot.cell_count(); ++k) alive.insert(snapshot.cell(k));
    const std::vector<Cell> added = environment.insert_point(c, inside);
    expect_gone(snapshot, c, inside);
    EXPECT_THROW(environment.insert_point(c, inside), Error);
    std::size_t new_blocks = 0;
    for (const Cell a : added) {
      EXPECT_TRUE(snapshot.is_cell(a));
      EXPECT_FALSE(alive.contains(a)) << "two cells of one name";
      EXPECT_NE(a, c) << "the name of a cell that goes is not that of one that comes with it";
      new_blocks += snapshot.block_count(a);
      used_again += names.contains(a);
    }
    EXPECT_GE(slots + 4 * new_blocks, snapshot.half_facet_slots());
    names.insert(c);
  }
  EXPECT_GT(used_again, 30u);
  EXPECT_NO_THROW(environment.certify());
}

TEST(ReplaceCells, GiveRoomAgainButNotAtOnce2) { expect_names_gone(triangle_grid({.cells = {2, 2}})); }
TEST(ReplaceCells, GiveRoomAgainButNotAtOnce3) { expect_names_gone(tetrahedral_grid({.cells = {1, 1, 1}})); }
TEST(ReplaceCells, GiveRoomAgainButNotAtOnceToCellsOfSeveralSizes) {
  // Hexahedra take two blocks, pyramids two, tetrahedra one.
  Environment<3> environment = Environment<3>::build(hex_grid({.cells = {2, 1, 1}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  for (int i = 0; i < 60; ++i) {
    const Cell c = snapshot.cell(i % 7);
    const Point<3> inside = test::mean_of_vertices(snapshot.view(c));
    environment.insert_point(c, inside);
    expect_gone(snapshot, c, inside);
  }
  EXPECT_NO_THROW(environment.certify());
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) blocks += snapshot.block_count(snapshot.cell(i));
  // All that is not in use is what the last ones left of sizes that none of the later ones had.
  EXPECT_LE(snapshot.half_facet_slots() / 4 - blocks, 16u);
}

TEST(ReplaceCells, RaiseTheEpoch) {
  Environment<2> environment = Environment<2>::build(triangle_grid({.cells = {2, 2}}));
  const Snapshot<2>& snapshot = environment.snapshot();
  const auto raises = [&](const auto& edit) {
    const std::uint64_t epoch = snapshot.epoch(), geometry = snapshot.geometry_epoch();
    try {
      edit();
    } catch (const Error&) {
    }
    return std::array<bool, 2>{snapshot.epoch() > epoch, snapshot.geometry_epoch() > geometry};
  };
  using Raised = std::array<bool, 2>;
  Half_facet inner = Half_facet::none, outer = Half_facet::none;
  for (std::size_t k = 0; k < 3; ++k) {
    const Half_facet f = snapshot.half_facet(snapshot.cell(0), k);
    (snapshot.neighbour(f) == Cell::none ? outer : inner) = f;
  }
  EXPECT_EQ(raises([&] { environment.set_impassable(inner, true); }), (Raised{true, false}));
  EXPECT_EQ(raises([&] { environment.set_impassable(inner, true); }), (Raised{false, false})) << "it is one";
  EXPECT_EQ(raises([&] { environment.set_impassable(outer, true); }), (Raised{false, false}));
  EXPECT_EQ(raises([&] { environment.set_impassable(outer, false); }), (Raised{false, false})) << "refused";
  EXPECT_EQ(raises([&] { environment.set_impassable(inner, false); }), (Raised{true, false}));
  std::uint32_t middle = 0;
  while (snapshot.point(middle) != Point<2>{1, 1}) ++middle;
  EXPECT_EQ(raises([&] { environment.move_vertex(middle, {1.25, 1}); }), (Raised{true, true}));
  EXPECT_EQ(raises([&] {
              environment.move_vertex(middle, {1.25, 1});
            }),
            (Raised{false, false}))
      << "it is there";
  EXPECT_EQ(raises([&] { environment.move_vertex(middle, {5, 1}); }), (Raised{false, false})) << "refused";
  const Cell c = snapshot.cell(0);
  EXPECT_EQ(raises([&] { environment.insert_point(c, {9, 9}); }), (Raised{false, false})) << "refused";
  EXPECT_EQ(raises([&] { environment.insert_point(c, test::mean_of_vertices(snapshot.view(c))); }),
            (Raised{true, true}));
  EXPECT_NO_THROW(snapshot.check_epoch(snapshot.epoch(), "x"));
  EXPECT_THROW(snapshot.check_epoch(snapshot.epoch() - 1, "x"), Error);
}

}  // namespace
}  // namespace cellwalk
