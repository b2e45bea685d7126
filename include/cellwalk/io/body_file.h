// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies: vertices with edges, and faces if there are any, from any mesh file, and polylines from tables.
#ifndef CELLWALK_IO_BODY_FILE_H
#define CELLWALK_IO_BODY_FILE_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/body_soup.h>

#include <filesystem>

namespace cellwalk::io {

template <int D>
struct Body_file {
  Body_soup<D> body;
  Read_report report;  ///< its facets are the faces of the body
};

/// Reads a body. All features of the file become part of it: lines and polylines (OBJ `l`, PLY `edge`, OFF
/// facets of two corners, line elements of Gmsh, segments of .poly and .wkt), polygons, and the edges and
/// facets of volume cells. A .csv with columns x,y,z is a polyline through its rows. Bodies need not be
/// closed, manifold or of one part; vertices without edges and vertices with equal coordinates are kept.
/// Edges of PLY and CSV may have a radius. See docs/formats.md.
///
/// A 2D body has z zero throughout (a .csv has no z), and only the sides of polygons.
/// \throw Error(input) if the file is unreadable, broken, of an unknown format or without vertices, or if a
///        2D body has a z that is not zero; with file and line if known, the problem and the remedy
template <int D>
Body_file<D> read_body(const std::filesystem::path& path);

extern template Body_file<2> read_body(const std::filesystem::path&);
extern template Body_file<3> read_body(const std::filesystem::path&);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_BODY_FILE_H
