// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk replay TRACE: answers and times a recorded motion.
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/machine.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"
#include "cli/run/bodies.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

constexpr int default_rounds = 7, default_warmup = 1, most_rounds = 100000;

struct Replay_options {
  std::string trace, json;
  Sweep sweep = Sweep::triangle;
  int rounds = default_rounds, warmup = default_warmup;
  bool sheared = false;
};

/// The results of all rounds, which differ in time only.
struct Replayed {
  std::vector<double> ns_per_move;  ///< of each round
  std::uint64_t mismatches = 0;
  Replay_counts counts;  ///< of one round

  double median() const {
    std::vector<double> sorted = ns_per_move;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  }
};

Trace load(const Replay_options& options) {
  Trace trace = io::read_trace(options.trace);
  if (trace.moves() == 0)
    throw Error(Error_code::input, fmt::format("{}: {} bodies and {} steps: there is nothing to replay",
                                               options.trace, trace.bodies, trace.steps));
  return options.sheared ? mapped(std::move(trace), sheared<3>()) : trace;
}

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
                           replayed.median(), sweep_names[static_cast<std::size_t>(options.sweep)],
                           options.rounds, *least, *most));
  line("mismatches", fmt::format("{} answer bits differ from the recorded ones", replayed.mismatches));
  line("moves", describe_moves(c.body));
  line("contacts", fmt::format("{} vertices were held by walls; {} edges went round an obstacle",
                               c.body.contacts, c.rounds));
  line("edges", describe_edges(c.body.edges));
  return text;
}

void replay(const Replay_options& options) {
  Outputs outputs({options.trace});
  io::Atomic_file* const json = outputs.file(options.json);
  const Trace trace = load(options);
  const Environment<3> environment = build(trace, options);
  const Replayed replayed = replay_rounds(trace, environment, options);
  write_json(json, {{"ns_per_vertex_move", replayed.median()},
                    {"ns_per_vertex_move_rounds", replayed.ns_per_move},
                    {"mismatches", replayed.mismatches},
                    {"counts", counts_json(replayed)},
                    {"manifest", manifest(trace, options)}});
  outputs.commit(summary(trace, options, replayed));
}

}  // namespace

void add_replay(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Replay_options>();
  CLI::App* command = app.add_subcommand(
      "replay", "Answer and time a recorded motion of bodies, and compare with the recorded exact answers");
  command->add_option("trace", options->trace, "A trace, see docs/formats.md")
      ->required()
      ->type_name("TRACE");
  add_choice(
      *command, "--sweep", options->sweep,
      {{sweep_names[0], Sweep::three_segments}, {sweep_names[1], Sweep::triangle}},
      "What is checked of edges. three_segments: the way of the vertex, then the edge, as in the paper; "
      "answers bits 0 to 3. triangle: also all that the edge sweeps; answers bits 4 to 6, too");
  command
      ->add_option("--repeat", options->rounds,
                   "Rounds that are timed, each from the start; the median counts")
      ->type_name("N")
      ->check(whole_number(1, most_rounds))
      ->capture_default_str();
  command->add_option("--warmup", options->warmup, "Rounds before them that are not timed")
      ->type_name("N")
      ->check(whole_number(0, most_rounds))
      ->capture_default_str();
  command->add_flag("--shear", options->sheared,
                    "Shear the grid and all motion: cells are no cubes then, and cost the same");
  add_json(*command, options->json);
  add_examples(*command,
               {"cellwalk replay motion.trace",
                "cellwalk replay motion.trace --sweep three_segments --repeat 21 --json times.json"});
  command->callback([options, &chosen] { chosen = [options] { replay(*options); }; });
}

}  // namespace cellwalk::cli
