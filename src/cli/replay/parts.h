// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of a trace that ranks replay, and what they found, put together.
#ifndef CELLWALK_CLI_REPLAY_PARTS_H
#define CELLWALK_CLI_REPLAY_PARTS_H

#include <cellwalk/body/step.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/body_trace.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::cli {

/// A trace of some of the bodies only.
/// \pre the bodies exist
Body_trace part_of(const Body_trace& trace, const Block& bodies);

/// Of each round, the time of one of so many moves.
/// \pre moves > 0
std::vector<double> per_move(std::vector<double> times, std::uint64_t moves);

/// What the rounds of a replay found. Ranks work at the same time, so the slowest one counts.
struct Rounds {
  std::vector<double> ns;       ///< of each round that is timed
  std::vector<double> step_us;  ///< of each step, the least of these rounds; empty: not measured
  std::uint64_t mismatches = 0, registered_anew = 0;
  Body_counts counts;  ///< of one round

  /// On the first rank: of all ranks; on others, as it was.
  void gather(Ranks& ranks) {
    detail::Byte_writer bytes;
    if (!ranks.is_first()) bytes(ns, step_us, mismatches, registered_anew, counts);
    ranks.gather(bytes.message(), [this](const std::string& of_rank) {
      if (!of_rank.empty()) take(of_rank);
    });
  }

 private:
  void take(std::string_view of_rank) {
    detail::Byte_reader bytes(of_rank);
    const auto slower = [](std::vector<double>& times, const std::vector<double>& others) {
      for (std::size_t i = 0; i < times.size() && i < others.size(); ++i)
        times[i] = std::max(times[i], others[i]);
    };
    slower(ns, bytes.next<std::vector<double>>());
    slower(step_us, bytes.next<std::vector<double>>());
    mismatches += bytes.next<std::uint64_t>();
    registered_anew += bytes.next<std::uint64_t>();
    counts += bytes.next<Body_counts>();
  }
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPLAY_PARTS_H
