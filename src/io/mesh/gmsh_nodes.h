// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: Gmsh follows the node numbers of elements without a look, and crashes where they lead
// nowhere.
#ifndef CELLWALK_IO_MESH_GMSH_NODES_H
#define CELLWALK_IO_MESH_GMSH_NODES_H

#include <string>
#include <string_view>

#include "gmsh_text.h"

namespace cellwalk::io {

/// Looks through the nodes and elements of a file of version 1, 2 or 4, strictly: what Gmsh reads otherwise
/// than it is meant leads out of its tables.
/// \throw Error(input), with the line of a text, where an element names a node that is not there before it, a
///        node's number is not one, blocks hold another number than was announced, a section occurs twice, or
///        they are cut short or hold what is no number
void check_msh_nodes(const std::string& name, std::string_view bytes, const Msh_header& header);

/// \throw Error(input) with file and line where an element has a negative number among those of its nodes,
///        which Gmsh does not look at
void check_unv_nodes(const std::string& name, std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_NODES_H
