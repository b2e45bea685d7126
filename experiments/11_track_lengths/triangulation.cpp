// SPDX-License-Identifier: LGPL-3.0-or-later
#include "triangulation.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cellwalk::track_lengths {
namespace {

/// The corners in increasing order, but the last two exchanged if the cell is positive only so.
std::array<std::uint32_t, 4> corners(Delaunay::Cell_handle cell) {
  std::array<std::uint32_t, 4> all{};
  for (int i = 0; i < 4; ++i) all[static_cast<std::size_t>(i)] = cell->vertex(i)->info();
  bool is_odd = false;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) is_odd ^= all[i] > all[j];
  std::ranges::sort(all);
  if (is_odd) std::swap(all[2], all[3]);
  return all;
}

}  // namespace

Triangulation::Triangulation(const std::vector<Point<3>>& points) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    numbered.emplace_back(Kernel::Point_3(points[i][0], points[i][1], points[i][2]), i);
  delaunay_.insert(numbered.begin(), numbered.end());

  std::vector<std::pair<std::array<std::uint32_t, 4>, Delaunay::Cell_handle>> cells;
  for (const Delaunay::Cell_handle cell : delaunay_.finite_cell_handles())
    cells.emplace_back(corners(cell), cell);
  std::ranges::sort(cells, {}, [](const auto& cell) { return cell.first; });
  soup_.points = points;
  for (const auto& [v, cell] : cells) {
    add_tetrahedron(soup_, v[0], v[1], v[2], v[3]);
    cells_.push_back(cell);
  }
}

void Triangulation::name_cells(const Snapshot<3>& snapshot) {
  std::vector<Delaunay::Cell_handle> named(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::uint32_t name = to_index(snapshot.cell(i));
    named[name] = cells_[i];
    cells_[i]->info() = name;
  }
  cells_ = std::move(named);
}

}  // namespace cellwalk::track_lengths
