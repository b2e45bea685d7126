// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the check of gmsh_nodes.h for binary files.
#ifndef CELLWALK_IO_MESH_GMSH_BINARY_H
#define CELLWALK_IO_MESH_GMSH_BINARY_H

#include <string>
#include <string_view>

#include "gmsh_text.h"

namespace cellwalk::io {

/// \pre the header is that of a binary file of version 2 or 4.1
/// \throw Error(input) if an element names a node that is not defined before it, or is of an unknown type, a
///        node's number is invalid, blocks contain more than was announced, or a section occurs twice
void check_binary_msh_nodes(const std::string& name, std::string_view bytes, const Msh_header& header);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_BINARY_H
