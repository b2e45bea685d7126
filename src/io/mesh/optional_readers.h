// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the readers that need a library that a build may lack. All checks without the library come
// first.
#ifndef CELLWALK_IO_MESH_OPTIONAL_READERS_H
#define CELLWALK_IO_MESH_OPTIONAL_READERS_H

#include <cellwalk/io/mesh_file.h>

#include <string>
#include <string_view>

#include "reader_module.h"

namespace cellwalk::io {

/// Legacy VTK and VTK XML, unstructured grids and polygonal data.
/// \throw Error(input) also if this build lacks VTK, or its module cannot be loaded
Mesh_file parse_by_vtk(const std::string& name, std::string_view bytes, Format format);

/// True if this build includes the reader.
bool has_vtk();

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_OPTIONAL_READERS_H
