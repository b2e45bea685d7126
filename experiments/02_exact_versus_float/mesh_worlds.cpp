// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes from files, and motions between their features.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <variant>

#include "worlds.h"

namespace cellwalk::exact_float {

Mesh_world read_mesh_world(const std::filesystem::path& file) {
  io::Mesh_file read = io::read_mesh(file);
  auto* const soup = std::get_if<Cell_soup<3>>(&read.mesh);
  if (!soup) throw Error(Error_code::input, file.string() + ": has no cells in space");
  Mesh_world world;
  world.soup = std::move(*soup);
  world.opposite = glue(world.soup).opposite;
  for (std::uint32_t c = 0; c < world.soup.cell_count(); ++c)
    world.cell_of.insert(world.cell_of.end(), world.soup.cell_begin[c + 1] - world.soup.cell_begin[c], c);
  return world;
}

namespace {

std::uint32_t any_facet(const Mesh_world& world, std::uint32_t cell, Random& random) {
  const std::uint32_t begin = world.soup.cell_begin[cell], end = world.soup.cell_begin[cell + 1];
  return begin + static_cast<std::uint32_t>(random.below(end - begin));
}

/// A weighted mean of the corners of a facet.
template <class Weight>
Point<3> mean(const Mesh_world& world, std::uint32_t facet, const Weight& weight) {
  Vector<3> sum{};
  double weights = 0;
  for (const std::uint32_t v : world.soup.facet(facet)) {
    const double w = weight();
    for (int i = 0; i < 3; ++i) sum[i] += w * world.soup.points[v][i];
    weights += w;
  }
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
}

Point<3> any_point(const Mesh_world& world, std::uint32_t cell, Random& random) {
  const std::uint32_t facet = any_facet(world, cell, random);
  const auto loop = world.soup.facet(facet);
  const std::size_t k = random.below(loop.size());
  const Point<3>&a = world.soup.points[loop[k]], &b = world.soup.points[loop[(k + 1) % loop.size()]];
  switch (random.below(4)) {
    case 0:
      return a;
    case 1:
      return a + 0.5 * (b - a);
    case 2:
      return mean(world, facet, [] { return 1.0; });
    default:
      break;
  }
  const auto weight = [&] { return random.real(0, 1); };
  const Point<3> p = mean(world, facet, weight);
  return p + random.real(0, 1) * (mean(world, any_facet(world, cell, random), weight) - p);
}

}  // namespace

Motion<3> make_motion(const Mesh_world& world, Random& random) {
  constexpr std::uint64_t farthest = 5;  // cells from one end to the other
  auto cell = static_cast<std::uint32_t>(random.below(world.soup.cell_count()));
  const Point<3> from = any_point(world, cell, random);
  for (std::uint64_t left = random.below(farthest + 1); left > 0; --left) {
    const std::uint32_t other = world.opposite[any_facet(world, cell, random)];
    if (other != no_facet) cell = world.cell_of[other];
  }
  const Point<3> aim = any_point(world, cell, random);
  if (random.below(2) == 0) return {from, aim};
  return {from, from + 1.5 * (aim - from)};
}

}  // namespace cellwalk::exact_float
