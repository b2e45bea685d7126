// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of the replay, once for all methods that answer vertex by vertex.
//
// A Check has the members
//   static constexpr unsigned bits                        the bits that it answers: segment_bits,
//                                                         triangle_bits or both
//   void prepare(const Trace&)                            see Peer
//   bool start(body, positions, targets, counter)         before each step of a body; true: the body meets no
//                                                         wall in the step
//   unsigned vertex(body, v, positions, target, counter)  the answer for a vertex
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_REPLAY_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_REPLAY_H

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "peer.h"

namespace cellwalk::figure_8 {

/// Bits 0 to 3 of a vertex, where `hits(a, b)` says whether a segment hits a wall.
template <class Hits>
inline unsigned four_segments(std::size_t v, const Point<3>* positions, const Point<3>& target,
                              const Hits& hits) {
  const Point<3>& from = positions[v];
  const unsigned blocked = hits(from, target);
  const Point<3>& p = blocked ? from : target;
  unsigned bits = blocked;
  for (std::size_t k = 0; k < trace_edges; ++k)
    bits |= static_cast<unsigned>(hits(p, positions[trace_neighbour(v, k)])) << (k + 1);
  return bits;
}

template <class Check, class Counter>
void replay_trace(Check& check, const Trace& trace, std::vector<Point<3>>& positions,
                  std::span<std::uint8_t> answers, Counter& counter) {
  constexpr bool moves_itself = (Check::bits & segment_bits) == segment_bits;
  std::size_t at = 0;
  for (std::size_t step = 0; step < trace.steps; ++step)
    for (std::size_t body = 0; body < trace.bodies; ++body, at += trace_vertices) {
      Point<3>* const x = positions.data() + body * trace_vertices;
      const Point<3>* const targets = trace.targets.data() + at;
      std::uint8_t* const out = answers.data() + at;
      const std::uint8_t* const recorded = trace.answers.data() + at;
      if (check.start(body, x, targets, counter)) {
        std::fill_n(out, trace_vertices, std::uint8_t{0});
        if constexpr (moves_itself) {
          std::copy_n(targets, trace_vertices, x);
        } else {
          for (std::size_t v = 0; v < trace_vertices; ++v)
            if (!(recorded[v] & segment_bits)) x[v] = targets[v];
        }
        counter.clear_moves(trace_vertices);
        continue;
      }
      for (std::size_t v = 0; v < trace_vertices; ++v) {
        const unsigned bits = check.vertex(body, v, x, targets[v], counter);
        out[v] = static_cast<std::uint8_t>(bits);
        if (!((moves_itself ? bits : recorded[v]) & segment_bits)) x[v] = targets[v];
      }
    }
}

/// A peer made of a Check.
template <class Check>
class Checking_peer : public Peer {
 public:
  Checking_peer(std::string name, Check check) : name_(std::move(name)), check_(std::move(check)) {}
  std::string name() const override { return name_; }
  unsigned answer_bits() const override { return Check::bits; }
  bool is_reproducible() const override {
    if constexpr (requires { Check::follows_processor; }) return !Check::follows_processor;
    return true;
  }
  void prepare(const Trace& trace) override {
    positions_ = trace.start_positions;
    check_.prepare(trace);
  }
  void replay(const Trace& trace, std::span<std::uint8_t> answers) override {
    Counter<false> counter;
    replay_trace(check_, trace, positions_, answers, counter);
  }
  Counts count(const Trace& trace, std::span<std::uint8_t> answers) override {
    Counter<true> counter;
    replay_trace(check_, trace, positions_, answers, counter);
    if constexpr (requires { check_.add_counts(counter.counts); }) check_.add_counts(counter.counts);
    return counter.counts;
  }

 private:
  std::string name_;
  Check check_;
  std::vector<Point<3>> positions_;
};

template <class Check>
void add_peer(Peers& peers, std::string name, Check check, const Build& build) {
  peers.push_back(std::make_unique<Checking_peer<Check>>(std::move(name), std::move(check)));
  peers.back()->build = build;
}

/// A Check without preparation or memory of a body.
struct Stateless {
  static constexpr unsigned bits = segment_bits;
  void prepare(const Trace&) {}
  template <class Counter>
  bool start(std::size_t, const Point<3>*, const Point<3>*, Counter&) {
    return false;
  }
};

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_REPLAY_H
