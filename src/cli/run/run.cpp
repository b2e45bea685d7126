// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run [SCENE.json] -o DIR: simulates a scene and writes what happened.
#include <cellwalk/internal/io/body_trace_file.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/io/atomic_file.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bodies.h"
#include "changes.h"
#include "cli/common/command.h"
#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "cli/common/interruption.h"
#include "cli/common/moves_file.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"
#include "files.h"
#include "picture.h"
#include "prepared_environment.h"
#include "recording.h"
#include "scene_source.h"
#include "sharing.h"
#include "trace.h"
#include "walls.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

struct Run_options {
  std::string scene, folder;
  std::string record;  ///< a trace to write; empty: none
  std::string json;    ///< where the report goes as well; empty: nowhere
  std::vector<std::string> changes;
  std::string scene_text;   ///< with the changes
  std::uint32_t steps = 0;  ///< 0: as many as the scene says
  std::size_t threads = 0;  ///< 0: as many as there are cores
  bool force = false;
  Body_options body;
};

/// What a run writes; null where it is not wanted.
struct Run_outputs {
  explicit Run_outputs(const Run_options& options)
      : all({options.scene}),
        folder(all.folder(options.folder, options.force)),
        record(all.file(options.record)),
        json(all.file(options.json)) {}

  Outputs all;
  Output_folder& folder;
  io::Atomic_file *record, *json;
};

template <int D>
struct Run {
  const Scene<D>& scene;
  const Run_options& options;
  Ranks& ranks;
  Run_outputs* outputs;  ///< on the first rank
  Environment<D>& environment;
  const Certificate& certificate;
  const Groups<D>& groups;  ///< that the file of the environment names
  const Scene_bodies<D>& bodies;

  std::uint32_t steps() const { return options.steps > 0 ? options.steps : scene.steps; }
  void operator()() const;

 private:
  World<D> make_world() const;
  State_times state_times(const World<D>& world) const;
  void write(World<D>& world) const;
  std::string caption(const World<D>& world, std::uint64_t contacts) const;
  ordered_json scene_text() const;
  ordered_json report(const World<D>& world, const Run_files<D>& files, const Run_walls<D>* walls,
                      const Run_changes<D>* changes, const Run_recording<D>* motion) const;
  std::string summary(const World<D>& world, const Run_files<D>& files, const Run_walls<D>* walls,
                      const Run_changes<D>* changes, bool motion, bool picture) const;
};

template <int D>
World<D> Run<D>::make_world() const {
  try {
    return World<D>(environment.snapshot(), scene, bodies.shapes, options.body);
  } catch (const Error& error) {
    // What a scene asks for is input, whatever it would be in a call.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: {}", options.scene, error.what()));
  }
}

template <int D>
State_times Run<D>::state_times(const World<D>& world) const {
  return {steps(), scene.output.frame_every, motion_interval(scene, environment.snapshot(), world, steps()),
          scene.output.picture.has_value() && !world.particles().empty()};
}

template <int D>
void Run<D>::operator()() const {
  World<D> world = make_world();
  if (outputs != nullptr) return write(world);
  Run_sharing<D> sharing(ranks, world, state_times(world));
  for (std::uint32_t i = 1; i <= steps(); ++i) {
    world.step();
    sharing.step();
  }
  world.validate();
  sharing.finish();
}

template <int D>
void Run<D>::write(World<D>& world) const {
  const auto record = start_trace(outputs->record, options.scene, world);
  const std::filesystem::path& folder = outputs->folder.path();
  const Interruption interruption;
  const Attentive_wait wait(ranks, interruption);
  Run_files<D> files(folder, environment, world, scene);
  std::optional<Run_walls<D>> walls;
  if (scene.walls) walls.emplace(folder, environment, scene, options.scene);
  std::optional<Run_changes<D>> changes;
  if (!scene.changes.list.empty()) changes.emplace(folder, environment, scene.changes, groups, options.scene);
  std::optional<Run_recording<D>> motion;
  if (const std::uint32_t every = motion_interval(scene, environment.snapshot(), world, steps()); every > 0)
    motion.emplace(folder / "motion.gz", environment.snapshot(), world,
                   Motion_times{scene.time_step, steps(), every}, wall_motion(scene));
  std::optional<Run_picture<D>> picture;
  if (scene.output.picture) picture.emplace(world, scene.walls.has_value());
  Run_sharing<D> sharing(ranks, world, state_times(world));
  {
    Progress progress("running " + options.scene, steps());
    for (std::uint32_t i = 1; i <= steps(); ++i) {
      if (changes) {
        const std::vector<Change_outcome> made = changes->step(world);
        if (walls) walls->follow(made);
      }
      if (walls) walls->step(world);
      world.step();
      sharing.step();
      if (record) record->record_step();
      files.record(world, i == steps());
      if (motion) motion->record(world, i == steps());
      if (picture) picture->record(world);
      progress.update(i);
      interruption.check();
    }
  }
  world.validate();
  sharing.finish();
  files.finish();
  if (walls || changes) {
    const Progress progress("certifying the environment as it is now");
    environment.certify();
  }
  if (walls) walls->finish();
  if (changes) changes->finish();
  if (motion) motion->commit();
  if (picture) {
    const Progress progress("drawing");
    const std::uint64_t contacts = files.contacts()[0] + files.contacts()[1] + files.contacts()[2];
    const Picture_request& request = *scene.output.picture;
    drawing::Picture_options how;
    how.width = request.width;
    how.height = request.height;
    const auto direction = [](const std::vector<double>& v) {
      return v.empty() ? Vector<3>{} : Vector<3>{v[0], v[1], v[2]};
    };
    how.camera.toward = direction(request.toward);
    how.camera.up = direction(request.up);
    if (D == 2) how.camera = {{0, 0, 1}, {0, 1, 0}, 0};
    const drawing::Image image =
        drawing::render(picture->draw(environment.soup(), world, scene, caption(world, contacts)), how);
    io::write_file(folder / "picture.png", drawing::encode_png(image));
  }
  const ordered_json said = report(world, files, walls ? &*walls : nullptr, changes ? &*changes : nullptr,
                                   motion ? &*motion : nullptr);
  io::write_json(folder / "run.json", said);
  if (record) io::write_body_trace(*outputs->record, record->trace());
  write_json(outputs->json, said);
  interruption.check();
  outputs->all.commit(summary(world, files, walls ? &*walls : nullptr, changes ? &*changes : nullptr,
                              motion.has_value(), picture.has_value()));
}

template <int D>
std::string Run<D>::caption(const World<D>& world, std::uint64_t contacts) const {
  const std::string title = scene.title.empty() ? "" : scene.title + ": ";
  std::string text = title;
  if (const Rod<D>* rod = world.catheter())
    text += fmt::format("catheter of {} vertices, ", rod->body().vertex_count());
  if (!world.particles().empty()) text += fmt::format("{} free particles, ", world.particles().size());
  if (const std::size_t count = world.bodies().size() - scene.catheter.has_value(); count > 0)
    text += fmt::format("{} {}, ", count, count == 1 ? "body" : "bodies");
  return text + fmt::format("{} steps, {} contacts", steps(), contacts);
}

/// The scene as it was run, for the manifest.
template <int D>
ordered_json Run<D>::scene_text() const {
  constexpr bool throws = true, skips_comments = true;
  return ordered_json::parse(options.scene_text, nullptr, throws, skips_comments);
}

template <int D>
ordered_json Run<D>::report(const World<D>& world, const Run_files<D>& files, const Run_walls<D>* walls,
                            const Run_changes<D>* changes, const Run_recording<D>* motion) const {
  ordered_json result{{"dimension", D}, {"steps", steps()}, {"time_step", scene.time_step}};
  result["environment"] = cli::to_json(certificate, D);
  result["particles"] = {{"free", world.particles().size()}};
  ordered_json kinds;
  for (std::size_t k = 0; k < 3; ++k) kinds[contact_kind_names[k]] = files.contacts()[k];
  result["contacts"] = kinds;
  if (!world.bodies().empty())
    result["bodies"] = bodies_json(sizes_of(world, scene), files.body_contacts(), bodies.notes);
  if (const Rod<D>* rod = world.catheter()) result["catheter"] = catheter_json(*rod);
  if (walls) result["walls"] = walls->report();
  if (changes) result["changes"] = changes->report();
  result["frames"] = files.frame_count();
  if (motion) result["motion"] = {{"every", motion->every()}, {"records", motion->frame_count()}};
  result["validated"] = true;  // World::validate has returned
  result["counts"] = to_json(world.counts());
  if (!world.bodies().empty()) result["body_counts"] = to_json(world.body_counts());
  // Everything needed to repeat the run, and nothing that differs between machines or days.
  result["manifest"] = {{"cellwalk", CELLWALK_VERSION}, {"scene", scene_text()}};
  if (!world.bodies().empty())
    result["manifest"]["sweep"] = sweep_names[static_cast<std::size_t>(options.body.sweep.sweep)];
  return result;
}

template <int D>
std::string Run<D>::summary(const World<D>& world, const Run_files<D>& files, const Run_walls<D>* walls,
                            const Run_changes<D>* changes, bool motion, bool picture) const {
  std::string text = fmt::format("{}: {}D, {} steps of {}\n", options.scene, D, steps(), scene.time_step);
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const auto& contacts = files.contacts();
  line("environment", fmt::format("{} cells, {} walls, certified", certificate.cells, certificate.walls));
  if (!world.particles().empty()) line("particles", fmt::format("{} free", world.particles().size()));
  const Body_sizes sizes = sizes_of(world, scene);
  if (sizes.bodies > 0)
    line("bodies", fmt::format("{}, with {} vertices, {} edges, {} faces", sizes.bodies, sizes.vertices,
                               sizes.edges, sizes.faces));
  line("contacts",
       fmt::format("{} ({} with facets, {} with edges, {} with vertices)",
                   contacts[0] + contacts[1] + contacts[2], contacts[2], contacts[1], contacts[0]));
  if (sizes.bodies > 0) {
    line("of bodies", describe_contacts(files.body_contacts()));
    line("moves", describe_moves(world.body_counts()));
    line("edges", describe_edges(world.body_counts().edges));
  }
  if (sizes.guided > 0)
    line("guided", fmt::format("{} of {} bodies at the end of their paths", sizes.arrived, sizes.guided));
  if (const Rod<D>* rod = world.catheter()) line("catheter", describe_catheter(*rod));
  if (walls) line("walls", walls->describe());
  if (changes) line("changes", changes->describe());
  line("validated",
       sizes.bodies > 0
           ? "every particle and vertex lies in its cell, no edge crosses a wall, by exact predicates"
           : "every particle lies in its cell, by exact predicates");
  std::string written = "run.json, contacts.csv";
  if (walls) written += scene.walls->soft ? ", walls.csv, forces.csv" : ", walls.csv";
  if (changes) written += ", changes.csv";
  if (files.frame_count() > 0) written += fmt::format(", run.pvd ({} frames)", files.frame_count());
  if (motion) written += ", motion.gz";
  if (picture) written += ", picture.png";
  line("written", fmt::format("{}: {}", options.folder, written));
  if (!options.record.empty()) line("recorded", options.record);
  return text;
}

template <int D>
void run_scene(const Run_options& options, Ranks& ranks, Run_outputs* outputs, const Scene<D>& scene) {
  if (outputs != nullptr) {
    if (const auto* file = std::get_if<std::string>(&scene.environment)) outputs->all.also_reads(*file);
    for (const auto& body : scene.bodies)
      if (const auto* file = std::get_if<std::string>(&body.source)) outputs->all.also_reads(*file);
  }
  Ranks alone;
  const std::string reason = hindrance(scene, !options.record.empty());
  Ranks& sharing = reason.empty() ? ranks : alone;
  if (!reason.empty() && outputs == nullptr) return;
  const Scene_bodies<D> bodies = load_bodies(scene, options.scene);
  if (!options.record.empty()) check_recordable(scene, options.scene);
  if (outputs != nullptr && scene.walls && !scene.walls->motion.empty())
    outputs->all.also_reads(scene.walls->motion);
  if (!reason.empty() && !ranks.is_alone())
    fmt::print(stderr, "cellwalk: {}: {}, so the first of {} ranks works alone\n", options.scene, reason,
               ranks.size());
  Prepared_environment prepared = prepare(scene.environment, scene.walls ? &*scene.walls : nullptr,
                                          scene.changes, options.scene, sharing);
  auto* environment = std::get_if<Environment<D>>(&prepared.environment);
  if (!environment)
    throw Error(Error_code::input,
                fmt::format("{}: dimension: the environment is of dimension {}, the scene of {}",
                            options.scene, 5 - D, D));
  const auto* const known = std::get_if<Groups<D>>(&prepared.groups);  // none are generated
  const Groups<D> groups = known ? *known : Groups<D>{};
  Run<D>{scene, options, sharing, outputs, *environment, prepared.certificate, groups, bodies}();
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
  command->add_option("-o,--output", options->folder, "Folder for the results; must not exist yet")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--set", options->changes,
                   "Replace a value of the scene: environment.cells=[46,46,47], bodies[0].count=50")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--steps", options->steps, "Run so many steps, whatever the scene says")
      ->type_name("N")
      ->check(whole_number(1, 100000000));
  command->add_option("--threads", options->threads, "Use at most so many threads; the results are the same")
      ->type_name("N")
      ->check(whole_number(1, 1024));
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
  command->add_flag("--force", options->force, "Replace the folder if it holds an earlier run");
  add_examples(*command, {"cellwalk run -o hexahedra", "cellwalk run data/vessel.json -o out --steps 100",
                          "cellwalk run -o large --set environment.cells=46 --set bodies[0].count=50"});
  command->callback([options, &chosen] {
    chosen = [options](Ranks& ranks) {
      std::optional<tbb::global_control> limit;
      if (options->threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, options->threads);
      try {
        run(*options, ranks);
      } catch (const Interrupted& interrupted) {
        end_by(interrupted);
      }
    };
  });
}

}  // namespace cellwalk::cli
