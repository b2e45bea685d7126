// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk import MESH -o ENV.ovm: converts any mesh to a certified environment, and reports every change.
#include <cellwalk/internal/io/named_points.h>
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/internal/loading/mesher.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

#include "cli/common/command.h"
#include "cli/common/edge_cells.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"
#include "cli/import_picture.h"
#include "cli/repair_options.h"

namespace cellwalk::cli {
namespace {

struct Options {
  std::string mesh, environment, json, picture, names;
  bool no_split = false;
  double edge_length = 0;
  Import_options import;
};

/// Adds the options of the meshers in this build.
void add_mesher_options(CLI::App& command, Mesher_options& options, double& tissue) {
  if (!mesher_parts().meshing) return;
  add_choice(
      command, "--mesher", options.mesher, {{"tetgen", Mesher::tetgen}, {"mesh3", Mesher::mesh3}},
      "For a surface: TetGen keeps it exactly; Mesh_3 approximates it with better cells and says how far");
  command
      .add_option("--quality", options.quality,
                  "TetGen: bound of circumradius to shortest edge, from 1.1; 0: none, with slivers that "
                  "make edges lie in up to 1.5 times as many cells")
      ->check(number_from(0, "of at least 0"))
      ->default_str("3")
      ->type_name("Q");
  command
      .add_option("--cell-size", options.cell_size,
                  "In units of the surface. Mesh_3: bound of circumradii; TetGen: no cell is larger than a "
                  "regular tetrahedron of this circumradius")
      ->check(number_from(least_size, "greater than 0"))
      ->type_name("H");
  command.add_option("--distance", options.distance, "Mesh_3: how far the boundary may leave the surface")
      ->check(number_from(least_size, "greater than 0"))
      ->type_name("D");
  command
      .add_option(
          "--tissue", tissue,
          "3D: surround it by solid cells up to a box at this distance, so that walls that move cannot "
          "run into each other; by TetGen")
      ->check(number_from(least_size, "greater than 0"))
      ->type_name("DIST");
  command
      .add_option("--time-limit", options.time_limit,
                  "Seconds that TetGen or Mesh_3 may take in all, after which it is ended")
      ->check(number_from(least_size, "greater than 0"))
      ->default_str("600")
      ->type_name("SECONDS");
  command.add_flag("--keep-obstacles", options.keep_obstacles,
                   "Keep the inside of obstacles and holes as solid cells");
}

/// Adds the option for cells that do not conform.
void add_conform(CLI::App& command, std::optional<double>& value) {
  constexpr double most = 0.01;
  const auto is_number = number_from(least_size, "", most);
  command
      .add_option_function<std::string>(
          "--conform",
          [&value](const std::string& word) {
            if (word == "off")
              value.reset();
            else
              value = word == "exact" ? 0 : std::stod(word);
          },
          "Cells of a file that overlap in a plane without a common facet: divide their facets there, "
          "exactly, "
          "or within this part of the diagonal, or refuse them")
      ->check([is_number](const std::string& word) {
        const bool is_known = word == "exact" || word == "off" || is_number(word).empty();
        return is_known ? std::string{}
                        : "takes exact, off, or a number greater than 0 up to 0.01, not " + word;
      })
      ->type_name("exact|REL|off")
      ->default_str("exact");
}

std::string text(const Import_report& report) {
  std::string text;
  for (const Import_report::Stage& stage : report.stages)
    for (std::size_t i = 0; i < stage.lines.size(); ++i)
      text += fmt::format("  {:<12}{}\n", i == 0 ? stage.title : "", stage.lines[i]);
  return text;
}

void import(Options& options) {
  std::vector<std::string> inputs = options.import.obstacles;
  inputs.insert(inputs.end(), {options.mesh, options.names});
  Outputs outputs(inputs);
  io::Atomic_file* const file = outputs.file(options.environment);
  io::Atomic_file* const json = outputs.file(options.json);
  io::Atomic_file* const picture = outputs.file(options.picture);
  if (!options.names.empty()) options.import.names = io::read_named_points(options.names);
  options.import.build.split = !options.no_split;
  Surface_soup surface;
  if (picture != nullptr)
    options.import.on_surface = [&surface](const Surface_soup& read) { surface = read; };
  std::optional<Progress> progress;
  options.import.on_stage = [&progress](const std::string& stage) {
    progress.reset();
    progress.emplace(stage);
  };
  Imported_environment imported = import_environment(options.mesh, options.import);
  std::visit(
      [&]<int D>(Environment<D>& environment) {
        write_environment<D>(*file, environment, imported.built.certificate,
                             std::get<Groups<D>>(imported.groups));
        if (picture != nullptr)
          write_picture<D>(*picture, surface, environment.snapshot(), std::get<Groups<D>>(imported.groups),
                           imported.report.json);
        const Edge_cells edges = count_edge_cells(environment.snapshot(), {.length = options.edge_length});
        progress.reset();
        imported.report.json["edge_cells"] = to_json(edges);
        imported.report.json["environment"] = options.environment;
        write_json(json, imported.report.json);
        outputs.commit(text(imported.report) +
                       summary(options.environment, imported.built.certificate, D, edges));
      },
      imported.environment);
}

}  // namespace

void add_import(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "import", "Make a certified environment of a mesh; says what was read, changed and refused");
  command
      ->add_option("mesh", options->mesh, "Cells, a surface, or a planar domain: " + io::supported_formats())
      ->required()
      ->type_name("MESH");
  add_environment_output(*command, options->environment);
  command
      ->add_option("--obstacle", options->import.obstacles,
                   "A closed surface inside; may be given several times")
      ->allow_extra_args(false)
      ->type_name("MESH2");
  add_mesher_options(*command, options->import.mesher, options->import.tissue);
  add_repair_options(*command, options->import.mesher, options->names);
  CLI::Option* const no_split = command->add_flag(
      "--no-split", options->no_split, "Refuse cells that are not exactly convex instead of splitting");
  command
      ->add_flag("--simplicial", options->import.build.simplicial,
                 "Split all cells into tetrahedra, or triangles in 2D, as walls that move need")
      ->excludes(no_split);
  add_duplicates(*command, options->import.build.duplicates);
  add_conform(*command, options->import.conform);
  add_edge_length(*command, options->edge_length);
  add_json(*command, options->json);
  command
      ->add_option(
          "--picture", options->picture,
          "Draw the surface as it is given, and what became of it: walls, caps and other groups with "
          "their names, and the places of repairs")
      ->type_name("OUT.png");
  add_examples(
      *command,
      {"cellwalk import vessel.stl -o vessel.ovm", "cellwalk import vessel.stl --cell-size 0.5 -o fine.ovm",
       "cellwalk import hull.off --obstacle rock.off --mesher mesh3 --cell-size 0.2 -o hull.ovm",
       "cellwalk import aneurysm.stl --mesher mesh3 --tissue 2 -o beating.ovm",
       "cellwalk import aorta.obj -o aorta.ovm --picture aorta.png",
       "cellwalk import floor.wkt -o floor.ovm --json report.json",
       "cellwalk import blocks.vtk --conform 1e-9 -o blocks.ovm",
       "cellwalk import vessel.ovm -o vessel.cellwalk"});
  command->callback([options, &chosen] { chosen = [options] { import(*options); }; });
}

}  // namespace cellwalk::cli
