// SPDX-License-Identifier: LGPL-3.0-or-later
// VTK unstructured grids (.vtu) for ParaView. Written without VTK, which is optional, so that every build
// writes the same bytes.
#ifndef CELLWALK_INTERNAL_IO_VTU_H
#define CELLWALK_INTERNAL_IO_VTU_H

#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace cellwalk::io {

/// The cell types, with the values of VTK.
enum class Vtu_cell : std::uint8_t {
  vertex = 1,
  line = 3,
  polyline = 4,
  triangle = 5,
  polygon = 7,
  quad = 9,
  tetrahedron = 10,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  polyhedron = 42
};

/// A named array of values, `components` for each point or cell.
struct Vtu_array {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int64_t>> values;
};

/// Points, cells and their data. 2D points have z = 0.
struct Vtu_grid {
  std::vector<Point<3>> points;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;  ///< of each cell, its end in connectivity
  std::vector<std::uint8_t> types;
  /// Of polyhedra: the number of faces, then the size and the points of each
  std::vector<std::int64_t> faces;
  std::vector<std::int64_t> face_offsets;  ///< of each cell, its end in faces, or -1; empty without polyhedra
  std::vector<Vtu_array> point_data, cell_data;

  std::size_t cell_count() const { return types.size(); }

  /// Appends a cell over existing points; for polyhedra see add_polyhedron().
  void add_cell(Vtu_cell type, std::span<const std::uint32_t> vertices);
  /// Appends a polyhedron, with its faces as loops, counterclockwise seen from outside.
  void add_polyhedron(std::span<const std::vector<std::uint32_t>> loops);
};

/// A 2D point with z = 0.
inline Point<3> in_space(const Point<2>& p) { return {p[0], p[1], 0}; }
inline Point<3> in_space(const Point<3>& p) { return p; }

/// The cells of a soup: tetrahedra, pyramids, wedges and hexahedra as such, others as polyhedra, 2D cells as
/// polygons.
/// Cell data: `solid`, and `cell`, the index in the soup.
template <int D>
Vtu_grid vtu_of_cells(const Cell_soup<D>& soup);

/// The walls of a soup at free space, each once: its impassable facets, those on its boundary and those of
/// solid cells, but none with solid cells only. Cell data: `cell`, the first cell with that facet.
template <int D>
Vtu_grid vtu_of_walls(const Cell_soup<D>& soup);

/// The encoding of arrays: readable text, or the bytes of the numbers in base64 (faster).
enum class Vtu_encoding { text, base64 };

/// The text of a file. The same grid gives the same bytes. Values are exact in both encodings.
/// \throw Error(usage) if the length of an array differs from that of its points or cells
std::string vtu_text(const Vtu_grid& grid, Vtu_encoding encoding = Vtu_encoding::base64);

/// Writes a grid; the file appears complete or not at all.
/// \throw Error as vtu_text(), Error(other) if it cannot be written
void write_vtu(const std::filesystem::path& path, const Vtu_grid& grid,
               Vtu_encoding encoding = Vtu_encoding::base64);

extern template Vtu_grid vtu_of_cells<2>(const Cell_soup<2>&);
extern template Vtu_grid vtu_of_cells<3>(const Cell_soup<3>&);
extern template Vtu_grid vtu_of_walls<2>(const Cell_soup<2>&);
extern template Vtu_grid vtu_of_walls<3>(const Cell_soup<3>&);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_VTU_H
