// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk import MESH -o ENV.ovm: any mesh becomes a certified environment, and every change is reported.
#include <cellwalk/io/ovm.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/environment_file.h"
#include "cli/mesher.h"
#include "cli/progress.h"

namespace cellwalk::cli {
namespace {

struct Import_options {
  std::string mesh, environment, json;
  std::vector<std::string> obstacles;
  Mesher_options mesher;
  bool no_split = false;
  Build_options build{.keep_map = false};
};

/// A report that grows stage by stage: a title and lines, and JSON.
struct Report {
  std::string text;
  nlohmann::ordered_json json;

  void add(const std::string& title, const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      text += fmt::format("  {:<12}{}\n", i == 0 ? title : "", lines[i]);
  }
};

nlohmann::ordered_json to_json(const std::string& path, const io::Mesh_file& file) {
  return {{"file", path},
          {"format", file.report.format},
          {"kind", io::kind_name(file.mesh)},
          {"points", file.report.points},
          {"cells", file.report.cells},
          {"facets", file.report.facets},
          {"notes", file.report.notes}};
}

io::Mesh_file read(const std::string& path, Report& report) {
  const Progress progress("reading " + path);
  io::Mesh_file file = io::read_mesh(path);
  std::string line = fmt::format("{}: {}, {}, {} points", path, file.report.format, io::kind_name(file.mesh),
                                 file.report.points);
  line += file.report.cells != 0 ? fmt::format(", {} cells", file.report.cells)
                                 : fmt::format(", {} facets", file.report.facets);
  std::vector<std::string> lines{line};
  lines.insert(lines.end(), file.report.notes.begin(), file.report.notes.end());
  report.add("read", lines);
  report.json["read"].push_back(to_json(path, file));
  return file;
}

std::vector<Surface_soup> read_obstacles(const Import_options& options, Report& report) {
  std::vector<Surface_soup> obstacles;
  for (const std::string& path : options.obstacles) {
    io::Mesh_file file = read(path, report);
    auto* surface = std::get_if<Surface_soup>(&file.mesh);
    if (surface == nullptr)
      throw Error(Error_code::input, fmt::format("{}: holds a {}: an obstacle must be a closed surface", path,
                                                 io::kind_name(file.mesh)));
    obstacles.push_back(std::move(*surface));
  }
  return obstacles;
}

std::vector<std::string> changes(const Build_report& built) {
  std::vector<std::string> lines;
  const auto changed = [&lines](std::size_t count, const char* what) {
    if (count != 0) lines.push_back(fmt::format("{} {}", count, what));
  };
  if (built.flipped) lines.push_back("every cell was inverted: all turned round");
  changed(built.merged_points, "points merged with others in the same place");
  changed(built.unused_points, "points of no cell left out");
  const Split_report& split = built.split;
  if (split.cells_split != 0)
    lines.push_back(fmt::format(
        "{} of {} cells split into {}: {} not exactly planar, {} not exactly convex, the "
        "others beside them",
        split.cells_split, built.cells_read, split.cells_made, split.not_planar, split.not_convex));
  changed(split.facets_triangulated, "facets cut into triangles");
  changed(split.points_added, "points added inside cells");
  if (lines.empty()) lines.push_back("nothing: every cell is exact as it is");
  return lines;
}

nlohmann::ordered_json to_json(const Build_report& built) {
  const Split_report& split = built.split;
  return {{"cells_read", built.cells_read},
          {"points_read", built.points_read},
          {"unused_points", built.unused_points},
          {"merged_points", built.merged_points},
          {"flipped", built.flipped},
          {"cells_split", split.cells_split},
          {"cells_made", split.cells_made},
          {"facets_triangulated", split.facets_triangulated},
          {"points_added", split.points_added},
          {"not_planar", split.not_planar},
          {"not_convex", split.not_convex}};
}

template <int D>
void build_and_write(Cell_soup<D> soup, const Import_options& options, Report& report) {
  Build_options build = options.build;
  build.split = !options.no_split;
  Build_report built;
  {
    const Progress progress("splitting, gluing and certifying " + options.mesh);
    const auto environment =
        naming(options.mesh, [&] { return Environment<D>::build(std::move(soup), build, &built); });
    io::write_ovm(options.environment, environment.soup());
  }
  report.add("changed", changes(built));
  report.json["changed"] = to_json(built);
  report.json["certificate"] = cli::to_json(built.certificate, D);
  report.json["environment"] = options.environment;
  write_json(options.json, report.json);
  fmt::print("{}{}: certified, {}D\n{}", report.text, options.environment, D, describe(built.certificate, D));
}

template <int D>
void build_meshed(Meshed<D> meshed, const Import_options& options, Report& report) {
  report.add("meshed", meshed.lines);
  report.json["meshed"] = std::move(meshed.report);
  build_and_write(std::move(meshed.soup), options, report);
}

void import(const Import_options& options) {
  Report report;
  io::Mesh_file file = read(options.mesh, report);
  if (auto* surface = std::get_if<Surface_soup>(&file.mesh)) {
    const std::vector<Surface_soup> obstacles = read_obstacles(options, report);
    const auto meshed = [&] {
      const Progress progress("meshing " + options.mesh);
      return naming(options.mesh, [&] { return mesh_surface(*surface, obstacles, options.mesher); });
    };
    return build_meshed(meshed(), options, report);
  }
  if (!options.obstacles.empty())
    throw Error(Error_code::usage, fmt::format("--obstacle goes with a surface, and {} holds a {}",
                                               options.mesh, io::kind_name(file.mesh)));
  if (const auto* domain = std::get_if<Planar_domain>(&file.mesh))
    return build_meshed(naming(options.mesh, [&] { return mesh_domain(*domain, options.mesher); }), options,
                        report);
  if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh))
    return build_and_write(std::move(*soup), options, report);
  build_and_write(std::move(std::get<Cell_soup<3>>(file.mesh)), options, report);
}

}  // namespace

void add_import(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Import_options>();
  CLI::App* command = app.add_subcommand(
      "import", "Make a certified environment of a mesh; says what was read, changed and refused");
  command
      ->add_option("mesh", options->mesh,
                   "Cells, a closed surface, or a planar domain: " + io::supported_formats())
      ->required()
      ->type_name("MESH");
  add_environment_output(*command, options->environment);
  command->add_option("--obstacle", options->obstacles, "A closed surface inside; may be given several times")
      ->type_name("MESH2");
  add_mesher_options(*command, options->mesher);
  command->add_flag("--no-split", options->no_split,
                    "Refuse cells that are not exactly convex instead of splitting");
  add_duplicates(*command, options->build.duplicates);
  add_json(*command, options->json);
  add_examples(*command,
               {"cellwalk import vessel.stl -o vessel.ovm",
                "cellwalk import hull.off --obstacle rock.off --mesher mesh3 --cell-size 0.2 -o hull.ovm",
                "cellwalk import floor.wkt -o floor.ovm --json report.json"});
  command->callback([options, &chosen] { chosen = [options] { import(*options); }; });
}

}  // namespace cellwalk::cli
