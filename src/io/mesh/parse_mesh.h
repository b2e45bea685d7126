// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: meshes from bytes of a known format.
#ifndef CELLWALK_IO_MESH_PARSE_MESH_H
#define CELLWALK_IO_MESH_PARSE_MESH_H

#include <cellwalk/io/mesh_file.h>

#include <string>

#include "format.h"

namespace cellwalk::io {

/// \throw Error(input) if the bytes are broken, or the format is not one of meshes
Mesh_file parse_mesh(const std::string& name, const std::string& bytes, Format format);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_PARSE_MESH_H
