// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the header of a PLY file.
#ifndef CELLWALK_IO_MESH_PLY_HEADER_H
#define CELLWALK_IO_MESH_PLY_HEADER_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::io {

enum class Ply_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Ply_encoding { text, little_endian, big_endian };

struct Ply_property {
  std::string name;
  Ply_type type;
  std::optional<Ply_type> count_type;  ///< of a list
};

struct Ply_element {
  std::string name;
  std::uint64_t count;
  std::vector<Ply_property> properties;

  /// The position of a property; none if there is none of that name and kind.
  std::optional<std::size_t> find(std::string_view property, bool list) const;
};

struct Ply_header {
  Ply_encoding encoding = Ply_encoding::text;
  std::vector<Ply_element> elements;
  std::size_t size = 0;   ///< bytes of the header: the data follow
  std::size_t lines = 0;  ///< lines of the header
};

/// \throw Error(input) with file and line if the header is malformed
Ply_header read_ply_header(const std::string& name, std::string_view bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_PLY_HEADER_H
