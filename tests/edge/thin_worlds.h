// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds in which edges are long and walls are thin: spikes, and sheets to slide on.
#ifndef CELLWALK_TESTS_EDGE_THIN_WORLDS_H
#define CELLWALK_TESTS_EDGE_THIN_WORLDS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/generators/slits.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "oracle/exact_world.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::test {

/// Columns of boxes, every second one only 1/64 wide. Many of the thin ones are solid up to some height:
/// spikes that fit between two positions of an edge. Long, so that edges pass many cells.
template <int D>
oracle::World<D> spikes(std::uint64_t seed) {
  Random random(seed);
  Lattice_world_options<D> options;
  options.cells.fill(D == 2 ? 4 : 2);
  options.cells[0] = D == 2 ? 24 : 12;
  options.seed = seed;
  options.membrane_share = 0.04;
  oracle::World<D> world;
  world.name = "spikes, world " + std::to_string(seed);
  Cell_soup<D>& soup = world.soup;
  soup = lattice_world(options);
  const std::uint32_t width = options.cells[0];
  std::vector<std::uint64_t> heights(soup.cell_count() / options.cells[1]);
  for (auto& height : heights) height = random.below(2) == 0 ? 0 : random.below(options.cells[1]);
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) {
    const std::uint32_t x = c % width, y = c / width % options.cells[1], z = c / width / options.cells[1];
    if (x % 2 == 0 || y >= heights[x + width * z]) continue;
    soup.solid[c] = 1;
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) soup.impassable[f] = 1;
  }
  for (Point<D>& p : soup.points) {
    const auto x = static_cast<int>(p[0]);
    p[0] = x % 2 == 0 ? x / 2 : x / 2 + 63.0 / 64;
    if (seed % 2 == 1) p[0] += p[1] / 8;  // leaning ones
  }
  return world;
}

/// Cells made one: the first of each group holds the facets of all but those within.
/// \pre the union is convex
template <int D>
Cell_soup<D> merged(const Cell_soup<D>& soup, const std::vector<std::uint32_t>& group_of) {
  const oracle::Facet_table table = oracle::make_facet_table(soup);
  Cell_soup<D> result;
  result.points = soup.points;
  for (std::uint32_t g = 0; g < soup.cell_count(); ++g) {
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
      const auto other = table.opposite[f];
      if (group_of[table.cell[f]] != g) continue;
      if (other < 0 || group_of[table.cell[static_cast<std::size_t>(other)]] != g)
        result.add_facet(soup.facet(f), soup.impassable[f]);
    }
    if (result.facet_count() > result.cell_begin.back()) result.end_cell();
  }
  return result;
}

/// Cells on both sides of a sheet, a membrane with holes; here and there with a wall that stands on it. In
/// every second world many cells are boxes that share both holes and walls of the sheet.
template <int D>
oracle::World<D> sheets(std::uint64_t seed) {
  Random random(seed);
  const bool boxes = seed % 2 == 0;
  Lattice_world_options<D> options;
  const std::uint32_t width = D == 2 ? 12 : 4;
  options.cells.fill(4);
  options.cells[0] = width;
  options.seed = seed;
  options.simplex_share = boxes ? 0 : 0.25;
  options.membrane_share = boxes ? 0 : 0.02;
  if (seed % 4 < 2) options.map = rotated<D>();
  oracle::World<D> world;
  world.name = "sheets, world " + std::to_string(seed);
  Cell_soup<D>& soup = world.soup;
  soup = lattice_world(options);
  const Point<D> middle = options.map(Point<D>{0, 2});
  const Vector<D> up = middle - options.map({});
  const oracle::Facet_table table = oracle::make_facet_table(soup);
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    if (table.opposite[f] < f) continue;
    const auto loop = soup.facet(f);
    const bool is_in_sheet = std::all_of(
        loop.begin(), loop.end(), [&](std::uint32_t v) { return dot(soup.points[v] - middle, up) == 0; });
    if (is_in_sheet && random.below(2) == 0) soup.impassable[f] = 1;
  }
  if (!boxes) return world;
  // Blocks of 2 by 2 cubes along the sheet (2D: of 2 squares), three out of four.
  std::vector<std::uint32_t> group_of(soup.cell_count());
  std::vector<std::uint64_t> chance(soup.cell_count());
  for (auto& c : chance) c = random.below(4);
  for (std::uint32_t c = 0; c < group_of.size(); ++c) {
    const std::uint32_t x = c % width, y = c / width % 4, z = c / width / 4;
    const std::uint32_t first = (x & ~1u) + width * (y + 4 * (z & ~1u));
    group_of[c] = chance[first] == 0 ? c : first;
  }
  soup = merged(soup, group_of);
  return world;
}

/// Makes slits of the membranes and of other walls between cells of a world.
template <int D>
void part_at_walls(oracle::World<D>& world) {
  Cell_soup<D>& soup = world.soup;
  const oracle::Facet_table table = oracle::make_facet_table(soup);
  std::vector<std::uint8_t> is_slit(soup.facet_count());
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    if (table.opposite[f] < 0 || !soup.impassable[f]) continue;
    is_slit[f] = 1;
    soup.impassable[f] = 0;
  }
  open_slits<D>(soup, is_slit);
  world.name = "slit " + world.name;
}

/// Two layers of wide boxes, which share windows and are parted by slits beside them.
template <int D>
oracle::World<D> windows(std::uint64_t seed) {
  Random random(seed);
  Lattice_world_options<D> options;
  options.cells.fill(4);
  options.cells[1] = 2;
  if (seed % 4 >= 2) options.map = rotated<D>();
  oracle::World<D> world;
  world.name = "windows, world " + std::to_string(seed);
  world.soup = lattice_world(options);
  const oracle::Facet_table table = oracle::make_facet_table(world.soup);
  std::vector<std::uint32_t> group_of;
  const std::uint32_t width = random.below(3) == 0 ? 4 : 2;
  for (std::uint32_t c = 0; c < world.soup.cell_count(); ++c) {
    const std::uint32_t x = c % 4, y = c / 4 % 2, z = c / 8;
    group_of.push_back(x - x % width + 4 * (y + 2 * (z - z % 2)));
  }
  for (std::uint32_t f = 0; f < world.soup.facet_count(); ++f) {
    const auto g = table.opposite[f];
    if (g < f || table.cell[f] / 4 % 2 == table.cell[static_cast<std::size_t>(g)] / 4 % 2) continue;
    if (random.below(2) == 0) world.soup.impassable[f] = 1;
  }
  world.soup = merged(world.soup, group_of);
  part_at_walls(world);
  return world;
}

/// Windows among slits, or sheets whose membranes are slits.
template <int D>
oracle::World<D> slit_world(std::uint64_t seed) {
  if (seed % 3 != 0) return windows<D>(seed);
  oracle::World<D> world = sheets<D>(seed / 3);
  part_at_walls(world);
  return world;
}

/// Facets that are walls between cells that share a passable one too.
template <int D>
int walls_beside_ways(const Snapshot<D>& snapshot) {
  std::map<std::array<Cell, 2>, std::array<int, 2>> shared;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t f = 0; f < snapshot.facet_count(snapshot.cell(i)); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(snapshot.cell(i), f);
      const Cell next = snapshot.neighbour(facet);
      if (next != Cell::none) ++shared[{snapshot.cell(i), next}][snapshot.is_impassable(facet)];
    }
  int walls = 0;
  for (const auto& [cells, facets] : shared) walls += facets[0] > 0 ? facets[1] : 0;
  return walls / 2;
}

/// Passable facets in whose plane both of their cells have boundary facets.
template <int D>
int slits_beside_ways(const Snapshot<D>& snapshot) {
  const auto has_wall_in_plane = [&](Half_facet path) {
    const Cell c = snapshot.cell_of(path);
    const auto plane = snapshot.loop(path);
    const auto in_plane = [&](std::uint32_t v) {
      Predicate_counts counts;
      const auto x = [&](std::size_t i) { return snapshot.point(plane[i]); };
      if constexpr (D == 2) return Exact::orientation(counts, x(0), x(1), snapshot.point(v)) == 0;
      if constexpr (D == 3) {
        std::size_t third = 2;
        while (are_collinear(x(0), x(1), x(third))) ++third;
        return Exact::orientation(counts, x(0), x(1), x(third), snapshot.point(v)) == 0;
      }
    };
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
      const Half_facet wall = Snapshot<D>::half_facet(c, f);
      if (snapshot.neighbour(wall) != Cell::none) continue;
      const auto loop = snapshot.loop(wall);
      if (std::all_of(loop.begin(), loop.end(), in_plane)) return true;
    }
    return false;
  };
  int ways = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t f = 0; f < snapshot.facet_count(snapshot.cell(i)); ++f) {
      const Half_facet path = Snapshot<D>::half_facet(snapshot.cell(i), f);
      if (snapshot.is_impassable(path)) continue;
      const Half_facet other = snapshot.opposite(path);
      ways += path < other && has_wall_in_plane(path) && has_wall_in_plane(other);
    }
  return ways;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_THIN_WORLDS_H
