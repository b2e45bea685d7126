// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/error.h>
#include <cellwalk/simulation/replay.h>

#include <fmt/format.h>

#include <bit>

namespace cellwalk {

Replay::Replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace& trace, Sweep sweep)
    : trace_(&trace), sweep_(sweep) {
  if (sweep == Sweep::faces)
    throw Error(Error_code::usage,
                "bodies of a trace have no faces: replay it by three_segments or triangle");
  bodies_.reserve(trace.bodies);
  answers_.reserve(trace.moves());
  for (std::uint32_t b = 0; b < trace.bodies; ++b) {
    try {
      bodies_.emplace_back(snapshot, locator, Trace_body::Positions(&trace.start(b, 0), trace_vertices));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {}: {}", b, error.what()));
    }
  }
}

void Replay::step() {
  for (std::uint32_t b = 0; b < trace_->bodies; ++b)
    for (std::uint32_t v = 0; v < trace_vertices; ++v) {
      const Trace_body::Move move = bodies_[b].move(v, trace_->target(steps_done_, b, v), sweep_, counts_);
      answers_.push_back(move.answer);
      if (move.contact) contacts_.push_back({steps_done_, b, v, *move.contact});
    }
  ++steps_done_;
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
