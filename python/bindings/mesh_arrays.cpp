// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells of an environment in the flat arrays of VTK and PyVista, and in the blocks of meshio.
#include "mesh_arrays.h"

#include <cellwalk/internal/io/vtu.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "cell_tables.h"

namespace cellwalk::python {
namespace {

using io::Vtu_cell;
using io::Vtu_grid;

/// The class MeshArrays of Python.
struct Mesh_arrays {
  py::array points, cells, celltypes, solid, walls;
  Vtu_grid grid;  ///< without points
};

std::span<const std::int64_t> part(const std::vector<std::int64_t>& values,
                                   const std::vector<std::int64_t>& ends, std::size_t i) {
  const auto begin = i == 0 ? 0 : ends[i - 1];
  return std::span(values).subspan(static_cast<std::size_t>(begin),
                                   static_cast<std::size_t>(ends[i] - begin));
}

/// The stream of the faces of each polyhedron: the end of the last one before it is its begin.
class Face_streams {
 public:
  explicit Face_streams(const Vtu_grid& grid) : grid_(grid) {}
  /// \pre called with polyhedra in ascending order
  std::span<const std::int64_t> operator[](std::size_t cell) {
    const std::int64_t begin = std::exchange(end_, grid_.face_offsets[cell]);
    return std::span(grid_.faces)
        .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end_ - begin));
  }

 private:
  const Vtu_grid& grid_;
  std::int64_t end_ = 0;
};

bool is_polyhedron(const Vtu_grid& grid, std::size_t cell) {
  return grid.types[cell] == static_cast<std::uint8_t>(Vtu_cell::polyhedron);
}

/// Each cell after the number of its corners; of a polyhedron, the stream of its faces after its length.
std::vector<std::int64_t> flat_cells(const Vtu_grid& grid) {
  std::vector<std::int64_t> cells;
  Face_streams faces(grid);
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const auto row = is_polyhedron(grid, i) ? faces[i] : part(grid.connectivity, grid.offsets, i);
    cells.push_back(static_cast<std::int64_t>(row.size()));
    cells.insert(cells.end(), row.begin(), row.end());
  }
  return cells;
}

py::array_t<std::int64_t> to_table(std::vector<std::int64_t>&& values, std::size_t columns) {
  const auto rows = static_cast<py::ssize_t>(values.size() / columns);
  return to_array(std::move(values)).reshape({rows, static_cast<py::ssize_t>(columns)});
}

/// A table of loops, filled up with -1.
struct Loops {
  std::vector<std::int64_t> corners;
  std::size_t width = 0;
};

/// The facets that are walls, each once.
template <int D>
Loops walls_of(const Snapshot<D>& snapshot) {
  std::vector<std::vector<std::uint32_t>> loops;
  Loops walls;
  walls.width = D;
  for (const Half_facet f : all_of(snapshot).facets) {
    if (!snapshot.is_impassable(f)) continue;
    loops.push_back(snapshot.loop(f));
    walls.width = std::max(walls.width, loops.back().size());
  }
  walls.corners.assign(loops.size() * walls.width, -1);
  for (std::size_t i = 0; i < loops.size(); ++i)
    std::ranges::copy(loops[i], walls.corners.begin() + static_cast<std::ptrdiff_t>(i * walls.width));
  return walls;
}

Mesh_arrays to_arrays(const Shared_world& self) {
  return std::visit(
      []<int D>(const World<D>& world) {
        Vtu_grid grid;
        Cell_soup<D> soup;
        Loops walls;
        std::vector<std::int64_t> cells;
        {
          const typename World<D>::Looking looking(world);
          soup = looking.soup();
          grid = io::vtu_of_cells(soup);
          walls = walls_of(looking.snapshot());
          cells = flat_cells(grid);
        }
        py::array_t<double> points({soup.points.size(), std::size_t{D}});
        std::copy_n(reinterpret_cast<const double*>(soup.points.data()), D * soup.points.size(),
                    points.mutable_data());
        py::array_t<bool> solid(static_cast<py::ssize_t>(soup.solid.size()));
        std::ranges::copy(soup.solid, solid.mutable_data());
        py::array_t<std::uint8_t> types(static_cast<py::ssize_t>(grid.types.size()), grid.types.data());
        return Mesh_arrays{std::move(points),
                           to_array(std::move(cells)),
                           std::move(types),
                           std::move(solid),
                           to_table(std::move(walls.corners), walls.width),
                           std::move(grid)};
      },
      *self.world);
}

/// The faces of a polyhedron as lists.
py::list faces_of(std::span<const std::int64_t> stream) {
  py::list faces;
  for (std::size_t k = 1; k < stream.size(); k += static_cast<std::size_t>(stream[k]) + 1) {
    py::list face;
    for (const std::int64_t corner : stream.subspan(k + 1, static_cast<std::size_t>(stream[k])))
      face.append(corner);
    faces.append(face);
  }
  return faces;
}

std::string block_name(std::uint8_t type, std::size_t corners) {
  switch (static_cast<Vtu_cell>(type)) {
    case Vtu_cell::triangle:
      return "triangle";
    case Vtu_cell::quad:
      return "quad";
    case Vtu_cell::tetrahedron:
      return "tetra";
    case Vtu_cell::hexahedron:
      return "hexahedron";
    case Vtu_cell::wedge:
      return "wedge";
    case Vtu_cell::pyramid:
      return "pyramid";
    case Vtu_cell::polyhedron:
      return fmt::format("polyhedron{}", corners);
    default:
      return "polygon";
  }
}

/// Runs of cells of one type.
py::list blocks_of(const Vtu_grid& grid) {
  py::list blocks;
  Face_streams faces(grid);
  const auto corners = [&](std::size_t i) { return part(grid.connectivity, grid.offsets, i); };
  for (std::size_t i = 0, end = 0; i < grid.cell_count(); i = end) {
    const std::size_t size = corners(i).size();
    while (end < grid.cell_count() && grid.types[end] == grid.types[i] && corners(end).size() == size) ++end;
    const std::string name = block_name(grid.types[i], size);
    if (is_polyhedron(grid, i)) {
      py::list cells;
      for (std::size_t c = i; c < end; ++c) cells.append(faces_of(faces[c]));
      blocks.append(py::make_tuple(name, cells));
      continue;
    }
    std::vector<std::int64_t> rows;
    rows.reserve((end - i) * size);
    for (std::size_t c = i; c < end; ++c) {
      const auto row = corners(c);
      rows.insert(rows.end(), row.begin(), row.end());
      if (grid.types[c] == static_cast<std::uint8_t>(Vtu_cell::wedge)) {  // meshio turns them around
        const auto wedge = rows.end() - 6;
        std::swap(wedge[1], wedge[2]);
        std::swap(wedge[4], wedge[5]);
      }
    }
    blocks.append(py::make_tuple(name, to_table(std::move(rows), size)));
  }
  return blocks;
}

}  // namespace

void bind_mesh_arrays(py::module_& module, Environment_class& environment) {
  py::class_<Mesh_arrays>(module, "MeshArrays",
                          "The cells of an environment as arrays of other programs, which the caller owns.")
      .def_readonly("points", &Mesh_arrays::points, "float64 (N, dimension): the points.")
      .def_readonly(
          "cells", &Mesh_arrays::cells,
          "int64: the cells as VTK and PyVista take them, one after the other, each after the number "
          "of its corners. A polyhedron has the number of its faces, then each face after the "
          "number of its corners, all of it after its length.")
      .def_readonly("celltypes", &Mesh_arrays::celltypes, "uint8 (M,): their types, with the numbers of VTK.")
      .def_property_readonly(
          "blocks", [](const Mesh_arrays& self) { return blocks_of(self.grid); },
          "The cells as meshio takes them: a list of pairs of a type and an integer array (K, k), in the "
          "order "
          "of the cells. The array of polyhedra is a list of lists of faces.")
      .def_readonly("solid", &Mesh_arrays::solid, "bool (M,): whether each cell is solid.")
      .def_readonly(
          "walls", &Mesh_arrays::walls,
          "int64 (K, k): the corners of all facets that are walls, each once; -1 after the last one.")
      .def("__repr__", [](const Mesh_arrays& self) {
        return fmt::format("<cellwalk.MeshArrays of {} points, {} cells, {} walls>", self.points.shape(0),
                           self.celltypes.size(), self.walls.shape(0));
      });
  environment.def(
      "to_arrays", &to_arrays,
      "The cells in the order of cells(), as arrays for other programs and for from_arrays():\n\n"
      "    arrays = environment.to_arrays()\n"
      "    meshio.Mesh(arrays.points, arrays.blocks)\n"
      "    pyvista.UnstructuredGrid(arrays.cells, arrays.celltypes, arrays.points)  # points in 3D\n\n"
      "Groups are left out.");
}

}  // namespace cellwalk::python
