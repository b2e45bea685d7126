// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: what a .msh file says about itself, beside what Gmsh reads from it.
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

/// \throw Error(input) with file and line where this is no .msh file. Gmsh takes what it does not recognise
///        for a script that could do anything: nothing but meshes may reach it.
Msh_header read_msh_header(const std::string& name, std::string_view bytes);

struct Msh_counts {
  std::optional<std::uint64_t> nodes, elements;  ///< as announced; nothing where they stand in binary
};
Msh_counts announced_counts(std::string_view bytes, const Msh_header& header);

/// Gmsh passes over what it does not know in a MEDIT file.
/// \throw Error(input) with file and line where that would lose cells, or this is no ASCII MEDIT file
Msh_counts check_medit(const std::string& name, std::string_view text);

/// Gmsh keeps only one of several elements that have the same number. If numbers repeat in a text of version
/// 1 or 2, returns the text with all elements numbered in order; else nothing.
std::optional<std::string> renumbered_elements(std::string_view text, const Msh_header& header);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_TEXT_H
