// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells read from arrays, whose types are given by names, by codes or by their numbers of corners.
#include "cell_arrays.h"

#include <cellwalk/internal/io/polyhedron.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace cellwalk::python {
namespace {

using Corners = std::vector<std::uint32_t>;

constexpr int vtk_pixel = 8, vtk_voxel = 11, vtk_wedge = 13, vtk_polyhedron = 42;

constexpr std::array<Cell_type, 16> types{{{"vertex", 1, 0, 1},
                                           {"poly_vertex", 2, 0, 0},
                                           {"line", 3, 1, 2},
                                           {"poly_line", 4, 1, 0},
                                           {"triangle", 5, 2, 3},
                                           {"polygon", 7, 2, 0},
                                           {"pixel", vtk_pixel, 2, 4},
                                           {"quad", 9, 2, 4},
                                           {"tetra", 10, 3, 4},
                                           {"voxel", vtk_voxel, 3, 8},
                                           {"hexahedron", 12, 3, 8},
                                           {"wedge", vtk_wedge, 3, 6},
                                           {"pyramid", 14, 3, 5},
                                           {"penta_prism", 15, 3, 10},
                                           {"hexa_prism", 16, 3, 12},
                                           {"polyhedron", vtk_polyhedron, 3, 0}}};

[[noreturn]] void refuse_cells(const std::string& message) { throw Error(Error_code::input, message); }

[[noreturn]] void refuse_cell_type(const std::string& given) {
  std::string names;
  for (const Cell_type& type : types)
    if (type.dimension > 1)
      names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", type.name, type.code);
  refuse_cells(fmt::format("cells of type {} are not taken: {} are", given, names));
}

const Cell_type& type_of_code(std::int64_t code) {
  for (const Cell_type& type : types)
    if (type.code == code) return type;
  refuse_cell_type(std::to_string(code));
}

/// Names may end with a number of corners: polyhedron12.
const Cell_type& type_of_name(const std::string& name) {
  const std::string_view bare = std::string_view(name).substr(0, name.find_last_not_of("0123456789") + 1);
  for (const Cell_type& type : types)
    if (type.name == name || (type.corners == 0 && type.name == bare)) return type;
  refuse_cell_type(name);
}

/// Puts the corners of VTK's cells into the order of meshio, and those of grids around their faces.
void reorder(std::span<std::uint32_t> v, const Cell_type& type, bool is_of_vtk) {
  if (is_of_vtk && type.code == vtk_wedge) {
    std::swap(v[1], v[2]);
    std::swap(v[4], v[5]);
  }
  if (type.code == vtk_pixel || type.code == vtk_voxel) std::swap(v[2], v[3]);
  if (type.code == vtk_voxel) std::swap(v[6], v[7]);
}

class Reader {
 public:
  Reader(const char* name, std::size_t point_count) : name_(name), point_count_(point_count) {}

  /// A table of one type, or of polygons that may end with -1.
  void add_table(const py::handle& table, const std::string& name, const Cell_type& type, bool is_of_vtk) {
    const Row_width width = type.corners != 0 ? Row_width{type.corners, type.corners}
                            : type.code == 7  ? polygons
                                              : Row_width{1, 0, true};
    const Index_table rows = indices_of(table, name, width, point_count_);
    for (std::size_t i = 0; i < rows.size(); ++i) add(type, rows.row(i), is_of_vtk);
  }

  /// Polyhedra as lists of their faces.
  void add_polyhedra(const py::handle& block, const std::string& name) {
    for (const py::handle cell : block) {
      Corners stream;
      for (const py::handle face : cell) {
        const std::vector<std::int64_t> loop = integers(face, name.c_str());
        if (loop.size() < 3)
          refuse_cells(
              fmt::format("{}: cell {} has a face with {} corners", name, given_.cells.size(), loop.size()));
        stream.push_back(static_cast<std::uint32_t>(loop.size()));
        for (const std::int64_t number : loop) stream.push_back(point(number));
      }
      add(type_of_code(vtk_polyhedron), stream, false);
    }
  }

  void add_block(const py::handle& type, const py::handle& data) {
    const bool is_code = !py::isinstance<py::str>(type);
    const Cell_type* const known = is_code ? &type_of_code(py::int_(py::reinterpret_borrow<py::object>(type)))
                                           : &type_of_name(type.cast<std::string>());
    const std::string name = fmt::format("{}[{}]", name_, std::string(py::repr(type)));
    known->code == vtk_polyhedron ? add_polyhedra(data, name) : add_table(data, name, *known, is_code);
  }

  /// Cells one after the other, each after the number of its corners.
  void add_flat(const py::object& cells, const py::object& types_given) {
    const std::vector<std::int64_t> all = integers(cells, "cells"),
                                    codes = integers(types_given, "celltypes");
    std::size_t at = 0;
    for (const std::int64_t code : codes) {
      const Cell_type& type = type_of_code(code);
      const auto refuse = [&](const char* what) {
        refuse_cells(fmt::format("cells: cell {}, of type {}, {}", given_.cells.size(), type.name, what));
      };
      if (at == all.size()) refuse("is missing: celltypes has more cells");
      const std::int64_t size = all[at++];
      if (size < 0 || static_cast<std::uint64_t>(size) > all.size() - at) refuse("goes beyond their end");
      const std::span<const std::int64_t> row(all.data() + at, static_cast<std::size_t>(size));
      at += row.size();
      if (type.code == vtk_polyhedron) {
        add(type, stream_of(row, refuse), true);
        continue;
      }
      if (type.corners != 0 && row.size() != type.corners)
        refuse(fmt::format("has {} points, not {}", row.size(), type.corners).c_str());
      Corners corners;
      for (const std::int64_t number : row) corners.push_back(point(number));
      add(type, corners, true);
    }
    if (at != all.size())
      refuse_cells(fmt::format("cells goes on after cell {}, the last of celltypes", codes.size() - 1));
  }

  Given_cells take() { return std::move(given_); }

 private:
  static std::vector<std::int64_t> integers(const py::handle& argument, const char* name) {
    const py::array array = as_array(argument);
    if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u') refuse_type(name, "integers", argument);
    if (array.ndim() != 1) refuse_shape(name, shape_text(array), "(N,)");
    const auto flat = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
    return {flat.data(), flat.data() + flat.size()};
  }

  std::uint32_t point(std::int64_t number) const {
    if (number < 0 || static_cast<std::uint64_t>(number) >= point_count_)
      throw Row_error(fmt::format("{}: cell {} names point {}: there are {} points, numbered from 0", name_,
                                  given_.cells.size(), number, point_count_));
    return static_cast<std::uint32_t>(number);
  }

  /// The faces of a polyhedron, after their number.
  template <class Refuse>
  Corners stream_of(std::span<const std::int64_t> row, const Refuse& refuse) const {
    constexpr const char* broken =
        "needs the number of its faces, then of each the number of its corners, and these";
    Corners stream;
    std::int64_t faces = 0;
    for (std::size_t k = 1; k < row.size(); ++faces) {
      const std::int64_t size = row[k++];
      if (size < 3 || static_cast<std::uint64_t>(size) > row.size() - k) refuse(broken);
      stream.push_back(static_cast<std::uint32_t>(size));
      for (std::int64_t j = 0; j < size; ++j) stream.push_back(point(row[k++]));
    }
    if (row.empty() || faces != row[0]) refuse(broken);
    return stream;
  }

  void add(const Cell_type& type, std::span<const std::uint32_t> corners, bool is_of_vtk) {
    const std::size_t begin = given_.corners.size();
    given_.corners.insert(given_.corners.end(), corners.begin(), corners.end());
    reorder(std::span(given_.corners).subspan(begin), type, is_of_vtk);
    given_.cells.push_back({&type, begin, given_.corners.size()});
  }

  const char* name_;
  std::size_t point_count_;
  Given_cells given_;
};

/// The type that rows of so many corners have.
const Cell_type& type_of_width(const py::handle& table) {
  const py::array array = as_array(table);
  switch (array.ndim() == 2 ? array.shape(1) : 0) {
    case 3:
      return type_of_name("triangle");
    case 4:
      return type_of_name("tetra");
    case 5:
      return type_of_name("pyramid");
    case 6:
      return type_of_name("wedge");
    case 8:
      return type_of_name("hexahedron");
    default:
      refuse_shape(
          "cells", shape_text(array),
          "(M, 4) for tetrahedra, (M, 5) for pyramids, (M, 6) for wedges, (M, 8) for hexahedra, or with "
          "celltypes (N,)");
  }
}

bool is_block(const py::handle& item) {
  if (py::hasattr(item, "type") && py::hasattr(item, "data")) return true;
  return (py::isinstance<py::tuple>(item) || py::isinstance<py::list>(item)) && py::len(item) == 2 &&
         py::isinstance<py::str>(item.attr("__getitem__")(0));
}

void add_blocks(Reader& reader, const py::object& cells) {
  for (const py::handle block : cells) {
    if (!is_block(block)) throw py::type_error("each block must be a pair of a type and an array");
    if (py::hasattr(block, "type"))
      reader.add_block(block.attr("type"), block.attr("data"));
    else
      reader.add_block(block.attr("__getitem__")(0), block.attr("__getitem__")(1));
  }
}

void add_cell(Cell_soup<2>& soup, const Cell_type&, std::span<const std::uint32_t> v) {
  add_polygon(soup, v);
}

void add_prism_over(Cell_soup<3>& soup, std::span<const std::uint32_t> v) {
  const std::size_t n = v.size() / 2;
  soup.add_facet(Corners(v.rbegin() + static_cast<std::ptrdiff_t>(n), v.rend()));
  soup.add_facet(v.subspan(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    soup.add_facet({v[i], v[j], v[n + j], v[n + i]});
  }
  soup.end_cell();
}

void add_polyhedron(Cell_soup<3>& soup, std::span<const std::uint32_t> stream) {
  std::vector<Corners> loops;
  for (std::size_t k = 0; k < stream.size(); k += stream[k] + 1) {
    const auto loop = stream.subspan(k + 1, stream[k]);
    loops.emplace_back(loop.begin(), loop.end());
  }
  io::turn_alike(loops, soup.points);
  for (const Corners& loop : loops) soup.add_facet(loop);
  soup.end_cell();
}

void add_cell(Cell_soup<3>& soup, const Cell_type& type, std::span<const std::uint32_t> v) {
  if (type.code == vtk_polyhedron) return add_polyhedron(soup, v);
  switch (v.size()) {
    case 4:
      add_tetrahedron(soup, v[0], v[1], v[2], v[3]);
      return;
    case 5:
      add_pyramid(soup, {v[0], v[1], v[2], v[3], v[4]});
      return;
    case 6:
      add_prism(soup, {v[0], v[1], v[2], v[3], v[4], v[5]});
      return;
    case 8:
      add_hexahedron(soup, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
      return;
    default:
      add_prism_over(soup, v);
  }
}

Corners sorted(std::span<const std::uint32_t> loop) {
  Corners corners(loop.begin(), loop.end());
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

int Given_cells::dimension() const {
  int highest = 0;
  for (const Cell& cell : cells) highest = std::max(highest, cell.type->dimension);
  return highest;
}

Given_cells cells_of(const py::object& cells, const py::object& types_given, const char* name,
                     std::string_view type_of_rows, std::size_t point_count) {
  Reader reader(name, point_count);
  if (!types_given.is_none()) {
    reader.add_flat(cells, types_given);
  } else if (py::hasattr(cells, "items")) {
    for (const py::handle item : cells.attr("items")())
      reader.add_block(item.attr("__getitem__")(0), item.attr("__getitem__")(1));
  } else if ((py::isinstance<py::list>(cells) || py::isinstance<py::tuple>(cells)) && py::len(cells) != 0 &&
             is_block(cells.attr("__getitem__")(0))) {
    add_blocks(reader, cells);
  } else {
    reader.add_table(cells, name,
                     type_of_rows.empty() ? type_of_width(cells) : type_of_name(std::string(type_of_rows)),
                     false);
  }
  return reader.take();
}

template <int D>
std::map<std::string_view, std::size_t> add_cells(Cell_soup<D>& soup, const Given_cells& given) {
  std::map<std::string_view, std::size_t> left_out;
  for (const Given_cells::Cell& cell : given.cells)
    if (cell.type->dimension == D)
      add_cell(soup, *cell.type, given.of(cell));
    else
      ++left_out[cell.type->name];
  return left_out;
}

template <int D>
void add_walls(Cell_soup<D>& soup, const py::object& walls) {
  const Given_cells given =
      cells_of(walls, py::none(), "walls", D == 2 ? "line" : "polygon", soup.points.size());
  std::map<Corners, bool> wanted;
  for (const Given_cells::Cell& wall : given.cells) wanted[sorted(given.of(wall))] = false;
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    if (const auto wall = wanted.find(sorted(soup.facet(f))); wall != wanted.end())
      soup.impassable[f] = wall->second = true;
  for (std::size_t i = 0; i < given.cells.size(); ++i)
    if (const auto corners = given.of(given.cells[i]); !wanted[sorted(corners)])
      refuse_cells(fmt::format("wall {} of walls: no cell has the facet ({})", i, fmt::join(corners, " ")));
}

#define CELLWALK_INSTANTIATE(D)                                                                  \
  template std::map<std::string_view, std::size_t> add_cells(Cell_soup<D>&, const Given_cells&); \
  template void add_walls(Cell_soup<D>&, const py::object&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::python
