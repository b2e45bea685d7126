// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments: from files, recipes and arrays; their content; queries of points and edges without known
// cells.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/internal/loading/report.h>
#include <cellwalk/internal/query/kernel_choice.h>
#include <cellwalk/query/query.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>

#include "bind_edits.h"
#include "make_environment.h"
#include "mesh_arrays.h"
#include "module.h"
#include "motions.h"
#include "options.h"
#include "pickling.h"
#include "reshape.h"

namespace cellwalk::python {

Shared_world share(Any_environment environment, const Certificate& certificate, std::string report,
                   const Any_groups& groups) {
  return std::visit(
      [&]<int D>(Environment<D>& built) -> Shared_world {
        built.freeze();
        return {std::make_shared<Any_world>(std::in_place_type<World<D>>, std::move(built), certificate,
                                            std::get<Groups<D>>(groups)),
                std::move(report)};
      },
      environment);
}

namespace {

py::object from_json(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

/// Where points are, as arrays.
struct Locations {
  py::array_t<std::uint8_t> status, dimension;
  py::array_t<std::int32_t> cell;
  py::array_t<std::uint32_t> sides;
};

Locations locate(const Shared_world& self, const py::object& points, int threads) {
  return std::visit(
      [&]<int D>(const World<D>& world) {
        const auto asked = points_of<D>(points, "points");
        const auto n = static_cast<py::ssize_t>(asked.size());
        Locations found{py::array_t<std::uint8_t>(n), py::array_t<std::uint8_t>(n),
                        py::array_t<std::int32_t>(n), py::array_t<std::uint32_t>(n)};
        auto *status = found.status.mutable_data(), *dimension = found.dimension.mutable_data();
        auto* cell = found.cell.mutable_data();
        auto* sides = found.sides.mutable_data();
        const typename World<D>::Reading reading(world);
        const Snapshot<D>& snapshot = reading.snapshot();
        const Locator<D>& locator = reading.locator();
        for_each_chunk(asked.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const Location<D> at = is_finite(asked[i]) ? locator.locate(asked[i]) : Location<D>{};
            status[i] = static_cast<std::uint8_t>(at.status);
            dimension[i] = static_cast<std::uint8_t>(at.dimension);
            cell[i] = number_of(snapshot, at.cell);
            sides[i] = static_cast<std::uint32_t>(at.sides.size());
          }
        });
        return found;
      },
      *self.world);
}

Motions walk_points(const Shared_world& self, const py::object& starts, const py::object& targets,
                    const std::string& touch, const std::string& kernel, const py::object& radius,
                    int threads) {
  check_threads(threads);
  const Touch stop_or_pass = to_touch(touch);
  Walk_method method;
  method.kernel = choose<Kernel_choice>(kernel, "kernel",
                                        {{"exact", Kernel_choice::exact},
                                         {"lazy", Kernel_choice::lazy},
                                         {"double", Kernel_choice::double_precision},
                                         {"float", Kernel_choice::float_precision}});
  if (method.kernel != Kernel_choice::exact) {
    method.strategy = Walk_strategy::exit_rule;
    if (stop_or_pass == Touch::stop)
      throw Error(Error_code::usage, "touch=\"stop\" needs kernel=\"exact\": touches are found exactly only");
  }
  return std::visit(
      [&]<int D>(const World<D>&) {
        const auto from = points_of<D>(starts, "starts"), to = points_of<D>(targets, "targets");
        need_rows(to, "targets", from.size(), "starts");
        const Radii radii(radius, from.size(), "starts");
        if (!radii.are_all_0() && method.kernel != Kernel_choice::exact)
          throw Error(Error_code::usage, "a radius needs kernel=\"exact\": distances are exact only");
        return run_questions<D>(self.world, from.size(), threads,
                                [&](const Snapshot<D>& snapshot, const Locator<D>& locator, std::size_t row,
                                    Edge_counts& counts) -> Answer<D> {
                                  if (!is_usable(from[row]) || !is_usable(to[row])) return {};
                                  return radii[row] == 0 ? answer_move(snapshot, locator, from[row], to[row],
                                                                       stop_or_pass, method, counts)
                                                         : answer_move(snapshot, locator, from[row], to[row],
                                                                       stop_or_pass, counts, radii[row]);
                                });
      },
      *self.world);
}

Motions sweep_edges(const Shared_world& self, const py::object& p, const py::object& targets,
                    const py::object& q, const std::string& sweep, const std::string& touch,
                    const std::string& search, const std::string& search_cells, double tolerance,
                    const std::string& search_limit, const py::object& radius, int threads) {
  check_threads(threads);
  Search_options searched;
  const Sweep_options options =
      to_sweep_options({sweep, touch, search, search_cells, tolerance, search_limit}, searched);
  return std::visit(
      [&]<int D>(const World<D>&) {
        const auto from = points_of<D>(p, "p"), to = points_of<D>(targets, "targets"),
                   other = points_of<D>(q, "q");
        need_rows(to, "targets", from.size(), "p");
        need_rows(other, "q", from.size(), "p");
        const Radii radii(radius, from.size(), "p");
        return run_questions<D>(self.world, from.size(), threads,
                                [&](const Snapshot<D>& snapshot, const Locator<D>& locator, std::size_t row,
                                    Edge_counts& counts) -> Answer<D> {
                                  if (!is_usable(from[row]) || !is_usable(to[row]) || !is_usable(other[row]))
                                    return {};
                                  return answer_sweep(
                                      snapshot, locator,
                                      Edge_motion<D>{from[row], to[row], other[row], radii[row]}, options,
                                      counts);
                                });
      },
      *self.world);
}

py::array points(const Shared_world& self) {
  return std::visit(
      [&]<int D>(const World<D>& world) {
        auto shown = [&] { return typename World<D>::Looking(world).points(); }();
        const std::vector<Point<D>>& all = *shown;
        using Kept = std::shared_ptr<const std::vector<Point<D>>>;
        const py::capsule owner(new Kept(std::move(shown)),
                                [](void* kept) { delete static_cast<Kept*>(kept); });
        return view_of(all.data()->data(), all.size(), D, sizeof(Point<D>), owner);
      },
      *self.world);
}

/// Facets that are walls, each once.
template <int D>
std::size_t wall_count(const Snapshot<D>& snapshot) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(cell, k);
      const Cell other = snapshot.neighbour(f);
      count += snapshot.is_impassable(f) && (other == Cell::none || to_index(other) > to_index(cell));
    }
  }
  return count;
}

/// The cells, then the walls as polygons or lines.
template <int D>
io::Vtu_grid for_viewers(const Cell_soup<D>& soup) {
  io::Vtu_grid grid = io::vtu_of_cells(soup);
  const io::Vtu_grid walls = io::vtu_of_walls(soup);
  std::vector<std::int64_t> cells = std::get<std::vector<std::int64_t>>(grid.cell_data[0].values);
  std::vector<std::int64_t> solid = std::get<std::vector<std::int64_t>>(grid.cell_data[1].values);
  std::vector<std::int64_t> is_wall(grid.cell_count(), 0);
  const auto& of_walls = std::get<std::vector<std::int64_t>>(walls.cell_data[0].values);
  auto corner = walls.connectivity.begin();
  for (std::size_t i = 0; i < walls.cell_count(); ++i) {
    const auto end = walls.connectivity.begin() + walls.offsets[i];
    grid.add_cell(static_cast<io::Vtu_cell>(walls.types[i]), std::vector<std::uint32_t>(corner, end));
    corner = end;
    cells.push_back(of_walls[i]);
    solid.push_back(0);
    is_wall.push_back(1);
  }
  grid.cell_data = {
      {"cell", 1, std::move(cells)}, {"solid", 1, std::move(solid)}, {"wall", 1, std::move(is_wall)}};
  return grid;
}

void save_for_viewers(const Shared_world& self, const std::string& name) {
  std::visit(
      [&]<int D>(const World<D>& world) {
        const typename World<D>::Looking looking(world);
        io::write_vtu(name, for_viewers(looking.soup()));
      },
      *self.world);
}

void save(const Shared_world& self, const py::object& path) {
  const std::string name = path_of(path);
  const std::string extension = std::filesystem::path(name).extension();
  if (extension == ".vtu") return save_for_viewers(self, name);
  if (extension != ".ovm" && !is_compiled_name(name))
    throw Error(Error_code::usage,
                fmt::format("{}: environments are saved as OpenVolumeMesh (*.ovm), compiled "
                            "(*.cellwalk), or for viewers as VTU (*.vtu)",
                            name));
  const std::vector<std::byte> bytes = compiled_bytes(self);
  const py::gil_scoped_release released;
  Any_compiled_environment copy = open_compiled_copy(bytes);  // without the memory that edits left unused
  std::visit(
      [&]<int D>(Compiled_environment<D>& compiled) {
        io::Atomic_file file(name);
        write_environment<D>(file, compiled.environment, compiled.certificate, std::move(compiled.groups));
        file.commit();
      },
      copy);
}

py::object certificate(const Shared_world& self) {
  const Certificate found = std::visit(
      [&]<int D>(const World<D>& world) { return typename World<D>::Reading(world).certificate(); },
      *self.world);
  return from_json(to_json(found, self.dimension()).dump());
}

}  // namespace

void bind_environment(py::module_& module) {
  py::class_<Locations>(module, "Locations", "The locations of points, row by row.")
      .def_readonly("status", &Locations::status, "uint8 (N,): codes of Place.")
      .def_readonly(
          "cell", &Locations::cell,
          "int32 (N,): the free cell of lowest number whose closure contains the point; -1 if there is none.")
      .def_readonly(
          "dimension", &Locations::dimension,
          "uint8 (N,): the dimension of the lowest cell of the complex that contains the point; 0: a vertex.")
      .def_readonly(
          "sides", &Locations::sides,
          "uint32 (N,): the number of sides of walls with free space at the point; 1 off membranes.")
      .def("__len__", [](const Locations& self) { return self.status.size(); })
      .def("__repr__", [](const Locations& self) {
        const auto* const status = self.status.data();
        return fmt::format("<cellwalk.Locations of {} rows, {} free>", self.status.size(),
                           std::count(status, status + self.status.size(),
                                      static_cast<std::uint8_t>(Location_status::free)));
      });

  Environment_class environment(module, "Environment",
                                "A certified complex of convex cells, some of whose facets are walls. "
                                "Threads can share it: only reshape() and editing() change it, and wait "
                                "until they are alone.");
  bind_makers(environment);
  bind_mesh_arrays(module, environment);
  bind_reshape(module, environment);
  bind_edits(module, environment);
  bind_pickles(environment);
  environment.def_property_readonly("dimension", &Shared_world::dimension, "2 or 3.")
      .def_property_readonly(
          "cell_count",
          [](const Shared_world& self) {
            return std::visit(
                []<int D>(const World<D>& world) {
                  return typename World<D>::Looking(world).snapshot().cell_count();
                },
                *self.world);
          },
          "Number of cells, solid ones included.")
      .def_property_readonly(
          "points", points,
          "float64 (N, dimension): the vertices, as a read-only view that changes as they move. After edits "
          "that add points, ask again: earlier views stay as they were.")
      .def_property_readonly("certificate", certificate,
                             "The counts, volumes, walls and components found by certification, which is "
                             "done again when this is "
                             "asked for after walls moved.")
      .def_property_readonly(
          "report", [](const Shared_world& self) { return from_json(self.report); },
          "The report of reading, meshing and changes when the environment was made, as written by `cellwalk "
          "import --json`.")
      .def(
          "save", save, py::arg("path"),
          "Writes a file. *.ovm, or *.cellwalk, which is mapped into memory instead of parsed: all of it, "
          "for "
          "load() and every command of the program. *.vtu, for viewers such as ParaView: the cells, then the "
          "walls as polygons, in 2D lines, with the data `cell`, `solid` and `wall`. Read again, that is "
          "cells "
          "only.")
      .def(
          "locate",
          [](const Shared_world& self, const py::object& points, int threads) {
            check_threads(threads);
            return locate(self, points, threads);
          },
          py::arg("points"), py::kw_only(), py::arg("threads") = 0,
          "Finds the cells that contain points, exactly. Rows that are not finite are outside.")
      .def("walk", walk_points, py::arg("starts"), py::arg("targets"), py::kw_only(),
           py::arg("touch") = "pass", py::arg("kernel") = "exact", py::arg("radius") = 0.0,
           py::arg("threads") = 0,
           "Answers motions of points from starts[i] to targets[i]: locates the starts, then walks. For "
           "points "
           "that move repeatedly, Particles are faster, since they remember their cells.\n\n"
           "touch: \"pass\": walls may be touched; \"stop\": touches are contacts.\n"
           "kernel: \"exact\", \"lazy\"; \"double\" and \"float\" may miss walls and are for experiments.\n"
           "radius: a number, or a float64 array (N,): how far each point keeps from every wall, exactly.\n"
           "threads: 0: all cores. The answers do not depend on it.")
      .def(
          "sweep", sweep_edges, py::arg("p"), py::arg("targets"), py::arg("q"), py::kw_only(),
          py::arg("sweep") = "triangle", py::arg("touch") = "pass", py::arg("search") = "exact",
          py::arg("search_cells") = "flooded", py::arg("tolerance") = 0x1p-20,
          py::arg("search_limit") = "below", py::arg("radius") = 0.0, py::arg("threads") = 0,
          "Answers motions of edges: the end p[i] moves to targets[i] while the end q[i] stands still.\n\n"
          "sweep: \"triangle\": the whole swept triangle; \"three_segments\": the path of p, then the edge, "
          "as "
          "in the paper; \"faces\": the same as triangle, since an edge has no face.\n"
          "touch: \"pass\": walls may be touched; \"stop\": touches are contacts.\n"
          "search: the method that locates a contact: \"exact\", \"dichotomic\" (within tolerance), "
          "\"dichotomic_segment\" (the paper's, which may be late) or \"exhaustive\".\n"
          "search_cells, search_limit: of the exhaustive search: obstacles in the cells that are \"flooded\" "
          "or \"traversed\", \"below\" the edge at its end, or \"none\" for no limit, with the same result.\n"
          "radius: a number, or a float64 array (N,): how far each edge keeps from every wall, exactly.\n"
          "threads: 0: all cores. The answers do not depend on it.")
      .def("__repr__", [](const Shared_world& self) {
        return std::visit(
            []<int D>(const World<D>& world) {
              const auto [cells, walls] = [&] {
                const typename World<D>::Looking looking(world);
                return std::pair(looking.snapshot().cell_count(), wall_count(looking.snapshot()));
              }();
              return fmt::format("<cellwalk.Environment, {}D, {} cells, {} walls>", D, cells, walls);
            },
            *self.world);
      });
}

}  // namespace cellwalk::python
