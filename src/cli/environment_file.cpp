// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/environment_file.h"

#include <cellwalk/io/json_file.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

#include "cli/progress.h"

namespace cellwalk::cli {
namespace {

template <int D>
Environment<D> build_as_it_stands(Cell_soup<D> soup, const Build_options& options, Build_report& report) {
  auto environment = Environment<D>::build(std::move(soup), options, &report);
  if (report.flipped)
    throw Error(Error_code::not_certified,
                "every cell is inverted; `cellwalk import` turns them round and writes an environment");
  return environment;
}

}  // namespace

Loaded_environment load_environment(const std::string& path, Build_options options) {
  const Progress progress("reading and certifying " + path);
  io::Mesh_file file = io::read_mesh(path);
  options.split = false;
  Build_report report;
  return naming(path, [&]() -> Loaded_environment {
    if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh))
      return {build_as_it_stands(std::move(*soup), options, report), report, std::move(file.report)};
    if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh))
      return {build_as_it_stands(std::move(*soup), options, report), report, std::move(file.report)};
    throw Error(Error_code::input,
                fmt::format("holds a {}, no cells; make an environment of it with `cellwalk import`",
                            io::kind_name(file.mesh)));
  });
}

void add_duplicates(CLI::App& command, Duplicate_vertices& value) {
  add_choice(command, "--duplicates", value,
             {{"refuse", Duplicate_vertices::refuse},
              {"merge", Duplicate_vertices::merge},
              {"keep", Duplicate_vertices::keep}},
             "Vertices in the same place: refuse the file, merge them, or keep them apart (a slit)");
}

void add_environment_output(CLI::App& command, std::string& path) {
  command.add_option("-o,--output", path, "The environment to write (OpenVolumeMesh ASCII, *.ovm)")
      ->required()
      ->type_name("ENV.ovm")
      ->check([](const std::string& text) {
        const bool fine = std::filesystem::path(text).extension() == ".ovm" || text.starts_with("/dev/");
        return fine ? std::string{}
                    : "environments are written as OpenVolumeMesh: name the file *.ovm, not " + text;
      });
}

void add_json(CLI::App& command, std::string& path) {
  command.add_option("--json", path, "Write the report as JSON too")->type_name("FILE");
}

void write_json(const std::string& path, const nlohmann::ordered_json& report) {
  if (!path.empty()) io::write_json(path, report);
}

std::string rounded(double value) { return fmt::format("{:.6g}", value); }

std::string describe(const Certificate& c, int dimension) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  line("cells", fmt::format("{} ({} solid)", c.cells, c.solid_cells));
  line("facets", std::to_string(c.facets));
  line("walls",
       fmt::format("{} ({} boundary facets, {} membranes)", c.walls, c.boundary_facets, c.membranes));
  if (dimension == 3) line("edges", std::to_string(c.ridges));
  line("vertices", fmt::format("{} ({} pinched)", c.vertices, c.pinched_vertices));
  line(dimension == 3 ? "volume" : "area", rounded(c.volume));
  line("free space", fmt::format("{} in {} component{}", rounded(c.free_volume), c.components,
                                 c.components == 1 ? "" : "s"));
  return text;
}

nlohmann::ordered_json to_json(const Certificate& c, int dimension) {
  return {{"dimension", dimension},
          {"cells", c.cells},
          {"solid_cells", c.solid_cells},
          {"facets", c.facets},
          {"walls", c.walls},
          {"boundary_facets", c.boundary_facets},
          {"membranes", c.membranes},
          {"ridges", c.ridges},
          {"vertices", c.vertices},
          {"pinched_vertices", c.pinched_vertices},
          {"components", c.components},
          {"volume", c.volume},
          {"free_volume", c.free_volume}};
}

}  // namespace cellwalk::cli
