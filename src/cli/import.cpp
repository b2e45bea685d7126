// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk import MESH -o ENV.ovm: converts any mesh to a certified environment, and reports every change.
#include <cellwalk/internal/loading/environment_writer.h>

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

namespace cellwalk::cli {
namespace {

struct Options {
  std::string mesh, environment, json;
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

/// Reads "X,Y,Z".
Point<3> point_of(const std::string& text) {
  Point<3> p;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? text.find(',', begin) : text.size();
    const std::string number = text.substr(begin, end == std::string::npos ? end : end - begin);
    if (end == std::string::npos || !CLI::detail::lexical_cast(number, p[k]) || !is_finite(p))
      throw Error(Error_code::usage,
                  fmt::format("--inside: '{}' is neither auto, solid, nor a point X,Y,Z", text));
    begin = end + 1;
  }
  return p;
}

/// Adds the options of surfaces with defects.
void add_repair_options(CLI::App& command, Mesher_options& options) {
  if (!mesher_parts().meshing) return;
  CLI::Option* const strict = command.add_flag(
      "--strict", options.is_strict,
      "Refuse surfaces that are open, not manifold or cross themselves, and cells that do not conform");
  command
      .add_option_function<std::vector<std::string>>(
          "--inside",
          [&options](const std::vector<std::string>& values) {
            for (const std::string& value : values) {
              if (value == "solid")
                options.repair.is_solid = true;
              else if (value != "auto")
                options.repair.inside.push_back(point_of(value));
            }
          },
          "The free space: auto: what the surface encloses, or the lumen of a thick wall; solid: always what "
          "it encloses; a point: the space around it, up to the narrowest places on the ways out. Several "
          "points for one space")
      ->allow_extra_args(false)
      ->excludes(strict)
      ->default_str("auto")
      ->type_name("auto|solid|X,Y,Z");
  const auto part = [&](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)
        ->check(number_from(0, "of at least 0"))
        ->excludes(strict)
        ->type_name("REL")
        ->capture_default_str();
  };
  part("--seam", options.repair.seam, "Join points of borders nearer than this part of the surface's size");
  part("--weld", options.repair.weld,
       "Join any points nearer than this part of the size, if no mesher takes them apart; 0: never");
  part("--max-move", options.repair.max_move,
       "Refuse a surface whose walls would lie farther from it than this part of its size");
  add_choice(command, "--sheets", options.repair.sheets,
             {{"keep", Sheets::keep}, {"open", Sheets::open}, {"refuse", Sheets::refuse}},
             "Facets inside, or given on both sides: membranes, nothing, or a reason to refuse the surface");
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
  inputs.push_back(options.mesh);
  Outputs outputs(inputs);
  io::Atomic_file* const file = outputs.file(options.environment);
  io::Atomic_file* const json = outputs.file(options.json);
  options.import.build.split = !options.no_split;
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
      ->type_name("MESH2");
  add_mesher_options(*command, options->import.mesher, options->import.tissue);
  add_repair_options(*command, options->import.mesher);
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
  add_examples(
      *command,
      {"cellwalk import vessel.stl -o vessel.ovm", "cellwalk import vessel.stl --cell-size 0.5 -o fine.ovm",
       "cellwalk import hull.off --obstacle rock.off --mesher mesh3 --cell-size 0.2 -o hull.ovm",
       "cellwalk import aneurysm.stl --mesher mesh3 --tissue 2 -o beating.ovm",
       "cellwalk import floor.wkt -o floor.ovm --json report.json",
       "cellwalk import blocks.vtk --conform 1e-9 -o blocks.ovm",
       "cellwalk import vessel.ovm -o vessel.cellwalk"});
  command->callback([options, &chosen] { chosen = [options] { import(*options); }; });
}

}  // namespace cellwalk::cli
