// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/trace_recorder.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <utility>

namespace cellwalk {
namespace {

/// A body at a wall stays there for good: a trace is not to start with one.
void check_trace_start(const Snapshot<3>& snapshot, const Body<3>& body, std::size_t number) {
  Edge_counts counts;
  bool has_extent = false;
  for (const auto& [u, v] : body.edges()) {
    const Particle<3>& from = body.particles()[u];
    const Point<3>& to = body.positions()[v];
    has_extent |= from.position != to;
    if (closed_meeting<3>(snapshot, from.cell, {from.position, to, from.position}, counts))
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

Trace_recorder::Trace_recorder(const Snapshot<3>& snapshot, const Locator<3>& locator, Trace start)
    : trace_(std::move(start)) {
  bodies_.reserve(trace_.bodies);
  for (std::uint32_t b = 0; b < trace_.bodies; ++b) {
    try {
      bodies_.emplace_back(
          snapshot, locator,
          trace_body_soup(std::span<const Point<3>, trace_vertices>(&trace_.start(b, 0), trace_vertices)));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {}: {}", b, error.what()));
    }
    check_trace_start(snapshot, bodies_[b], b);
  }
}

void Trace_recorder::step(std::span<const Point<3>> targets) {
  const Body_options options = trace_options(Sweep::triangle);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    report_.clear();
    bodies_[b].step(targets.subspan(b * trace_vertices, trace_vertices), options, report_, counts_);
    append_answers(report_.blocked, options.sweep.sweep, trace_.answers);
  }
  trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
  ++trace_.steps;
}

}  // namespace cellwalk
