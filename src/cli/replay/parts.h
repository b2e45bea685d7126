// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of a trace that ranks replay, and what they found, put together.
#ifndef CELLWALK_CLI_REPLAY_PARTS_H
#define CELLWALK_CLI_REPLAY_PARTS_H

#include <cellwalk/body/step.h>
#include <cellwalk/internal/kernel/bytes.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/body_trace.h>
#include <cellwalk/internal/records/trace.h>
#include <cellwalk/internal/simulation/replay.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::cli {

/// A trace of some of the bodies only.
/// \pre the bodies exist
Body_trace part_of(const Body_trace& trace, const Block& bodies);
Trace part_of(const Trace& trace, const Block& bodies);

/// Of each round, the time of one of so many moves.
/// \pre moves > 0
std::vector<double> per_move(std::vector<double> times, std::uint64_t moves);

inline void add(Body_counts& sum, const Body_counts& more) { sum += more; }
inline void add(Replay_counts& sum, const Replay_counts& more) {
  sum.vertex_hits += more.vertex_hits;
  sum.edge_hits += more.edge_hits;
  sum.triangle_hits += more.triangle_hits;
  sum.rounds += more.rounds;
  sum.body += more.body;
}

/// What the rounds of a replay found. Ranks work at the same time, so the slowest one counts.
template <class Counts>
struct Rounds {
  std::vector<double> ns;       ///< of each round that is timed
  std::vector<double> step_us;  ///< of each step, the least of these rounds; empty: not measured
  std::uint64_t mismatches = 0, registered_anew = 0;
  Counts counts{};  ///< of one round

  /// On the first rank: of all ranks; on others, as it was.
  void gather(Ranks& ranks) {
    Byte_writer bytes;
    if (!ranks.is_first()) {
      bytes.list(ns);
      bytes.list(step_us);
      bytes.value(mismatches);
      bytes.value(registered_anew);
      bytes.value(counts);
    }
    ranks.gather(bytes.take(), [this](const std::string& of_rank) {
      if (!of_rank.empty()) take(of_rank);
    });
  }

 private:
  void take(std::string_view of_rank) {
    Byte_reader bytes(of_rank);
    const auto slower = [](std::vector<double>& times, const std::vector<double>& others) {
      for (std::size_t i = 0; i < times.size() && i < others.size(); ++i)
        times[i] = std::max(times[i], others[i]);
    };
    slower(ns, bytes.list<double>());
    slower(step_us, bytes.list<double>());
    mismatches += bytes.value<std::uint64_t>();
    registered_anew += bytes.value<std::uint64_t>();
    add(counts, bytes.value<Counts>());
  }
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPLAY_PARTS_H
