// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the counts that a VTK file announces, checked before VTK allocates memory for them.
#ifndef CELLWALK_IO_MESH_VTK_TEXT_H
#define CELLWALK_IO_MESH_VTK_TEXT_H

#include <string>
#include <string_view>

#include "format.h"

namespace cellwalk::io {

/// \throw Error(input) if a file announces more points, cells or values than its bytes can encode
void check_vtk_counts(const std::string& name, std::string_view bytes, Format format);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_VTK_TEXT_H
