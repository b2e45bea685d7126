// SPDX-License-Identifier: LGPL-3.0-or-later
// A block whose lower half is tissue, and the steps of a world in which it lies.
#ifndef CELLWALK_TESTS_SIMULATION_TISSUE_LAB_H
#define CELLWALK_TESTS_SIMULATION_TISSUE_LAB_H

#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/tissue.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::test {

constexpr std::uint32_t block_side = 6;

/// A block of simplices, 6 along each axis, whose cells below a height along the last axis are solid.
template <int D>
Environment<D> tissue_block(double jitter = 0.1, double height = 3) {
  Simplex_grid_options<D> options;
  options.cells.fill(block_side);
  options.jitter = jitter;
  Cell_soup<D> soup;
  if constexpr (D == 2)
    soup = triangle_grid(options);
  else
    soup = tetrahedral_grid(options);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    double sum = 0, count = 0;
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      for (const std::uint32_t v : soup.facet(f)) sum += soup.points[v][D - 1], ++count;
    soup.solid[c] = sum < height * count;
  }
  return Environment<D>::build(std::move(soup));
}

/// Tissue, and the steps of a world in which it lies.
template <int D>
struct Tissue_lab {
  explicit Tissue_lab(const Tissue_material& material, const Scene<D>& scene = {},
                      std::vector<Body_soup<D>> shapes = {}, std::vector<Scene_shape<D>> fixed = {},
                      double jitter = 0.1)
      : environment(tissue_block<D>(jitter)),
        world(environment.snapshot(), scene, std::move(shapes)),
        tissue(environment.snapshot(), material, fixed) {}

  /// Returns how many points were to move.
  std::size_t step() {
    const auto moves = tissue.targets(world);
    if (!moves.empty()) world.move_walls(environment, moves, {.at_contact = At_contact::stop}, counts);
    tissue.follow();
    world.step();
    return moves.size();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
    environment.certify();
  }
  std::vector<Point<D>> points() const {
    const auto all = environment.snapshot().points();
    return {all.begin(), all.end()};
  }
  /// A point of the wall, far from the sides.
  std::uint32_t on_wall() const {
    Point<D> middle;
    middle.fill(3);
    std::uint32_t best = 0;
    for (std::uint32_t v = 1; v < points().size(); ++v)
      if (length(points()[v] - middle) < length(points()[best] - middle)) best = v;
    return best;
  }
  void move(std::uint32_t point, double by) {
    Point<D> x = environment.snapshot().point(point);
    x[D - 1] += by;
    const std::vector<Vertex_move<D>> moves{{point, x}};
    ASSERT_TRUE(world.move_walls(environment, moves, {}, counts).short_of_target.empty());
  }
  double height_of(std::uint32_t point) const { return environment.snapshot().point(point)[D - 1]; }
  double solid_volume() const {
    const Snapshot<D>& snapshot = environment.snapshot();
    double sum = 0;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell cell = snapshot.cell(i);
      if (cell == Cell::none || !snapshot.is_solid(cell)) continue;
      const auto v = snapshot.view(cell).vertices;
      const Point<D> x = snapshot.point(v[0]);
      const Vector<D> a = snapshot.point(v[1]) - x, b = snapshot.point(v[2]) - x;
      if constexpr (D == 2)
        sum += std::abs(a[0] * b[1] - a[1] * b[0]) / 2;
      else
        sum += std::abs(dot(cross(a, b), snapshot.point(v[3]) - x)) / 6;
    }
    return sum;
  }
  /// Cuts the tissue in its middle, across the first axis.
  Cut_report cut(double opening) {
    Environment_change<D> change{.kind = Change_kind::cut, .part = {}};
    if constexpr (D == 2)
      change.blade.points = {{3.05, 5}, {3.05, 1}};
    else
      change.blade.points = {{3.05, 0.5, 5}, {3.05, 5.5, 5}, {3.05, 5.5, 1}, {3.05, 0.5, 1}};
    change.blade.opening = opening;
    change.step = change.until = world.steps_done() + 1;
    Change_schedule<D> schedule(environment.snapshot(), {{}, {change}});
    const auto outcomes = world.change(environment, schedule, counts);
    EXPECT_EQ(outcomes.size(), 1u);
    EXPECT_TRUE(outcomes[0].result.is_made);
    return *outcomes[0].cut;
  }

  Environment<D> environment;
  World<D> world;
  Tissue<D> tissue;
  Reshape_counts counts;
};

/// A rod that is guided from free space into the wall and out again.
template <int D>
std::pair<Scene<D>, Body_soup<D>> rod_into_tissue() {
  Scene<D> scene;
  scene.time_step = 1;
  Point<D> high, low;
  high.fill(2.8);
  high[D - 1] = 4.2;
  low = high;
  low[D - 1] = 2.6;
  Body_start<D> start;
  start.guided = Guided_motion<D>{{high, low, high}, 0.2};
  start.placement.position = high;
  scene.bodies.push_back(start);
  Body_soup<D> rod;
  rod.points.resize(2);
  rod.points[1][0] = 0.4;
  rod.edges = {{0, 1}};
  return {scene, rod};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_TISSUE_LAB_H
