// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments from arrays, files and generators, built without the interpreter lock.
#include "make_environment.h"

#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/internal/loading/report.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.h"

namespace cellwalk::python {
namespace {

Duplicate_vertices to_duplicates(const std::string& word) {
  return choose<Duplicate_vertices>(word, "duplicates",
                                    {{"refuse", Duplicate_vertices::refuse},
                                     {"merge", Duplicate_vertices::merge},
                                     {"keep", Duplicate_vertices::keep}});
}

/// \throw UsageError for two options that exclude each other
Build_options to_build_options(const std::string& duplicates, bool split, bool simplicial) {
  if (simplicial && !split)
    throw Error(Error_code::usage, "simplicial=True splits cells, and split=False refuses them: give one");
  return {to_duplicates(duplicates), split, simplicial, /*keep_map=*/false};
}

/// Builds without the interpreter, and reports the changes.
template <int D>
Shared_world build(Cell_soup<D> soup, const Build_options& options) {
  Build_report built;
  const py::gil_scoped_release released;
  Environment<D> environment = Environment<D>::build(std::move(soup), options, &built);
  const nlohmann::ordered_json report{{"changed", to_json(built)},
                                      {"certificate", to_json(built.certificate, D)}};
  return share(std::move(environment), built.certificate, report.dump(), Groups<D>{});
}

void add_cell(Cell_soup<2>& soup, std::span<const std::uint32_t> v) { add_polygon(soup, v); }

void add_cell(Cell_soup<3>& soup, std::span<const std::uint32_t> v) {
  switch (v.size()) {
    case 4:
      add_tetrahedron(soup, v[0], v[1], v[2], v[3]);
      break;
    case 5:
      add_pyramid(soup, {v[0], v[1], v[2], v[3], v[4]});
      break;
    case 6:
      add_prism(soup, {v[0], v[1], v[2], v[3], v[4], v[5]});
      break;
    default:
      add_hexahedron(soup, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
  }
}

template <int D>
Shared_world of_arrays(const py::object& points, const py::object& cells, const Build_options& options) {
  const auto given = points_of<D>(points, "points");
  const Index_table table = indices_of(cells, "cells", given.size());
  const bool is_known =
      D == 2 ? table.columns >= 3 : (table.columns >= 4 && table.columns <= 6) || table.columns == 8;
  if (!is_known)
    throw py::value_error(fmt::format("cells has {} columns: {}", table.columns,
                                      D == 2 ? "2D cells are polygons of at least 3 points"
                                             : "3D cells are tetrahedra (4), pyramids (5), prisms (6) "
                                               "or hexahedra (8), in the order of VTK"));
  Cell_soup<D> soup;
  soup.points.assign(given.begin(), given.end());
  for (std::size_t i = 0; i < table.rows; ++i) add_cell(soup, table.row(i));
  return build(std::move(soup), options);
}

Shared_world from_arrays(const py::object& points, const py::object& cells, bool split, bool simplicial,
                         const std::string& duplicates) {
  const Build_options options = to_build_options(duplicates, split, simplicial);
  const bool is_planar = py::isinstance<py::array>(points) && points.attr("ndim").cast<int>() == 2 &&
                         points.cast<py::array>().shape(1) == 2;
  return is_planar ? of_arrays<2>(points, cells, options) : of_arrays<3>(points, cells, options);
}

Shared_world load(const py::object& path, const std::string& duplicates) {
  const std::string name = py::str(path);
  const Build_options options{.duplicates = to_duplicates(duplicates), .split = false, .keep_map = false};
  const py::gil_scoped_release released;
  Loaded_environment loaded = load_environment(name, options);
  const nlohmann::ordered_json report{
      {"read", {{"file", name}, {"format", loaded.read.format}, {"notes", loaded.read.notes}}},
      {"changed", to_json(loaded.built)}};
  return share(std::move(loaded.environment), loaded.built.certificate, report.dump(), loaded.groups);
}

/// "auto", "solid", a point, or a list of points.
void set_inside(const py::object& inside, Repair_options& repair) {
  if (py::isinstance<py::str>(inside)) {
    repair.is_solid = choose<bool>(inside.cast<std::string>(), "inside", {{"auto", false}, {"solid", true}});
    return;
  }
  const auto points = inside.cast<py::sequence>();
  if (py::len(points) != 0 && py::isinstance<py::sequence>(points[0]))
    repair.inside = inside.cast<std::vector<Point<3>>>();
  else
    repair.inside = {inside.cast<Point<3>>()};
}

/// "exact", "off", or a part of the diagonal.
std::optional<double> to_conform(const std::variant<std::string, double>& value) {
  if (const auto* part = std::get_if<double>(&value)) return *part;
  return choose<std::optional<double>>(std::get<std::string>(value), "conform",
                                       {{"exact", 0.0}, {"off", std::nullopt}});
}

Shared_world import_mesh(const py::object& path, const std::vector<py::object>& obstacles, bool split,
                         bool simplicial, const std::string& duplicates, const std::string& mesher,
                         std::optional<double> quality, double cell_size, double distance,
                         bool keep_obstacles, double tissue, double time_limit, bool strict,
                         const py::object& inside, const std::variant<std::string, double>& conform) {
  const std::string name = py::str(path);
  Import_options options;
  options.conform = to_conform(conform);
  options.tissue = tissue;
  for (const py::object& obstacle : obstacles) options.obstacles.push_back(py::str(obstacle));
  options.mesher = {choose<Mesher>(mesher, "mesher", {{"tetgen", Mesher::tetgen}, {"mesh3", Mesher::mesh3}}),
                    quality, cell_size, distance, keep_obstacles};
  options.mesher.time_limit = time_limit;
  options.mesher.is_strict = strict;
  set_inside(inside, options.mesher.repair);
  options.mesher.on_wait = [] {  // Ctrl-C ends the mesher
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  options.build = to_build_options(duplicates, split, simplicial);
  const py::gil_scoped_release released;
  Imported_environment imported = import_environment(name, options);
  return share(std::move(imported.environment), imported.built.certificate, imported.report.json.dump(),
               imported.groups);
}

/// Numbers, sequences of numbers and truth values, as generators take them.
Shared_world generate_environment(const std::string& kind, bool simplicial, const py::kwargs& given) {
  Generator_values values;
  for (const auto& [name, value] : given)
    values[std::string(py::str(name))] = py::isinstance<py::sequence>(value)
                                             ? value.cast<std::vector<double>>()
                                             : std::vector<double>{value.cast<double>()};
  Any_soup soup = generate(kind, values);
  Build_options options = build_of_generated;
  options.simplicial = simplicial;
  return std::visit([&](auto& cells) { return build(std::move(cells), options); }, soup);
}

}  // namespace

void bind_makers(Environment_class& environment) {
  environment
      .def(
          py::init(&from_arrays), py::arg("points"), py::arg("cells"), py::kw_only(), py::arg("split") = true,
          py::arg("simplicial") = false, py::arg("duplicates") = "refuse",
          "Makes an environment from arrays: points float64 (N, 3) with cells integer (M, 4), (M, 5), (M, 6) "
          "or (M, 8) "
          "(tetrahedra, pyramids, prisms, hexahedra, in the order of VTK), or points (N, 2) with polygons "
          "(M, k), "
          "counterclockwise. Its boundary facets are walls.\n\n"
          "split: cells that are not exactly convex are split; otherwise they are refused.\n"
          "simplicial: all cells are split into tetrahedra, or triangles, as walls need that move: see "
          "reshape().\n"
          "duplicates: points with equal coordinates: \"refuse\", \"merge\", or \"keep\" apart (as a slit).")
      .def_static("load", &load, py::arg("path"), py::kw_only(), py::arg("duplicates") = "refuse",
                  "Reads a file of cells and certifies it unchanged.")
      .def_static(
          "import_mesh", &import_mesh, py::arg("path"), py::kw_only(),
          py::arg("obstacles") = std::vector<py::object>{}, py::arg("split") = true,
          py::arg("simplicial") = false, py::arg("duplicates") = "refuse", py::arg("mesher") = "tetgen",
          py::arg("quality") = py::none(), py::arg("cell_size") = 0.0, py::arg("distance") = 0.0,
          py::arg("keep_obstacles") = false, py::arg("tissue") = 0.0,
          py::arg("time_limit") = Mesher_options{}.time_limit, py::arg("strict") = false,
          py::arg("inside") = "auto", py::arg("conform") = "exact",
          "Makes an environment from any mesh file, as `cellwalk import` does: cells are split if "
          "necessary, a "
          "surface is filled with tetrahedra, without the obstacles, and a planar domain with "
          "triangles. `report` lists all changes.\n\n"
          "simplicial: all cells are split into tetrahedra, or triangles, as walls need that move: "
          "see reshape().\n"
          "tissue: if not 0, 3D cells are surrounded by solid ones up to a box at this distance.\n"
          "time_limit: seconds that a mesher may take in all, in a process of its own.\n"
          "strict: surfaces that are open, not manifold or cross themselves are refused; otherwise "
          "they are repaired, and caps, mouths and sheets are groups of facets.\n"
          "inside: the free space: \"auto\", what the surface encloses, or the lumen of a thick wall; "
          "\"solid\", always what it encloses; a point or points in it.\n"
          "conform: cells of a file that overlap in a plane without a common facet get one: "
          "\"exact\", or within this part of the diagonal; \"off\": they are refused.")
      .def_static(
          "generate", &generate_environment, py::arg("kind"), py::kw_only(), py::arg("simplicial") = false,
          "Generates an environment. Kinds and options are those of `cellwalk "
          "generate`, with _ for "
          "-: generate(\"hexes\", cells=(10, 10, 10), solid=0.05). One number stands for all axes.\n\n"
          "simplicial: all cells are split into tetrahedra, or triangles, as walls need that move: "
          "see reshape().");
}

}  // namespace cellwalk::python
