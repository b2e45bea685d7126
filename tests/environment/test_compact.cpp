// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments that are compacted after edits: the same complex by other names, as if it had just been built.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sample_soups.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

/// Expects that all names of the one lead to the same things in the other.
template <int D>
void expect_same(const Snapshot<D>& before, const Snapshot<D>& after, const Compaction& names) {
  ASSERT_EQ(names.cells.size(), before.half_facet_slots() / 4);
  ASSERT_EQ(names.half_facets.size(), before.half_facet_slots());
  ASSERT_EQ(names.points.size(), before.points().size());
  std::size_t points = 0, cells = 0;
  for (std::uint32_t p = 0; p < names.points.size(); ++p) {
    if (names.points[p] == Compaction::none) continue;
    EXPECT_EQ(names.points[p], points++) << "they keep their order";
    EXPECT_EQ(after.point(names.points[p]), before.point(p));
  }
  EXPECT_EQ(points, after.points().size());
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < before.cell_slots(); ++i) {
    const Cell old = before.cell(i);
    if (old == Cell::none) continue;
    const Cell now = names.cells[to_index(old)];
    ASSERT_TRUE(after.is_cell(now));
    EXPECT_EQ(after.index(now), cells++) << "they keep their order";
    last = after.index(now);
    EXPECT_EQ(after.is_solid(now), before.is_solid(old));
    ASSERT_EQ(after.facet_count(now), before.facet_count(old));
    for (std::size_t k = 0; k < before.facet_count(old); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(old, k), g = names.half_facets[to_index(f)];
      ASSERT_EQ(after.cell_of(g), now);
      EXPECT_EQ(after.is_impassable(g), before.is_impassable(f));
      const Cell other = before.neighbour(f);
      EXPECT_EQ(after.neighbour(g), other == Cell::none ? Cell::none : names.cells[to_index(other)]);
      auto old_loop = before.loop(f), loop = after.loop(g);
      for (std::uint32_t& p : old_loop) p = names.points[p];
      std::rotate(old_loop.begin(), std::ranges::min_element(old_loop), old_loop.end());
      std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
      EXPECT_EQ(loop, old_loop);
    }
  }
  EXPECT_EQ(last + 1, after.cell_slots());
  EXPECT_EQ(after.cell_slots(), before.cell_count()) << "nothing is left free";
}

/// Replaces points by others, so that indices and blocks are left over.
template <int D>
void leave_holes(Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  detail::Cell_patcher<D> patcher(environment);
  for (const std::size_t i : {0, 3}) {
    if (i >= snapshot.cell_count()) continue;
    const Cell cell = snapshot.cell(i);
    const Cell_view<D> view = snapshot.view(cell);
    Vector<D> sum{};
    for (std::size_t v = 0; v < view.vertex_count(); ++v) sum = sum + (view.point(v) - Point<D>{});
    const Point<D> middle = Point<D>{} + (1.0 / static_cast<double>(view.vertex_count())) * sum;
    // The cell itself, to be put in the place of the star of the new point again.
    Cell_soup<D> old;
    std::size_t facet = 0;
    for (std::size_t k = 0; k < view.facet_count(); ++k) {
      const auto loop = snapshot.loop(snapshot.half_facet(cell, facet));
      old.add_facet(loop, snapshot.is_impassable(snapshot.half_facet(cell, facet)));
      ++facet;
      if constexpr (D == 2)
        for (std::size_t j = 0; j < view.facet_count(); ++j)
          if (snapshot.loop(snapshot.half_facet(cell, j))[0] == loop[1]) facet = j;
    }
    old.end_cell(snapshot.is_solid(cell));
    try {
      const std::vector<Cell> star = environment.insert_point(cell, middle);
      if (i == 0) patcher.replace(star, old, detail::glue_patch(old));
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), Error_code::usage) << error.what();  // not strictly inside
    }
  }
}

template <int D>
void expect_compacted(Environment<D>& environment) {
  const Snapshot<D> before = environment.snapshot();
  const Certificate certificate = environment.certify();
  const bool is_frozen = environment.is_frozen();
  const Compaction names = environment.compact();
  const Snapshot<D>& after = environment.snapshot();
  EXPECT_EQ(environment.is_frozen(), is_frozen);
  EXPECT_GT(after.epoch(), before.epoch());
  EXPECT_GT(after.geometry_epoch(), before.epoch());
  expect_same(before, after, names);
  const Certificate now = environment.certify();
  EXPECT_EQ(now.vertices, certificate.vertices);
  EXPECT_EQ(now.components, certificate.components);
  EXPECT_EQ(now.volume, certificate.volume);
  if (!is_frozen) {
    EXPECT_TRUE(environment.storage().map.is_valid());
  }
  // Nothing is left to be done, and edits go on.
  const auto facts = test::facts(after);
  environment.compact();
  EXPECT_EQ(test::facts(environment.snapshot()), facts);
  if (!is_frozen) {
    leave_holes(environment);
    EXPECT_NO_THROW(environment.certify());
  }
}

template <int D>
void expect_samples_compacted() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> environment = Environment<D>::build(soup);
    leave_holes(environment);
    expect_compacted(environment);
    Environment<D> frozen = Environment<D>::build(soup);
    leave_holes(frozen);
    frozen.freeze();
    expect_compacted(frozen);
  }
}

TEST(Compact, KeepsAllButNames2) { expect_samples_compacted<2>(); }
TEST(Compact, KeepsAllButNames3) { expect_samples_compacted<3>(); }

/// Facets in one place that are not glued, pinched points, and solid cells.
template <int D>
void expect_lattices_compacted() {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Lattice_world_options<D> options = mixed_lattice_world<D>(seed);
    options.slit_share = 0.1;
    Environment<D> environment =
        Environment<D>::build(lattice_world(options), {.duplicates = Duplicate_vertices::keep});
    leave_holes(environment);
    expect_compacted(environment);
  }
}

TEST(Compact, KeepsSlitsAndPinchedPoints2) { expect_lattices_compacted<2>(); }
TEST(Compact, KeepsSlitsAndPinchedPoints3) { expect_lattices_compacted<3>(); }

TEST(Compact, GivesMemoryBack) {
  Simplex_grid_options<3> options;
  options.cells.fill(6);
  Environment<3> environment = Environment<3>::build(tetrahedral_grid(options));
  const std::size_t bytes = environment.snapshot().bytes();
  detail::Cell_patcher<3> patcher(environment);
  const Snapshot<3>& snapshot = environment.snapshot();
  // A point in every cell, and then all of them gone.
  std::vector<std::vector<Cell>> stars;
  std::vector<Cell_soup<3>> cells;
  for (std::size_t i = snapshot.cell_slots(); i-- > 0;) {
    const Cell cell = snapshot.cell(i);
    const Cell_view<3> view = snapshot.view(cell);
    Point<3> middle{};
    for (std::size_t v = 0; v < 4; ++v) middle = middle + 0.25 * (view.point(v) - Point<3>{});
    Cell_soup<3>& soup = cells.emplace_back();
    for (std::size_t k = 0; k < 4; ++k)
      soup.add_facet(snapshot.loop(snapshot.half_facet(cell, k)),
                     snapshot.is_impassable(snapshot.half_facet(cell, k)));
    soup.end_cell();
    stars.push_back(environment.insert_point(cell, middle));
  }
  for (std::size_t i = 0; i < stars.size(); ++i)
    patcher.replace(stars[i], cells[i], detail::glue_patch(cells[i]));
  EXPECT_GT(snapshot.bytes(), 2 * bytes);
  EXPECT_GT(snapshot.points().size(), 4 * 343u);
  environment.compact();
  EXPECT_LT(snapshot.bytes(), bytes + bytes / 10);
  EXPECT_EQ(snapshot.points().size(), 343u);
  environment.certify();
}

}  // namespace
}  // namespace cellwalk
