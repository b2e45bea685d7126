// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/flood.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/simulation/trace_recorder.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cellwalk {

Trace_recorder::Trace_recorder(const Snapshot<3>& snapshot, const Locator<3>& locator, Trace start)
    : snapshot_(&snapshot), trace_(std::move(start)) {
  bodies_.reserve(trace_.bodies);
  for (std::uint32_t b = 0; b < trace_.bodies; ++b) {
    try {
      bodies_.emplace_back(snapshot, locator, Trace_body::Positions(&trace_.start(b, 0), trace_vertices));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {}: {}", b, error.what()));
    }
    check_start(b);
  }
}

void Trace_recorder::check_start(std::size_t body) const {
  const auto& particles = bodies_[body].particles();
  Edge_counts counts;
  bool has_extent = false;
  // An edge is met off one end of it by a particle that goes along it, so of two that go either way one meets what touches it.
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k) {
      const std::size_t w = trace_neighbour(v, k);
      has_extent |= particles[v].position != particles[w].position;
      if (first_touch(*snapshot_, particles[v], particles[w].position, counts))
        throw Error(
            Error_code::input,
            fmt::format("body {}: its edge from vertex {} to vertex {} touches a wall at the start, which a "
                        "trace counts as a hit: put it elsewhere",
                        body, v, w));
    }
  if (!has_extent)
    throw Error(Error_code::input,
                fmt::format("body {}: all its vertices are in one place: give it a size", body));
}

bool Trace_recorder::touches(const Trace_body& body, std::size_t vertex, const Point<3>& target) const {
  const Particle<3>& from = body.particles()[vertex];
  const auto neighbour = [&](std::size_t k) -> const Particle<3>& {
    return body.particles()[trace_neighbour(vertex, k)];
  };
  Edge_counts counts;
  bool clear = true;
  for (std::size_t k = 0; k < trace_edges && clear; ++k)
    clear = is_clear(*snapshot_, from.cell, {from.position, target, neighbour(k).position}, counts);
  if (clear) return false;
  Particle<3> to = from;
  if (move(*snapshot_, to, target, counts.walk).contact) return false;
  if (first_touch(*snapshot_, from, target, counts)) return true;
  Sweep_options passing, stopping;
  stopping.touch = Touch::stop;
  for (std::size_t k = 0; k < trace_edges; ++k) {
    const Particle<3>& q = neighbour(k);
    const Chain before = body.chain(vertex, k);
    if (!sweep_edge(*snapshot_, from, target, q, before, stopping, counts).contact) continue;
    if (!sweep_edge(*snapshot_, from, target, q, before, passing, counts).contact) return true;
    if (!find_any_chain(*snapshot_, to, q, counts.walk).contact &&
        first_touch(*snapshot_, to, q.position, counts))
      return true;
  }
  return false;
}

void Trace_recorder::step(std::span<const Point<3>> targets) {
  std::vector<std::uint8_t> answers;
  answers.reserve(targets.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t v = 0; v < trace_vertices; ++v) {
      const Point<3>& target = targets[b * trace_vertices + v];
      if (touches(bodies_[b], v, target))
        throw Error(
            Error_code::input,
            fmt::format(
                "step {}, body {}, vertex {}: touches a wall without crossing it, which a trace counts "
                "as a hit: let the body start elsewhere, or otherwise",
                trace_.steps, b, v));
      answers.push_back(bodies_[b].move(v, target, Sweep::triangle, counts_).answer);
    }
  trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
  trace_.answers.insert(trace_.answers.end(), answers.begin(), answers.end());
  ++trace_.steps;
}

}  // namespace cellwalk
