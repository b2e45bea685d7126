// SPDX-License-Identifier: LGPL-3.0-or-later
// What a replay finds, and how long it takes.
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>
#include <variant>

#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/machine.h"
#include "cli/common/node_environment.h"
#include "cli/common/progress.h"
#include "cli/run/bodies.h"
#include "parts.h"
#include "replay.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

/// The grid of the trace.
Environment<3> grid_of(const Body_trace& trace, const Replay_options& options) {
  if (!options.environment.empty())
    throw Error(Error_code::usage,
                fmt::format("--environment: {} holds its grid: leave the option out", options.trace));
  if (options.sheared && trace.has_radii())
    throw Error(
        Error_code::usage,
        fmt::format("--shear: {} holds bodies with a radius, and a shear changes distances: leave the "
                    "option out",
                    options.trace));
  const Progress progress("generating and certifying the grid");
  try {
    return trace_environment(*trace.grid, options.sheared ? sheared<3>() : Lattice_map<3>{});
  } catch (const Error& error) {
    // A trace is input, so errors in it are not those of a call.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: {}", options.trace, error.what()));
  }
}

/// The environment of a file.
Environment<3> load_for_replay(const Replay_options& options, Ranks& ranks) {
  if (options.environment.empty())
    throw Error(Error_code::usage,
                fmt::format("--environment is missing: {} holds bodies, and not the walls around "
                            "them; name the file of their environment",
                            options.trace));
  if (options.sheared)
    throw Error(Error_code::usage,
                fmt::format("--shear is for traces that hold a grid of unit cubes, and {} holds none: leave "
                            "the option out",
                            options.trace));
  Build_options build;
  build.keep_map = false;
  Loaded_environment loaded = load_once_a_node(ranks, options.environment, build);
  auto* environment = std::get_if<Environment<3>>(&loaded.environment);
  if (!environment)
    throw Error(Error_code::input,
                fmt::format("{}: is 2D, and the bodies of {} are 3D: name the environment that "
                            "they moved in",
                            options.environment, options.trace));
  return std::move(*environment);
}

/// Replays the trace again and again. Only the moves are timed: bodies are put in place, and answers
/// compared, in between.
Rounds replay_rounds(const Body_trace& trace, std::size_t first_body, const Environment<3>& environment,
                     const Replay_options& options) {
  using Clock = std::chrono::steady_clock;
  const Locator<3> locator(environment.snapshot());
  const int rounds = options.warmup + options.rounds;
  Progress progress("replaying " + options.trace, static_cast<std::uint64_t>(rounds));
  Rounds result;
  result.step_us.assign(trace.steps, std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    Body_replay replay = naming(options.trace, [&] {
      return Body_replay(environment.snapshot(), locator, trace, body_trace_options(options.sweep, trace),
                         first_body);
    });
    double ns = 0;
    for (std::uint32_t s = 0; s < trace.steps; ++s) {
      naming(options.trace, [&] { replay.prepare(); });
      const Clock::time_point begin = Clock::now();
      replay.step();
      const std::chrono::duration<double, std::nano> passed = Clock::now() - begin;
      replay.note_answers();
      ns += passed.count();
      if (round >= options.warmup) result.step_us[s] = std::min(result.step_us[s], passed.count() / 1000);
    }
    progress.update(static_cast<std::uint64_t>(round) + 1);
    if (!trace.answers.empty())
      result.mismatches =
          std::max(result.mismatches, count_mismatches(trace, replay.answers(), options.sweep));
    result.registered_anew = replay.registered_anew();
    result.counts = replay.counts();
    if (round >= options.warmup) result.ns.push_back(ns);
  }
  return result;
}

/// The middle value, or the mean of the two in the middle. \pre there is one
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The least of sorted values that a share of them does not exceed. \pre there is one
double quantile(const std::vector<double>& sorted, double share) {
  const double count = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[std::clamp<std::size_t>(static_cast<std::size_t>(count), 1, sorted.size()) - 1];
}

ordered_json step_times(std::vector<double> step_us) {
  std::sort(step_us.begin(), step_us.end());
  return {{"median", median(step_us)},
          {"p99", quantile(step_us, 0.99)},
          {"p999", quantile(step_us, 0.999)},
          {"max", step_us.back()}};
}

ordered_json manifest(const Body_trace& trace, const Environment<3>& environment,
                      const Replay_options& options, const Ranks& ranks) {
  ordered_json result = machine_json();
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  result["trace"] = {{"file", name(options.trace)},
                     {"bodies", trace.bodies.size()},
                     {"vertices", trace.vertices()},
                     {"steps", trace.steps}};
  ordered_json& walls = result["environment"];
  if (trace.grid)
    walls = {{"grid", trace.grid->cells}, {"solid", trace.grid->solid.size()}, {"sheared", options.sheared}};
  else
    walls = {{"file", name(options.environment)}};
  walls["cells"] = environment.snapshot().cell_count();
  result["sweep"] = sweep_names[static_cast<std::size_t>(options.sweep)];
  result["rounds"] = options.rounds;
  result["warmup"] = options.warmup;
  result["ranks"] = ranks.size();
  return result;
}

std::string summary(const Body_trace& trace, const Environment<3>& environment, const Replay_options& options,
                    const Rounds& replayed, const std::vector<double>& ns_per_move, const ordered_json& us) {
  std::string text = fmt::format("{}: {} bodies with {} vertices, {} steps, among {} cells{}\n",
                                 options.trace, trace.bodies.size(), trace.vertices(), trace.steps,
                                 environment.snapshot().cell_count(), options.sheared ? ", sheared" : "");
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const auto [least, most] = std::minmax_element(ns_per_move.begin(), ns_per_move.end());
  line("time",
       fmt::format(
           "{:.1f} ns per vertex move with its edges, by {} (median of {} rounds, from {:.1f} to {:.1f})",
           median(ns_per_move), sweep_names[static_cast<std::size_t>(options.sweep)], options.rounds, *least,
           *most));
  line("steps", fmt::format("{:.1f} us in the median, 99 % within {:.1f}, 99.9 % within {:.1f}",
                            us["median"].get<double>(), us["p99"].get<double>(), us["p999"].get<double>()));
  line("mismatches", trace.answers.empty()
                         ? "not known: the trace holds no answers"
                         : fmt::format("{} answer bits differ from the recorded ones", replayed.mismatches));
  line("blocked", fmt::format("{} of {} moves", replayed.counts.held, trace.moves()));
  line("moves", describe_moves(replayed.counts));
  line("edges", describe_edges(replayed.counts.edges));
  return text;
}

}  // namespace

std::optional<Replay_report> replay(Body_trace trace, const Replay_options& options, Ranks& ranks) {
  if (trace.moves() == 0)
    throw Error(Error_code::input, fmt::format("{}: {} bodies and {} steps: there is nothing to replay",
                                               options.trace, trace.bodies.size(), trace.steps));
  const Environment<3> environment = trace.grid ? grid_of(trace, options) : load_for_replay(options, ranks);
  if (options.sheared) trace = mapped(std::move(trace), sheared<3>());
  const Block bodies = ranks.block(trace.bodies.size());
  const Body_trace part = ranks.is_alone() ? Body_trace{} : part_of(trace, bodies);
  Rounds replayed = replay_rounds(ranks.is_alone() ? trace : part, bodies.begin, environment, options);
  replayed.gather(ranks);
  if (!ranks.is_first()) return std::nullopt;
  const std::vector<double> ns_per_move = per_move(replayed.ns, trace.moves());
  const ordered_json us = step_times(replayed.step_us);
  ordered_json json{{"ns_per_vertex_move", median(ns_per_move)},
                    {"ns_per_vertex_move_rounds", ns_per_move},
                    {"moves", trace.moves()},
                    {"blocked", replayed.counts.held},
                    {"step_us", us}};
  json["mismatches"] = trace.answers.empty() ? ordered_json() : ordered_json(replayed.mismatches);
  json["registered_anew"] = replayed.registered_anew;
  json["counts"] = to_json(replayed.counts);
  json["manifest"] = manifest(trace, environment, options, ranks);
  return Replay_report{json, summary(trace, environment, options, replayed, ns_per_move, us)};
}

}  // namespace cellwalk::cli
