// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells and walls of a soup as VTK cells: as those of known types, or polyhedra.
#include <cellwalk/internal/io/vtu.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace cellwalk::io {
namespace {

using Loop = std::vector<std::uint32_t>;

Loop loop_of(const Cell_soup<3>& soup, std::size_t f) { return {soup.facet(f).begin(), soup.facet(f).end()}; }

std::vector<Loop> loops_of(const Cell_soup<3>& soup, std::size_t c) {
  std::vector<Loop> loops;
  for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
    loops.push_back(loop_of(soup, f));
  return loops;
}

/// The vertex of the cell that is joined to v by an edge and does not lie on the first facet, if there is
/// exactly one.
std::optional<std::uint32_t> above(const std::vector<Loop>& loops, std::uint32_t v) {
  const Loop& base = loops[0];
  std::optional<std::uint32_t> found;
  for (std::size_t f = 1; f < loops.size(); ++f)
    for (std::size_t i = 0; i < loops[f].size(); ++i) {
      const std::size_t n = loops[f].size();
      if (loops[f][i] != v) continue;
      for (std::uint32_t w : {loops[f][(i + 1) % n], loops[f][(i + n - 1) % n]}) {
        if (std::find(base.begin(), base.end(), w) != base.end()) continue;
        if (found && *found != w) return std::nullopt;
        found = w;
      }
    }
  return found;
}

/// The corners of a cell that is combinatorially a tetrahedron, pyramid, wedge or hexahedron: those of its
/// base, counterclockwise seen from inside, then those above them. Otherwise none.
std::optional<Loop> corners_of_known_type(std::vector<Loop> loops) {
  const auto of_size = [&](std::size_t n) {
    return std::count_if(loops.begin(), loops.end(), [n](const Loop& loop) { return loop.size() == n; });
  };
  const std::array sizes{of_size(3), of_size(4)};
  const bool has_apex = sizes == std::array{4L, 0L} || sizes == std::array{4L, 1L};
  if (!has_apex && sizes != std::array{2L, 3L} && sizes != std::array{0L, 6L}) return std::nullopt;
  if (loops.size() != static_cast<std::size_t>(sizes[0] + sizes[1])) return std::nullopt;
  const std::size_t base_size = sizes[1] == 1 || sizes[1] == 6 ? 4 : 3;
  std::stable_partition(loops.begin(), loops.end(),
                        [&](const Loop& loop) { return loop.size() == base_size; });
  Loop corners(loops[0].rbegin(), loops[0].rend());
  std::rotate(corners.begin(), corners.end() - 1, corners.end());
  const Loop base = corners;
  for (std::uint32_t v : base) {
    const auto top = above(loops, v);
    if (!top) return std::nullopt;
    if (has_apex && corners.size() > base_size) {
      if (corners.back() != *top) return std::nullopt;
      continue;
    }
    corners.push_back(*top);
  }
  Loop sorted = corners;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
  // Every vertex must be one of the corners.
  for (const Loop& loop : loops)
    for (std::uint32_t v : loop)
      if (!std::binary_search(sorted.begin(), sorted.end(), v)) return std::nullopt;
  return corners;
}

void add_cell_of(Vtu_grid& grid, const Cell_soup<3>& soup, std::size_t c) {
  const std::vector<Loop> loops = loops_of(soup, c);
  std::optional<Loop> corners = corners_of_known_type(loops);
  if (!corners) return grid.add_polyhedron(loops);
  switch (corners->size()) {
    case 4:
      return grid.add_cell(Vtu_cell::tetrahedron, *corners);
    case 5:
      return grid.add_cell(Vtu_cell::pyramid, *corners);
    case 6:  // VTK has the triangles of a wedge in the opposite direction.
      std::swap((*corners)[1], (*corners)[2]);
      std::swap((*corners)[4], (*corners)[5]);
      return grid.add_cell(Vtu_cell::wedge, *corners);
    default:
      return grid.add_cell(Vtu_cell::hexahedron, *corners);
  }
}

Vtu_cell polygon_type(std::size_t n) {
  return n == 3 ? Vtu_cell::triangle : n == 4 ? Vtu_cell::quad : Vtu_cell::polygon;
}

void add_cell_of(Vtu_grid& grid, const Cell_soup<2>& soup, std::size_t c) {
  Loop loop;
  for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
    loop.push_back(soup.facet(f)[0]);
  grid.add_cell(polygon_type(loop.size()), loop);
}

template <int D>
Vtu_grid points_of(const Cell_soup<D>& soup) {
  Vtu_grid grid;
  for (const Point<D>& p : soup.points) grid.points.push_back(in_space(p));
  return grid;
}

}  // namespace

template <int D>
Vtu_grid vtu_of_cells(const Cell_soup<D>& soup) {
  Vtu_grid grid = points_of(soup);
  std::vector<std::int64_t> index, solid;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    add_cell_of(grid, soup, c);
    index.push_back(static_cast<std::int64_t>(c));
    solid.push_back(soup.solid[c]);
  }
  grid.cell_data = {{"cell", 1, std::move(index)}, {"solid", 1, std::move(solid)}};
  return grid;
}

template <int D>
Vtu_grid vtu_of_walls(const Cell_soup<D>& soup) {
  struct Facet {
    std::size_t first, cell, sides = 0;
    bool wall = false, is_at_free = false;
  };
  std::map<Loop, Facet> facets;  // by sorted vertices
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      Loop key(soup.facet(f).begin(), soup.facet(f).end());
      std::sort(key.begin(), key.end());
      Facet& facet = facets.try_emplace(std::move(key), Facet{f, c}).first->second;
      ++facet.sides;
      facet.wall |= soup.impassable[f] != 0 || (facet.sides == 2 && soup.solid[c] != soup.solid[facet.cell]);
      facet.is_at_free |= soup.solid[c] == 0;
    }
  std::vector<Facet> walls;
  for (const auto& [key, facet] : facets)
    if (facet.is_at_free && (facet.wall || facet.sides == 1)) walls.push_back(facet);
  std::sort(walls.begin(), walls.end(), [](const Facet& a, const Facet& b) { return a.first < b.first; });
  Vtu_grid grid = points_of(soup);
  std::vector<std::int64_t> cells;
  for (const Facet& wall : walls) {
    const auto loop = soup.facet(wall.first);
    grid.add_cell(D == 2 ? Vtu_cell::line : polygon_type(loop.size()), loop);
    cells.push_back(static_cast<std::int64_t>(wall.cell));
  }
  grid.cell_data = {{"cell", 1, std::move(cells)}};
  return grid;
}

template Vtu_grid vtu_of_cells<2>(const Cell_soup<2>&);
template Vtu_grid vtu_of_cells<3>(const Cell_soup<3>&);
template Vtu_grid vtu_of_walls<2>(const Cell_soup<2>&);
template Vtu_grid vtu_of_walls<3>(const Cell_soup<3>&);

}  // namespace cellwalk::io
