// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk replay TRACE: answers and times a recorded motion.
#include "replay.h"

#include <cellwalk/internal/io/trace_file.h>

#include <memory>

#include "cli/common/command.h"
#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"

namespace cellwalk::cli {
namespace {

constexpr int most_rounds = 100000;

void run_replay(const Replay_options& options, Ranks& ranks) {
  Outputs outputs({options.trace, options.environment});
  io::Atomic_file* const json = ranks.is_first() ? outputs.file(options.json) : nullptr;
  if (ranks.is_first() && !ranks.is_alone()) outputs.inputs_are_shared();
  const std::optional<Replay_report> report = replay(io::read_trace(options.trace), options, ranks);
  if (!report) return;
  write_json(json, report->json);
  outputs.commit(report->summary);
}

}  // namespace

void add_replay(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Replay_options>();
  CLI::App* command = app.add_subcommand(
      "replay", "Answer and time a recorded motion of bodies, and compare with the recorded exact answers");
  command->add_option("trace", options->trace, "A trace, see docs/formats.md")
      ->required()
      ->type_name("TRACE");
  command
      ->add_option("--environment", options->environment,
                   "The environment that the bodies moved in, as check takes it; for traces that do not "
                   "hold a grid of unit cubes")
      ->type_name("ENV");
  add_choice(
      *command, "--sweep", options->sweep,
      {{sweep_names[0], Sweep::three_segments}, {sweep_names[1], Sweep::triangle}},
      "What is checked of edges. three_segments: the path of the vertex, then the edge where it ends, as in "
      "the paper. triangle: also all that the edge sweeps; compares those answers, too");
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
                    "Shear the grid of the trace and all motion: cells are no cubes then, and cost the same");
  add_json(*command, options->json);
  add_examples(*command, {"cellwalk replay motion.trace --environment vessel.ovm",
                          "cellwalk replay grid.trace --sweep three_segments --repeat 21 --json times.json"});
  command->callback(
      [options, &chosen] { chosen = [options](Ranks& ranks) { run_replay(*options, ranks); }; });
}

}  // namespace cellwalk::cli
