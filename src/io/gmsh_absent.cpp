// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled where Gmsh is not.
#include "optional_readers.h"
#include "text.h"

namespace cellwalk::io {

Element_soup parse_by_gmsh(const std::string& name, std::string_view, Format, Lines, Read_report&) {
  fail(name,
       "this build lacks Gmsh, which reads .msh, .mesh and .unv: install libgmsh-dev and configure with "
       "-DCELLWALK_WITH_GMSH=ON, or convert the file to .ovm");
}

std::string gmsh_version() { return {}; }

}  // namespace cellwalk::io
