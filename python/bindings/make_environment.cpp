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
#include "cell_arrays.h"

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
/// \param notes of what was left out before
template <int D>
Shared_world build(Cell_soup<D> soup, const Build_options& options, std::vector<std::string> notes = {}) {
  Build_report built;
  const py::gil_scoped_release released;
  Environment<D> environment = Environment<D>::build(std::move(soup), options, &built);
  nlohmann::ordered_json report;
  if (!notes.empty()) report["read"] = {{"notes", std::move(notes)}};
  report["changed"] = to_json(built);
  report["certificate"] = to_json(built.certificate, D);
  return share(std::move(environment), built.certificate, report.dump(), Groups<D>{});
}

/// The points of a plane that are given in space.
/// \throw Error(input) unless their third coordinates are 0
std::vector<Point<2>> flat(const Points<3>& points) {
  std::vector<Point<2>> result;
  result.reserve(points.size());
  for (const Point<3>& x : points) {
    if (x[2] != 0)
      throw Error(
          Error_code::input,
          fmt::format("points[{}] has z = {}, and all cells are polygons: a surface is no environment; "
                      "write it to a file, and import_mesh() fills it",
                      result.size(), x[2]));
    result.push_back({x[0], x[1]});
  }
  return result;
}

template <int D>
void set_solid(Cell_soup<D>& soup, const py::object& solid) {
  const py::array given = as_array(solid);
  if (given.dtype().kind() != 'b') refuse_type("solid", "a boolean array", solid);
  if (given.ndim() != 1 || static_cast<std::size_t>(given.size()) != soup.cell_count())
    refuse_shape("solid", shape_text(given),
                 fmt::format("({},), one for each of the cells,", soup.cell_count()));
  const auto values = py::array_t<bool, py::array::c_style>(given);
  std::copy_n(values.data(), soup.cell_count(), soup.solid.begin());
}

template <int D>
Shared_world of_cells(std::vector<Point<D>> points, const Given_cells& given, const py::object& solid,
                      const py::object& walls, const Build_options& options) {
  Cell_soup<D> soup;
  soup.points = std::move(points);
  std::vector<std::string> notes;
  for (const auto& [name, count] : add_cells(soup, given))
    notes.push_back(fmt::format("{} of type {} are no cells in {}D: left out", count, name, D));
  if (!solid.is_none()) set_solid(soup, solid);
  if (!walls.is_none()) add_walls(soup, walls);
  return build(std::move(soup), options, std::move(notes));
}

Shared_world from_arrays(const py::object& points, const py::object& cells, const py::object& celltypes,
                         const py::object& solid, const py::object& walls, bool split, bool simplicial,
                         const std::string& duplicates) {
  const Build_options options = to_build_options(duplicates, split, simplicial);
  const py::array array = as_array(points);
  if (array.ndim() == 2 && array.shape(1) == 2) {
    const Points<2> at(array, "points");
    return of_cells<2>({at.begin(), at.end()}, cells_of(cells, celltypes, "cells", "polygon", at.size()),
                       solid, walls, options);
  }
  const Points<3> at(array, "points");
  const Given_cells given = cells_of(cells, celltypes, "cells", "", at.size());
  return given.dimension() == 2 ? of_cells<2>(flat(at), given, solid, walls, options)
                                : of_cells<3>({at.begin(), at.end()}, given, solid, walls, options);
}

Shared_world load(const py::object& path, const std::string& duplicates) {
  const std::string name = path_of(path);
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
  if (as_array(inside).ndim() == 1) {
    repair.inside = {point_of<3>(inside, "inside")};
    return;
  }
  const Points<3> points(inside, "inside");
  repair.inside.assign(points.begin(), points.end());
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
  const std::string name = path_of(path);
  Import_options options;
  options.conform = to_conform(conform);
  options.tissue = tissue;
  for (const py::object& obstacle : obstacles) options.obstacles.push_back(path_of(obstacle));
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
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key);
    py::array array = as_array(value);
    if (array.dtype().kind() == 'b') array = array.attr("astype")("float64");
    if (array.ndim() == 0) array = array.attr("reshape")(1);
    const Number_rows numbers(array, name.c_str(), 0);
    values[name].assign(numbers.data(), numbers.data() + numbers.size());
  }
  Any_soup soup = generate(kind, values);
  Build_options options = build_of_generated;
  options.simplicial = simplicial;
  return std::visit([&](auto& cells) { return build(std::move(cells), options); }, soup);
}

}  // namespace

void bind_makers(Environment_class& environment) {
  environment
      .def_static(
          "from_arrays", &from_arrays, py::arg("points"), py::arg("cells"), py::arg("celltypes") = py::none(),
          py::kw_only(), py::arg("solid") = py::none(), py::arg("walls") = py::none(),
          py::arg("split") = true, py::arg("simplicial") = false, py::arg("duplicates") = "refuse",
          "Makes an environment of arrays: points (N, 3), or (N, 2) in the plane, and cells. Facets on its "
          "boundary, and between free and solid cells, are walls.\n\n"
          "cells: integers (M, k): tetrahedra (k = 4), pyramids (5), wedges (6) or hexahedra (8), in the "
          "plane "
          "polygons, counterclockwise, that may end with -1. Or blocks of them by type, as meshio has them: "
          "a "
          "list of pairs of a type, such as \"tetra\", and an array, or a dictionary; also by the numbers of "
          "VTK, as PyVista has them. Or, with celltypes, the flat array of VTK and PyVista. The order of "
          "corners "
          "is that of meshio or VTK, which differ for wedges. Polygons in space with z = 0 throughout are "
          "cells "
          "of the plane; beside other cells, those of lower dimension are left out, with a note in "
          "`report`.\n"
          "celltypes: integers (M,): the types, by the numbers of VTK.\n"
          "solid: bool (M,): the cells that are not free.\n"
          "walls: facets that are walls too, in the forms of cells: corners (K, k), that may end with -1.\n"
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
