// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/error.h>
#include <cellwalk/simulation/replay.h>
#include <cellwalk/simulation/trace_body.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace cellwalk {

Replay::Replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace& trace,
               const Replay_options& options)
    : trace_(&trace) {
  if (options.sweep == Sweep::faces)
    throw Error(Error_code::usage,
                "bodies of a trace have no faces: replay it by three_segments or triangle");
  options_.sweep.sweep = options.sweep;
  options_.sweep.touch = Touch::stop;
  options_.clearance = options.clearance;
  bodies_.reserve(trace.bodies);
  answers_.resize(trace.moves());
  for (std::uint32_t b = 0; b < trace.bodies; ++b) {
    try {
      bodies_.emplace_back(snapshot, locator,
                           trace_body_soup(Trace_positions(&trace.start(b, 0), trace_vertices)));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {}: {}", b, error.what()));
    }
  }
  for (std::size_t v = 0; v < trace_vertices; ++v) {
    std::array<std::size_t, trace_edges> neighbours;
    for (std::size_t k = 0; k < trace_edges; ++k) neighbours[k] = trace_neighbour(v, k);
    for (std::size_t k = 0; k < trace_edges; ++k) {
      const auto place = std::ranges::count_if(neighbours, [&](std::size_t w) { return w < neighbours[k]; });
      edge_of_[v][static_cast<std::size_t>(place)] = static_cast<std::uint8_t>(k);
    }
  }
}

void Replay::step() {
  for (std::uint32_t b = 0; b < trace_->bodies; ++b) {
    blocked_.clear();
    bodies_[b].step_or_stay({&trace_->target(steps_done_, b, 0), trace_vertices}, options_, blocked_,
                            counts_.body);
    for (const Blocked_move<3>& blocked : blocked_) note(b, blocked);
  }
  ++steps_done_;
}

void Replay::note(std::uint32_t body, const Blocked_move<3>& blocked) {
  std::uint8_t answer = 0;
  if (blocked.is_vertex_blocked) {
    answer =
        options_.sweep.sweep == Sweep::triangle ? trace_segment_bit | trace_triangle_bits : trace_segment_bit;
    ++counts_.vertex_hits;
  }
  for (std::size_t i = 0; i < trace_edges; ++i) {
    const auto k = edge_of_[blocked.vertex][i];
    const bool hits = blocked.edges >> i & 1, swept_hits = blocked.swept_edges >> i & 1;
    answer |= static_cast<std::uint8_t>(hits << (1 + k) | swept_hits << (4 + k));
    counts_.edge_hits += hits;
    counts_.triangle_hits += swept_hits;
    counts_.rounds += swept_hits && !hits;
  }
  answers_[trace_->index(steps_done_, body, blocked.vertex)] = answer;
  if (blocked.contact)
    contacts_.push_back({steps_done_, body, blocked.vertex,
                         blocked.is_vertex_blocked ? Body_feature::vertex : Body_feature::edge,
                         *blocked.contact});
}

void Replay::validate() {
  for (Body<3>& body : bodies_) {
    body.catch_up(counts_.body);
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
