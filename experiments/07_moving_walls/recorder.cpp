// SPDX-License-Identifier: LGPL-3.0-or-later
#include "recorder.h"

#include "common/processor_time.h"

namespace cellwalk::moving_walls {

using experiments::processor_seconds;

Recorded_step record_step(Scene& scene, const Walls& walls, double time) {
  const std::vector<Vertex_move<3>> targets = scene.targets(time);
  std::vector<Point<3>> from;
  for (const Vertex_move<3>& move : targets) from.push_back(scene.snapshot().point(move.point));
  std::vector<Vertex_result<3>> results;
  results.reserve(targets.size());

  Recorded_step step;
  const double start = processor_seconds();
  Reshaping<3> reshaping(scene.environment(), scene.residents());
  for (const auto& [point, target] : targets) results.push_back(reshaping.move(point, target));
  const double moved = processor_seconds();
  reshaping.finish();
  step.close_us = 1e6 * (processor_seconds() - moved);
  step.move_us = 1e6 * (moved - start);
  step.counts = reshaping.counts();

  step.point_moves = targets.size();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::uint32_t vertex = walls.vertex_of[targets[i].point];
    const bool is_no_move = results[i].end == Move_end::cell || results[i].end == Move_end::boundary;
    step.dropped += is_no_move;
    if (vertex == nothing || is_no_move || from[i] == targets[i].target) continue;
    step.moves.push_back({vertex, from[i], targets[i].target, results[i].position});
    step.blocked.push_back(results[i].end != Move_end::reached);
  }
  return step;
}

}  // namespace cellwalk::moving_walls
