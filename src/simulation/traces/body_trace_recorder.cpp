// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>

#include <span>
#include <utility>

namespace cellwalk {

Body_trace_recorder::Body_trace_recorder(const World<3>& world) : world_(world) {
  take_bodies();
  note_positions();
}

Body_trace_recorder::Body_trace_recorder(const World<3>& world, Body_trace trace)
    : world_(world), trace_(std::move(trace)) {
  trace_.bodies.clear();
  take_bodies();
}

void Body_trace_recorder::take_bodies() {
  for (const Moving_body<3>& moving : world_.bodies()) {
    const Body<3>& body = moving.body();
    trace_.bodies.push_back({static_cast<std::uint32_t>(body.vertex_count()),
                             {body.edges().begin(), body.edges().end()},
                             {body.faces().begin(), body.faces().end()},
                             detail::Body_access<3>::radii(body)});
    degrees_.push_back(answerable_degrees(trace_.bodies.back(), degrees_.size()));
    before_.push_back(body);
  }
}

void Body_trace_recorder::note_positions() {
  for (const Moving_body<3>& moving : world_.bodies()) {
    const auto positions = moving.body().positions();
    trace_.before.insert(trace_.before.end(), positions.begin(), positions.end());
  }
}

void Body_trace_recorder::record_step() {
  const Body_options options = body_trace_options(Sweep::triangle, trace_);
  for (std::size_t b = 0; b < before_.size(); ++b) {
    const Moving_body<3>& moving = world_.bodies()[b];
    const std::span<const Point<3>> targets = moving.targets();
    trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
    report_.clear();
    before_[b].step(targets, options, report_, counts_);
    append_body_answers(degrees_[b], report_.blocked, options.sweep.sweep, trace_.answers);
    before_[b] = moving.body();
  }
  note_positions();
  ++trace_.steps;
}

}  // namespace cellwalk
