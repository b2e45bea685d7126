// SPDX-License-Identifier: LGPL-3.0-or-later
// The tetrahedra through which rays are traced.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_WORLDS_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_WORLDS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/walk/locate.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace cellwalk::track_lengths {

class Triangulation;

/// Tetrahedra, certified. It stays where it is.
struct World {
  World(std::string name, Cell_soup<3> soup, bool is_convex);
  World(std::string name, std::unique_ptr<Triangulation> delaunay);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  const Snapshot<3>& snapshot() const { return environment.snapshot(); }

  std::string name;
  bool is_convex;
  bool is_lattice = false;                       ///< its points have integer coordinates
  std::unique_ptr<Triangulation> triangulation;  ///< of the same tetrahedra, if they are Delaunay's
  Environment<3> environment;
  Locator<3> locator;
  double side;  ///< of a cube with the volume of six cells
};

/// A grid of cubes of side 1, six tetrahedra each, whose points are moved at random.
std::unique_ptr<World> jittered_grid(std::size_t tetrahedra, std::uint64_t seed);
/// The Delaunay triangulation of random points in a cube, one in a volume of 1 on average.
std::unique_ptr<World> random_points(std::size_t tetrahedra, std::uint64_t seed);
/// The Delaunay triangulation of the points of a grid of cubes of side 1.
std::unique_ptr<World> lattice(std::size_t tetrahedra);
/// Those of a file of tetrahedra.
std::unique_ptr<World> mesh_file(const std::filesystem::path& file);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_WORLDS_H
