// SPDX-License-Identifier: LGPL-3.0-or-later
#include "worlds.h"

#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "triangulation.h"

namespace cellwalk::track_lengths {
namespace {

Environment<3> build(Cell_soup<3> soup) {
  Build_options options;
  options.split = false;
  options.keep_map = false;
  return Environment<3>::build(std::move(soup), options);
}

double volume(const Cell_view<3>& cell) {
  double edge[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) edge[i][k] = cell.point(i + 1)[k] - cell.point(0)[k];
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    sum += edge[0][k] * (edge[1][l] * edge[2][m] - edge[1][m] * edge[2][l]);
  }
  return std::abs(sum) / 6;
}

double side_of(const Snapshot<3>& snapshot) {
  double sum = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) sum += volume(snapshot.view(snapshot.cell(i)));
  // Rounded to single precision: libraries round cube roots differently.
  return static_cast<float>(std::cbrt(6 * sum / static_cast<double>(snapshot.cell_count())));
}

std::uint32_t cubes_along_axis(std::size_t tetrahedra) {
  return static_cast<std::uint32_t>(std::cbrt(static_cast<double>(tetrahedra) / 6) + 0.5);
}

}  // namespace

World::World(std::string name_of_world, Cell_soup<3> soup, bool convex)
    : name(std::move(name_of_world)),
      is_convex(convex),
      environment(build(std::move(soup))),
      locator(environment.snapshot()),
      side(side_of(environment.snapshot())) {}

World::World(std::string name_of_world, std::unique_ptr<Triangulation> delaunay)
    : World(std::move(name_of_world), delaunay->soup(), true) {
  triangulation = std::move(delaunay);
  triangulation->name_cells(snapshot());
}

World::~World() = default;

std::unique_ptr<World> jittered_grid(std::size_t tetrahedra, std::uint64_t seed) {
  Simplex_grid_options<3> options;
  options.cells = Grid_options<3>::filled(cubes_along_axis(tetrahedra));
  options.jitter = 0.12;
  options.seed = seed;
  // Points of the boundary are moved, too.
  return std::make_unique<World>("grid", tetrahedral_grid(options), false);
}

std::unique_ptr<World> random_points(std::size_t tetrahedra, std::uint64_t seed) {
  constexpr double tetrahedra_of_point = 6.5;
  const auto count = static_cast<std::size_t>(static_cast<double>(tetrahedra) / tetrahedra_of_point);
  const double side = static_cast<float>(std::cbrt(static_cast<double>(count)));
  Random random(seed);
  std::vector<Point<3>> points(count);
  for (Point<3>& p : points)
    for (double& x : p) x = random.real(0, side);
  return std::make_unique<World>("random points", std::make_unique<Triangulation>(points));
}

std::unique_ptr<World> lattice(std::size_t tetrahedra) {
  const std::uint32_t n = cubes_along_axis(tetrahedra);
  std::vector<Point<3>> points;
  for (std::uint32_t z = 0; z <= n; ++z)
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x)
        points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  auto world = std::make_unique<World>("lattice", std::make_unique<Triangulation>(points));
  world->is_lattice = true;
  return world;
}

std::unique_ptr<World> mesh_file(const std::filesystem::path& file) {
  io::Mesh_file read = io::read_mesh(file);
  auto* const soup = std::get_if<Cell_soup<3>>(&read.mesh);
  if (!soup) throw Error(Error_code::input, file.string() + ": has no cells in space");
  return std::make_unique<World>(file.stem().string(), std::move(*soup), false);
}

}  // namespace cellwalk::track_lengths
