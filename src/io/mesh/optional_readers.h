// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: readers that need libraries that a build may lack. All checks without the library come
// first.
#ifndef CELLWALK_IO_MESH_OPTIONAL_READERS_H
#define CELLWALK_IO_MESH_OPTIONAL_READERS_H

#include <cellwalk/io/mesh_file.h>

#include <string>
#include <string_view>

#include "reader_module.h"

namespace cellwalk::io {

/// .msh, .mesh and .unv by Gmsh. `bytes` are the whole file, inflated.
/// \throw Error(input) also if this build lacks Gmsh, or its module cannot be loaded
Element_soup parse_by_gmsh(const std::string& name, std::string_view bytes, Format format, Lines lines,
                           Read_report& report);

/// Legacy VTK and VTK XML, unstructured grids and polygonal data.
/// \throw Error(input) as above
Mesh_file parse_by_vtk(const std::string& name, std::string_view bytes, Format format);

/// True if this build includes the reader.
bool has_gmsh();
bool has_vtk();

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_OPTIONAL_READERS_H
