// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/simulation/target_recorder.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <utility>

namespace cellwalk {
namespace {

/// A body at a wall would stay there for good: a trace in which touches block is not to start with one.
void check_start(const Snapshot<3>& snapshot, const Body<3>& body, std::size_t number, bool touch_blocks) {
  Edge_counts counts;
  bool has_extent = false;
  for (const auto& [u, v] : body.edges()) {
    const Particle<3>& from = body.particles()[u];
    const Point<3>& to = body.positions()[v];
    has_extent |= from.position != to;
    if (touch_blocks && closed_meeting<3>(snapshot, from.cell, {from.position, to, from.position}, counts))
      throw Error(
          Error_code::input,
          fmt::format("body {}: its edge from vertex {} to vertex {} touches a wall at the start, which a "
                      "trace counts as a hit: put it elsewhere",
                      number, u, v));
  }
  if (!has_extent)
    throw Error(Error_code::input,
                fmt::format("body {}: all its vertices are in one place: give it a size", number));
}

}  // namespace

Target_recorder::Target_recorder(const Snapshot<3>& snapshot, const Locator<3>& locator, Body_trace start)
    : trace_(std::move(start)),
      replay_(snapshot, locator, trace_, body_trace_options(Sweep::triangle, trace_)) {
  for (std::size_t b = 0; b < bodies().size(); ++b)
    check_start(snapshot, bodies()[b], b, trace_.touch_blocks);
}

void Target_recorder::step(std::span<const Point<3>> targets) {
  trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
  ++trace_.steps;
  replay_.step();
  replay_.note_answers();
  const auto answers = replay_.answers().last(trace_.answers_of_step());
  trace_.answers.insert(trace_.answers.end(), answers.begin(), answers.end());
  for (const Body<3>& body : bodies())
    trace_.before.insert(trace_.before.end(), body.positions().begin(), body.positions().end());
}

}  // namespace cellwalk
