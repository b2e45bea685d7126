// SPDX-License-Identifier: LGPL-3.0-or-later
// The corners of each VTK cell type in the order of the soup, and its polyhedra from their streams.
#include "vtk_cells.h"

#include <cellwalk/internal/io/polyhedron.h>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <optional>

#include "io/files/text.h"
#include "wedge_order.h"

namespace cellwalk::io {
namespace {

using Indices = std::vector<std::uint32_t>;

std::vector<Point<3>> read_points(const std::string& name, vtkPoints* from) {
  std::vector<Point<3>> points;
  if (!from) return points;
  points.reserve(static_cast<std::size_t>(from->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < from->GetNumberOfPoints(); ++i) {
    Point<3> p;
    from->GetPoint(i, p.data());
    if (!is_finite(p)) fail(name, fmt::format("point {} has a coordinate that is not finite", i));
    points.push_back(p);
  }
  return points;
}

/// Rows of point indices, each checked, since VTK's readers trust the file.
class Rows {
 public:
  Rows(const std::string& name, vtkCellArray* cells, std::size_t point_count)
      : name_(name),
        points_(point_count),
        offsets_(cells->GetOffsetsArray()),
        values_(cells->GetConnectivityArray()) {}

  std::size_t size() const {
    return offsets_->GetNumberOfTuples() > 0 ? static_cast<std::size_t>(offsets_->GetNumberOfTuples() - 1)
                                             : 0;
  }

  Indices operator[](std::size_t c) const {
    const auto i = static_cast<vtkIdType>(c);
    const double begin = offsets_->GetTuple1(i), end = offsets_->GetTuple1(i + 1);
    if (!(0 <= begin && begin <= end && end <= static_cast<double>(values_->GetNumberOfTuples())))
      fail(name_, fmt::format("cell {}: its offsets leave the connectivity: the file is broken", c));
    Indices row;
    for (double j = begin; j < end; ++j)
      row.push_back(point(c, values_->GetTuple1(static_cast<vtkIdType>(j))));
    return row;
  }

  std::uint32_t point(std::size_t cell, double index) const {
    if (!(index >= 0 && index < static_cast<double>(points_)))
      fail(name_, fmt::format("cell {} names point {}, of {}", cell, index, points_));
    return static_cast<std::uint32_t>(index);
  }

 private:
  const std::string& name_;
  std::size_t points_;
  vtkDataArray *offsets_, *values_;
};

/// The reading of a VTK cell type: its first `corners` points, in the order of the soup's functions.
struct Shape {
  int dimension;
  std::size_t corners;
  bool straightened = false;  ///< of higher order: only its corners are read
};

std::optional<Shape> shape_of(int type) {
  switch (type) {
    case VTK_TETRA:
      return Shape{3, 4};
    case VTK_PYRAMID:
      return Shape{3, 5};
    case VTK_WEDGE:
      return Shape{3, 6};
    case VTK_HEXAHEDRON:
    case VTK_VOXEL:
      return Shape{3, 8};
    case VTK_PENTAGONAL_PRISM:
      return Shape{3, 10};
    case VTK_HEXAGONAL_PRISM:
      return Shape{3, 12};
    case VTK_QUADRATIC_TETRA:
      return Shape{3, 4, true};
    case VTK_QUADRATIC_PYRAMID:
    case VTK_TRIQUADRATIC_PYRAMID:
      return Shape{3, 5, true};
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      return Shape{3, 6, true};
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
      return Shape{3, 8, true};
    case VTK_TRIANGLE:
      return Shape{2, 3};
    case VTK_QUAD:
    case VTK_PIXEL:
      return Shape{2, 4};
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
      return Shape{2, 3, true};
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
      return Shape{2, 4, true};
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_QUADRATIC_EDGE:
    case VTK_CUBIC_LINE:
      return Shape{0, 0};
    default:
      return std::nullopt;
  }
}

class Cell_reader {
 public:
  Cell_reader(const std::string& name, vtkPoints* points) : name_(name) {
    soup().points = read_points(name, points);
  }

  void grid(vtkUnstructuredGrid& grid) {
    if (!grid.GetCells()) fail(name_, "has no list of cells: it is cut short, or holds points only");
    const Rows rows(name_, grid.GetCells(), soup().points.size());
    vtkUnsignedCharArray* types = grid.GetCellTypesArray();
    const std::size_t n = rows.size();
    if (!types || static_cast<std::size_t>(types->GetNumberOfTuples()) != n)
      fail(name_, "the numbers of cells and of cell types differ: the file is broken");
    Wedge_order wedges(soup());
    for (std::size_t c = 0; c < n; ++c) {
      const int type = types->GetValue(static_cast<vtkIdType>(c));
      if (type == VTK_POLYHEDRON) {
        polyhedron(grid, rows, c);
        continue;
      }
      element(c, type, rows[c]);
      if (soup().cell_count() > cells_before_) {
        collapsed_.settle_last(soup(), name_, fmt::format("cell {}", c));
        wedges.note_cell(type == VTK_WEDGE || is_quadratic_wedge(type));
      }
      cells_before_ = soup().cell_count();
    }
    if (const std::size_t turned = wedges.settle())
      notes_.push_back(
          fmt::format("{} wedges follow the order of corners opposite to VTK's: read so", turned));
    finish();
  }

  void surface(vtkPolyData& data) {
    for (vtkCellArray* cells : {data.GetVerts(), data.GetLines()})
      lower_ += static_cast<std::size_t>(cells->GetNumberOfCells());
    const Rows polygons(name_, data.GetPolys(), soup().points.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) polygon(i, polygons[i]);
    const Rows strips(name_, data.GetStrips(), soup().points.size());
    for (std::size_t i = 0; i < strips.size(); ++i) strip(strips[i]);
    finish();
  }

  Read_elements result() { return {std::move(elements_), std::move(notes_), collapsed_}; }

 private:
  Cell_soup<3>& soup() { return elements_.volumes; }

  static bool is_quadratic_wedge(int type) {
    return type == VTK_QUADRATIC_WEDGE || type == VTK_QUADRATIC_LINEAR_WEDGE ||
           type == VTK_BIQUADRATIC_QUADRATIC_WEDGE;
  }

  void element(std::size_t c, int type, Indices v) {
    if (type == VTK_POLYGON) return polygon(c, std::move(v));
    if (type == VTK_TRIANGLE_STRIP) return strip(v);
    const auto shape = shape_of(type);
    if (!shape)
      fail(name_,
           fmt::format(
               "cell {} is of VTK's type {}, which is not read: tetrahedra, hexahedra, voxels, wedges, "
               "pyramids, prisms and polyhedra are",
               c, type));
    if (shape->dimension < 2) {
      ++lower_;
      return;
    }
    if (v.size() < shape->corners)
      fail(name_,
           fmt::format("cell {} has {} points, of {} that its type takes", c, v.size(), shape->corners));
    straightened_ += shape->straightened;
    v.resize(shape->corners);
    if (type == VTK_VOXEL || type == VTK_PIXEL) std::swap(v[2], v[3]);
    if (type == VTK_VOXEL) std::swap(v[6], v[7]);
    if (shape->dimension == 3) return volume(v);
    collapsed_.settle(v, soup().points);
    elements_.polygons.push_back(std::move(v));
  }

  void volume(const Indices& v) {
    switch (v.size()) {
      case 4:
        add_tetrahedron(soup(), v[0], v[1], v[2], v[3]);
        return;
      case 5:
        add_pyramid(soup(), {v[0], v[1], v[2], v[3], v[4]});
        return;
      // VTK has the triangles of a wedge in the opposite direction.
      case 6:
        add_prism(soup(), {v[0], v[2], v[1], v[3], v[5], v[4]});
        return;
      case 8:
        add_hexahedron(soup(), {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
        return;
      default:
        prism(v);
        return;
    }
  }

  /// A prism over a pentagon or hexagon: its base counterclockwise seen from inside, then its top.
  void prism(const Indices& v) {
    const std::size_t n = v.size() / 2;
    soup().add_facet(Indices(v.rend() - static_cast<std::ptrdiff_t>(n), v.rend()));
    soup().add_facet(Indices(v.begin() + static_cast<std::ptrdiff_t>(n), v.end()));
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      soup().add_facet({v[i], v[j], v[n + j], v[n + i]});
    }
    soup().end_cell();
  }

  void polygon(std::size_t c, Indices v) {
    if (v.size() < 3) fail(name_, fmt::format("cell {}: a polygon of {} points", c, v.size()));
    elements_.polygons.push_back(std::move(v));
  }

  void strip(const Indices& v) {
    for (std::size_t i = 0; i + 2 < v.size(); ++i)
      elements_.polygons.push_back(i % 2 ? Indices{v[i + 1], v[i], v[i + 2]}
                                         : Indices{v[i], v[i + 1], v[i + 2]});
  }

  /// The faces of a polyhedron are in a stream of their own: the count, then for each face its count and
  /// points.
  void polyhedron(vtkUnstructuredGrid& grid, const Rows& rows, std::size_t c) {
    vtkIdTypeArray *faces = grid.GetFaces(), *locations = grid.GetFaceLocations();
    const auto broken = [&] {
      fail(name_, fmt::format("cell {}: the faces of this polyhedron are broken", c));
    };
    if (!faces || !locations || static_cast<vtkIdType>(c) >= locations->GetNumberOfTuples()) broken();
    vtkIdType at = locations->GetValue(static_cast<vtkIdType>(c));
    const auto next = [&] {
      if (at < 0 || at >= faces->GetNumberOfTuples()) broken();
      return faces->GetValue(at++);
    };
    std::vector<Indices> loops;
    for (vtkIdType face_count = next(), f = 0; f < face_count; ++f) {
      Indices loop;
      const vtkIdType size = next();
      if (size < 3) broken();
      for (vtkIdType k = 0; k < size; ++k) loop.push_back(rows.point(c, static_cast<double>(next())));
      loops.push_back(std::move(loop));
    }
    if (loops.size() < 4) broken();
    turned_ += turn_alike(loops, soup().points);
    for (const Indices& loop : loops) soup().add_facet(loop);
    soup().end_cell();
    cells_before_ = soup().cell_count();
  }

  void finish() {
    if (lower_ > 0) notes_.push_back(fmt::format("{} point and line cells ignored", lower_));
    if (straightened_ > 0)
      notes_.push_back(
          fmt::format("{} cells of higher order read by their corner points, as straight", straightened_));
    if (turned_ > 0)
      notes_.push_back(fmt::format("{} polyhedra had facets of either orientation: made alike", turned_));
  }

  const std::string& name_;
  Element_soup elements_;
  std::vector<std::string> notes_;
  Collapsed_cells collapsed_;
  std::size_t lower_ = 0, straightened_ = 0, turned_ = 0, cells_before_ = 0;
};

}  // namespace

Read_elements read_cells(const std::string& name, vtkUnstructuredGrid& grid) {
  Cell_reader reader(name, grid.GetPoints());
  reader.grid(grid);
  return reader.result();
}

Read_elements read_cells(const std::string& name, vtkPolyData& surface) {
  Cell_reader reader(name, surface.GetPoints());
  reader.surface(surface);
  return reader.result();
}

}  // namespace cellwalk::io
