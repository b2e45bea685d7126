// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the common part of the reader and writer of recordings.
#ifndef CELLWALK_IO_RESULTS_RECORDING_FORMAT_H
#define CELLWALK_IO_RESULTS_RECORDING_FORMAT_H

#include <cellwalk/internal/records/recording.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace cellwalk::io {

inline constexpr std::string_view recording_magic = "CWMOTN01";

/// The bytes of one frame without the changes of the walls: 16 bits a coordinate, 32 a cell, 8 a decision.
/// \param points of the walls so far
inline std::uint64_t recording_frame_size(const Recording_scene& scene, std::uint64_t points) {
  const auto axes = static_cast<std::uint64_t>(scene.dimension);
  const std::uint64_t moving = scene.moving_count();
  return 2 * axes * (moving + (scene.walls_move ? points : 0)) + sizeof(std::uint32_t) * moving +
         scene.bodies.size();
}

/// Reads a recording from its inflated bytes.
/// \param name stands for the file in errors
/// \throw Error(input) if they are not a recording, or damaged
Recording_scene parse_recording(const std::string& name, std::string_view bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_RESULTS_RECORDING_FORMAT_H
