// SPDX-License-Identifier: LGPL-3.0-or-later
#include "swept_walls.h"

#include <algorithm>
#include <utility>

#include "common/peers/growing_box.h"

namespace cellwalk::moving_walls {

using experiments::Growing_box;

Swept_walls::Swept_walls(const Walls& walls, std::vector<Point<3>> positions)
    : walls_(walls),
      before_(std::move(positions)),
      target_(before_),
      rank_(before_.size(), nothing),
      stamp_(walls.triangles.size(), 0) {
  for (std::uint32_t t = 0; t < walls.triangles.size(); ++t) boxes_.push_back(box_of(t));
}

Box Swept_walls::box_of(std::uint32_t triangle) const {
  const auto& [a, b, c] = walls_.triangles[triangle];
  Growing_box box(before_[a]);
  box.add(before_[b]);
  box.add(before_[c]);
  box.add(target_[a]);
  box.add(target_[b]);
  box.add(target_[c]);
  return box.box();
}

void Swept_walls::begin(std::span<const Wall_move> moves) {
  for (const Wall_move& m : moves_) {
    before_[m.vertex] = target_[m.vertex] = m.after;
    rank_[m.vertex] = nothing;
  }
  std::swap(last_moves_, moves_);
  moves_.assign(moves.begin(), moves.end());
  touched_.clear();
  ++step_;
  for (std::uint32_t i = 0; i < moves_.size(); ++i) {
    rank_[moves_[i].vertex] = i;
    target_[moves_[i].vertex] = moves_[i].to;
    for (const std::uint32_t t : walls_.triangles_at(moves_[i].vertex))
      if (std::exchange(stamp_[t], step_) != step_) touched_.push_back(t);
  }
  touched_box_ = Box::nowhere();
  for (const std::uint32_t t : touched_) {
    boxes_[t] = box_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
      touched_box_.low[k] = std::min(touched_box_.low[k], boxes_[t].low[k]);
      touched_box_.high[k] = std::max(touched_box_.high[k], boxes_[t].high[k]);
    }
  }
}

Moving_wall moving_wall(const Swept_walls& walls, std::uint32_t triangle, std::uint32_t move) {
  const Wall_move& m = walls.moves()[move];
  const auto& corners = walls.walls().triangles[triangle];
  const auto k = static_cast<std::size_t>(std::ranges::find(corners, m.vertex) - corners.begin());
  return {
      m.from, m.to, {walls.position(corners[(k + 1) % 3], move), walls.position(corners[(k + 2) % 3], move)}};
}

}  // namespace cellwalk::moving_walls
