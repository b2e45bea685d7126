// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: what Gmsh is given of a file. Whatever would crash it, be run by it as a script, or lose
// cells, is found before.
#ifndef CELLWALK_IO_MESH_GMSH_INPUT_H
#define CELLWALK_IO_MESH_GMSH_INPUT_H

#include <cellwalk/io/mesh_file.h>

#include <string>
#include <string_view>

#include "format.h"
#include "gmsh_text.h"

namespace cellwalk::io {

struct Gmsh_input {
  std::string file_name;  ///< makes Gmsh choose the right reader
  std::string changed;    ///< the bytes to read instead of the file's, if not empty
  Msh_counts counts;
};

/// Fills in the report's format and notes.
/// \throw Error(input) with file and line where the bytes are no mesh of that format, or name nodes that are
///        not there
Gmsh_input prepare_for_gmsh(const std::string& name, std::string_view bytes, Format format,
                            Read_report& report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_INPUT_H
