// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forms.h"

#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/walk.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include "box_world.h"
#include "common/processor_time.h"
#include "random_flights.h"

namespace cellwalk::ablation {
namespace {

/// Turned by a matrix whose entries are not exact: facets are planar up to rounding.
Cell_soup<3> turned(Cell_soup<3> soup) {
  constexpr std::array<Vector<3>, 3> axes{Vector<3>{0.36, 0.48, -0.8}, Vector<3>{-0.8, 0.6, 0},
                                          Vector<3>{0.48, 0.64, 0.6}};
  for (Point<3>& x : soup.points) x = Point<3>{dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)};
  return soup;
}

Cell_soup<3> cells_of(const Form_setting& setting) {
  if (!setting.file.empty()) {
    io::Mesh_file file = io::read_mesh(setting.file.string());
    if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh)) return std::move(*soup);
    throw Error(Error_code::input, fmt::format("{}: holds no 3D cells", setting.file.string()));
  }
  const std::uint32_t n = setting.is_small ? 6 : 30;
  if (setting.mesh == "frusta_around_boxes") return small_obstacles::box_world<3>({n / 2, 0.25, 1}).soup();
  Grid_options<3> options;
  options.cells = Grid_options<3>::filled(n);
  options.solid_share = 0.08;
  Cell_soup<3> soup = hex_grid(options);
  return setting.mesh == "hexahedra_turned" ? turned(std::move(soup)) : soup;
}

Form_row built(const Form_setting& setting, const Cell_soup<3>& soup, bool simplicial,
               std::optional<Environment<3>>& environment) {
  Build_report report;
  environment.emplace(Environment<3>::build(
      soup, {.duplicates = Duplicate_vertices::keep, .simplicial = simplicial, .keep_map = false}, &report));
  const Snapshot<3>& snapshot = environment->snapshot();
  Form_row row;
  row.mesh = setting.mesh;
  row.form = simplicial ? "tetrahedra" : "polyhedra";
  row.cells_read = report.cells_read;
  row.not_planar = report.split.not_planar;
  row.not_convex = report.split.not_convex;
  row.cells = snapshot.cell_count();
  row.bytes = snapshot.bytes();
  for (std::uint32_t f = 0; f < snapshot.half_facet_slots(); ++f) {
    const Cell cell = snapshot.cell_of(Half_facet{f});
    row.facets += snapshot.is_cell(cell) && snapshot.facet_of(Half_facet{f}) < snapshot.facet_count(cell);
  }
  return row;
}

/// Makes the moves, particle after particle, round and round. Returns seconds.
double make_moves(const Snapshot<3>& snapshot, std::vector<Particle<3>> particles,
                  const std::vector<Vector<3>>& moves, Walk_counts& counts, std::uint64_t& blocked) {
  Walk_options options;
  options.locates_contact = false;
  const double start = experiments::processor_seconds();
  for (std::size_t i = 0; i < moves.size(); ++i) {
    Particle<3>& p = particles[i % particles.size()];
    const Point<3> target = p.position + moves[i];
    blocked += move(snapshot, p, target, counts, options).status == Walk_status::contact;
  }
  return experiments::processor_seconds() - start;
}

}  // namespace

std::vector<Form_setting> form_settings(bool is_small, const std::filesystem::path& data,
                                        std::uint64_t seed) {
  std::vector<Form_setting> settings;
  for (const char* mesh : {"hexahedra", "hexahedra_turned", "frusta_around_boxes"})
    settings.push_back({mesh, {}, is_small, seed});
  if (data.empty()) return settings;
  for (const char* file : {"Cube_with_props.ovm", "Cylinder.ovm", "cylinder_Hexa.msh", "ellipsoid.mesh"})
    settings.push_back({file, data / "hex_poly" / file, is_small, seed});
  return settings;
}

std::vector<Form_row> run_forms(const Form_setting& setting, int rounds) {
  const Cell_soup<3> soup = cells_of(setting);
  std::array<std::optional<Environment<3>>, 2> forms;
  std::vector<Form_row> rows;
  for (const bool simplicial : {false, true})
    rows.push_back(built(setting, soup, simplicial, forms[simplicial]));
  std::array<std::vector<Particle<3>>, 2> starts;
  std::vector<Vector<3>> moves;
  const std::size_t count = setting.is_small ? 1'000 : 20'000;
  for (std::size_t i = 0; i < 2; ++i) {
    Random random(setting.seed);
    const Snapshot<3>& snapshot = forms[i]->snapshot();
    starts[i] = random_starts(snapshot, count, random);
    if (i == 0) moves = random_moves(0.5 * edge_length(snapshot, starts[i]), 10 * count, random);
    Walk_counts counts;
    make_moves(snapshot, starts[i], moves, counts, rows[i].blocked);
    rows[i].moves = moves.size();
    rows[i].crossings = counts.crossings;
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < 2; ++i) {
      Walk_counts counts;
      std::uint64_t blocked = 0;
      const double seconds = make_moves(forms[i]->snapshot(), starts[i], moves, counts, blocked);
      rows[i].nanoseconds.push_back(1e9 * seconds / static_cast<double>(moves.size()));
    }
  return rows;
}

}  // namespace cellwalk::ablation
