// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers of the loops and points of walls, and the differences after each change.
#include "recorded_walls.h"

#include <cellwalk/internal/io/vtu.h>

#include <algorithm>
#include <utility>

namespace cellwalk::cli {
namespace {

/// More passable edges of the plane than this are a grey area, not lines.
constexpr std::size_t most_lines = 40'000;

/// The same loop, begun at its first point. In the plane the two points of a wall distinguish its sides, and
/// stay in order.
Numbered_loops::Loop from_lowest(Numbered_loops::Loop loop) {
  if (loop.size() > 2) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

}  // namespace

void Numbered_loops::see(const Loop& loop) {
  const auto [known, is_new] = numbers_.try_emplace(loop, static_cast<std::uint32_t>(is_seen_.size()));
  if (is_new) {
    added_.push_back(loop);
    is_seen_.push_back(1);
  } else {
    is_seen_[known->second] = 1;
  }
}

Loops_change Numbered_loops::end() {
  Loops_change change;
  for (std::uint32_t i = 0; i < is_there_.size(); ++i)
    if (is_there_[i] != is_seen_[i]) change.toggled.push_back(i);
  change.added = std::exchange(added_, {});
  is_there_ = is_seen_;
  return change;
}

template <int D>
std::uint32_t Recorded_walls<D>::number_of(std::uint32_t point) {
  if (point >= number_.size()) number_.resize(snapshot_->points().size(), 0);
  if (number_[point] == 0) {
    new_points_.push_back(io::in_space(snapshot_->point(point)));
    points_.push_back(point);
    number_[point] = static_cast<std::uint32_t>(points_.size());
  }
  return number_[point] - 1;
}

template <int D>
void Recorded_walls<D>::see_cell(Cell cell) {
  const Snapshot<D>& snapshot = *snapshot_;
  Numbered_loops::Loop corners;  // of the cell, in the plane
  for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
    const Half_facet facet = snapshot.half_facet(cell, f);
    Numbered_loops::Loop loop = snapshot.loop(facet);
    if (D == 3 && !snapshot.is_impassable(facet)) continue;
    for (std::uint32_t& point : loop) point = number_of(point);
    if (D == 2) corners.push_back(loop[0]);
    if (snapshot.is_impassable(facet))
      walls_.see(from_lowest(std::move(loop)));
    else if (has_lines_ && snapshot.index(snapshot.neighbour(facet)) > snapshot.index(cell))
      lines_.see({std::min(loop[0], loop[1]), std::max(loop[0], loop[1])});
  }
  if (D == 2) floor_.see(from_lowest(std::move(corners)));
}

template <int D>
Walls_change Recorded_walls<D>::follow() {
  Walls_change change;
  if (!is_first_ && epoch_ == snapshot_->epoch()) return change;
  epoch_ = snapshot_->epoch();
  for (Numbered_loops* loops : {&walls_, &floor_, &lines_}) loops->begin();
  for (std::size_t i = 0; i < snapshot_->cell_slots(); ++i)
    if (const Cell cell = snapshot_->cell(i); cell != Cell::none && !snapshot_->is_solid(cell))
      see_cell(cell);
  change.walls = walls_.end();
  change.floor = floor_.end();
  change.lines = lines_.end();
  change.points = std::exchange(new_points_, {});
  if (std::exchange(is_first_, false) && change.lines.added.size() > most_lines) {
    change.lines.added.clear();
    has_lines_ = false;
    lines_ = {};
  }
  return change;
}

template class Recorded_walls<2>;
template class Recorded_walls<3>;

}  // namespace cellwalk::cli
