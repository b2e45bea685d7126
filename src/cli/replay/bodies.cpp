// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk replay of a trace of any bodies, in an environment from a file.
#include "cli/run/bodies.h"

#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <variant>

#include "cli/common/contact_kind_names.h"
#include "cli/common/machine.h"
#include "cli/common/node_environment.h"
#include "cli/common/progress.h"
#include "parts.h"
#include "replay.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

Environment<3> load_environment_of_bodies(const Replay_options& options, Ranks& ranks) {
  if (options.environment.empty())
    throw Error(Error_code::usage,
                fmt::format("--environment is missing: {} holds bodies, and not the walls around "
                            "them; name the file of their environment",
                            options.trace));
  if (options.sheared)
    throw Error(Error_code::usage,
                fmt::format("--shear is for traces in a grid of unit cubes, and {} is of any "
                            "bodies: leave the option out",
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
Rounds<Body_counts> replay_rounds_of_bodies(const Body_trace& trace, std::size_t first_body,
                                            const Environment<3>& environment,
                                            const Replay_options& options) {
  using Clock = std::chrono::steady_clock;
  const Locator<3> locator(environment.snapshot());
  const int rounds = options.warmup + options.rounds;
  Progress progress("replaying " + options.trace, static_cast<std::uint64_t>(rounds));
  Rounds<Body_counts> result;
  result.step_us.assign(trace.steps, std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    Body_replay replay = naming(options.trace, [&] {
      return Body_replay(environment.snapshot(), locator, trace, body_trace_options(options.sweep),
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

ordered_json manifest_of_bodies(const Body_trace& trace, const Environment<3>& environment,
                                const Replay_options& options, const Ranks& ranks) {
  ordered_json result = machine_json();
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  result["trace"] = {{"file", name(options.trace)},
                     {"bodies", trace.bodies.size()},
                     {"vertices", trace.vertices()},
                     {"steps", trace.steps}};
  result["environment"] = {{"file", name(options.environment)},
                           {"cells", environment.snapshot().cell_count()}};
  result["sweep"] = sweep_names[static_cast<std::size_t>(options.sweep)];
  result["rounds"] = options.rounds;
  result["warmup"] = options.warmup;
  result["ranks"] = ranks.size();
  return result;
}

std::string summary_of_bodies(const Body_trace& trace, const Environment<3>& environment,
                              const Replay_options& options, const Rounds<Body_counts>& replayed,
                              const std::vector<double>& ns_per_move, const ordered_json& us) {
  std::string text =
      fmt::format("{}: {} bodies with {} vertices, {} steps, among {} cells\n", options.trace,
                  trace.bodies.size(), trace.vertices(), trace.steps, environment.snapshot().cell_count());
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

std::optional<Replay_report> replay_bodies(const Body_trace& trace, const Replay_options& options,
                                           Ranks& ranks) {
  if (trace.moves() == 0)
    throw Error(Error_code::input, fmt::format("{}: {} bodies and {} steps: there is nothing to replay",
                                               options.trace, trace.bodies.size(), trace.steps));
  const Environment<3> environment = load_environment_of_bodies(options, ranks);
  const Block bodies = ranks.block(trace.bodies.size());
  const Body_trace part = ranks.is_alone() ? Body_trace{} : part_of(trace, bodies);
  Rounds<Body_counts> replayed =
      replay_rounds_of_bodies(ranks.is_alone() ? trace : part, bodies.begin, environment, options);
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
  json["manifest"] = manifest_of_bodies(trace, environment, options, ranks);
  return Replay_report{json, summary_of_bodies(trace, environment, options, replayed, ns_per_move, us)};
}

}  // namespace cellwalk::cli
