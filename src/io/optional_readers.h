// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: readers of libraries that a build may lack. For each, one of two files is compiled: the reader, or the
// one that says what is missing.
#ifndef CELLWALK_IO_OPTIONAL_READERS_H
#define CELLWALK_IO_OPTIONAL_READERS_H

#include <cellwalk/io/mesh_file.h>

#include <string>
#include <string_view>

#include "element_soup.h"
#include "format.h"

namespace cellwalk::io {

enum class Lines { left_out, read };

/// .msh, .mesh and .unv by Gmsh. `bytes` are the whole file, inflated.
Element_soup parse_by_gmsh(const std::string& name, std::string_view bytes, Format format, Lines lines,
                           Read_report& report);
/// Empty where this build lacks Gmsh.
std::string gmsh_version();

/// Legacy VTK and VTK XML, unstructured grids and polygonal data.
Mesh_file parse_by_vtk(const std::string& name, const std::string& bytes, Format format);
/// Empty where this build lacks VTK.
std::string vtk_version();

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_OPTIONAL_READERS_H
