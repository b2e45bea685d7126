// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the check of the node numbers of elements. Gmsh follows them without a check, and crashes if
// they are undefined.
#ifndef CELLWALK_IO_MESH_GMSH_NODES_H
#define CELLWALK_IO_MESH_GMSH_NODES_H

#include <string>
#include <string_view>

#include "gmsh_text.h"

namespace cellwalk::io {

/// Checks the nodes and elements of a file of version 1, 2 or 4 strictly: input that Gmsh misreads leads out
/// of its tables.
/// \throw Error(input), with the line of a text, if an element names a node that is not defined before it, a
///        node's number is invalid, blocks contain another number of members than was announced, a section
///        occurs twice or is cut short, or a number is malformed
void check_msh_nodes(const std::string& name, std::string_view bytes, const Msh_header& header);

/// \throw Error(input) with file and line if an element has a negative node number, which Gmsh does not check
void check_unv_nodes(const std::string& name, std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_NODES_H
