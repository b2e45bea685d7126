// SPDX-License-Identifier: LGPL-3.0-or-later
// The split in 2D: polygons into triangles. Edges are never cut, so neighbours are not affected.
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/split.h>
#include <cellwalk/kernel/error.h>

#include <numeric>

#include "polygon.h"
#include "soup.h"

namespace cellwalk {
namespace {

/// Replaces cell c by triangles. Returns their number.
std::size_t split_cell(const Cell_soup<2>& soup, std::size_t c, Cell_soup<2>& result) {
  std::vector<std::uint32_t> loop;
  std::vector<Point<2>> polygon;
  std::vector<std::uint8_t> walls;
  for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    loop.push_back(soup.facet(f)[0]);
    polygon.push_back(soup.points[loop.back()]);
    walls.push_back(soup.impassable[f]);
  }
  Predicate_counts counts;
  const int turn = detail::simple_turn(counts, polygon);
  if (turn <= 0)
    throw Error(Error_code::not_certified, detail::cell_name(c) + " cannot be split: " +
                                               (turn < 0 ? "it is inverted (its vertices run clockwise)"
                                                         : "it crosses or touches itself") +
                                               "; repair or remove the cell");
  const auto triangles = detail::triangulations(counts, polygon, turn, loop, 1).front();
  for (const detail::Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t u = t[i], v = t[(i + 1) % 3];
      const bool is_side = v == (u + 1) % loop.size();
      result.add_facet({loop[u], loop[v]}, is_side && walls[u]);
    }
    result.end_cell(soup.solid[c]);
  }
  return triangles.size();
}

}  // namespace

template <>
Cell_soup<2> split(Cell_soup<2> soup, Split_report& report, std::vector<std::uint32_t>* origin,
                   Cells_to_split which) {
  report = {};
  const std::vector<Cell_check> checks = detail::check_soup(soup);
  detail::refuse_hopeless(checks);
  if (origin) origin->clear();
  Cell_soup<2> result;
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) {
    std::size_t made = 1;
    const bool is_valid = checks[c].defect == Cell_defect::none;
    if (is_valid && (which == Cells_to_split::invalid || detail::is_simplex(soup, c))) {
      for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
        result.add_facet(soup.facet(f), soup.impassable[f]);
      result.end_cell(soup.solid[c]);
    } else {
      made = split_cell(soup, c, result);
      ++report.cells_split;
      ++(is_valid ? report.not_simplices : report.not_convex);
      report.cells_made += made;
    }
    if (origin) origin->insert(origin->end(), made, c);
  }
  result.points = std::move(soup.points);
  return result;
}

}  // namespace cellwalk
