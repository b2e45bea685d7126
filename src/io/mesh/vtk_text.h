// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the counts that a file of VTK XML announces, checked before VTK allocates memory for them.
#ifndef CELLWALK_IO_MESH_VTK_TEXT_H
#define CELLWALK_IO_MESH_VTK_TEXT_H

#include <string>
#include <string_view>

namespace cellwalk::io {

/// Checks attributes such as NumberOfPoints="8".
/// \throw Error(input) if a file announces more points, cells or values than its bytes can encode
void check_vtk_counts(const std::string& name, std::string_view bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_VTK_TEXT_H
