// SPDX-License-Identifier: GPL-3.0-or-later
// Other cells in the same walls: writes an environment whose tetrahedra are bounded in volume, so that their
// edges are about N times shorter than those of the given cells. TetGen keeps every triangle of a wall.
//
//   finer_cells SCENES.json NAME N OUT.ovm    the cells of a scene in a list
#include <cellwalk/environment/environment.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>

#include "common/peers/wall_mesh.h"
#include "scenes.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::real_scenes;

Scene_entry find(const std::string& list, const std::string& name) {
  for (Scene_entry& entry : read_scene_list(list))
    if (entry.name == name) return std::move(entry);
  throw std::runtime_error(list + ": has no scene " + name);
}

Surface_soup surface_of(const experiments::Wall_mesh& walls) {
  Surface_soup surface{walls.points, {}};
  for (const auto& triangle : walls.triangles) surface.facets.emplace_back(triangle.begin(), triangle.end());
  return surface;
}

void run(std::span<char*> arguments) {
  const Cell_soup<3> soup = load_cells(find(arguments[1], arguments[2]));
  const double times = std::stod(arguments[3]);
  const auto walls = experiments::wall_mesh(soup, glue(soup), experiments::Facing::wall);
  Tetrahedralize_options options;
  options.quality = 1.5;
  const double mean_volume = enclosed_volume(walls) / static_cast<double>(soup.cell_count());
  // A regular tetrahedron of circumradius r has the volume 8 sqrt(3) / 27 r^3.
  options.cell_size = std::cbrt(mean_volume * 27 / (8 * std::sqrt(3.0))) / times;
  options.most_added_points = 4000000;
  const Cell_soup<3> finer = tetrahedralize(surface_of(walls), {}, options);
  io::write_ovm<3>(arguments[4], finer);
  fmt::print("{}: {} cells instead of {}\n", arguments[4], finer.cell_count(), soup.cell_count());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: finer_cells SCENES.json NAME N OUT.ovm\n");
    return 2;
  }
  try {
    run({argv, static_cast<std::size_t>(argc)});
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "finer_cells: {}\n", error.what());
    return 1;
  }
}
