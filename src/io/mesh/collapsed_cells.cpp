// SPDX-License-Identifier: LGPL-3.0-or-later
// Repeated corners united, and the facets that remain of such a cell.
#include "collapsed_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

using Loop = std::vector<std::uint32_t>;

using Points = std::vector<Point<3>>;

bool is_same_place(const Points& points, std::uint32_t a, std::uint32_t b) {
  return a == b || points[a] == points[b];
}

bool has_repeated_corners(const Points& points, std::span<const std::uint32_t> loop) {
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (is_same_place(points, loop[i], loop[(i + 1) % loop.size()])) return true;
  return false;
}

/// Leaves one of the corners in one place that are beside each other; the last corner is beside the first.
void unite(Loop& loop, const Points& points) {
  const auto is_same = [&](std::uint32_t a, std::uint32_t b) { return is_same_place(points, a, b); };
  loop.erase(std::unique(loop.begin(), loop.end(), is_same), loop.end());
  while (loop.size() > 1 && is_same(loop.front(), loop.back())) loop.pop_back();
}

bool passes_a_point_twice(const Loop& loop) {
  return std::set<std::uint32_t>(loop.begin(), loop.end()).size() != loop.size();
}

bool are_opposite(Loop a, Loop b) {
  if (a.size() != b.size()) return false;
  std::reverse(b.begin(), b.end());
  std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
  std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
  return a == b;
}

/// The facets of a cell, with one name for each place, and without repeated corners.
std::vector<Loop> united_loops(const Cell_soup<3>& soup, std::size_t cell) {
  Loop places;
  const auto first_there = [&](std::uint32_t v) {
    for (const std::uint32_t known : places)
      if (is_same_place(soup.points, known, v)) return known;
    places.push_back(v);
    return v;
  };
  std::vector<Loop> loops;
  for (std::uint32_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
    Loop loop;
    for (const std::uint32_t v : soup.facet(f)) loop.push_back(first_there(v));
    unite(loop, soup.points);
    loops.push_back(std::move(loop));
  }
  return loops;
}

void cancel_opposite(std::vector<Loop>& loops) {
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = i + 1; j < loops.size(); ++j)
      if (are_opposite(loops[i], loops[j])) {
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(j));
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(i));
        --i;
        break;
      }
}

/// Replaces the facets of the last cell, none of which is a wall.
void replace_last(Cell_soup<3>& soup, const std::vector<Loop>& loops) {
  const std::uint32_t first = soup.cell_begin[soup.cell_count() - 1];
  soup.vertices.resize(soup.facet_begin[first]);
  soup.facet_begin.resize(first + 1);
  soup.impassable.resize(first);
  for (const Loop& loop : loops) soup.add_facet(loop);
  soup.cell_begin.back() = static_cast<std::uint32_t>(soup.facet_count());
}

}  // namespace

void Collapsed_cells::settle_last(Cell_soup<3>& soup, const std::string& name, const std::string& place) {
  const std::size_t cell = soup.cell_count() - 1;
  bool is_collapsed = false;
  for (std::uint32_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f)
    is_collapsed |= has_repeated_corners(soup.points, soup.facet(f));
  if (!is_collapsed) return;
  std::vector<Loop> loops = united_loops(soup, cell);
  std::erase_if(loops, [](const Loop& loop) { return loop.size() < 3; });
  if (std::any_of(loops.begin(), loops.end(), passes_a_point_twice)) return;
  cancel_opposite(loops);
  if (loops.size() < 4)
    fail(name,
         fmt::format("{} has no inside: its corners repeat, and {} facets are left", place, loops.size()));
  const auto triangles =
      std::count_if(loops.begin(), loops.end(), [](const Loop& l) { return l.size() == 3; });
  const auto quadrilaterals =
      std::count_if(loops.begin(), loops.end(), [](const Loop& l) { return l.size() == 4; });
  const auto is = [&](std::ptrdiff_t t, std::ptrdiff_t q) {
    return triangles == t && quadrilaterals == q && loops.size() == static_cast<std::size_t>(t + q);
  };
  ++(is(2, 3) ? wedges_ : is(4, 1) ? pyramids_ : is(4, 0) ? tetrahedra_ : others_);
  replace_last(soup, loops);
}

void Collapsed_cells::settle(std::vector<std::uint32_t>& polygon, const std::vector<Point<3>>& points) {
  if (!has_repeated_corners(points, polygon)) return;
  Loop united = polygon;
  unite(united, points);
  if (united.size() == polygon.size() || united.size() < 3) return;
  ++polygons_;
  polygon = std::move(united);
}

void Collapsed_cells::report_to(Read_report& report) const {
  const std::size_t cells = wedges_ + pyramids_ + tetrahedra_ + others_;
  report.collapsed += cells + polygons_;
  std::string shapes;
  const auto add = [&shapes](std::size_t count, const char* what) {
    if (count > 0) shapes += fmt::format("{}{} {}", shapes.empty() ? "" : ", ", count, what);
  };
  add(wedges_, "wedges");
  add(pyramids_, "pyramids");
  add(tetrahedra_, "tetrahedra");
  add(others_, "of other shapes");
  if (cells > 0)
    report.notes.push_back(
        fmt::format("{} collapsed cells read without repeated corners: {}", cells, shapes));
  if (polygons_ > 0)
    report.notes.push_back(
        fmt::format("{} collapsed polygons read without repeated corners, as triangles", polygons_));
}

}  // namespace cellwalk::io
