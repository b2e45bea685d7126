// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the recognition of formats.
#ifndef CELLWALK_IO_MESH_FORMAT_H
#define CELLWALK_IO_MESH_FORMAT_H

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

enum class Format { unknown, off, obj, stl, ply, ovm, poly, wkt, msh, medit, unv, foam, vtk, vtk_xml, csv };

/// The format by the first bytes; unknown if these are inconclusive.
Format format_by_content(std::string_view bytes);

/// The format that the content resembles: for files whose names do not show it, such as pipes.
Format guessed_format(std::string_view bytes);

/// Where the keyword of an OFF file ends within its first word: the number of vertices may follow without a
/// blank. 0 if it is none.
std::size_t end_of_off_keyword(std::string_view word);
inline constexpr std::string_view off_keyword = "OFF";

/// The format by the extension, without a final `.gz`.
Format format_by_extension(const std::filesystem::path& path);

/// The name of a format, such as "Gmsh".
std::string_view format_name(Format format);

/// The bytes of a file, inflated, and their format: by the content if that is conclusive, otherwise by the
/// extension.
struct Recognized_file {
  std::string bytes;
  Format format;
  std::string note;  ///< if content and extension contradict each other, otherwise empty
};
/// \param bytes as they lie in the file
/// \throw Error(input) if they cannot be inflated, or the file is empty
Recognized_file recognized_file(const std::filesystem::path& path, std::string bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FORMAT_H
