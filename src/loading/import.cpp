// SPDX-License-Identifier: LGPL-3.0-or-later
// Any mesh becomes a certified environment, and every change is reported.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/internal/loading/report.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/loading/import.h>

#include <fmt/core.h>

#include <limits>

#include "compiled_file.h"

namespace cellwalk {
namespace {

nlohmann::ordered_json to_json(const std::string& path, const io::Mesh_file& file) {
  return {{"file", path},
          {"format", file.report.format},
          {"kind", io::kind_name(file.mesh)},
          {"points", file.report.points},
          {"cells", file.report.cells},
          {"facets", file.report.facets},
          {"collapsed", file.report.collapsed},
          {"notes", file.report.notes}};
}

/// Of the diagonal. Beyond it, cells would be joined that nobody meant to touch.
constexpr double largest_conform = 0.01;

/// One import: the stages append to the report.
class Import {
 public:
  Import(const std::string& path, const Import_options& options) : path_(path), options_(options) {}

  Imported_environment run() {
    io::Mesh_file file = read(path_);
    if (const auto* surface = std::get_if<Surface_soup>(&file.mesh)) {
      if (options_.on_surface) options_.on_surface(*surface);
      const std::vector<Surface_soup> obstacles = read_obstacles();
      begin("meshing " + path_);
      Mesher_options mesher = options_.mesher;
      for (const std::string& path : options_.obstacles) mesher.obstacle_names.push_back("obstacle " + path);
      return build_meshed(naming(path_, [&] { return mesh_surface(*surface, obstacles, mesher); }));
    }
    const auto* domain = std::get_if<Planar_domain>(&file.mesh);
    if (const char* option = option_of_surfaces(domain != nullptr))
      throw Error(Error_code::usage, fmt::format("{} goes with a surface, and {} holds a {}", option, path_,
                                                 io::kind_name(file.mesh)));
    if (domain != nullptr)
      return build_meshed(naming(path_, [&] { return mesh_domain(*domain, options_.mesher); }));
    if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh))
      return build_cells(std::move(*soup), std::move(file.groups));
    return build_cells(std::move(std::get<Cell_soup<3>>(file.mesh)), std::move(file.groups));
  }

 private:
  /// An option that has no effect on a file of cells, or a planar domain, if one is given.
  const char* option_of_surfaces(bool is_domain) const {
    const Mesher_options& mesher = options_.mesher;
    if (!options_.obstacles.empty()) return "--obstacle";
    if (!options_.names.empty()) return "--names";
    if (mesher.mesher != Mesher::tetgen) return "--mesher";
    if (mesher.keep_obstacles && !is_domain) return "--keep-obstacles";
    if (mesher.quality) return "--quality";
    if (mesher.cell_size != 0) return "--cell-size";
    if (mesher.distance != 0) return "--distance";
    return option_of_repair(mesher.repair);
  }

  void begin(const std::string& stage) const {
    if (options_.on_stage) options_.on_stage(stage);
  }

  io::Mesh_file read(const std::string& path) {
    begin("reading " + path);
    io::Mesh_file file = Cells_input(path).mesh();
    const io::Read_report& found = file.report;
    std::string line =
        fmt::format("{}: {}, {}, {} points", path, found.format, io::kind_name(file.mesh), found.points);
    line +=
        found.cells != 0 ? fmt::format(", {} cells", found.cells) : fmt::format(", {} facets", found.facets);
    std::vector<std::string> lines{line};
    lines.insert(lines.end(), found.notes.begin(), found.notes.end());
    report_.stages.push_back({"read", std::move(lines)});
    report_.json["read"].push_back(to_json(path, file));
    return file;
  }

  std::vector<Surface_soup> read_obstacles() {
    std::vector<Surface_soup> obstacles;
    for (const std::string& path : options_.obstacles) {
      io::Mesh_file file = read(path);
      auto* surface = std::get_if<Surface_soup>(&file.mesh);
      if (surface == nullptr)
        throw Error(Error_code::input, fmt::format("{}: holds a {}: an obstacle must be a closed surface",
                                                   path, io::kind_name(file.mesh)));
      obstacles.push_back(std::move(*surface));
    }
    return obstacles;
  }

  /// Gives caps and mouths the names that are wanted.
  template <int D>
  void name_parts(Meshed<D>& meshed) const {
    for (const auto& [name, place] : options_.names) {
      nlohmann::ordered_json* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (auto& part : meshed.repaired["parts"]) {
        const double distance = length(part["centre"].template get<Point<3>>() - place);
        if (part.contains("edges") && part["edges"] != 0 && distance < least)
          least = distance, nearest = &part;
      }
      if (nearest == nullptr)
        throw Error(Error_code::usage, "--names: the surface has no caps and no mouths to name");
      const auto old = (*nearest)["name"].template get<std::string>();
      if (old == name) continue;
      if (options_.names.contains(old))
        throw Error(Error_code::usage,
                    fmt::format("--names: {} and {} are nearest to the same cap or mouth, of width {}", old,
                                name, rounded((*nearest)["width"].template get<double>())));
      if (meshed.groups.contains(name))
        throw Error(Error_code::usage, fmt::format("--names: {} is the name of another part", name));
      (*nearest)["name"] = name;
      auto group = meshed.groups.extract(old);
      group.key() = name;
      meshed.groups.insert(std::move(group));
      meshed.repairs.push_back(fmt::format("{} is named {}", old, name));
    }
  }

  template <int D>
  Imported_environment build_meshed(Meshed<D> meshed) {
    name_parts(meshed);
    if (!meshed.repairs.empty()) {
      report_.stages.push_back({"repaired", std::move(meshed.repairs)});
      report_.json["repaired"] = std::move(meshed.repaired);
    }
    report_.stages.push_back({"meshed", std::move(meshed.lines)});
    report_.json["meshed"] = std::move(meshed.report);
    return build(std::move(meshed.soup), meshed.groups);
  }

  /// Cells of a file, which need not conform.
  template <int D>
  Imported_environment build_cells(Cell_soup<D> soup, Soup_groups groups) {
    if (options_.conform && !(*options_.conform >= 0 && *options_.conform <= largest_conform))
      throw Error(Error_code::usage,
                  fmt::format("--conform: takes exact, off, or a number greater than 0 up to 0.01, not {}",
                              *options_.conform));
    if (options_.conform && !options_.mesher.is_strict &&
        options_.build.duplicates != Duplicate_vertices::keep) {
      const Refinement refined = naming(path_, [&] { return refine(soup, groups, *options_.conform); });
      if (refined.facing.pairs != 0) report_.stages.push_back({"refined", changes(refined)});
      report_.json["refined"] = to_json(refined);
    }
    return build(std::move(soup), groups);
  }

  template <int D>
  Imported_environment build(Cell_soup<D> soup, const Soup_groups& groups) {
    begin("splitting, gluing and certifying " + path_);
    Build_report built;
    const Group_places<D> places = naming(path_, [&] { return Group_places<D>(soup, groups); });
    auto environment =
        naming(path_, [&] { return Environment<D>::build(std::move(soup), options_.build, &built); });
    report_.stages.push_back({"changed", changes(built)});
    if (auto lines = notes(built.facing); !lines.empty())
      report_.stages.push_back({"noted", std::move(lines)});
    report_.json["changed"] = to_json(built);
    Groups<D> found = places.find(environment.snapshot(), built.origin);
    if (options_.tissue != 0) {
      if constexpr (D == 3)
        environment = naming(path_, [&] { return in_tissue(environment, found, built.certificate); });
      else
        throw Error(Error_code::usage, fmt::format("--tissue goes with 3D, and {} is 2D", path_));
    }
    report_.json["certificate"] = to_json(built.certificate, D);
    return {std::move(environment), std::move(built), std::move(report_), std::move(found)};
  }

  /// The cells surrounded by solid ones, and certified again.
  Environment<3> in_tissue(const Environment<3>& alone, Groups<3>& groups, Certificate& certificate) {
    begin("meshing the tissue around " + path_);
    Cell_soup<3> cells = alone.soup();
    // They keep their numbers and points.
    const Group_places<3> places(cells, soup_groups(alone.snapshot(), groups));
    Meshed<3> meshed = add_tissue(std::move(cells), options_.tissue, options_.mesher);
    report_.stages.push_back({"tissue", std::move(meshed.lines)});
    report_.json["tissue"] = std::move(meshed.report);
    begin("gluing and certifying " + path_);
    Build_report built;
    auto environment = Environment<3>::build(std::move(meshed.soup), options_.build, &built);
    certificate = built.certificate;
    groups = places.find(environment.snapshot(), built.origin);
    return environment;
  }

  const std::string& path_;
  const Import_options& options_;
  Import_report report_;
};

}  // namespace

Imported_environment import_environment(const std::string& path, const Import_options& options) {
  return Import(path, options).run();
}

template <int D>
Environment<D> import_environment(const std::string& path) {
  return of_dimension<D>(import_environment(path, {}).environment);
}

template Environment<2> import_environment(const std::string&);
template Environment<3> import_environment(const std::string&);

}  // namespace cellwalk
