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
#include "parts.h"
#include "replay.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

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
Rounds<Replay_counts> replay_rounds(const Trace& trace, std::size_t first_body,
                                    const Environment<3>& environment, const Replay_options& options) {
  using Clock = std::chrono::steady_clock;
  const Locator<3> locator(environment.snapshot());
  const int rounds = options.warmup + options.rounds;
  Progress progress("replaying " + options.trace, static_cast<std::uint64_t>(rounds));
  Rounds<Replay_counts> result;
  for (int round = 0; round < rounds; ++round) {
    Replay replay = naming(options.trace, [&] {
      return Replay(environment.snapshot(), locator, trace, {options.sweep, true}, first_body);
    });
    const Clock::time_point begin = Clock::now();
    replay.run();
    const std::chrono::duration<double, std::nano> passed = Clock::now() - begin;
    progress.update(static_cast<std::uint64_t>(round) + 1);
    result.mismatches = std::max(result.mismatches, count_mismatches(trace, replay.answers(), options.sweep));
    result.counts = replay.counts();
    if (round >= options.warmup) result.ns.push_back(passed.count());
  }
  return result;
}

ordered_json counts_json(const Replay_counts& c) {
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

ordered_json manifest(const Trace& trace, const Replay_options& options, const Ranks& ranks) {
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
  result["ranks"] = ranks.size();
  return result;
}

std::string summary(const Trace& trace, const Replay_options& options, const Rounds<Replay_counts>& replayed,
                    const std::vector<double>& ns_per_move) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const Replay_counts& c = replayed.counts;
  const auto [least, most] = std::minmax_element(ns_per_move.begin(), ns_per_move.end());
  text = fmt::format("{}: {} x {} x {} cells{}, {} of them solid, {} bodies, {} steps\n", options.trace,
                     trace.nx, trace.ny, trace.nz, options.sheared ? ", sheared" : "", trace.obstacles.size(),
                     trace.bodies, trace.steps);
  line("time", fmt::format("{:.1f} ns per vertex move with its three edges, by {} (median of {} rounds, from "
                           "{:.1f} to {:.1f})",
                           median(ns_per_move), sweep_names[static_cast<std::size_t>(options.sweep)],
                           options.rounds, *least, *most));
  line("mismatches", fmt::format("{} answer bits differ from the recorded ones", replayed.mismatches));
  line("moves", describe_moves(c.body));
  line("contacts", fmt::format("{} vertices were held by walls; {} edges went round an obstacle",
                               c.body.contacts, c.rounds));
  line("edges", describe_edges(c.body.edges));
  return text;
}

}  // namespace

std::optional<Replay_report> replay_grid(Trace trace, const Replay_options& options, Ranks& ranks) {
  if (trace.moves() == 0)
    throw Error(Error_code::input, fmt::format("{}: {} bodies and {} steps: there is nothing to replay",
                                               options.trace, trace.bodies, trace.steps));
  if (!options.environment.empty())
    throw Error(Error_code::usage,
                fmt::format("--environment: {} holds its grid: leave the option out", options.trace));
  if (options.sheared) trace = mapped(std::move(trace), sheared<3>());
  const Environment<3> environment = build(trace, options);
  const Block bodies = ranks.block(trace.bodies);
  Rounds<Replay_counts> replayed = replay_rounds(part_of(trace, bodies), bodies.begin, environment, options);
  replayed.gather(ranks);
  if (!ranks.is_first()) return std::nullopt;
  const std::vector<double> ns_per_move = per_move(replayed.ns, trace.moves());
  return Replay_report{{{"ns_per_vertex_move", median(ns_per_move)},
                        {"ns_per_vertex_move_rounds", ns_per_move},
                        {"mismatches", replayed.mismatches},
                        {"counts", counts_json(replayed.counts)},
                        {"manifest", manifest(trace, options, ranks)}},
                       summary(trace, options, replayed, ns_per_move)};
}

}  // namespace cellwalk::cli
