// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies: vertices with edges, and faces where there are any, from any mesh file, and polylines from tables.
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

/// Reads a body. What there is in the file becomes part of it: lines and polylines (OBJ `l`, PLY `edge`, OFF facets of two
/// corners, line elements of Gmsh, segments of .poly and .wkt), polygons, and of volume cells all edges and facets. A
/// .csv with columns x,y,z is a polyline: each row is joined to the next. Bodies need not be closed, manifold or of one
/// part; vertices on no edge and vertices at one place are kept as they are. See docs/formats.md.
///
/// A body of the plane (D = 2) has z zero throughout (a .csv has no z), and of polygons the sides only.
/// \throw Error(input) where the file is unreadable, broken, of an unknown format or without vertices, or where a body of
///        the plane has a z that is not zero: file and line where they can be known, what is wrong, what to do
template <int D>
Body_file<D> read_body(const std::filesystem::path& path);

extern template Body_file<2> read_body(const std::filesystem::path&);
extern template Body_file<3> read_body(const std::filesystem::path&);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_BODY_FILE_H
