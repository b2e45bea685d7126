// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled where VTK is not.
#include "optional_readers.h"
#include "text.h"

namespace cellwalk::io {

Mesh_file parse_by_vtk(const std::string& name, const std::string&, Format) {
  fail(name,
       "this build lacks VTK, which reads .vtk and .vtu: install libvtk9-dev and configure with "
       "-DCELLWALK_WITH_VTK=ON, or convert the file to .ovm");
}

std::string vtk_version() { return {}; }

}  // namespace cellwalk::io
