// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells drawn up to a limit of triangles, beyond which a share of them is left out.
#include <cellwalk/internal/drawing/walls.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace cellwalk::drawing {
namespace {

using Loop = std::vector<std::uint32_t>;

// Triangles of facets in 3D, of cells in the plane; about 270 bytes each while they are drawn.
constexpr std::size_t most_wall_triangles = 300000;
// Shares of the diagonal of the environment's box.
constexpr double wall_width = 0.005, grid_width = 0.0009;
constexpr std::size_t most_grid_cells = 4000;  // beyond that inner edges would only darken the picture

/// Calls f for each wall at free space, once, and with false for the other facets of free cells, also once.
template <int D, class F>
void for_each_facet(const Snapshot<D>& snapshot, F f) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || snapshot.is_solid(c)) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet h = snapshot.half_facet(c, k);
      const Cell other = snapshot.neighbour(h);
      if (other != Cell::none && !snapshot.is_solid(other) && to_index(other) < to_index(c)) continue;
      f(h, snapshot.is_impassable(h));
    }
  }
}

/// The vertices of a cell in the plane, in their order around it.
Loop corners_of(const Snapshot<2>& snapshot, Cell c) {
  std::vector<Loop> edges;
  for (std::size_t k = 0; k < snapshot.facet_count(c); ++k)
    edges.push_back(snapshot.loop(snapshot.half_facet(c, k)));
  Loop corners{edges[0][0]};
  std::uint32_t next = edges[0][1];
  while (corners.size() < edges.size()) {
    corners.push_back(next);
    next = (*std::find_if(edges.begin(), edges.end(), [&](const Loop& e) { return e[0] == next; }))[1];
  }
  return corners;
}

double share_of(std::size_t triangles) {
  return triangles > most_wall_triangles
             ? static_cast<double>(most_wall_triangles) / static_cast<double>(triangles)
             : 1;
}

void draw_cells(Drawing& drawing, const Snapshot<2>& snapshot, const Wall_materials& m) {
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none) triangles += snapshot.facet_count(c) - 2;
  const double share = share_of(triangles), growth = 1 / std::sqrt(share);
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || !is_among(share, i)) continue;
    std::vector<Point<3>> points;
    Vector<3> sum{};
    for (const std::uint32_t p : corners_of(snapshot, c)) {
      points.push_back({snapshot.point(p)[0], snapshot.point(p)[1], 0});
      sum = sum + points.back();
    }
    const Point<3> middle = (1.0 / static_cast<double>(points.size())) * sum;
    Loop loop;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (share < 1) points[k] = middle + growth * (points[k] - middle);
      loop.push_back(static_cast<std::uint32_t>(k));
    }
    add_surface(drawing, points, std::vector<Loop>{loop}, snapshot.is_solid(c) ? m.solid_cell : m.free_cell);
  }
}

}  // namespace

bool is_among(double share, std::size_t number) {
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio: the evenest steps
  return static_cast<double>(number * golden >> 11) * 0x1p-53 < share;
}

Round_shapes lines_of_walls(const Snapshot<2>& snapshot) {
  const bool has_grid = snapshot.cell_count() <= most_grid_cells;
  std::size_t lines = 0;
  for_each_facet(snapshot, [&](Half_facet, bool is_wall) { lines += is_wall || has_grid; });
  return {0, lines, 2 * lines};
}

Round_shapes lines_of_walls(const Snapshot<3>&) { return {}; }

void draw_walls(Drawing& drawing, const Snapshot<2>& snapshot, const Wall_materials& m, double lines,
                double unit) {
  draw_cells(drawing, snapshot, m);
  const double layer = 1e-4 * unit;  // between flat things, for the depth buffer
  const bool has_grid = snapshot.cell_count() <= most_grid_cells;
  for_each_facet(snapshot, [&](Half_facet h, bool is_wall) {
    if ((!is_wall && !has_grid) || !is_among(lines, to_index(h))) return;
    const Loop ends = snapshot.loop(h);
    add_flat_line(drawing, snapshot.point(ends[0]), snapshot.point(ends[1]),
                  (is_wall ? wall_width : grid_width) * unit, (is_wall ? 2 : 1) * layer,
                  is_wall ? m.wall : m.inner_edge);
  });
}

void draw_walls(Drawing& drawing, const Snapshot<3>& snapshot, const Wall_materials& m, double, double) {
  draw_walls_but(drawing, snapshot, m, {});
}

void draw_walls_but(Drawing& drawing, const Snapshot<3>& snapshot, const Wall_materials& m,
                    const std::unordered_set<Half_facet>& left_out) {
  const auto is_left_out = [&](Half_facet h) {
    return left_out.contains(h) || left_out.contains(snapshot.opposite(h));
  };
  std::size_t triangles = 0;
  for_each_facet(snapshot, [&](Half_facet h, bool is_wall) {
    if (is_wall && !is_left_out(h)) triangles += snapshot.loop(h).size() - 2;
  });
  const double share = share_of(triangles);
  double& opacity = drawing.materials[m.wall].colour.opacity;
  opacity = std::min(1.0, opacity / share);
  std::vector<Point<3>> points;
  std::unordered_map<std::uint32_t, std::uint32_t> number_of;  // of points in use
  std::vector<Loop> facets;
  for_each_facet(snapshot, [&](Half_facet h, bool is_wall) {
    if (!is_wall || is_left_out(h) || !is_among(share, to_index(h))) return;
    Loop loop = snapshot.loop(h);
    for (std::uint32_t& p : loop) {
      const auto [at, is_new] = number_of.try_emplace(p, static_cast<std::uint32_t>(points.size()));
      if (is_new) points.push_back(snapshot.point(p));
      p = at->second;
    }
    facets.push_back(std::move(loop));
  });
  add_surface(drawing, points, facets, m.wall);
}

}  // namespace cellwalk::drawing
