// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run [SCENE.json] -o DIR: simulates a scene and writes the results.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/io/scene.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bodies.h"
#include "catheter.h"
#include "checkpoints.h"
#include "cli/common/command.h"
#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/interruption.h"
#include "cli/common/printable.h"
#include "cli/common/progress.h"
#include "options.h"
#include "parts.h"
#include "preparation.h"
#include "report.h"
#include "scene_source.h"
#include "sharing.h"
#include "trace.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

/// Draws the picture. A run is not lost for it: if there is too little memory, or too much to draw, it ends
/// without.
/// \return why there is none; empty if it was drawn
template <int D>
std::string draw(const Run_input<D>& input, const Run_parts<D>& parts, const std::filesystem::path& file) {
  const Progress progress("drawing");
  const Picture_request& request = *input.scene.output.picture;
  drawing::Picture_options how;
  how.width = request.width;
  how.height = request.height;
  const auto direction = [](const std::vector<double>& v) {
    return v.empty() ? Vector<3>{} : Vector<3>{v[0], v[1], v[2]};
  };
  how.camera.toward = direction(request.toward);
  how.camera.up = direction(request.up);
  if (D == 2) how.camera = {{0, 0, 1}, {0, 1, 0}, 0};
  std::string png;
  try {
    png = drawing::encode_png(drawing::render(parts.picture->draw(parts.world, caption(input, parts)), how));
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const Error& error) {
    return error.what();
  }
  io::write_file(file, png);
  return {};
}

/// Runs the steps that are left, without checkpoints: a signal ends the program at once.
template <int D>
void run_steps(const Run_input<D>& input, Run_parts<D>& parts, Run_sharing<D>& sharing) {
  Progress progress("running " + input.options.scene, input.steps());
  for (std::uint32_t i = 1; i <= input.steps(); ++i) {
    parts.step(sharing, i == input.steps());
    progress.update(i);
  }
}

/// The same with checkpoints, by one process. A signal ends the program after the step, with a last one;
/// there is one after the last step as well, since the work that follows may take long.
template <int D>
void run_steps(const Run_input<D>& input, Run_parts<D>& parts, Run_checkpoints<D>& checkpoints,
               Working_folder& working, const Interruption& interruption) {
  Progress progress("running " + input.options.scene, input.steps());
  const auto keep = [&](std::uint32_t step) {
    checkpoints.keep(step, input.environment, input.certificate,
                     [&](detail::Byte_writer& out) { parts.save(out); });
  };
  Ranks alone;
  Run_sharing<D> sharing(alone, parts.world, state_times(input, parts.world));
  std::uint32_t i = parts.world.steps_done();
  if (i == 0) {
    keep(0);
    working.forget_earlier();
    interruption.check();
  }
  while (i++ < input.steps()) {
    parts.step(sharing, i == input.steps());
    if (checkpoints.is_due(i) || i == input.steps() || interruption.has_come()) keep(i);
    progress.update(i);
    interruption.check();
  }
}

/// Completes the files of a run whose steps are done.
/// \param sharing null: there was none
/// \return why it has no picture, if it was to have one
template <int D>
std::string finish(const Run_input<D>& input, Run_parts<D>& parts, Run_sharing<D>* sharing,
                   Run_outputs& outputs, const std::filesystem::path& folder) {
  parts.world.validate();
  if (sharing != nullptr) sharing->finish();
  parts.files.finish();
  if (parts.walls || parts.changes) {
    const Progress progress("certifying the environment as it is now");
    input.environment.certify();
  }
  if (parts.walls) parts.walls->finish();
  if (parts.changes) parts.changes->finish();
  if (parts.motion) parts.motion->commit();
  std::string not_drawn;
  if (parts.picture) not_drawn = draw(input, parts, folder / "picture.png");
  ordered_json written = report(input, parts);
  if (!not_drawn.empty()) written["no_picture"] = not_drawn;
  io::write_json(folder / "run.json", written);
  if (parts.record) write_trace(parts.record->trace(), outputs.record, folder);
  write_json(outputs.json, written);
  return not_drawn;
}

/// A new run with checkpoints.
template <int D>
void run_kept(const Run_input<D>& input, World<D>&& world, const Groups<D>& groups,
              const Scene_bodies<D>& bodies, Run_outputs& outputs) {
  Working_folder& working = *outputs.working;
  Result_files place(working.results(), working.checkpoints(), {});
  std::optional<Interruption> interruption(std::in_place);
  working.begin();
  Run_parts<D> parts(input, place, std::move(world), groups, outputs.record != nullptr);
  Run_checkpoints<D> checkpoints(working.checkpoints(), place,
                                 Run_settings(input.options, bodies.notes, input.import_lines),
                                 changes_environment(input.scene));
  run_steps(input, parts, checkpoints, working, *interruption);
  interruption.reset();
  const std::string not_drawn = finish<D>(input, parts, nullptr, outputs, place.folder());
  outputs.all.commit(summary(input, parts, not_drawn));
}

/// The part of a rank that is not the first.
template <int D>
void help(const Run_input<D>& input, const std::vector<Body_soup<D>>& shapes, Ranks& ranks) {
  World<D> world = make_world(input, shapes);
  Run_sharing<D> sharing(ranks, world, state_times(input, world));
  for (std::uint32_t i = 1; i <= input.steps(); ++i) {
    world.step();
    sharing.step();
  }
  world.validate();
  sharing.finish();
}

/// \param outputs null on ranks that are not the first
template <int D>
void run_scene(const Run_options& options, Ranks& all, Run_outputs* outputs, const Scene<D>& given) {
  Scene<D> scene = given;
  if (outputs != nullptr) {
    if (const auto* file = std::get_if<std::string>(&scene.environment)) outputs->all.also_reads(*file);
    if (const auto* call = std::get_if<Import_call>(&scene.environment)) {
      outputs->all.also_reads(call->file);
      for (const std::string& file : call->obstacles) outputs->all.also_reads(file);
    }
    for (const auto& body : scene.bodies)
      if (const auto* file = std::get_if<std::string>(&body.source)) outputs->all.also_reads(*file);
  }
  Ranks alone;
  const std::string reason = why_not_shared(scene, !options.record.empty(), options.checkpoint_every > 0);
  Ranks& ranks = reason.empty() ? all : alone;
  if (!reason.empty() && outputs == nullptr) return;
  const Scene_bodies<D> bodies = load_bodies(scene, options.scene);
  if (!options.record.empty()) check_recordable(scene, options.scene);
  if (outputs != nullptr && scene.walls && !scene.walls->motion.empty())
    outputs->all.also_reads(scene.walls->motion);
  if (!reason.empty() && !all.is_alone())
    fmt::print(stderr, "cellwalk: {}: {}, so the first of {} ranks works alone\n", printable(options.scene),
               reason, all.size());
  Prepared_environment prepared = prepare(scene, options.scene, ranks);
  auto* environment = std::get_if<Environment<D>>(&prepared.environment);
  if (!environment)
    throw Error(Error_code::input,
                fmt::format("{}: dimension: the environment is of dimension {}, the scene of {}",
                            options.scene, 5 - D, D));
  const auto* const known = std::get_if<Groups<D>>(&prepared.groups);  // none are generated
  const Groups<D> groups = known ? *known : Groups<D>{};
  lay_catheter(scene, options.scene, environment->snapshot(), groups);
  const Run_input<D> input{
      scene, options, *environment, prepared.certificate, bodies.notes, std::move(prepared.lines)};
  if (outputs == nullptr) return help(input, bodies.shapes, ranks);
  World<D> world = make_world(input, bodies.shapes);
  if (outputs->working != nullptr) return run_kept(input, std::move(world), groups, bodies, *outputs);
  Result_files place(outputs->folder->path());
  Run_parts<D> parts(input, place, std::move(world), groups, outputs->record != nullptr);
  Run_sharing<D> sharing(ranks, parts.world, state_times(input, parts.world));
  run_steps(input, parts, sharing);
  const std::string not_drawn = finish(input, parts, &sharing, *outputs, place.folder());
  outputs->all.commit(summary(input, parts, not_drawn));
}

/// Goes on with a scene.
template <int D>
void resume_scene(const Run_options& options, Run_outputs& outputs, const Scene<D>& scene, Kept_run& kept) {
  const std::filesystem::path folder = outputs.working->checkpoints();
  detail::Environment_history history;
  Compiled_environment<D> environment = take_environment<D>(folder, kept.rest, history);
  if (needs_map(scene)) environment.environment.thaw();
  detail::follow_history(environment.environment, history);
  const Run_input<D> input{scene,
                           options,
                           environment.environment,
                           environment.certificate,
                           kept.settings.notes,
                           kept.settings.import_lines};
  Result_files place(outputs.working->results(), folder, kept.lengths);
  Run_parts<D> parts(input, place, !kept.settings.record.empty(), kept.rest);
  Run_settings settings = kept.settings;
  if (options.checkpoint_every > 0) settings.every = options.checkpoint_every;
  Run_checkpoints<D> checkpoints(folder, place, std::move(settings), changes_environment(scene));
  std::optional<Interruption> interruption(std::in_place);
  run_steps(input, parts, checkpoints, *outputs.working, *interruption);
  interruption.reset();
  const std::string not_drawn = finish<D>(input, parts, nullptr, outputs, place.folder());
  outputs.all.commit(summary(input, parts, not_drawn) + not_written(kept.settings, options));
}

/// Refuses options of another run than the one that goes on.
void check_same(const Run_options& options, const Given_options& given, const Run_settings& settings,
                std::uint32_t steps) {
  const auto refuse = [&](const char* what) {
    throw Error(Error_code::usage,
                fmt::format("{}: this run began with {}: leave that out, or begin another run",
                            options.resume, what));
  };
  if (given.scene && load_scene(options.scene, options.changes).text != settings.scene_text)
    refuse("another scene");
  if (given.steps && options.steps != steps) refuse("another number of --steps");
  if (given.sweep && options.body.sweep.sweep != settings.sweep) refuse("another --sweep");
  // Where they go is up to whoever goes on.
  if (given.record && settings.record.empty()) refuse("another --record");
  if (given.json && settings.json.empty()) refuse("another --json");
}

void resume(Run_options options, const Given_options& given) {
  const auto note_end = [&] {
    fmt::print("{}: the run had ended, and its results are there\n", options.resume);
  };
  if (Working_folder::has_ended(options.resume)) return note_end();
  Run_outputs outputs(options.resume);
  if (outputs.working->is_done()) {
    outputs.working->settle();
    return note_end();
  }
  Kept_run kept = read_checkpoint(outputs.working->checkpoints());
  const Run_settings& settings = kept.settings;
  outputs.working->allow_replacing(settings.replaced);
  const Any_scene scene = io::parse_scene(settings.scene, settings.scene_text,
                                          std::filesystem::path(settings.scene).parent_path());
  const std::uint32_t steps =
      settings.steps > 0 ? settings.steps : std::visit([](const auto& of) { return of.steps; }, scene);
  check_same(options, given, settings, steps);
  outputs.open(options.record, options.json);
  options.scene = printable(settings.scene);
  options.scene_text = settings.scene_text;
  options.folder = options.resume;
  options.steps = settings.steps;
  options.body.sweep.sweep = settings.sweep;
  std::visit([&](const auto& of) { resume_scene(options, outputs, of, kept); }, scene);
}

void run(Run_options options, Ranks& ranks) {
  std::optional<Run_outputs> outputs;
  if (ranks.is_first()) outputs.emplace(options);
  if (outputs && !ranks.is_alone()) outputs->all.inputs_are_shared();
  Scene_source source = load_scene(options.scene, options.changes);
  options.scene = source.name;
  options.scene_text = std::move(source.text);
  const auto run_it = [&](const auto& scene) {
    run_scene(options, ranks, outputs ? &*outputs : nullptr, scene);
  };
  std::visit(run_it, source.scene);
}

/// \param output, force options that a run cannot have which goes on
void add_checkpoint_options(CLI::App& command, Run_options& options, CLI::Option* output,
                            CLI::Option* force) {
  command
      .add_option(
          "--checkpoint-every", options.checkpoint_every,
          "Keep all that is needed to go on with the run after every N steps, in DIR.part; the results are "
          "the same")
      ->type_name("N")
      ->check(whole_number(1, 100000000));
  command
      .add_option("--resume", options.resume,
                  "Go on with the run that --checkpoint-every kept in DIR.part, and that was stopped")
      ->type_name("DIR")
      ->excludes(output)
      ->excludes(force);
}

}  // namespace

void add_run(CLI::App& app, Action& chosen) {
  CLI::App* command =
      app.add_subcommand("run", "Simulate a scene: bodies, particles and a catheter among walls");
  const auto options = std::make_shared<Run_options>();
  command
      ->add_option("scene", options->scene,
                   "The scene, see docs/scenes.md; without one 225 hexahedra bounce among 1000 cells "
                   "(data/hexahedra.json)")
      ->type_name("SCENE.json");
  CLI::Option* const output =
      command->add_option("-o,--output", options->folder, "Folder for the results; must not exist yet")
          ->type_name("DIR");
  command
      ->add_option("--set", options->changes,
                   "Replace a value of the scene: environment.cells=[46,46,47], bodies[0].count=50")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--steps", options->steps, "Run so many steps, whatever the scene says")
      ->type_name("N")
      ->check(whole_number(1, 100000000));
  command->add_option("--threads", options->threads, "Threads; 0: all. The results do not depend on it")
      ->type_name("N")
      ->check(whole_number(0, 1024));
  add_choice(
      *command, "--sweep", options->body.sweep.sweep,
      {{sweep_names[0], Sweep::three_segments},
       {sweep_names[1], Sweep::triangle},
       {sweep_names[2], Sweep::faces}},
      "What is checked of bodies: edges by the paper's three segments, which miss what fits between them; "
      "the triangles that edges sweep; or faces as well");
  command
      ->add_option("--record", options->record,
                   "Record the motion of all bodies, with the exact answers of walls, for cellwalk replay")
      ->type_name("TRACE");
  add_json(*command, options->json);
  CLI::Option* const force =
      command->add_flag("--force", options->force, "Replace the folder if it holds an earlier run");
  add_checkpoint_options(*command, *options, output, force);
  add_examples(*command,
               {"cellwalk run -o hexahedra", "cellwalk run data/vessel.json -o out --steps 100",
                "cellwalk run -o large --set environment.cells=46 --set 'bodies[0].count=50'",
                "cellwalk run -o long --steps 100000 --checkpoint-every 1000", "cellwalk run --resume long"});
  command->callback([options, command, &chosen] {
    if (options->folder.empty() && options->resume.empty()) throw CLI::RequiredError("--output");
    const auto is_given = [command](const char* name) { return command->get_option(name)->count() > 0; };
    const Given_options given{is_given("scene") || is_given("--set"), is_given("--steps"),
                              is_given("--sweep"), is_given("--record"), is_given("--json")};
    chosen = [options, given](Ranks& ranks) {
      std::optional<tbb::global_control> limit;
      if (options->threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, options->threads);
      try {
        if (options->resume.empty())
          run(*options, ranks);
        else if (ranks.is_first())
          resume(*options, given);
      } catch (const Interrupted& interrupted) {
        end_by(interrupted);
      }
    };
  });
}

}  // namespace cellwalk::cli
