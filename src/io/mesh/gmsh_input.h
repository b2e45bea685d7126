// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the input of Gmsh. Everything that would crash it, be executed by it as a script, or lose
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
  std::string file_name;  ///< by which Gmsh chooses the right reader
  std::string changed;    ///< the bytes to read instead of the file's, if not empty
  Msh_counts counts;
};

/// Fills in the report's format and notes.
/// \throw Error(input) with file and line if the bytes are not a mesh of that format, or name undefined nodes
Gmsh_input prepare_for_gmsh(const std::string& name, std::string_view bytes, Format format,
                            Read_report& report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_INPUT_H
