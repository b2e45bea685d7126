// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells replaced in map, snapshot and indices, against environments that are built anew.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_cluster.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "map_checks.h"

namespace cellwalk {
namespace {

using detail::Cell_patcher;
using detail::glue_patch;

double turn(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Environment<2> grid(std::uint64_t seed) {
  Simplex_grid_options<2> options;
  options.cells = {5, 4};
  options.jitter = 0.15;
  options.seed = seed;
  return Environment<2>::build(triangle_grid(options));
}

/// The triangle of the second cell of a facet, seen from the first: its loop, and the other vertices of both.
struct Quad {
  std::uint32_t a, b, own, other;
};

std::optional<Quad> quad_at(const Snapshot<2>& snapshot, Half_facet f) {
  const Half_facet g = snapshot.opposite(f);
  if (g == Half_facet::none || snapshot.is_impassable(f)) return {};
  const auto loop = snapshot.loop(f);
  const auto apex = [&](Half_facet h) {
    for (const std::uint32_t v : snapshot.view(snapshot.cell_of(h)).vertices)
      if (v != loop[0] && v != loop[1]) return v;
    return loop[0];
  };
  const Quad quad{loop[0], loop[1], apex(f), apex(g)};
  const auto at = [&](std::uint32_t v) { return snapshot.point(v); };
  // Lattices are exact in doubles; jittered points need only be far from flat.
  if (turn(at(quad.a), at(quad.other), at(quad.own)) < 1e-3 ||
      turn(at(quad.other), at(quad.b), at(quad.own)) < 1e-3)
    return {};
  return quad;
}

bool flip(Environment<2>& environment, Half_facet f) {
  const Snapshot<2>& snapshot = environment.snapshot();
  const std::optional<Quad> quad = quad_at(snapshot, f);
  if (!quad) return false;
  Cell_soup<2> soup;
  add_polygon(soup, std::array{quad->a, quad->other, quad->own});
  add_polygon(soup, std::array{quad->other, quad->b, quad->own});
  const std::array removed{snapshot.cell_of(f), snapshot.neighbour(f)};
  Cell_patcher<2>(environment).replace(removed, soup, glue_patch(soup));
  return true;
}

/// All cells around each point, by looking at all of them.
void expect_stars(Environment<2>& environment) {
  const Snapshot<2>& snapshot = environment.snapshot();
  std::vector<std::vector<Cell>> stars(snapshot.points().size());
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none)
      for (const std::uint32_t v : snapshot.view(c).vertices) stars[v].push_back(c);
  for (std::uint32_t v = 0; v < stars.size(); ++v) {
    std::vector<Cell> found = environment.cells_around(v);
    std::sort(found.begin(), found.end());
    std::sort(stars[v].begin(), stars[v].end());
    EXPECT_EQ(found, stars[v]) << "point " << v;
  }
}

TEST(CellPatcher, FlipsLikeAnEnvironmentBuiltAnew) {
  int flipped = 0, moved = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Environment<2> environment = grid(seed);
    const Snapshot<2>& snapshot = environment.snapshot();
    Random random(seed);
    const std::size_t slots = snapshot.half_facet_slots();
    for (int k = 0; k < 60; ++k) {
      const Cell c = snapshot.cell(random.below(snapshot.cell_slots()));
      const auto facet = static_cast<std::size_t>(random.below(3));
      flipped += flip(environment, Snapshot<2>::half_facet(c, facet));
      const auto v = static_cast<std::uint32_t>(random.below(snapshot.points().size()));
      const Point<2> target = snapshot.point(v) + Vector<2>{random.real(-1, 1), random.real(-1, 1)};
      // The boundary has an index, which follows.
      Environment<2> anew = Environment<2>::build(environment.soup(), {.keep_map = false});
      const auto is_accepted = [&](Environment<2>& of) {
        try {
          of.move_vertex(v, target);
          return true;
        } catch (const Error&) {
          return false;
        }
      };
      const bool expected = is_accepted(anew);
      ASSERT_EQ(is_accepted(environment), expected) << "seed " << seed << ", point " << v;
      ++(expected ? moved : refused);
    }
    expect_stars(environment);
    EXPECT_NO_THROW(environment.certify());
    EXPECT_TRUE(environment.storage().map.is_valid());
    EXPECT_LE(snapshot.half_facet_slots(), slots + 4 * 2);
  }
  EXPECT_GT(flipped, 100);
  EXPECT_GT(moved, 50);
  EXPECT_GT(refused, 50);
}

/// The boxes of a cluster as numbers, in any order.
std::vector<std::vector<float>> contents(const std::vector<detail::Facet_boxes<2>>& boxes) {
  std::vector<std::vector<float>> result;
  for (const auto& four : boxes)
    for (int lane = 0; lane < 4; ++lane) {
      std::vector<float> box{static_cast<float>(four.facets[static_cast<std::size_t>(lane)])};
      for (std::size_t k = 0; k < 2; ++k) {
        box.push_back(four.low[k][lane]);
        box.push_back(four.high[k][lane]);
      }
      if (box[1] <= box[2]) result.push_back(box);
    }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::vector<float>> contents(const std::vector<detail::Wall_lanes<2>>& walls) {
  std::vector<std::vector<float>> result;
  for (const auto& four : walls)
    for (int lane = 0; lane < 4; ++lane) {
      std::vector<float> wall{static_cast<float>(four.boxes.facets[static_cast<std::size_t>(lane)])};
      for (const auto& lanes : {four.boxes.low, four.boxes.high, four.planes.normal})
        for (std::size_t k = 0; k < 2; ++k) wall.push_back(lanes[k][lane]);
      wall.push_back(four.planes.offset[lane]);
      result.push_back(wall);
    }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(CellPatcher, ClustersOfCellsFollow) {
  Simplex_grid_options<2> options;
  options.cells = {20, 20};
  options.jitter = 0.15;
  Environment<2> environment = Environment<2>::build(triangle_grid(options));
  const Snapshot<2>& snapshot = environment.snapshot();
  const auto& clusters = snapshot.clusters();
  Random random(3);
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    if (const Half_facet f = Snapshot<2>::half_facet(snapshot.cell(i), i % 3);
        snapshot.neighbour(f) != Cell::none && random.chance(0.4))
      environment.set_impassable(f, true);
  std::size_t compared = 0, added = 0;
  for (int k = 0; k < 60; ++k) {
    std::uint32_t size = 0;  // of a cluster
    while (clusters.cluster_of(snapshot, Cell{size}) == 0) ++size;
    const std::uint32_t count = clusters.size(snapshot);
    ASSERT_GT(count, 3u);
    for (std::uint32_t n = 0; n < count; ++n) {
      const auto made = detail::make_cluster(snapshot, n, size);
      ASSERT_EQ(contents(clusters.cluster(snapshot, n).walls), contents(made->walls)) << n;
      ASSERT_EQ(contents(clusters.cluster(snapshot, n).passages), contents(made->passages)) << n;
      ++compared;
    }
    for (int i = 0; i < 4; ++i) {
      const Cell c = snapshot.cell(random.below(snapshot.cell_slots()));
      flip(environment, Snapshot<2>::half_facet(c, static_cast<std::size_t>(random.below(3))));
    }
    // More names than there were.
    const Cell grown = snapshot.cell(random.below(snapshot.cell_slots()));
    const Cell_view<2> view = snapshot.view(grown);
    const Point<2> x =
        view.point(0) + 0.25 * (view.point(1) - view.point(0)) + 0.25 * (view.point(2) - view.point(0));
    added += environment.insert_point(grown, x).size();
  }
  EXPECT_EQ(added, 180u);
  EXPECT_GT(compared, 200u);
}

TEST(CellPatcher, AFrozenEnvironmentIsRefused) {
  Environment<2> environment = grid(1);
  environment.freeze();
  const Cell_soup<2> soup;
  EXPECT_THROW(Cell_patcher<2>(environment).replace({}, soup, glue_patch(soup)), Error);
}

/// Cells that go without others leave a hole with walls around it, also in the map.
TEST(CellPatcher, LeavesAHole) {
  Environment<3> environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  const Certificate before = environment.certify();
  const Cell_soup<3> none;
  const std::array removed{snapshot.cell(20)};
  EXPECT_TRUE(Cell_patcher<3>(environment).replace(removed, none, glue_patch(none)).empty());
  const Certificate after = environment.certify();
  EXPECT_EQ(after.cells + 1, before.cells);
  EXPECT_GT(after.boundary_facets, before.boundary_facets);
}

}  // namespace
}  // namespace cellwalk
