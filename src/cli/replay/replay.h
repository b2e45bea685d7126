// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays of both kinds of traces.
#ifndef CELLWALK_CLI_REPLAY_REPLAY_H
#define CELLWALK_CLI_REPLAY_REPLAY_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/body_trace.h>
#include <cellwalk/internal/records/trace.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

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

/// Replays a trace in a grid of unit cubes, which holds its environment; ranks share the bodies. The report
/// is that of all, on the first rank.
/// \throw Error naming the trace, or the option that does not apply to it
std::optional<Replay_report> replay_grid(Trace trace, const Replay_options& options, Ranks& ranks);

/// Replays a trace of any bodies in the environment of a file; the same.
/// \throw Error naming the trace, the environment, or the option that does not apply
std::optional<Replay_report> replay_bodies(const Body_trace& trace, const Replay_options& options,
                                           Ranks& ranks);

/// The middle value, or the mean of the two in the middle.
/// \pre there is one
double median(std::vector<double> values);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPLAY_REPLAY_H
