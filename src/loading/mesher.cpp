// SPDX-License-Identifier: GPL-3.0-or-later
// The meshing component of a full build: TetGen, Mesh_3 and the triangulation of domains.
#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/internal/loading/report.h>
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/internal/meshing/repair_surface.h>
#include <cellwalk/internal/meshing/tissue.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/meshing/triangulate.h>

#include <fmt/core.h>

#include <chrono>
#include <string>
#include <utility>

namespace cellwalk {
namespace {

nlohmann::ordered_json to_json(const Surface_report& surface) {
  return {{"points_read", surface.points_read},
          {"facets_read", surface.facets_read},
          {"merged_points", surface.merged_points},
          {"unused_points", surface.unused_points},
          {"collapsed_facets", surface.collapsed_facets},
          {"triangulated_facets", surface.triangulated_facets},
          {"turned_facets", surface.turned_facets},
          {"inside_out", surface.inside_out},
          {"components", surface.components},
          {"volume", surface.volume}};
}

/// The corrections of each surface.
template <class Report>
void add_surfaces(const Report& report, Meshed<3>& meshed) {
  meshed.report["surface"] = to_json(report.surface);
  for (const std::string& line : describe(report.surface)) meshed.lines.push_back("surface: " + line);
  for (std::size_t i = 0; i < report.obstacles.size(); ++i) {
    meshed.report["obstacles"].push_back(to_json(report.obstacles[i]));
    for (const std::string& line : describe(report.obstacles[i]))
      meshed.lines.push_back(fmt::format("obstacle {}: {}", i + 1, line));
  }
}

/// Adds a line with the reason why TetGen needed another tolerance than its own.
void add_tolerance(const std::string& tolerance, Meshed<3>& meshed) {
  if (tolerance.empty()) return;
  meshed.lines.push_back(tolerance);
  meshed.report["tolerance"] = tolerance;
}

[[noreturn]] void refuse_option(const std::string& what) { throw Error(Error_code::usage, what); }

/// The bounds that tetrahedra may violate, in words.
std::string bounds_of(const Tetrahedralize_options& options) {
  std::string text = options.quality > 0 ? fmt::format("quality {:g}", options.quality) : "";
  if (options.cell_size > 0)
    text += fmt::format("{}size {:g}", text.empty() ? "" : " or ", options.cell_size);
  return text;
}

/// The lines that surfaces with and without repairs have in common.
template <class Report>
void add_cells(const Report& report, std::size_t walls, const Tetrahedralize_options& tetgen,
               Meshed<3>& meshed) {
  meshed.lines.push_back(
      fmt::format("TetGen: {} tetrahedra, {} points added inside, all {} surface triangles kept",
                  meshed.soup.cell_count(), report.added_points, walls));
  if (report.out_of_bounds != 0)
    meshed.lines.push_back(
        fmt::format("{} tetrahedra violate the bound of {}", report.out_of_bounds, bounds_of(tetgen)));
  if (report.added_points == tetgen.most_added_points)
    meshed.lines.push_back("refinement stopped at the largest number of points");
  meshed.report = {{"mesher", "tetgen"},
                   {"quality", tetgen.quality},
                   {"cell_size", tetgen.cell_size},
                   {"cells", meshed.soup.cell_count()},
                   {"out_of_bounds", report.out_of_bounds},
                   {"added_points", report.added_points},
                   {"boundary_facets", walls}};
}

std::string place(const Point<3>& p) {
  return fmt::format("({}, {}, {})", rounded(p[0]), rounded(p[1]), rounded(p[2]));
}

nlohmann::ordered_json to_json(const Repaired_part& part) {
  return {{"name", part.name},           {"kind", part.name.substr(0, part.name.find('_'))},
          {"edges", part.edges},         {"facets", part.facets},
          {"centre", part.centre},       {"normal", part.normal},
          {"area", part.area},           {"width", part.width},
          {"off_plane", part.off_plane}, {"doubt", part.doubt}};
}

/// "cap_1: 24 edges, area 130, width 12.9, centre (..), normal (..), up to 3.5 off its plane: the volume
/// depends on it by 5.8 %".
std::string describe(const Repaired_part& part, const Repair_report& report) {
  std::string text = fmt::format("{}: {}area {:.3g}, width {:.3g}, centre {}, normal {}", part.name,
                                 part.edges != 0 ? fmt::format("{} edges, ", part.edges) : "", part.area,
                                 part.width, place(part.centre), place(part.normal));
  constexpr double visible = 1e-4;
  if (part.off_plane > visible * report.size)
    text += fmt::format(", up to {:.2g} off its plane", part.off_plane);
  if (part.doubt > visible * report.volume)
    text += fmt::format(": the volume depends on it by {:.2g} %", 100 * part.doubt / report.volume);
  return text;
}

nlohmann::ordered_json to_json(const Repair_report& report) {
  nlohmann::ordered_json json{{"size", report.size},
                              {"volume", report.volume},
                              {"moved", report.moved},
                              {"winding_error", report.winding_error},
                              {"changes", nlohmann::ordered_json::array()},
                              {"parts", nlohmann::ordered_json::array()}};
  for (const Repair_change& c : report.changes)
    json["changes"].push_back({{"step", c.step},
                               {"text", c.text},
                               {"count", c.count},
                               {"moved", c.measured},
                               {"places", c.places}});
  for (const Repaired_part& part : report.parts) json["parts"].push_back(to_json(part));
  return json;
}

/// Further ones are in the JSON report.
constexpr std::size_t most_parts_listed = 12;

Meshed<3> with_repair(const Surface_soup& surface, const Mesher_options& options,
                      const Tetrahedralize_options& tetgen) {
  Repair_report report;
  Repaired_surface repaired = repair_surface(surface, options.repair, tetgen, report);
  Meshed<3> meshed{std::move(repaired.soup), {}, {}};
  meshed.groups = std::move(repaired.groups);
  for (const Repair_change& change : report.changes) meshed.repairs.push_back(change.text);
  std::size_t listed = 0;
  for (const Repaired_part& part : report.parts)
    if (listed++ < most_parts_listed) meshed.repairs.push_back(describe(part, report));
  if (listed > most_parts_listed)
    meshed.repairs.push_back(fmt::format("and {} smaller ones", listed - most_parts_listed));
  meshed.repairs.push_back(report.moved == 0
                               ? "walls lie on the surface"
                               : fmt::format("walls lie within {:.2g} of the surface, {:.1g} of its size",
                                             report.moved * report.size, report.moved));
  meshed.repaired = to_json(report);
  add_cells(report, report.walls, tetgen, meshed);
  add_tolerance(report.tolerance, meshed);
  return meshed;
}

/// What to say of a closed surface whose inside may not be wanted.
void note_lumen(const Surface_soup& surface, Meshed<3>& meshed) {
  const auto lumen = lumen_around(check_surface(surface));
  if (!lumen) return;
  meshed.lines.push_back(fmt::format(
      "the surface is a thick wall, and its material is free; for the lumen that it surrounds, give "
      "--inside {:.4g},{:.4g},{:.4g}",
      (*lumen)[0], (*lumen)[1], (*lumen)[2]));
  meshed.report["lumen"] = *lumen;
}

Meshed<3> with_tetgen(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                      const Mesher_options& options) {
  if (options.distance != 0)
    refuse_option("--distance goes with --mesher mesh3: TetGen keeps the surface exactly");
  Tetrahedralize_options tetgen;
  tetgen.quality = options.quality.value_or(tetgen.quality);
  tetgen.cell_size = options.cell_size;
  tetgen.keep_obstacles = options.keep_obstacles;
  tetgen.obstacle_names = options.obstacle_names;
  tetgen.limits = {options.time_limit, options.on_wait};
  const bool may_repair = obstacles.empty() && !options.is_strict;
  if (const char* option = option_of_repair(options.repair); option != nullptr && !may_repair)
    refuse_option(fmt::format("{} goes neither with --strict nor with --obstacle", option));
  if (!options.repair.inside.empty()) return with_repair(surface, options, tetgen);
  Tetrahedralize_report report;
  Meshed<3> meshed;
  const auto start = std::chrono::steady_clock::now();
  try {
    meshed.soup = tetrahedralize(surface, obstacles, tetgen, &report);
  } catch (const Error& error) {
    const bool is_imperfect = error.code() == Error_code::input || error.code() == Error_code::not_certified;
    if (!is_imperfect || !may_repair) throw;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (elapsed.count() >= options.time_limit) throw;  // for want of time, not for a defect
    tetgen.limits.seconds -= elapsed.count();
    return with_repair(surface, options, tetgen);
  }
  add_cells(report, report.boundary_facets, tetgen, meshed);
  meshed.report["solid_cells"] = report.solid_cells;
  add_tolerance(report.tolerance, meshed);
  add_surfaces(report, meshed);
  if (obstacles.empty() && !options.is_strict && !options.repair.is_solid) note_lumen(surface, meshed);
  return meshed;
}

Meshed<3> with_mesh3(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                     const Mesher_options& options) {
  if (options.quality)
    refuse_option("--quality goes with --mesher tetgen: the cells of Mesh_3 have a bound of 2");
  if (options.keep_obstacles)
    refuse_option("--keep-obstacles goes with --mesher tetgen: Mesh_3 fills no obstacles");
  if (const char* option = option_of_repair(options.repair))
    refuse_option(
        fmt::format("{} goes with --mesher tetgen: Mesh_3 fills closed surfaces only, as they are", option));
  Mesh3_options mesh;
  mesh.cell_size = options.cell_size;
  mesh.facet_distance = options.distance;
  mesh.obstacle_names = options.obstacle_names;
  mesh.limits = {options.time_limit, options.on_wait};
  Mesh3_report report;
  Meshed<3> meshed{mesh3(surface, obstacles, mesh, &report), {}, {}};
  meshed.lines.push_back(
      fmt::format("Mesh_3: {} tetrahedra, {} boundary triangles; the boundary approximates the surface: {} "
                  "from it, it is {} away",
                  meshed.soup.cell_count(), report.boundary_facets, rounded(report.distance_to_surface),
                  rounded(report.distance_from_surface)));
  meshed.report = {{"mesher", "mesh3"},
                   {"cells", meshed.soup.cell_count()},
                   {"boundary_facets", report.boundary_facets},
                   {"distance_to_surface", report.distance_to_surface},
                   {"distance_from_surface", report.distance_from_surface}};
  add_surfaces(report, meshed);
  return meshed;
}

}  // namespace

Mesher_parts mesher_parts() { return {true, has_tetgen()}; }

Meshed<3> mesh_surface(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                       const Mesher_options& options) {
  return options.mesher == Mesher::tetgen ? with_tetgen(surface, obstacles, options)
                                          : with_mesh3(surface, obstacles, options);
}

Meshed<3> add_tissue(Cell_soup<3> cells, double thickness, const Mesher_options& options) {
  Tissue_options tissue;
  tissue.thickness = thickness;
  tissue.quality = options.quality.value_or(tissue.quality);
  tissue.limits = {options.time_limit, options.on_wait};
  Tissue_report report;
  Meshed<3> meshed{surround_by_tissue(std::move(cells), tissue, &report), {}, {}};
  meshed.lines.push_back(
      fmt::format("{} solid tetrahedra to a box from {} to {}, all {} boundary triangles kept",
                  report.solid_cells, place(report.low), place(report.high), report.inner_facets));
  if (report.out_of_bounds != 0)
    meshed.lines.push_back(
        fmt::format("{} of them violate the bound of quality {:g}", report.out_of_bounds, tissue.quality));
  if (report.added_points == tissue.most_added_points)
    meshed.lines.push_back("refinement stopped at the largest number of points");
  meshed.report = {{"thickness", thickness},
                   {"quality", tissue.quality},
                   {"low", report.low},
                   {"high", report.high},
                   {"solid_cells", report.solid_cells},
                   {"added_points", report.added_points},
                   {"inner_facets", report.inner_facets},
                   {"out_of_bounds", report.out_of_bounds}};
  add_tolerance(report.tolerance, meshed);
  return meshed;
}

Meshed<2> mesh_domain(const Planar_domain& domain, const Mesher_options& options) {
  Triangulate_report report;
  Meshed<2> meshed{triangulate(domain, {options.keep_obstacles}, &report), {}, {}};
  meshed.lines.push_back(fmt::format("constrained triangulation: {} triangles, {} membranes",
                                     meshed.soup.cell_count(), report.walls));
  const auto changed = [&meshed](std::size_t count, const char* what) {
    if (count != 0) meshed.lines.push_back(fmt::format("{} {}", count, what));
  };
  changed(report.merged_points, "points merged with others in the same place");
  changed(report.unused_points, "points of no segment left out");
  changed(report.outer_holes, "hole points outside the domain, without effect");
  changed(report.dropped_segments, "segments left out: given twice, or without length");
  meshed.report = {{"mesher", "constrained triangulation"},
                   {"cells", meshed.soup.cell_count()},
                   {"membranes", report.walls},
                   {"merged_points", report.merged_points},
                   {"unused_points", report.unused_points},
                   {"dropped_segments", report.dropped_segments},
                   {"outer_holes", report.outer_holes},
                   {"solid_cells", report.solid_cells}};
  return meshed;
}

}  // namespace cellwalk
