// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world.h"

#include <cellwalk/internal/generators/lattice_world.h>

#include <algorithm>
#include <map>
#include <set>

#include "02_exact_versus_float/worlds.h"
#include "oracle/exact_world.h"
#include "oracle/oracle.h"

namespace cellwalk::corpus {
namespace {

template <int D>
bool has_area(const Cell_soup<D>& soup, const std::array<std::uint32_t, D>& corners) {
  if constexpr (D == 2) {
    return true;
  } else {
    std::vector<Vec> v;
    for (const std::uint32_t corner : corners) v.push_back(exact<D>(soup.points[corner]));
    for (std::size_t i = 0; i < 3; ++i)
      if (meet(std::array<Vec, 1>{v[i]}, std::array<Vec, 2>{v[(i + 1) % 3], v[(i + 2) % 3]})) return false;
    return true;
  }
}

/// A point inside a wall; exact, as coordinates have few bits.
template <int D>
Point<D> inner_point(const Cell_soup<D>& soup, const std::array<std::uint32_t, D>& corners) {
  Point<D> sum = soup.points[corners[0]];
  for (const std::uint32_t v : corners) sum = sum + soup.points[v];
  const Point<D> doubled = D == 2 ? sum - soup.points[corners[0]] : sum;
  return (D == 2 ? 0.5 : 0.25) * doubled;
}

/// The facets that bound free space, cut into simplices.
template <int D>
void add_walls(World<D>& world) {
  const Cell_soup<D>& soup = world.soup;
  const oracle::Facet_table table = oracle::make_facet_table(soup);
  const oracle::Oracle<D> oracle(soup);
  std::uint32_t number = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    if (table.passable[f] || soup.solid[table.cell[f]]) continue;
    const auto other = table.opposite[f];
    const bool is_membrane = other >= 0 && !soup.solid[table.cell[static_cast<std::size_t>(other)]];
    if (is_membrane && static_cast<std::size_t>(other) < f) continue;
    std::vector<std::uint32_t> loop(soup.facet(f).begin(), soup.facet(f).end());
    // Seen from outside its cell it turns to the left; in 2D the cell is to its left already.
    if (D == 3) std::reverse(loop.begin(), loop.end());
    for (std::size_t k = 1; k + 1 < loop.size() || (D == 2 && k == 1); ++k) {
      Wall<D> wall;
      wall.corners[0] = loop[0];
      for (std::size_t i = 1; i < D; ++i) wall.corners[i] = loop[k + i - 1];
      if (!has_area<D>(soup, wall.corners)) continue;
      wall.facet = number;
      const int sides = oracle.place(inner_point<D>(soup, wall.corners)).sides;
      wall.kind = is_membrane ? Wall_kind::membrane : sides > 1 ? Wall_kind::slit : Wall_kind::solid;
      world.walls.push_back(wall);
    }
    ++number;
  }
}

template <int D>
void add_features(World<D>& world) {
  std::set<std::uint32_t> vertices;
  std::map<std::array<std::uint32_t, 3>, int> uses;  // facet, u < v
  for (const Wall<D>& wall : world.walls) {
    vertices.insert(wall.corners.begin(), wall.corners.end());
    for (std::size_t i = 0; D == 3 && i < D; ++i) {
      const std::uint32_t u = wall.corners[i], v = wall.corners[(i + 1) % D];
      ++uses[{wall.facet, std::min(u, v), std::max(u, v)}];
    }
  }
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& [side, count] : uses)
    if (count == 1) edges.insert({side[1], side[2]});
  world.vertices.assign(vertices.begin(), vertices.end());
  world.edges.assign(edges.begin(), edges.end());
  const auto points = [&](const auto& corners) {
    std::vector<Vec> result;
    for (const std::uint32_t v : corners) result.push_back(exact<D>(world.soup.points[v]));
    return result;
  };
  for (const std::uint32_t v : world.vertices) world.vertex_points.push_back(points(std::array{v}));
  for (const auto& edge : world.edges) world.edge_points.push_back(points(edge));
  for (const Wall<D>& wall : world.walls) world.wall_points.push_back(points(wall.corners));
}

template <int D>
World<D> make_world(const std::string& name, const Lattice_world_options<D>& options) {
  World<D> world;
  world.name = std::to_string(D) + "d-" + name;
  world.soup = lattice_world(options);
  add_walls(world);
  add_features(world);
  return world;
}

}  // namespace

template <int D>
std::vector<World<D>> make_worlds() {
  std::vector<World<D>> worlds;
  const auto add = [&](const char* name, std::uint64_t seed, const auto& change) {
    Lattice_world_options<D> options;
    options.cells.fill(D == 2 ? 4 : 2);
    options.seed = seed;
    change(options);
    worlds.push_back(make_world<D>(name, options));
  };
  using Options = Lattice_world_options<D>;
  add("lattice", 1, [](Options& o) { o.solid_share = 0.25; });
  add("membranes", 2, [](Options& o) { o.membrane_share = 0.35; });
  add("pinched", 3, [](Options& o) {
    o.cells[0] = 3;
    o.removed_share = 0.4;
  });
  add("coplanar", 4, [](Options& o) {
    o.cells[0] = D == 2 ? 5 : 3;
    o.box_share = 0.7;
    o.membrane_share = 0.2;
  });
  add("collinear", 5, [](Options& o) {
    o.box_share = 0.6;
    o.merge_share = D == 3 ? 0.9 : 0;
    o.membrane_share = 0.2;
  });
  add("simplices", 6, [](Options& o) {
    o.simplex_share = D == 3 ? 0.4 : 0.7;
    o.star_share = 0.2;
    o.prism_share = D == 3 ? 0.3 : 0;
    o.membrane_share = 0.15;
    o.solid_share = 0.1;
  });
  add("slits", 7, [](Options& o) { o.slit_share = 0.25; });
  add("rotated", 8, [](Options& o) {
    o.map = rotated<D>();
    o.membrane_share = 0.2;
    o.solid_share = 0.15;
  });
  add("rotated-slits", 9, [](Options& o) {
    o.map = rotated<D>(0.125);
    o.box_share = 0.5;
    o.slit_share = 0.2;
  });
  add("turned", 10, [](Options& o) {
    o.map = exact_float::lattice_map<D>({});
    o.membrane_share = 0.25;
    o.solid_share = 0.15;
  });
  add("sheared", 11, [](Options& o) {
    o.map = sheared<D>(0.25);
    o.simplex_share = 0.3;
    o.membrane_share = 0.2;
    o.removed_share = 0.15;
  });
  add("thin", 12, [](Options& o) {
    o.map.columns[0][0] = 0x1p-10;
    o.cells[0] = D == 2 ? 6 : 3;
    o.solid_share = 0.2;
    o.membrane_share = 0.15;
  });
  add("small", 13, [](Options& o) {
    o.map = scaled<D>(0x1p-20);
    o.membrane_share = 0.25;
    o.solid_share = 0.15;
  });
  return worlds;
}

template <int D>
std::vector<World<D>> make_moving_worlds() {
  std::vector<World<D>> worlds;
  const auto add = [&](const char* name, std::uint64_t seed, const auto& change) {
    Lattice_world_options<D> options;
    options.cells.fill(D == 2 ? 4 : 2);
    options.cells[0] = D == 2 ? 4 : 3;
    options.seed = seed;
    options.simplex_share = D == 2 ? 0.6 : 1;
    options.star_share = D == 2 ? 0.4 : 0;
    change(options);
    worlds.push_back(make_world<D>(name, options));
  };
  using Options = Lattice_world_options<D>;
  add("moving-solid", 21, [](Options& o) { o.solid_share = 0.2; });
  add("moving-membranes", 22, [](Options& o) { o.membrane_share = D == 2 ? 0.3 : 0.2; });
  add("moving-pinched", 23, [](Options& o) {
    o.removed_share = 0.3;
    o.membrane_share = 0.1;
  });
  add("moving-slits", 24, [](Options& o) {
    o.slit_share = 0.2;
    o.membrane_share = 0.05;
  });
  add("moving-rotated", 25, [](Options& o) {
    o.map = rotated<D>();
    o.membrane_share = 0.15;
    o.solid_share = 0.1;
  });
  add("moving-turned", 26, [](Options& o) {
    o.map = exact_float::lattice_map<D>({});
    o.membrane_share = 0.2;
  });
  add("moving-small", 27, [](Options& o) {
    o.map = scaled<D>(0x1p-20);
    o.membrane_share = 0.15;
    o.solid_share = 0.1;
  });
  return worlds;
}

template <int D>
void place_vertex(World<D>& world, std::uint32_t vertex, const Vec& place) {
  const auto replace = [&](const auto& corners, std::vector<Vec>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (corners[i] == vertex) points[i] = place;
  };
  for (std::size_t i = 0; i < world.vertices.size(); ++i)
    replace(std::array{world.vertices[i]}, world.vertex_points[i]);
  for (std::size_t i = 0; i < world.edges.size(); ++i) replace(world.edges[i], world.edge_points[i]);
  for (std::size_t i = 0; i < world.walls.size(); ++i) replace(world.walls[i].corners, world.wall_points[i]);
}

#define CELLWALK_INSTANTIATE(D)                           \
  template std::vector<World<D>> make_worlds<D>();        \
  template std::vector<World<D>> make_moving_worlds<D>(); \
  template void place_vertex<D>(World<D>&, std::uint32_t, const Vec&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::corpus
