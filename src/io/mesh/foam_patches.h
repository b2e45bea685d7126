// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: what an OpenFOAM mesh calls by name: patches of its boundary, zones of faces and cells.
#ifndef CELLWALK_IO_MESH_FOAM_PATCHES_H
#define CELLWALK_IO_MESH_FOAM_PATCHES_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "foam_lists.h"
#include "foam_reader.h"

namespace cellwalk::io {

/// A run of boundary faces.
struct Foam_patch {
  std::string name, type;
  std::size_t first = 0, size = 0;  ///< of faces
};

/// The patches of a file `boundary`, each after the one before it.
/// \throw Error(input) if one begins before the end of that before it, or ends after the last face
std::vector<Foam_patch> read_foam_patches(Foam_reader& in, std::size_t internal_faces, std::size_t faces);

struct Foam_zone {
  std::string name;
  std::vector<std::uint32_t> members;
};

/// The zones of a file `cellZones` or `faceZones`.
/// \param key of the list of members: `cellLabels` or `faceLabels`
std::vector<Foam_zone> read_foam_zones(Foam_reader& in, std::string_view key, const Label_range& members);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FOAM_PATCHES_H
