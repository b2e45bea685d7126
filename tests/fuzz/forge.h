// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments with entries that somebody changed, and checksums that fit.
#ifndef CELLWALK_TESTS_FUZZ_FORGE_H
#define CELLWALK_TESTS_FUZZ_FORGE_H

#include <cstddef>
#include <vector>

#include "fuzz/decoder.h"

namespace cellwalk::fuzz {

using Image = std::vector<std::byte>;

/// Images that nobody changed: of squares, triangles and polygons; of tetrahedra, hexahedra and polyhedra;
/// with walls, membranes, slits, solid cells, groups, and what edits left free.
const std::vector<Image>& sound_images();

/// One of them with a few entries of its arrays changed: to the least and greatest numbers, to those around
/// its own and around the lengths of arrays, to those of other entries; or two entries exchanged.
Image forged_image(Decoder& in);

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_FORGE_H
