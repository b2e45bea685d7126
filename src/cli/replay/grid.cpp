// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk replay of a trace in a grid of unit cubes, which holds its environment.
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/machine.h"
#include "cli/common/progress.h"
#include "cli/run/bodies.h"
#include "replay.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

/// The results of all rounds, which differ in time only.
struct Replayed {
  std::vector<double> ns_per_move;  ///< of each round
  std::uint64_t mismatches = 0;
  Replay_counts counts;  ///< of one round
};

Environment<3> build(const Trace& trace, const Replay_options& options) {
  const Progress progress("generating and certifying the grid");
  try {
    return trace_environment(trace, options.sheared ? sheared<3>() : Lattice_map<3>{});
  } catch (const Error& error) {
    // A trace is input, so errors in it are not those of a call.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: {}", options.trace, error.what()));
  }
}

/// Replays the trace repeatedly. Only the moves are timed, neither the comparison of answers nor the
/// registration of bodies.
Replayed replay_rounds(const Trace& trace, const Environment<3>& environment, const Replay_options& options) {
  using Clock = std::chrono::steady_clock;
  const Locator<3> locator(environment.snapshot());
  const int rounds = options.warmup + options.rounds;
  Progress progress("replaying " + options.trace, static_cast<std::uint64_t>(rounds));
  Replayed result;
  for (int round = 0; round < rounds; ++round) {
    Replay replay = naming(options.trace, [&] {
      return Replay(environment.snapshot(), locator, trace, {options.sweep, true});
    });
    const Clock::time_point begin = Clock::now();
    replay.run();
    const std::chrono::duration<double, std::nano> passed = Clock::now() - begin;
    progress.update(static_cast<std::uint64_t>(round) + 1);
    result.mismatches = std::max(result.mismatches, count_mismatches(trace, replay.answers(), options.sweep));
    result.counts = replay.counts();
    if (round >= options.warmup)
      result.ns_per_move.push_back(passed.count() / static_cast<double>(trace.moves()));
  }
  return result;
}

ordered_json counts_json(const Replayed& replayed) {
  const Replay_counts& c = replayed.counts;
  const Edge_counts& edges = c.body.edges;
  ordered_json result{{"moves", c.body.moves},
                      {"in_region", c.body.in_region},
                      {"held", c.body.held},
                      {"vertex_hits", c.vertex_hits},
                      {"edge_hits", c.edge_hits},
                      {"triangle_hits", c.triangle_hits},
                      {"rounds", c.rounds},
                      {"walks", edges.walk.walks},
                      {"crossings", edges.walk.crossings},
                      {"exact_fallbacks", edges.walk.predicates.fallbacks}};
  result["body"] = to_json(c.body);
  return result;
}

ordered_json manifest(const Trace& trace, const Replay_options& options) {
  ordered_json result = machine_json();
  result["trace"] = {{"file", std::filesystem::path(options.trace).filename().string()},
                     {"cells", {trace.nx, trace.ny, trace.nz}},
                     {"bodies", trace.bodies},
                     {"steps", trace.steps},
                     {"obstacles", trace.obstacles.size()},
                     {"seed", trace.seed},
                     {"obstacle_fraction", trace.obstacle_fraction},
                     {"body_side", trace.body_side},
                     {"speed", trace.speed}};
  result["sweep"] = sweep_names[static_cast<std::size_t>(options.sweep)];
  result["sheared"] = options.sheared;
  result["rounds"] = options.rounds;
  result["warmup"] = options.warmup;
  result["threads"] = 1;
  return result;
}

std::string summary(const Trace& trace, const Replay_options& options, const Replayed& replayed) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const Replay_counts& c = replayed.counts;
  const auto [least, most] = std::minmax_element(replayed.ns_per_move.begin(), replayed.ns_per_move.end());
  text = fmt::format("{}: {} x {} x {} cells{}, {} of them solid, {} bodies, {} steps\n", options.trace,
                     trace.nx, trace.ny, trace.nz, options.sheared ? ", sheared" : "", trace.obstacles.size(),
                     trace.bodies, trace.steps);
  line("time", fmt::format("{:.1f} ns per vertex move with its three edges, by {} (median of {} rounds, from "
                           "{:.1f} to {:.1f})",
                           median(replayed.ns_per_move), sweep_names[static_cast<std::size_t>(options.sweep)],
                           options.rounds, *least, *most));
  line("mismatches", fmt::format("{} answer bits differ from the recorded ones", replayed.mismatches));
  line("moves", describe_moves(c.body));
  line("contacts", fmt::format("{} vertices were held by walls; {} edges went round an obstacle",
                               c.body.contacts, c.rounds));
  line("edges", describe_edges(c.body.edges));
  return text;
}

}  // namespace

Replay_report replay_grid(Trace trace, const Replay_options& options) {
  if (trace.moves() == 0)
    throw Error(Error_code::input, fmt::format("{}: {} bodies and {} steps: there is nothing to replay",
                                               options.trace, trace.bodies, trace.steps));
  if (!options.environment.empty())
    throw Error(Error_code::usage,
                fmt::format("--environment: {} holds its grid: leave the option out", options.trace));
  if (options.threads != 1)
    throw Error(Error_code::usage,
                fmt::format("--threads: the bodies of {} have 8 vertices, which one thread moves: leave the "
                            "option out",
                            options.trace));
  if (options.sheared) trace = mapped(std::move(trace), sheared<3>());
  const Environment<3> environment = build(trace, options);
  const Replayed replayed = replay_rounds(trace, environment, options);
  return {{{"ns_per_vertex_move", median(replayed.ns_per_move)},
           {"ns_per_vertex_move_rounds", replayed.ns_per_move},
           {"mismatches", replayed.mismatches},
           {"counts", counts_json(replayed)},
           {"manifest", manifest(trace, options)}},
          summary(trace, options, replayed)};
}

}  // namespace cellwalk::cli
