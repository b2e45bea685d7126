// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_rule.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace cellwalk {

Replay::Replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace& trace,
               const Replay_options& options, std::size_t first_body)
    : snapshot_(&snapshot), trace_(&trace) {
  if (options.sweep == Sweep::faces)
    throw Error(Error_code::usage,
                "bodies of a trace have no faces: replay it by three_segments or triangle");
  options_ = trace_options(options.sweep);
  options_.clearance = options.clearance;
  bodies_.reserve(trace.bodies);
  answers_.resize(trace.moves());
  for (std::uint32_t b = 0; b < trace.bodies; ++b) {
    try {
      bodies_.emplace_back(
          snapshot, locator,
          trace_body_soup(std::span<const Point<3>, trace_vertices>(&trace.start(b, 0), trace_vertices)));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {}: {}", first_body + b, error.what()));
    }
  }
}

void Replay::step() {
  for (std::uint32_t b = 0; b < trace_->bodies; ++b) {
    report_.clear();
    bodies_[b].step({&trace_->target(steps_done_, b, 0), trace_vertices}, options_, report_, counts_.body);
    for (const Rejected_move<3>& blocked : report_.blocked) note(b, blocked);
  }
  ++steps_done_;
}

void Replay::note(std::uint32_t body, const Rejected_move<3>& blocked) {
  answers_[trace_->index(steps_done_, body, blocked.vertex)] = trace_answer(blocked, options_.sweep.sweep);
  const auto count = [](std::uint64_t edges) { return static_cast<std::uint64_t>(std::popcount(edges)); };
  counts_.vertex_hits += blocked.is_vertex_blocked;
  counts_.edge_hits += count(blocked.edges);
  counts_.triangle_hits += count(blocked.swept_edges);
  counts_.rounds += count(blocked.swept_edges & ~blocked.edges);
  if (blocked.contact)
    contacts_.push_back(
        {steps_done_ + 1, 0, *blocked.contact, snapshot_->index(blocked.contact->cell), body});
}

void Replay::validate() {
  for (Body<3>& body : bodies_) {
    body.refresh(counts_.body);
    body.validate();
  }
}

void Replay::run() {
  while (steps_done_ < trace_->steps) step();
}

std::uint64_t count_mismatches(const Trace& trace, std::span<const std::uint8_t> answers, Sweep sweep) {
  const std::uint8_t decided =
      sweep == Sweep::three_segments ? trace_segment_bit | trace_edge_bits : trace_all_bits;
  std::uint64_t count = (trace.answers.size() - answers.size()) * std::popcount(decided);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto differ = static_cast<std::uint8_t>((trace.answers[i] ^ answers[i]) & decided);
    count += static_cast<std::uint64_t>(std::popcount(differ));
  }
  return count;
}

}  // namespace cellwalk
