// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/trace_recorder.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <utility>

namespace cellwalk {

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
