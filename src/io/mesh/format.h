// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: which format some bytes are in.
#ifndef CELLWALK_IO_MESH_FORMAT_H
#define CELLWALK_IO_MESH_FORMAT_H

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

enum class Format { unknown, off, obj, stl, ply, ovm, poly, wkt, msh, medit, unv, vtk, vtk_xml, csv };

/// By what the bytes begin with; unknown where that does not tell.
Format format_by_content(std::string_view bytes);

/// By the extension, `.gz` after it left out.
Format format_by_extension(const std::filesystem::path& path);

/// Such as "Gmsh".
std::string_view format_name(Format format);

/// The bytes of a file, inflated, and the format they are in: by the content where that tells, else by the
/// extension.
struct Recognized_file {
  std::string bytes;
  Format format;
  std::string note;  ///< where content and extension contradict each other, else empty
};
/// \throw Error(input) where the file cannot be read or is empty
Recognized_file load_recognized(const std::filesystem::path& path);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FORMAT_H
