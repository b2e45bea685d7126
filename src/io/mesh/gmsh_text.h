// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the header and the announced counts of a .msh file, beside the content that Gmsh reads.
#ifndef CELLWALK_IO_MESH_GMSH_TEXT_H
#define CELLWALK_IO_MESH_GMSH_TEXT_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cellwalk::io {

struct Msh_header {
  std::string version;  ///< such as "1" or "4.1"
  bool binary = false;
};

/// \throw Error(input) with file and line if this is not a .msh file. Gmsh takes other input for a script,
///        which could do anything, so only meshes may reach it.
Msh_header read_msh_header(const std::string& name, std::string_view bytes);

struct Msh_counts {
  std::optional<std::uint64_t> nodes, elements;  ///< as announced; none if they are binary
};
Msh_counts announced_counts(std::string_view bytes, const Msh_header& header);

/// Checks a MEDIT file, of which Gmsh skips unknown parts.
/// \throw Error(input) with file and line if that would lose cells, or if this is not an ASCII MEDIT file
Msh_counts check_medit(const std::string& name, std::string_view text);

/// Gmsh keeps only one of several elements with the same number. If numbers repeat in a text of version 1 or
/// 2, returns the text with all elements numbered in order; otherwise none.
std::optional<std::string> renumbered_elements(std::string_view text, const Msh_header& header);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_TEXT_H
