// SPDX-License-Identifier: LGPL-3.0-or-later
// The replay of a trace, as the command has it.
#ifndef CELLWALK_CLI_REPLAY_REPLAY_H
#define CELLWALK_CLI_REPLAY_REPLAY_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/body_trace.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace cellwalk::cli {

struct Replay_options {
  std::string trace, environment, json;
  Sweep sweep = Sweep::triangle;
  int rounds = 7, warmup = 1;
  bool sheared = false;
};

struct Replay_report {
  nlohmann::ordered_json json;
  std::string summary;
};

/// Replays a trace in its grid, or in the environment of a file; ranks share the bodies. The report is that
/// of all, on the first rank.
/// \throw Error naming the trace, the environment, or the option that does not apply
std::optional<Replay_report> replay(Body_trace trace, const Replay_options& options, Ranks& ranks);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPLAY_REPLAY_H
