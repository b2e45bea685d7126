// SPDX-License-Identifier: LGPL-3.0-or-later
// Clusters of cells against the snapshot that they are made of.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/environment/cell_cluster.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>

namespace cellwalk::test {
namespace {

Point<3> middle(const Cell_view<3>& cell) {
  Point<3> sum{};
  for (std::size_t v = 0; v < cell.vertex_count(); ++v) sum = sum + cell.point(v);
  return 1.0 / static_cast<double>(cell.vertex_count()) * sum;
}

/// A facet of a cell that is not of the boundary.
Half_facet inner_facet(const Snapshot<3>& snapshot, std::size_t cell) {
  Half_facet f = snapshot.half_facet(snapshot.cell(cell), 0);
  while (snapshot.neighbour(f) == Cell::none) f = Half_facet{to_index(f) + 1};
  return f;
}

void expect_around_facets(const Snapshot<3>& snapshot, const detail::Facet_boxes<3>& boxes) {
  const Plane_frame<3>& frame = snapshot.frame();
  for (std::size_t lane = 0; lane < 4; ++lane) {
    if (!(boxes.low[0][lane] <= boxes.high[0][lane])) continue;
    for (const std::uint32_t v : snapshot.loop(Half_facet{boxes.facets[lane]}))
      for (std::size_t k = 0; k < 3; ++k) {
        const double t = (snapshot.point(v)[k] - frame.centre[k]) * frame.scale;
        EXPECT_LE(boxes.low[k][lane], t);
        EXPECT_GE(boxes.high[k][lane], t);
      }
  }
}

void expect_plane_of(const Snapshot<3>& snapshot, Half_facet f, const Plane_block<3>& planes,
                     std::size_t lane) {
  const std::size_t facet = snapshot.facet_of(f);
  const Plane_block<3>& of_cell = snapshot.blocks(snapshot.cell_of(f))[facet / 4];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(planes.normal[k][lane], of_cell.normal[k][facet % 4]);
  EXPECT_EQ(planes.offset[lane], of_cell.offset[facet % 4]);
}

/// Clusters miss none of the walls that a flood of cells meets.
void expect_walls_of_all_cells(const Snapshot<3>& snapshot, std::size_t least_clusters) {
  const detail::Cell_clusters<3>& clusters = snapshot.clusters();
  std::set<std::uint32_t> walls, expected;
  std::set<std::pair<std::uint32_t, std::uint32_t>> passages, expected_passages;
  std::set<std::uint32_t> numbers;
  for (std::size_t index = 0; index < snapshot.cell_slots(); ++index) {
    const Cell cell = snapshot.cell(index);
    const std::uint32_t here = clusters.cluster_of(snapshot, cell);
    numbers.insert(here);
    for (std::size_t i = 0; i < snapshot.facet_count(cell); ++i) {
      const Half_facet f = Snapshot<3>::half_facet(cell, i);
      if (snapshot.is_impassable(f)) {
        expected.insert(to_index(f));
      } else if (const auto there = clusters.cluster_of(snapshot, snapshot.neighbour(f)); there != here) {
        expected_passages.emplace(here, there);
      }
    }
  }
  for (const std::uint32_t number : numbers) {
    const detail::Cell_cluster<3>& cluster = clusters.cluster(snapshot, number);
    const auto each = [](const detail::Facet_boxes<3>& boxes, const auto& use) {
      for (std::size_t lane = 0; lane < 4; ++lane)
        if (boxes.low[0][lane] <= boxes.high[0][lane]) use(boxes.facets[lane], lane);
    };
    for (const detail::Wall_lanes<3>& four : cluster.walls) {
      expect_around_facets(snapshot, four.boxes);
      each(four.boxes, [&](std::uint32_t f, std::size_t lane) {
        EXPECT_TRUE(walls.insert(f).second);
        expect_plane_of(snapshot, Half_facet{f}, four.planes, lane);
      });
    }
    for (const detail::Facet_boxes<3>& four : cluster.passages)
      each(four,
           [&](std::uint32_t there, std::size_t) { EXPECT_TRUE(passages.emplace(number, there).second); });
  }
  EXPECT_GE(numbers.size(), least_clusters);
  EXPECT_EQ(walls, expected);
  EXPECT_EQ(passages, expected_passages);
}

TEST(CellClusters, HaveTheWallsOfAllCells) {
  const auto environment = Environment<3>::build(branching_vessel({}));
  expect_walls_of_all_cells(environment.snapshot(), 20);
}

TEST(CellClusters, FollowEdits) {
  Simplex_grid_options<3> grid;
  grid.cells = {3, 3, 3};
  Environment<3> environment = Environment<3>::build(tetrahedral_grid(grid));
  const Snapshot<3>& snapshot = environment.snapshot();
  expect_walls_of_all_cells(snapshot, 3);
  for (std::size_t cell = 0; cell < snapshot.cell_count(); cell += 3)
    environment.set_impassable(inner_facet(snapshot, cell), true);
  expect_walls_of_all_cells(snapshot, 3);
  environment.set_impassable(inner_facet(snapshot, 9), false);
  expect_walls_of_all_cells(snapshot, 3);
  std::uint32_t inner = 0;
  while (snapshot.point(inner) != Point<3>{1, 1, 1}) ++inner;
  environment.move_vertex(inner, {1.125, 1, 0.875});
  expect_walls_of_all_cells(snapshot, 3);
  std::uint32_t corner = 0;
  while (snapshot.point(corner) != Point<3>{3, 3, 3}) ++corner;
  environment.move_vertex(corner, {6, 6, 6});  // out of the frame of all boxes
  expect_walls_of_all_cells(snapshot, 3);
  for (const std::size_t index : {1, 161, 30}) {
    environment.insert_point(snapshot.cell(index), middle(snapshot.view(snapshot.cell(index))));
    expect_walls_of_all_cells(snapshot, 3);
  }
}

}  // namespace
}  // namespace cellwalk::test
